//! Why there is no plan.

use super::MOST_ROWS;
use crate::mission::chain::Farthest;

/// Why there is no plan.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PlanError {
    /// Depth means nothing here.
    #[error("nobody knows the middle of this map's tunnel: say where the head is to go with chain.goal_m")]
    NoTunnel,
    /// Depth means nothing here, but there are passages.
    #[error(
        "nobody knows the middle of this map's tunnel: say where the head is to go with chain.goal_m (--goal); {0}"
    )]
    NoGoal(Farthest),
    /// A depth the tunnel does not have.
    #[error("to_m = {to_m}: the tunnel ends {length_m:.2} m from the base")]
    Beyond {
        /// The depth asked for (m).
        to_m: f64,
        /// Greatest depth (m).
        length_m: f64,
    },
    /// A quantity outside its range.
    #[error("{key} = {got}: must be more than 0")]
    NotPositive {
        /// The quantity.
        key: &'static str,
        /// What was given.
        got: f64,
    },
    /// A quantity outside its range.
    #[error("{key} = {got}: must lie in 0..={most}")]
    OutOfRange {
        /// The quantity.
        key: &'static str,
        /// What was given.
        got: f64,
        /// Its largest value.
        most: f64,
    },
    /// Too fine.
    #[error("step_m = {step_m}: {to_m} m in such steps are more than {MOST_ROWS} rows")]
    Rows {
        /// The step asked for (m).
        step_m: f64,
        /// The depth asked for (m).
        to_m: f64,
    },
    /// Nobody wants it any more.
    #[error("interrupted")]
    Interrupted,
}
