//! What a chain came to, from its frames.

mod head;
mod metrics;
mod summary;
mod timeline;
mod verdict;

pub use metrics::Metrics;
pub use summary::{LinkSummary, Summary};
pub use timeline::Timeline;
