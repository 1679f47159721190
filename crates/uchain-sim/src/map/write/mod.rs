//! Maps as files that others read, and that [`MapConfig`](super::MapConfig) reads again.

mod csv;
#[cfg(feature = "drawings")]
mod geojson;
#[cfg(feature = "drawings")]
mod parts;
mod ros;
#[cfg(all(test, feature = "drawings"))]
mod round_trip;
#[cfg(feature = "drawings")]
mod svg;
#[cfg(all(test, feature = "maps"))]
mod tests;

pub use csv::write_csv;
#[cfg(feature = "drawings")]
pub use geojson::write_geojson;
pub use ros::RosCells;
pub(crate) use ros::{pgm, yaml};
#[cfg(feature = "drawings")]
pub use svg::write_svg;
