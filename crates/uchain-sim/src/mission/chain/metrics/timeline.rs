//! A run in a bounded number of moments.

use crate::{
    analyse::Thinned,
    mission::chain::{Frame, Moment},
    record::{RecordError, Recorder},
};

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

impl Recorder<Frame> for Timeline {
    fn frame(&mut self, frame: &Frame) -> Result<(), RecordError> {
        if frame.decision {
            self.kept.push(Moment::of(frame, self.lost_s));
        }
        Ok(())
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
