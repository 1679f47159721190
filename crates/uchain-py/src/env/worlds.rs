//! The worlds of an environment: flights that wait at their decisions.

use std::sync::{
    Arc,
    atomic::{AtomicBool, Ordering},
};

use pyo3::{exceptions::PyValueError, prelude::*};
use uchain_core::{
    chain::{Follow, PilotInput},
    params::OutOfRange,
};
use uchain_sim::{
    clock::time_s,
    mission::chain::{Asked, Course, Flight, PilotStep},
    pilot,
};

use crate::own_law::Filling;

/// Why nothing has moved.
pub(super) enum Refused {
    /// A speed that is none.
    Speed(String),
    /// What no pilot may ask for.
    Pilot(String),
    /// Nothing can move.
    State(String),
}

/// All worlds.
pub(super) struct Worlds {
    flights: Vec<Flight>,
    relays: usize,
    /// Whether all are at their first decision.
    is_fresh: bool,
    /// A step has begun and not ended: worlds stand anywhere, until they are reset.
    is_half_done: bool,
}

/// The wall of this name.
pub(super) fn follow_of(word: &str) -> PyResult<Follow> {
    Follow::of_word(word).ok_or_else(|| {
        PyValueError::new_err(format!("follow = {word:?}: expected \"centre\", \"left\" or \"right\""))
    })
}

impl Worlds {
    pub(super) fn start(course: &Arc<Course>, worlds: usize, seed: u64, stop: &AtomicBool) -> Self {
        let relays = course.spawns.len().saturating_sub(1);
        let mut all = Self { flights: Vec::new(), relays, is_fresh: true, is_half_done: false };
        for world in 0..worlds {
            // Whoever was interrupted gets an exception in place of an environment.
            if stop.load(Ordering::Relaxed) {
                break;
            }
            all.flights.push(Flight::start(course, seed.saturating_add(world as u64)));
        }
        all
    }

    pub(super) fn reset(&mut self, seed: Option<u64>, stop: &AtomicBool) {
        self.is_half_done = true;
        for (world, flight) in self.flights.iter_mut().enumerate() {
            let seed = seed.map_or(flight.seed(), |seed| seed.saturating_add(world as u64));
            if stop.load(Ordering::Relaxed) {
                return;
            }
            flight.reset(seed);
        }
        (self.is_fresh, self.is_half_done) = (true, false);
    }

    /// Every world goes on to its next decision; `speeds` has a number for each relay of each.
    pub(super) fn step(
        &mut self,
        speeds: &[f32],
        pilots: Option<&[f32]>,
        follow: Option<Follow>,
        stop: Option<&AtomicBool>,
    ) -> Result<(), Refused> {
        self.may_move()?;
        let relays = self.relays;
        for (world, flight) in self.flights.iter_mut().enumerate() {
            let tick = flight.chain().tick();
            for Asked { uav, .. } in flight.asked() {
                let got = of(speeds, world, relays, *uav);
                if !got.is_finite() {
                    let time_s = time_s(tick);
                    return Err(Refused::Speed(format!(
                        "forward_mps[{world}, {}] = {got}, at tick {tick} ({time_s:.2} s) for UAV {uav}: expected a finite \
                         number (m/s), for this relay asks",
                        uav.saturating_sub(1)
                    )));
                }
            }
        }
        let follow = follow.unwrap_or_default();
        let pilots = pilots
            .unwrap_or_default()
            .iter()
            .map(|&speed_mps| (!speed_mps.is_nan()).then_some(PilotInput { speed_mps, follow }));
        let refused = |why: OutOfRange| Refused::Pilot(format!("pilot_mps: {why}"));
        // All of them are looked at before the first one steers.
        for input in pilots.clone().flatten() {
            PilotStep::from(pilot::Asked { tick: 0, input }).check().map_err(refused)?;
        }
        for (flight, input) in self.flights.iter_mut().zip(pilots) {
            input.map_or(Ok(()), |input| flight.steer(input)).map_err(refused)?;
        }
        (self.is_fresh, self.is_half_done) = (false, true);
        let mut level_mps = Vec::with_capacity(relays);
        for (world, flight) in self.flights.iter_mut().enumerate() {
            if stop.is_some_and(|stop| stop.load(Ordering::Relaxed)) {
                return Ok(());
            }
            level_mps.clear();
            level_mps.extend(flight.asked().iter().map(|asked| of(speeds, world, relays, asked.uav)));
            let gone_on = flight.go_on(&level_mps, &mut ());
            gone_on.map_err(|error| Refused::State(error.to_string()))?;
        }
        self.is_half_done = false;
        Ok(())
    }

    fn may_move(&self) -> Result<(), Refused> {
        self.is_there()?;
        if self.flights.iter().all(|flight| flight.stopped().is_some()) {
            let message = "all worlds are done, and nothing moves any more: reset() flies them again";
            return Err(Refused::State(message.to_owned()));
        }
        Ok(())
    }

    fn is_there(&self) -> Result<(), Refused> {
        if self.is_half_done {
            let message =
                "the last step was interrupted, and worlds stand anywhere: reset() flies them again";
            return Err(Refused::State(message.to_owned()));
        }
        Ok(())
    }

    /// What the relays know.
    pub(super) fn seen(&mut self) -> Result<Filling, Refused> {
        self.is_there()?;
        let relays = self.relays;
        let mut filling = Filling::new(self.flights.len() * relays);
        for (world, flight) in self.flights.iter_mut().enumerate() {
            let tick = flight.chain().tick();
            for relay in 0..relays {
                filling.stand(world * relays + relay, world, relay + 1, tick);
            }
            for asked in flight.asked() {
                if let Some(relay) = asked.uav.checked_sub(1) {
                    filling.ask(world * relays + relay, world, tick, asked);
                }
            }
        }
        Ok(filling)
    }

    pub(super) fn flights(&self) -> &[Flight] {
        &self.flights
    }

    pub(super) fn done(&self) -> Vec<bool> {
        self.flights.iter().map(|flight| flight.stopped().is_some()).collect()
    }

    pub(super) fn time_s(&self) -> Vec<f64> {
        self.flights.iter().map(|flight| time_s(flight.chain().tick())).collect()
    }

    pub(super) fn seeds(&self) -> Vec<u64> {
        self.flights.iter().map(Flight::seed).collect()
    }

    /// The seed of the first world, if all are at their first decision.
    pub(super) fn first_seed(&self) -> Option<u64> {
        self.flights.first().filter(|_| self.is_fresh && !self.is_half_done).map(Flight::seed)
    }

    /// What each has come to so far, as JSON.
    pub(super) fn summaries(&self) -> serde_json::Result<Vec<String>> {
        self.flights.iter().map(|flight| serde_json::to_string(&flight.summary())).collect()
    }
}

/// The speed of a relay; a UAV that is none has 0.
fn of(speeds: &[f32], world: usize, relays: usize, uav: usize) -> f32 {
    let relay = uav.checked_sub(1).and_then(|relay| speeds.get(world * relays + relay));
    relay.copied().unwrap_or(0.0)
}
