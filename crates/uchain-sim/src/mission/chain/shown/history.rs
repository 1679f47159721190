//! Frames of a chain that are kept for a picture, in bounded memory.

use uchain_core::bounded;

use super::super::{Chain, Course, Frame, History};
use crate::{
    mission,
    record::{RecordError, Recorder},
};

/// Most UAV places kept for the picture, and the bounds on frames that follow from it.
const PLACES_MAX: usize = 2_000_000;
const FRAMES: (usize, usize) = (500, 8000);

/// Keeps decision frames for a picture: all of a short run, every 2nd, 4th, … of a long one, and the last one.
#[derive(Debug, Clone)]
pub struct ThinnedHistory {
    history: History,
    frames_max: usize,
    stride: u64,
    decisions: u64,
    last: Frame,
}

impl ThinnedHistory {
    /// Of a chain of so many UAVs.
    pub fn new(uavs: usize) -> Self {
        Self {
            history: History::default(),
            frames_max: bounded(PLACES_MAX / uavs.max(1), FRAMES.0, FRAMES.1),
            stride: 1,
            decisions: 0,
            last: Frame::default(),
        }
    }

    /// The frames kept, the last one included.
    pub fn to_the_end(&mut self) -> &History {
        if self.history.frames.last().is_some_and(|kept| kept.tick < self.last.tick) {
            self.history.frames.push(self.last.clone());
        }
        &self.history
    }
}

impl Recorder<Frame> for ThinnedHistory {
    fn frame(&mut self, frame: &Frame) -> Result<(), RecordError> {
        if !frame.decision {
            return Ok(());
        }
        self.last.clone_from(frame);
        if self.decisions.is_multiple_of(self.stride) {
            self.history.frames.push(frame.clone());
        }
        self.decisions += 1;
        if self.history.frames.len() >= self.frames_max {
            let mut index = 0_u32;
            self.history.frames.retain(|_| {
                index += 1;
                index % 2 == 1
            });
            self.stride *= 2;
        }
        Ok(())
    }
}

impl mission::History for ThinnedHistory {
    type Mission = Chain;

    fn of(course: &Course) -> Self {
        Self::new(course.spawns.len())
    }

    fn progress(&self, frame: &Frame) -> String {
        format!("{:.0} s", frame.time_s())
    }
}
