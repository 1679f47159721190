//! What a chain came to, from its frames.

#[cfg(feature = "sweep")]
mod columns;
mod head;
mod metrics;
mod summary;
mod timeline;
mod verdict;

#[cfg(feature = "sweep")]
pub(super) use columns::COLUMNS;
pub use metrics::Metrics;
pub use summary::{LinkSummary, Summary};
pub use timeline::Timeline;
