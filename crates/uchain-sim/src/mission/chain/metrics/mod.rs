//! What a chain came to, from its frames.

#[cfg(feature = "sweep")]
mod columns;
mod head;
mod summary;
mod tally;
mod timeline;
mod verdict;

#[cfg(feature = "sweep")]
pub(super) use columns::COLUMNS;
pub use summary::{LinkSummary, Summary};
pub use tally::Metrics;
pub use timeline::Timeline;
