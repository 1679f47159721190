//! Cave surveys, as Survex writes them (`.3d`): the passages along their legs, seen from above.

#[cfg(feature = "drawings")]
mod cave;
#[cfg(feature = "drawings")]
mod choose;
#[cfg(feature = "drawings")]
mod convex;
#[cfg(feature = "drawings")]
mod draw;
#[cfg(feature = "drawings")]
mod levels;
#[cfg(feature = "drawings")]
mod name;
#[cfg(feature = "drawings")]
mod read;
#[cfg(all(test, feature = "drawings"))]
mod tests;

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::{Fault, Format, MapFormat};
use crate::map::{CentreLine, Map, MapError};

/// What every file starts with.
const MAGIC: &[u8] = b"Survex 3D Image File";

pub(super) const FORMAT: Format = Format {
    table: "map.survex",
    name: "Survex survey",
    keys: SurvexConfig::KEYS,
    ends: &["3d"],
    sniff: |bytes| bytes.starts_with(MAGIC),
};

uchain_core::params! {
    /// A cave survey of Survex (`.3d`): its passages, seen from above. All of them, or those on the way from one station to
    /// another.
    #[derive(Serialize, Deserialize)]
    #[serde(deny_unknown_fields)]
    pub struct SurvexConfig {
        /// Path of the file, from the folder of the scenario file (from the working folder for a compiled-in scenario).
        pub file: PathBuf;
        /// Station where the way begins, by its name or the last parts of it; without `to`, the station around which a
        /// whole cave is kept first (an entrance otherwise).
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pub from: Option<String>;
        /// Station where the way ends; then the map is the shortest way there from `from`, and no more.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pub to: Option<String>;
        /// How far passages beside that way belong to the map, along the survey (m).
        /// - Source: ours
        #[serde(default)]
        pub branch_m: f64, in 0.0..=100_000.0;
        /// Width of passages where nobody has measured it (m), instead of the median of the measured ones (2 m without
        /// any).
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[schemars(range(min = 0.2, max = 100.0))]
        pub missing_width_m: Option<f64>;
        /// Passages that lie over one another with more than this between their heights are kept apart; with less, they
        /// are one (m).
        /// - Source: ours
        #[serde(default = "default_level_gap_m")]
        pub level_gap_m: f64, in 0.0..=10_000.0;
    }
}

fn default_level_gap_m() -> f64 {
    2.0
}

impl MapFormat for SurvexConfig {
    fn legal(&self) -> Result<(), Fault> {
        let missing_width_m = self.missing_width_m;
        missing_width_m.map_or(Ok(()), |width_m| Fault::range("missing_width_m", width_m, 0.2, 100.0))?;
        if let (Some(to), None) = (&self.to, &self.from) {
            let expected = "needs from: the station where the way begins".to_owned();
            return Err(Fault { key: "to".to_owned(), got: to.clone(), expected });
        }
        Ok(self.check()?)
    }

    fn lay(&self, folder: &Path, _: [f64; 2]) -> Result<(Map, Option<CentreLine>), MapError> {
        read_survex(&folder.join(&self.file), self).map(|map| (map, None))
    }
}

/// The passages of a survey. The file is `file`, whatever the settings call it.
///
/// # Errors
/// No such file, or no survey; a station that is not in it, or that no way leads to; a way that crosses itself at another
/// height.
#[cfg(feature = "drawings")]
pub fn read_survex(file: &Path, settings: &SurvexConfig) -> Result<Map, MapError> {
    let bytes = crate::map::raster::read(file, read::MOST_BYTES)
        .map_err(|why| MapError::Read { file: file.to_owned(), why })?;
    survex_in_memory(file, &bytes, settings)
}

/// The passages of a survey that is in memory; messages call it `file`.
///
/// # Errors
/// As [`read_survex`].
#[cfg(feature = "drawings")]
pub fn survex_in_memory(file: &Path, bytes: &[u8], settings: &SurvexConfig) -> Result<Map, MapError> {
    let survey = read::read(bytes).map_err(|why| MapError::Read { file: file.to_owned(), why })?;
    draw::map(survey, settings, file)
}

/// Without the feature `drawings`, nothing is read.
///
/// # Errors
/// Always [`MapError::NoMapFiles`].
#[cfg(not(feature = "drawings"))]
pub fn read_survex(file: &Path, _: &SurvexConfig) -> Result<Map, MapError> {
    Err(MapError::NoMapFiles { file: file.to_owned() })
}
