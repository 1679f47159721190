//! The lines of a grid along one axis.

use super::{PLACES_MAX, TableError};

/// Coordinates nearer to each other than this are one (m).
const ONE_M: f64 = 1e-4;
/// How far from a line a place may lie, in steps.
const OFF: f64 = 0.01;

/// Evenly spaced lines.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Axis {
    first_m: f64,
    /// From line to line (m); 0 if there is one alone.
    pub(super) step_m: f64,
    pub(super) lines: usize,
}

impl Axis {
    /// The lines that all these coordinates (m) lie on, one at least.
    pub(super) fn of(axis: &'static str, mut at_m: Vec<f64>) -> Result<Self, TableError> {
        at_m.sort_by(f64::total_cmp);
        at_m.dedup_by(|next_m, before_m| *next_m - *before_m < ONE_M);
        let (Some(&first_m), Some(&last_m)) = (at_m.first(), at_m.last()) else {
            return Err(TableError::TooFewPlaces { got: 0 });
        };
        let gaps = || at_m.windows(2).map(|pair| pair[1] - pair[0]);
        let least_m = gaps().fold(f64::INFINITY, f64::min);
        if !least_m.is_finite() {
            return Ok(Self { first_m, step_m: 0.0, lines: 1 });
        }
        // Lines without a place are left out of a file: gap by gap, so that digits which a file cuts off do not add up.
        let steps: f64 = gaps().map(|gap_m| (gap_m / least_m).round()).sum();
        let most = PLACES_MAX * PLACES_MAX;
        if steps >= most as f64 {
            return Err(TableError::TooManyLines { axis, got: steps + 1.0, most });
        }
        let axis_of = Self { first_m, step_m: (last_m - first_m) / steps, lines: steps as usize + 1 };
        let off = |at_m: f64| (axis_of.steps_to(at_m) - axis_of.steps_to(at_m).round()).abs();
        match at_m.iter().find(|at_m| off(**at_m) > OFF) {
            Some(&got_m) => Err(TableError::Uneven { axis, got_m, first_m, step_m: least_m }),
            None => Ok(axis_of),
        }
    }

    fn steps_to(&self, at_m: f64) -> f64 {
        if self.lines > 1 { (at_m - self.first_m) / self.step_m } else { 0.0 }
    }

    /// The line next to a coordinate (m).
    pub(super) fn nearest(&self, at_m: f64) -> usize {
        (self.steps_to(at_m).round() as usize).min(self.lines - 1)
    }

    /// The lines before and behind a coordinate (m), each with its share; `None` more than half a step beyond the grid, and
    /// for what is no number. A line alone holds everywhere.
    pub(super) fn between(&self, at_m: f64) -> Option<((usize, f64), (usize, f64))> {
        let (steps, last) = (self.steps_to(at_m), self.lines - 1);
        if at_m.is_nan() || !(-0.5..=last as f64 + 0.5).contains(&steps) {
            return None;
        }
        let steps = steps.max(0.0).min(last as f64);
        let before = (steps as usize).min(last);
        let share = steps - before as f64;
        Some(((before, 1.0 - share), ((before + 1).min(last), share)))
    }
}
