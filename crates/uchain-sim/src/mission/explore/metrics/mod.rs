//! What an exploration came to, from its frames.

#[cfg(feature = "sweep")]
mod columns;
mod gaps;
mod history;
mod metrics;
mod states;
mod summary;
mod timeline;

#[cfg(feature = "sweep")]
pub(super) use columns::COLUMNS;
pub use gaps::Gap;
pub use history::ExploreHistory;
pub use metrics::{ExploreMetrics, Survey};
pub use states::{Moment, States};
pub use summary::ExploreSummary;
pub use timeline::ExploreTimeline;
