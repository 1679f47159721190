//! What an exploration came to, from its frames.

mod coverage;
mod gaps;
mod ground;
mod history;
mod metrics;
mod passages;
mod ros_map;
mod states;
mod summary;

pub use coverage::{Coverage, Unseen};
pub use gaps::Gap;
pub use ground::Ground;
pub use history::ExploreHistory;
pub use metrics::{ExploreMetrics, Survey};
pub(crate) use passages::width_but_for_m;
pub use passages::{Passage, Passages, Width};
pub use ros_map::RosMap;
pub use states::{Moment, States};
pub use summary::ExploreSummary;
