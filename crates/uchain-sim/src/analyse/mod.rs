//! Frames in, numbers out.

mod compare;
mod digest;
pub mod explore;
mod metrics;
pub mod optimum;
mod plan;
mod summary;
mod timeline;

pub use compare::{Compare, Comparison, Difference, Value, Whose};
pub use digest::Digest;
pub use metrics::Metrics;
pub use plan::{Launch, MOST_LISTED, MOST_ROWS, Plan, PlanError, PlanRow, plan};
pub use summary::{LinkSummary, Summary};
pub use timeline::{ExploreTimeline, Timeline};
