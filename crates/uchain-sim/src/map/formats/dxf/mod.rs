//! DXF, as CAD programs exchange it: the text form.
//!
//! The rule: lines, polylines, arcs, circles, ellipses and splines are walls of their polyline's width, or else of `wall_m`; lines
//! that meet end to end are one. On a layer called `free`, `room`, `passage` or `tunnel`, what is closed is free space; on one
//! called `rock` or `pillar`, what is closed is rock, and so is what is drawn as SOLID or TRACE anywhere; `notes`, `background`
//! and `ignore` are left out; on a layer `places`, a text names a place. Any other name of a layer but `0` is a material.
//! Layers that are off or frozen, paper space, texts, dimensions and hatches are dropped, and counted by kind.

#[cfg(feature = "drawings")]
pub(in crate::map) mod read;

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::{Fault, Format, MapFormat};
use crate::map::{CentreLine, Map, MapError, Outside};

#[cfg(feature = "drawings")]
pub use read::dxf_in_memory;

pub(super) const FORMAT: Format = Format {
    table: "map.dxf",
    name: "DXF",
    keys: DxfConfig::KEYS,
    ends: &["dxf"],
    sniff: |bytes| {
        let text = String::from_utf8_lossy(bytes);
        let mut lines = text.lines().map(str::trim);
        // Comments may come first: pairs of 999 and any words.
        while lines.clone().next() == Some("999") {
            lines.nth(1);
        }
        text.starts_with("AutoCAD Binary DXF")
            || (lines.next() == Some("0") && lines.next() == Some("SECTION"))
    },
};

uchain_core::params! {
    /// A DXF drawing: its lines, polylines, arcs, circles, ellipses and splines are walls; what is closed on a layer called free, room,
    /// passage or tunnel is free space, on one called rock or pillar rock. Another name of a layer is a material.
    #[derive(Serialize, Deserialize)]
    #[serde(deny_unknown_fields)]
    pub struct DxfConfig {
        /// Path of the drawing, from the folder of the scenario file (from the working folder for a compiled-in scenario).
        pub file: PathBuf;
        /// Length of one unit of the drawing (m), instead of what its `$INSUNITS` says. A drawing that says nothing is taken to be in
        /// metres, or in millimetres if it is larger than 2,000 units.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[schemars(range(min = 0.000_001, max = 1_000_000.0))]
        pub unit_m: Option<f64>;
        /// Thickness of a wall that is drawn as a line without a width (m).
        /// - Source: ours
        #[serde(default = "default_wall_m")]
        pub wall_m: f64, in 0.01..=100.0;
        /// How far a straight piece of wall may lie from the curve it stands for (m).
        /// - Source: ours
        #[serde(default = "default_curve_m")]
        pub curve_m: f64, in 0.001..=10.0;
        /// Ends of lines that are nearer to each other than this meet, and edges shorter than this are drawn together (m).
        /// - Source: ours
        #[serde(default = "default_snap_m")]
        pub snap_m: f64, in 0.0..=10.0;
        /// What lies outside of all walls, where nothing is drawn as free.
        #[serde(default)]
        pub outside: Outside;
    }
}

fn default_wall_m() -> f64 {
    0.1
}

fn default_curve_m() -> f64 {
    0.01
}

fn default_snap_m() -> f64 {
    0.01
}

impl MapFormat for DxfConfig {
    fn legal(&self) -> Result<(), Fault> {
        self.unit_m.map_or(Ok(()), |unit_m| Fault::range("unit_m", unit_m, 1e-6, 1e6))?;
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

impl Default for DxfConfig {
    /// Of no file; all else as where a scenario says nothing.
    fn default() -> Self {
        let (wall_m, curve_m, snap_m) = (default_wall_m(), default_curve_m(), default_snap_m());
        Self { file: PathBuf::new(), unit_m: None, wall_m, curve_m, snap_m, outside: Outside::default() }
    }
}
