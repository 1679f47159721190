//! A run in a bounded number of moments.

use crate::record::{ExploreFrame, Frame, Moment, Odometer, Progress, RecordError, Recorder};

/// Keeps moments of the decisions, evenly spaced, at most twice as many as asked for, and the last one.
#[derive(Debug, Clone)]
pub struct Timeline {
    lost_s: f32,
    kept: Thinned<Moment>,
}

impl Timeline {
    /// Keeps about so many moments; a link that is silent for longer than `lost_s` connects nobody (s).
    pub fn new(wanted: usize, lost_s: f32) -> Self {
        Self { lost_s, kept: Thinned::new(wanted) }
    }

    /// The moments kept, in order.
    pub fn into_moments(self) -> Vec<Moment> {
        self.kept.into_all()
    }
}

impl Recorder for Timeline {
    fn frame(&mut self, frame: &Frame) -> Result<(), RecordError> {
        if frame.decision {
            self.kept.push(Moment::of(frame, self.lost_s));
        }
        Ok(())
    }
}

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

/// Keeps every first, second, fourth … of what comes, so that it is never too much.
#[derive(Debug, Clone)]
struct Thinned<T> {
    wanted: usize,
    kept: Vec<T>,
    last: Option<T>,
    stride: u64,
    seen: u64,
}

impl<T: Copy + PartialEq> Thinned<T> {
    fn new(wanted: usize) -> Self {
        Self { wanted: wanted.max(1), kept: Vec::new(), last: None, stride: 1, seen: 0 }
    }

    fn push(&mut self, next: T) {
        self.last = Some(next);
        if self.seen.is_multiple_of(self.stride) {
            self.kept.push(next);
        }
        self.seen += 1;
        if self.kept.len() >= 2 * self.wanted {
            let mut index = 0_u32;
            self.kept.retain(|_| {
                index += 1;
                index % 2 == 1
            });
            self.stride *= 2;
        }
    }

    fn into_all(mut self) -> Vec<T> {
        let last = self.last.filter(|last| self.kept.last() != Some(last));
        self.kept.extend(last);
        self.kept
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_run_is_kept_in_few_moments_with_its_first_and_last() {
        let mut timeline = Timeline::new(10, 1.0);
        for tick in 0..1000 {
            timeline.frame(&Frame { tick, decision: tick % 4 == 0, ..Frame::default() }).unwrap();
        }
        let times: Vec<f64> = timeline.into_moments().iter().map(|moment| moment.time_s).collect();
        assert!((10..=21).contains(&times.len()), "{times:?}");
        assert_eq!((times[0], times[times.len() - 1]), (0.0, 49.8));
    }
}
