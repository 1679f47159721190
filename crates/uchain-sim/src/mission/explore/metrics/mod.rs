//! What an exploration came to, from its frames.

#[cfg(feature = "sweep")]
mod columns;
mod gaps;
mod history;
mod states;
mod summary;
mod tally;
mod timeline;

#[cfg(feature = "sweep")]
pub(super) use columns::COLUMNS;
pub use gaps::Gap;
pub use history::ExploreHistory;
pub use states::{Moment, States};
pub use summary::ExploreSummary;
pub use tally::{ExploreMetrics, Survey};
pub use timeline::ExploreTimeline;
