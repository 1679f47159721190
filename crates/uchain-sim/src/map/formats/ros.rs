//! ROS `map_server` maps.

#[cfg(feature = "maps")]
pub(in crate::map) mod read;

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::{Fault, Format, MapFormat};
use crate::map::{CentreLine, Map, MapError, Unknown};

#[cfg(feature = "maps")]
pub use read::{read_ros, ros_in_memory, ros_picture};

pub(super) const FORMAT: Format = Format {
    table: "map.ros",
    name: "ROS map",
    keys: RosConfig::KEYS,
    ends: &["yaml", "yml", "pgm", "png"],
    sniff: is_ros,
};

/// A picture, or a text with the keys that `map_server` cannot do without.
fn is_ros(bytes: &[u8]) -> bool {
    let has = |key: &[u8]| bytes.split(|&byte| byte == b'\n').any(|line| line.starts_with(key));
    is_picture(bytes) || (has(b"image:") && has(b"resolution:"))
}

/// By its first bytes.
fn is_picture(bytes: &[u8]) -> bool {
    const PICTURES: [&[u8]; 8] = [b"\x89PNG\r\n\x1a\n", b"P1", b"P2", b"P3", b"P4", b"P5", b"P6", b"P7\n"];
    PICTURES.iter().any(|magic| bytes.starts_with(magic))
}

uchain_core::params! {
    /// A ROS `map_server` map.
    #[derive(Serialize, Deserialize)]
    #[serde(deny_unknown_fields)]
    pub struct RosConfig {
        /// Path of the yaml file, or of the picture alone (pgm, png; then `cell_m` has to
        /// be said), from the folder of the scenario file (from the working folder for a compiled-in scenario).
        pub file: PathBuf;
        /// What cells of unknown state are.
        #[serde(default)]
        pub unknown: Unknown;
        /// Side of a cell (m), instead of the file's own `resolution`; a picture alone does not say, and needs it.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[schemars(range(min = 0.001, max = 1000.0))]
        pub cell_m: Option<f64>;
        /// How far a simplified wall may lie from the cells' edge (m).
        /// - Source: ours
        #[serde(default = "default_simplify_m")]
        pub simplify_m: f64, in 0.0..=1.0;
    }
}

fn default_simplify_m() -> f64 {
    0.06
}

impl MapFormat for RosConfig {
    fn legal(&self) -> Result<(), Fault> {
        self.cell_m.map_or(Ok(()), |cell_m| Fault::range("cell_m", cell_m, 0.001, 1000.0))?;
        Ok(self.check()?)
    }

    fn lay(&self, folder: &Path, _: [f64; 2]) -> Result<(Map, Option<CentreLine>), MapError> {
        let file = folder.join(&self.file);
        read_ros(&file, self.unknown, self.cell_m, self.simplify_m).map(|map| (map, None))
    }
}

/// Without the feature `maps`, nothing is read.
///
/// # Errors
/// Always [`MapError::NoMapFiles`].
#[cfg(not(feature = "maps"))]
pub fn read_ros(yaml: &Path, _: Unknown, _: Option<f64>, _: f64) -> Result<Map, MapError> {
    Err(MapError::NoMapFiles { file: yaml.to_owned() })
}
