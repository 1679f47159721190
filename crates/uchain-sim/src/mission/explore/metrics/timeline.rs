//! An exploration in a bounded number of rounds.

use crate::{
    analyse::Thinned,
    mission::explore::{ExploreFrame, Odometer, Progress},
    record::{RecordError, Recorder},
};

/// Keeps rounds of an exploration, evenly spaced, at most twice as many as asked for, and the last one.
#[derive(Debug, Clone)]
pub struct ExploreTimeline {
    odometer: Odometer,
    kept: Thinned<Progress>,
}

impl ExploreTimeline {
    /// Keeps about so many rounds.
    pub fn new(wanted: usize) -> Self {
        Self { odometer: Odometer::default(), kept: Thinned::new(wanted) }
    }

    /// How far the exploration had come at the begin of the rounds kept, in order, and in the end.
    pub fn into_rounds(self) -> Vec<Progress> {
        self.kept.into_all()
    }
}

impl Recorder<ExploreFrame> for ExploreTimeline {
    fn frame(&mut self, frame: &ExploreFrame) -> Result<(), RecordError> {
        let progress = self.odometer.add(frame);
        if frame.decision || frame.stopped.is_some() {
            self.kept.push(progress);
        }
        Ok(())
    }
}
