//! Watching a run of whatever mission.

use std::ops::ControlFlow;

use crate::{
    clock::time_s,
    record::{RecordError, Recorder, Snapshot},
};

/// How far a run has come.
pub struct Now<'a> {
    /// Ticks since the start.
    pub tick: u64,
    /// Whether somebody decided at the start of this tick.
    pub is_decision: bool,
    /// Says it in words.
    pub words: &'a dyn Fn() -> String,
}

impl Now<'_> {
    /// Simulated time at the end of the tick (s).
    pub fn time_s(&self) -> f64 {
        time_s(self.tick)
    }
}

/// Someone who is told at every tick how far a run has come, and can stop it.
pub trait Watch {
    /// One tick has passed; to break off is to be interrupted.
    fn tick(&mut self, now: &Now<'_>) -> ControlFlow<()>;
}

impl Watch for () {
    fn tick(&mut self, _: &Now<'_>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

/// Shows somebody who watches the frames of whatever mission.
pub(super) struct Watched<'a>(pub(super) &'a mut dyn Watch);

impl<F: Snapshot> Recorder<F> for Watched<'_> {
    fn frame(&mut self, frame: &F) -> Result<(), RecordError> {
        tell(self.0, frame, &String::new)
    }
}

/// Tells somebody who watches of a frame.
pub(super) fn tell<F: Snapshot>(
    watch: &mut dyn Watch,
    frame: &F,
    words: &dyn Fn() -> String,
) -> Result<(), RecordError> {
    let now = Now { tick: frame.tick(), is_decision: frame.is_decision(), words };
    match watch.tick(&now) {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(RecordError::Interrupted { time_s: now.time_s() }),
    }
}
