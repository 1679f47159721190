//! A number in steps, as the wire holds it.

use crate::bounded;

/// How a field is counted.
pub(super) struct Step {
    /// Steps in one unit.
    pub(super) per_unit: f32,
    /// The least and the most steps that the field holds.
    pub(super) low: f32,
    pub(super) high: f32,
}

pub(super) const SPEED_MPS: Step = Step { per_unit: 1024.0, low: i16::MIN as f32, high: i16::MAX as f32 };
pub(super) const FLOWN_S: Step = Step { per_unit: 20.0, low: 0.0, high: u16::MAX as f32 };
pub(super) const IMBALANCE_DB: Step = Step { per_unit: 64.0, low: 0.0, high: u16::MAX as f32 };
pub(super) const BATTERY: Step = Step { per_unit: 254.0, low: 0.0, high: 254.0 };

impl Step {
    /// The nearest whole number of steps within the field's range; `None` of what is no finite number.
    pub(super) fn count(&self, value: f32) -> Option<f32> {
        value.is_finite().then(|| libm::roundf(bounded(value * self.per_unit, self.low, self.high)))
    }

    /// So many steps as a number. Divided, not multiplied by a rounded step: a decimal number that is a whole number of
    /// steps comes out as the nearest `f32` of it.
    pub(super) fn value(&self, steps: impl Into<f32>) -> f32 {
        steps.into() / self.per_unit
    }
}
