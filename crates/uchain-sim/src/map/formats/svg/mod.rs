//! SVG drawings.
//!
//! The rule: what is **stroked** is a wall as wide as its stroke, at least `wall_m`; what is **filled** is rock; what is called
//! `free`, `room`, `passage` or `tunnel` is free space: areas, outlines that are closed, and open lines as wide as their stroke.
//! A name is a layer's or an object's label in Inkscape, an id or a class; the innermost counts. What is called `rock` or
//! `pillar` is rock even if it is only outlined; `notes`, `background` and `ignore` are left out; in a layer `places`, a text or
//! a shape names a place. White is paper and draws nothing. Text, images, hidden elements and those neither filled nor stroked
//! are dropped, and counted. Any other name of a layer is a material, and so is an id that ends in a number (`concrete-3`) and a
//! class; `data-loss-db` says what a wall of it takes from a link.

#[cfg(feature = "drawings")]
pub(in crate::map) mod read;

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::{Fault, Format, MapFormat};
use crate::map::{CentreLine, Map, MapError, Outside};

#[cfg(feature = "drawings")]
pub use read::svg_in_memory;

pub(super) const FORMAT: Format = Format {
    table: "map.svg",
    name: "SVG",
    keys: SvgConfig::KEYS,
    ends: &["svg"],
    sniff: |bytes| {
        let text = String::from_utf8_lossy(bytes);
        text.trim_start().starts_with('<') && text.contains("<svg")
    },
};

uchain_core::params! {
    /// An SVG drawing: what is stroked is a wall as wide as its stroke, what is filled is rock, what is called free, room, passage
    /// or tunnel (layer, id or class) is free space. Of a layer's other names each is a material. Text, images, hidden and white
    /// elements and those neither filled nor stroked are dropped, and counted. The page's lower left corner is the origin.
    #[derive(Serialize, Deserialize)]
    #[serde(deny_unknown_fields)]
    pub struct SvgConfig {
        /// Path of the drawing, from the folder of the scenario file (from the working folder for a compiled-in scenario).
        pub file: PathBuf;
        /// The drawing's scale is one to this (1): with 100, a centimetre on paper is a metre. For want of it, of `unit_m` and of
        /// `width_m`, 100 is taken, and said. A px is a 96th of an inch.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[schemars(range(min = 0.001, max = 1_000_000.0))]
        pub scale: Option<f64>;
        /// Length of one unit of the drawing, that of its `viewBox` (m), instead of `scale`.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[schemars(range(min = 0.000_001, max = 1_000_000.0))]
        pub unit_m: Option<f64>;
        /// Width of the page (m), instead of `scale`.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[schemars(range(min = 0.001, max = 200_000.0))]
        pub width_m: Option<f64>;
        /// Least thickness of a wall (m).
        /// - Source: ours
        #[serde(default = "default_wall_m")]
        pub wall_m: f64, in 0.01..=100.0;
        /// How far a straight piece of wall may lie from the curve it stands for (m).
        /// - Source: ours
        #[serde(default = "default_curve_m")]
        pub curve_m: f64, in 0.001..=10.0;
        /// Edges shorter than this are drawn together (m); for want of it 0.01, or 0 for a drawing that uchain wrote.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[schemars(range(min = 0.0, max = 10.0))]
        pub snap_m: Option<f64>;
        /// What lies outside of all walls, where nothing is called free.
        #[serde(default)]
        pub outside: Outside;
    }
}

fn default_wall_m() -> f64 {
    0.05
}

fn default_curve_m() -> f64 {
    0.01
}

impl MapFormat for SvgConfig {
    fn legal(&self) -> Result<(), Fault> {
        let ranges = [
            ("scale", self.scale, 0.001, 1e6),
            ("unit_m", self.unit_m, 1e-6, 1e6),
            ("width_m", self.width_m, 0.001, 200_000.0),
            ("snap_m", self.snap_m, 0.0, 10.0),
        ];
        for (key, got, low, high) in ranges {
            got.map_or(Ok(()), |got| Fault::range(key, got, low, high))?;
        }
        let sizes: Vec<(&str, f64)> =
            ranges[..3].iter().filter_map(|&(key, got, ..)| Some((key, got?))).collect();
        if let [_, (key, got), ..] = sizes[..] {
            let expected = format!("one of scale, unit_m and width_m; {} says it already", sizes[0].0);
            return Err(Fault { key: key.to_owned(), got: got.to_string(), expected });
        }
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

impl Default for SvgConfig {
    /// Of no file; all else as where a scenario says nothing.
    fn default() -> Self {
        Self {
            file: PathBuf::new(),
            scale: None,
            unit_m: None,
            width_m: None,
            wall_m: default_wall_m(),
            curve_m: default_curve_m(),
            snap_m: None,
            outside: Outside::default(),
        }
    }
}
