//! A flight that waits at every decision for whoever levels its relays.

use std::sync::Arc;

use uchain_core::{
    chain::{Command, PilotInput},
    params::OutOfRange,
};

use super::{Asked, Chain, Course, Frame, Summary};
use crate::{
    mission::{Mission as _, Stopped, UnderWay},
    record::{RecordError, Recorder},
};

/// A chain whose relays are levelled from outside, at whatever time: it stands at a decision, says who asks, and goes on to
/// the next decision with what they get. With [`equalize`](uchain_core::chain::equalize) it is the flight of
/// [`run`](crate::run::run).
///
/// ```
/// use uchain_libm as _; // the same bits on every system
/// use uchain_core::chain::equalize;
/// use uchain_sim::{config::builtin, mission::chain::{Course, Flight}, run::run};
/// let course = Course::read(&builtin("corner").unwrap(), &["duration_s=90".into()]).unwrap();
/// let mut flight = Flight::start(&course, 1);
/// while flight.stopped().is_none() {
///     let speed = |asked: &uchain_sim::mission::chain::Asked| {
///         equalize(asked.levelling.back_db, asked.levelling.front_db, &course.scenario.equalize)
///     };
///     let level_mps: Vec<f32> = flight.asked().iter().map(speed).collect();
///     flight.go_on(&level_mps, &mut ()).unwrap();
/// }
/// assert_eq!(flight.summary(), run(&course, 1, &mut ()).unwrap());
/// ```
#[derive(Debug)]
pub struct Flight {
    under_way: UnderWay<Chain>,
    commands: Vec<Command>,
    stopped: Option<Stopped>,
}

impl Flight {
    /// At its first decision. A [`Leveller`](super::Leveller) of the course is not asked; brains of one's own decide as a whole,
    /// and ask for nothing.
    pub fn start(course: &Arc<Course>, seed: u64) -> Self {
        Self { under_way: UnderWay::start(course, seed), commands: Vec::new(), stopped: None }
    }

    /// As [`Flight::start`] would make it of the same course, in the memory it has.
    pub fn reset(&mut self, seed: u64) {
        self.under_way.reset(seed);
        self.stopped = None;
    }

    /// The relays that ask for a speed at this decision, by id; nobody once it is over.
    pub fn asked(&mut self) -> &[Asked] {
        if self.stopped.is_some() { &[] } else { self.under_way.mission_mut().prepare() }
    }

    /// Goes on to the next decision, or to its end, with forward speeds for those that asked (m/s), in their order. Once it is
    /// over nothing moves any more.
    ///
    /// # Errors
    /// Only the recorder's own.
    pub fn go_on(
        &mut self,
        level_mps: &[f32],
        recorder: &mut impl Recorder<Frame>,
    ) -> Result<Option<Stopped>, RecordError> {
        if self.stopped.is_none() {
            self.under_way.mission_mut().conclude(level_mps, &mut self.commands);
            self.stopped = self.under_way.act(&self.commands, recorder)?;
            while self.stopped.is_none() && !self.under_way.mission().is_decision() {
                self.stopped = self.under_way.tick(recorder)?;
            }
        }
        Ok(self.stopped)
    }

    /// What the pilot asks for from the next tick on that has not been sensed yet: the one after this decision's.
    ///
    /// # Errors
    /// Those of [`Mission::steer`](crate::mission::Mission::steer).
    pub fn steer(&mut self, input: PilotInput) -> Result<(), OutOfRange> {
        self.under_way.mission_mut().steer(input)
    }

    /// Why it is over, if it is.
    pub fn stopped(&self) -> Option<Stopped> {
        self.stopped
    }

    /// The chain: bodies, members, what its UAVs believe.
    pub fn chain(&self) -> &Chain {
        self.under_way.mission()
    }

    /// What the last tick left behind; empty before the first one.
    pub fn frame(&self) -> &Frame {
        self.under_way.mission().frame()
    }

    /// Its seed.
    pub fn seed(&self) -> u64 {
        self.under_way.seed()
    }

    /// What it has come to so far.
    pub fn summary(&self) -> Summary {
        self.under_way.summary()
    }
}
