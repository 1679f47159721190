//! Whether a node's tunables are ones it can fly by.

use super::NodeParams;
use crate::params::OutOfRange;

impl NodeParams {
    /// Least and most that `tof_range_m` may be (m), both included.
    pub const TOF_RANGE_LIMITS_M: (f32, f32) = (0.1, 100.0);

    /// The first tunable outside its range. A node flies by what it was made with, so whoever reads tunables from a file or
    /// a parameter store asks this before [`Node::new`](super::Node::new): within the ranges nothing a node sees makes it ask
    /// for what is no number.
    ///
    /// # Errors
    /// [`OutOfRange`] names the field, what it is and what it may be.
    ///
    /// ```
    /// use uchain_core::chain::NodeParams;
    /// let mut params = NodeParams::default();
    /// assert!(params.check().is_ok());
    /// params.tof_range_m = f32::INFINITY;
    /// assert_eq!(params.check().unwrap_err().key, "tof_range_m");
    /// ```
    pub fn check(&self) -> Result<(), OutOfRange> {
        self.kalman.check()?;
        self.equalize.check()?;
        self.center.check()?;
        self.takeoff.check()?;
        self.link.check()?;
        let (low, high) = Self::TOF_RANGE_LIMITS_M;
        if !(low..=high).contains(&self.tof_range_m) {
            let (got, low, high) = (self.tof_range_m.into(), low.into(), high.into());
            return Err(OutOfRange { key: "tof_range_m", got, low, high });
        }
        Ok(())
    }
}
