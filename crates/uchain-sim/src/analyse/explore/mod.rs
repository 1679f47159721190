//! What an exploration came to, from its frames.

mod coverage;
mod ground;
mod history;
mod metrics;
mod ros_map;
mod summary;

pub use coverage::{Coverage, Unseen};
pub use ground::Ground;
pub use history::ExploreHistory;
pub use metrics::{ExploreMetrics, Survey};
pub use ros_map::RosMap;
pub use summary::ExploreSummary;
