//! GeoJSON.
//!
//! The rule: polygons are rock, lines are walls; a property `kind` says otherwise (`free`: free space, for a line a passage as wide
//! as its `thickness_m`; `wall`, for a polygon its outline; `ignore`). `material`, `loss_db` and `thickness_m` say what a wall is.
//! Points with a `name` are places. Coordinates are longitude and latitude (RFC 7946), laid out about their middle; they are
//! metres where the key `metres`, a member `units` = `m` or a `crs` other than longitude and latitude says so, and where
//! they lie beyond ±180 or ±90.

#[cfg(feature = "drawings")]
pub(in crate::map) mod read;

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::{Fault, Format, MapFormat};
use crate::map::{CentreLine, Map, MapError, Outside};

#[cfg(feature = "drawings")]
pub use read::geojson_in_memory;

pub(super) const FORMAT: Format = Format {
    table: "map.geojson",
    name: "GeoJSON",
    keys: GeojsonConfig::KEYS,
    ends: &["geojson", "json"],
    sniff: |bytes| {
        let text = String::from_utf8_lossy(bytes);
        let kinds = ["Feature", "FeatureCollection", "GeometryCollection", "Polygon", "LineString"];
        let mut kinds = kinds.iter().flat_map(|kind| [format!("\"{kind}\""), format!("\"Multi{kind}\"")]);
        text.trim_start().starts_with('{')
            && text.contains("\"type\"")
            && kinds.any(|kind| text.contains(&kind))
    },
};

uchain_core::params! {
    /// A GeoJSON file: polygons are rock, lines are walls; a property `kind` (rock, free, wall, ignore) says otherwise. Properties
    /// `material`, `loss_db` and `thickness_m` say what a wall is; points with a `name` are places. Longitude and latitude are
    /// laid out in metres about their middle.
    #[derive(Serialize, Deserialize)]
    #[serde(deny_unknown_fields)]
    pub struct GeojsonConfig {
        /// Path of the file, from the folder of the scenario file (from the working folder for a compiled-in scenario).
        pub file: PathBuf;
        /// Coordinates are metres, even where they could be degrees.
        #[serde(default)]
        pub metres: bool;
        /// Thickness of a wall that does not say its own (m).
        /// - Source: ours
        #[serde(default = "default_wall_m")]
        pub wall_m: f64, in 0.01..=100.0;
        /// Edges shorter than this are drawn together (m); for want of it 0.01, or 0 for a file that uchain wrote.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[schemars(range(min = 0.0, max = 10.0))]
        pub snap_m: Option<f64>;
        /// What lies outside of all walls, where nothing is drawn as free.
        #[serde(default)]
        pub outside: Outside;
    }
}

fn default_wall_m() -> f64 {
    0.1
}

impl MapFormat for GeojsonConfig {
    fn legal(&self) -> Result<(), Fault> {
        self.snap_m.map_or(Ok(()), |snap_m| Fault::range("snap_m", snap_m, 0.0, 10.0))?;
        Ok(self.check()?)
    }

    fn lay(&self, folder: &Path, _: [f64; 2]) -> Result<(Map, Option<CentreLine>), MapError> {
        let file = folder.join(&self.file);
        #[cfg(feature = "drawings")]
        return read::of_file(&file, self).map(|map| (map, None));
        #[cfg(not(feature = "drawings"))]
        Err(MapError::NoMapFiles { file })
    }
}

impl Default for GeojsonConfig {
    /// Of no file; all else as where a scenario says nothing.
    fn default() -> Self {
        let (metres, snap_m, outside) = (false, None, Outside::default());
        Self { file: PathBuf::new(), metres, wall_m: default_wall_m(), snap_m, outside }
    }
}
