//! The same flight once more, to any tick: what a film does not hold is flown again, and who asks why needs a mission that
//! stands there.

use std::sync::Arc;

use uchain_sim::{
    mission::Mission,
    pilot::Asked,
    record::Snapshot as _,
    run::{FrameOf, InputOf},
};

use crate::seen::Viewed;

/// Ticks of one UAV that are flown before a page is answered: some milliseconds.
const MOST_AT_ONCE: u64 = 20_000;

/// A mission that is flown to where somebody looks.
#[derive(Debug)]
pub(super) struct Again<S: Viewed> {
    mission: Option<S::Mission>,
    next: usize,
    read: S::Read,
}

impl<S: Viewed> Default for Again<S> {
    fn default() -> Self {
        Self { mission: None, next: 0, read: S::Read::default() }
    }
}

impl<S: Viewed> Again<S> {
    /// Flies on toward the end of a tick, from the start if it was past it; whether it stands there. As far as it comes in
    /// some milliseconds: ask again.
    pub(super) fn seek(
        &mut self,
        scene: &Arc<S>,
        seed: u64,
        inputs: &[Asked<InputOf<S>>],
        tick: u64,
    ) -> bool {
        let mission = self.mission.get_or_insert_with(|| S::Mission::start(scene.clone(), seed));
        if mission.frame().tick() > tick {
            mission.reset(seed);
            (self.next, self.read) = (0, S::Read::default());
        }
        let most = MOST_AT_ONCE / (scene.crew() as u64 + 4);
        for _ in 0..most {
            let now = mission.frame().tick();
            if now >= tick {
                break;
            }
            steer(mission, inputs, &mut self.next);
            // Nobody listens who could say no.
            if mission.step(&mut ()).is_err() {
                break;
            }
            S::read_on(&mut self.read, mission.frame());
        }
        mission.frame().tick() == tick
    }

    /// What the mission has left behind where it stands.
    pub(super) fn mission(&self) -> Option<&S::Mission> {
        self.mission.as_ref()
    }

    /// What was read up to there.
    pub(super) fn read(&self) -> &S::Read {
        &self.read
    }

    /// The frame that a film would keep of that.
    pub(super) fn kept(&self) -> Option<FrameOf<S>> {
        self.mission.as_ref().map(|mission| S::kept(mission.frame(), &self.read))
    }
}

/// Asks a mission for what its pilot asks at this tick, if it is something new; inputs that are out of range were refused
/// when they came.
pub(super) fn steer<M: Mission>(mission: &mut M, inputs: &[Asked<M::Input>], next: &mut usize) {
    let now = mission.frame().tick();
    while let Some(asked) = inputs.get(*next).filter(|asked| asked.tick <= now) {
        if asked.tick == now {
            // Checked when it came.
            let _ = mission.steer(asked.input.clone());
        }
        *next += 1;
    }
}
