//! What many runs say together.

use serde::Serialize;
use statrs::distribution::{ContinuousCDF as _, StudentsT};

/// Share of intervals that hold the true mean.
const CONFIDENCE: f64 = 0.95;

/// Mean and median of a sample, and how well the mean is known; all in the unit of the sample.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Estimate {
    /// How many values.
    pub count: usize,
    /// Mean.
    pub mean: f64,
    /// Half of the 95 % interval around the mean, by Student's t; `None` of one value.
    pub half_width: Option<f64>,
    /// Of something that is never below 0, such as a count: there its interval is cut.
    #[serde(skip)]
    pub is_never_negative: bool,
    /// Median; the mean of the two middle values of an even number.
    pub median: f64,
}

impl Estimate {
    /// Of a sample; `None` of an empty one.
    ///
    /// ```
    /// use uchain_sim::analyse::Estimate;
    /// let estimate = Estimate::of(&[1.0, 2.0, 3.0, 4.0]).unwrap();
    /// assert_eq!((estimate.mean, estimate.median), (2.5, 2.5));
    /// assert!((estimate.half_width.unwrap() - 2.054).abs() < 0.001); // 3.182 · 1.291 / √4
    /// ```
    pub fn of(sample: &[f64]) -> Option<Self> {
        let count = sample.len();
        let n = count as f64;
        let mean = sample.iter().sum::<f64>() / n;
        let mut sorted = sample.to_vec();
        sorted.sort_by(f64::total_cmp);
        let upper = *sorted.get(count / 2)?;
        let median = if count % 2 == 1 { upper } else { f64::midpoint(*sorted.get(count / 2 - 1)?, upper) };
        let half_width = StudentsT::new(0.0, 1.0, n - 1.0).ok().map(|t| {
            let variance =
                sample.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>() / (n - 1.0);
            t.inverse_cdf(f64::midpoint(1.0, CONFIDENCE)) * (variance / n).sqrt()
        });
        Some(Self { count, mean, half_width, is_never_negative: false, median })
    }

    /// Of a sample of something that is never below 0, such as a count or a time. Its mean is not below 0 either, so
    /// what the interval loses by the cut never holds it: the confidence stays.
    ///
    /// ```
    /// use uchain_sim::analyse::Estimate;
    /// let contacts = [0.0, 0.0, 0.0, 1.0];
    /// assert!(Estimate::of(&contacts).unwrap().interval().0 < -0.5);
    /// assert_eq!(Estimate::of_never_negative(&contacts).unwrap().interval().0, 0.0);
    /// ```
    pub fn of_never_negative(sample: &[f64]) -> Option<Self> {
        // Who is wrong about it is not contradicted by an interval without the mean.
        let is_so = sample.iter().all(|value| *value >= 0.0);
        Some(Self { is_never_negative: is_so, ..Self::of(sample)? })
    }

    /// Ends of the 95 % interval around the mean, or the mean twice.
    pub fn interval(&self) -> (f64, f64) {
        let half = self.half_width.unwrap_or(0.0);
        let low = self.mean - half;
        (if self.is_never_negative { low.max(0.0) } else { low }, self.mean + half)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::seed::{Seed, Source};

    #[test]
    fn nineteen_of_twenty_intervals_hold_the_true_mean() {
        let trials = 2000;
        let holds = |trial: u64| {
            let mut stream = Seed(trial).stream(0, Source::Start);
            let sample: Vec<f64> = (0..5).map(|_| f64::from(stream.normal()) + 3.0).collect();
            let (low, high) = Estimate::of(&sample).unwrap().interval();
            (low..=high).contains(&3.0)
        };
        let share = (0..trials).filter(|trial| holds(*trial)).count() as f64 / trials as f64;
        assert!((share - 0.95).abs() < 0.015, "{share}");
    }

    #[test]
    fn one_value_has_no_interval_and_none_has_nothing() {
        assert_eq!(Estimate::of(&[]), None);
        let one = Estimate::of(&[2.0]).unwrap();
        assert_eq!((one.half_width, one.interval()), (None, (2.0, 2.0)));
        assert_eq!(Estimate::of(&[5.0, 5.0]).unwrap().half_width, Some(0.0));
    }
}
