//! Frames in, numbers out.

mod digest;
pub mod explore;
mod metrics;
pub mod optimum;
mod plan;
mod summary;

pub use digest::Digest;
pub use metrics::Metrics;
pub use plan::{Launch, MOST_LISTED, MOST_ROWS, Plan, PlanError, PlanRow, plan};
pub use summary::{LinkSummary, Summary};
