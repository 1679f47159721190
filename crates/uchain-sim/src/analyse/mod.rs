//! Frames in, numbers out.

mod chain;
mod compare;
mod digest;
pub mod explore;
pub mod optimum;
mod outcome;
mod plan;
#[cfg(feature = "sweep")]
mod significance;
#[cfg(feature = "sweep")]
mod stats;
mod timeline;

pub use chain::{LinkSummary, Metrics, Summary};
pub use compare::{Compare, Comparison, Difference, Value, Whose};
pub use digest::Digest;
pub use outcome::{Break, Outcome, Over, Remedy, Verdict, Way};
pub use plan::{Launch, MOST_LISTED, MOST_ROWS, Plan, PlanError, PlanRow, plan};
#[cfg(feature = "sweep")]
pub use significance::{Tendency, is_less_in_pairs, is_rarer_in_pairs, saved_percent, tends_to_be_less};
#[cfg(feature = "sweep")]
pub use stats::Estimate;
pub use timeline::{ExploreTimeline, Timeline};
