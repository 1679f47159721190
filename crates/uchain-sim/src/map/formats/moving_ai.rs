//! Grid maps of the MovingAI benchmarks.

#[cfg(feature = "maps")]
mod read;

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::{Fault, Format, MapFormat};
use crate::map::{CentreLine, Map, MapError};

#[cfg(feature = "maps")]
pub use read::read_moving_ai;

pub(super) const FORMAT: Format = Format {
    table: "map.movingai",
    name: "MovingAI grid",
    keys: MovingAiConfig::KEYS,
    ends: &["map"],
    sniff: |bytes| bytes.starts_with(b"type octile"),
};

uchain_core::params! {
    /// A grid map of the MovingAI benchmarks (`type octile`): `.`, `G` and `S` are free.
    #[derive(Serialize, Deserialize)]
    #[serde(deny_unknown_fields)]
    pub struct MovingAiConfig {
        /// Path of the map file, from the folder of the scenario file (from the working folder for a compiled-in
        /// scenario).
        pub file: PathBuf;
        /// Side of a cell (m); the file does not say.
        /// - Source: ours
        #[serde(default = "default_cell_m")]
        pub cell_m: f64, in 0.001..=1000.0;
    }
}

fn default_cell_m() -> f64 {
    0.5
}

impl MapFormat for MovingAiConfig {
    fn legal(&self) -> Result<(), Fault> {
        Ok(self.check()?)
    }

    fn lay(&self, folder: &Path, _: [f64; 2]) -> Result<(Map, Option<CentreLine>), MapError> {
        read_moving_ai(&folder.join(&self.file), self.cell_m).map(|map| (map, None))
    }
}

/// Without the feature `maps`, nothing is read.
///
/// # Errors
/// Always [`MapError::NoMapFiles`].
#[cfg(not(feature = "maps"))]
pub fn read_moving_ai(file: &Path, _: f64) -> Result<Map, MapError> {
    Err(MapError::NoMapFiles { file: file.to_owned() })
}
