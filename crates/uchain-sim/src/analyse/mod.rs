//! Frames in, numbers out.

mod digest;
mod metrics;
mod summary;

pub use digest::Digest;
pub use metrics::Metrics;
pub use summary::{LinkSummary, Summary};
