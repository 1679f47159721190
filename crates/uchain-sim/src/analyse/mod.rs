//! Frames in, numbers out.

mod digest;
mod metrics;
pub mod optimum;
mod summary;

pub use digest::Digest;
pub use metrics::Metrics;
pub use summary::{LinkSummary, Summary};
