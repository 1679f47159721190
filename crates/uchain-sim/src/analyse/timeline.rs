//! A run in a bounded number of moments.

use crate::record::{Frame, Moment, RecordError, Recorder};

/// Keeps moments of the decisions, evenly spaced, at most twice as many as asked for, and the last one.
#[derive(Debug, Clone)]
pub struct Timeline {
    limit_db: f32,
    wanted: usize,
    moments: Vec<Moment>,
    last: Option<Moment>,
    stride: u64,
    decisions: u64,
}

impl Timeline {
    /// Keeps about so many moments; from `limit_db` on nothing is received (dB).
    pub fn new(wanted: usize, limit_db: f32) -> Self {
        let wanted = wanted.max(1);
        Self { limit_db, wanted, moments: Vec::new(), last: None, stride: 1, decisions: 0 }
    }

    /// The moments kept, in order.
    pub fn into_moments(mut self) -> Vec<Moment> {
        let last = self.last.filter(|last| self.moments.last() != Some(last));
        self.moments.extend(last);
        self.moments
    }
}

impl Recorder for Timeline {
    fn frame(&mut self, frame: &Frame) -> Result<(), RecordError> {
        if !frame.decision {
            return Ok(());
        }
        let moment = Moment::of(frame, self.limit_db);
        self.last = Some(moment);
        if self.decisions.is_multiple_of(self.stride) {
            self.moments.push(moment);
        }
        self.decisions += 1;
        if self.moments.len() >= 2 * self.wanted {
            let mut index = 0_u32;
            self.moments.retain(|_| {
                index += 1;
                index % 2 == 1
            });
            self.stride *= 2;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_run_is_kept_in_few_moments_with_its_first_and_last() {
        let mut timeline = Timeline::new(10, 100.0);
        for tick in 0..1000 {
            timeline.frame(&Frame { tick, decision: tick % 4 == 0, ..Frame::default() }).unwrap();
        }
        let times: Vec<f64> = timeline.into_moments().iter().map(|moment| moment.time_s).collect();
        assert!((10..=21).contains(&times.len()), "{times:?}");
        assert_eq!((times[0], times[times.len() - 1]), (0.0, 49.8));
    }
}
