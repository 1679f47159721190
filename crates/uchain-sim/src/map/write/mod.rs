//! Maps as files that others read, and that [`MapConfig`](super::MapConfig) reads again.

mod csv;
mod ros;
#[cfg(all(test, feature = "maps"))]
mod tests;

pub use csv::write_csv;
pub use ros::RosCells;
pub(crate) use ros::{pgm, yaml};
