//! Worlds of the SubT challenge: tunnels laid out as tiles of 20 m (`.tsv`), with the graph of what sees what beside them
//! (`.dot`).

#[cfg(feature = "drawings")]
mod dot;
#[cfg(feature = "drawings")]
mod draw;
#[cfg(feature = "drawings")]
mod joins;
#[cfg(all(test, feature = "drawings"))]
mod tests;
#[cfg(feature = "drawings")]
mod tiles;

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::{Fault, Format, MapFormat};
use crate::map::{CentreLine, Map, MapError};

pub(super) const FORMAT: Format = Format {
    table: "map.subt",
    name: "SubT tiles",
    keys: SubtConfig::KEYS,
    ends: &["tsv", "dot"],
    sniff: |bytes| is_graph(bytes) || is_layout(bytes),
};

/// A cell with a tile: `tunnel_tile_5,90,0`.
fn is_layout(bytes: &[u8]) -> bool {
    let text = String::from_utf8_lossy(bytes);
    let mut cells = text.split(['\t', '\n']).map(|cell| cell.trim().trim_matches('"'));
    cells.any(|cell| {
        let mut parts = cell.split(',');
        let word = parts.next().unwrap_or_default().to_lowercase();
        let mut is_number = || parts.next().is_some_and(|part| part.trim().parse::<f64>().is_ok());
        (word.contains("tunnel_tile") || word.contains("tunnel tile") || word == "base_station")
            && is_number()
            && is_number()
    })
}

/// A graph of tiles, which says nothing of where they lie.
fn is_graph(bytes: &[u8]) -> bool {
    let text = String::from_utf8_lossy(bytes);
    let has = |word: &str| text.contains(word);
    has("graph") && has("{") && has("[label=") && has("::")
}

uchain_core::params! {
    /// A tunnel of the SubT challenge, laid out as tiles of 20 m (`.tsv`), all levels in one plan.
    #[derive(Serialize, Deserialize)]
    #[serde(deny_unknown_fields)]
    pub struct SubtConfig {
        /// Path of the layout, from the folder of the scenario file (from the working folder for a compiled-in scenario).
        pub file: PathBuf;
        /// Path of the graph of the tiles (`.dot`), for their names and what it costs to be heard across them, from the
        /// same folder; otherwise the one beside the layout that is called like it, if there is one.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pub graph: Option<PathBuf>;
        /// Width of the tunnels (m); layouts do not say.
        /// - Source: ours
        #[serde(default = "default_width_m")]
        pub width_m: f64, in 0.5..=18.0;
        /// Width of tunnels in constrained tiles (m); layouts do not say.
        /// - Source: ours
        #[serde(default = "default_constrained_width_m")]
        pub constrained_width_m: f64, in 0.5..=18.0;
    }
}

fn default_width_m() -> f64 {
    5.0
}

fn default_constrained_width_m() -> f64 {
    2.0
}

impl MapFormat for SubtConfig {
    fn legal(&self) -> Result<(), Fault> {
        Ok(self.check()?)
    }

    fn lay(&self, folder: &Path, _: [f64; 2]) -> Result<(Map, Option<CentreLine>), MapError> {
        let named = self.graph.as_ref().map(|graph| folder.join(graph));
        read_subt(&folder.join(&self.file), named.as_deref(), self).map(|map| (map, None))
    }
}

/// The tunnels of a layout. The files are `file` and, for its graph, `graph` or the one beside it, whatever the settings call
/// them.
///
/// # Errors
/// No such file, or no layout.
#[cfg(feature = "drawings")]
pub fn read_subt(file: &Path, graph: Option<&Path>, settings: &SubtConfig) -> Result<Map, MapError> {
    let text = |file: &Path| {
        let wrong = |why| MapError::Read { file: file.to_owned(), why };
        let bytes = crate::map::raster::read(file, MOST_BYTES).map_err(wrong)?;
        String::from_utf8(bytes)
            .map_err(|error| wrong(format!("no text from byte {} on", error.utf8_error().valid_up_to())))
    };
    let layout = text(file)?;
    if is_graph(layout.as_bytes()) {
        let why = format!(
            "a graph of tiles, which does not say where they lie; give the layout that belongs to it: {}",
            file.with_extension("tsv").display()
        );
        return Err(MapError::Read { file: file.to_owned(), why });
    }
    let beside = file.with_extension("dot");
    let graph = match graph {
        Some(graph) => Some(text(graph)?),
        None if beside.is_file() => Some(text(&beside)?),
        None => None,
    };
    subt_in_memory(file, &layout, graph.as_deref(), settings)
}

/// The tunnels of a layout that is in memory, with its graph; messages call it `file`.
///
/// # Errors
/// No layout, or another layout's graph.
#[cfg(feature = "drawings")]
pub fn subt_in_memory(
    file: &Path,
    layout: &str,
    graph: Option<&str>,
    settings: &SubtConfig,
) -> Result<Map, MapError> {
    let wrong = |why| MapError::Read { file: file.to_owned(), why };
    let layout = tiles::layout(layout).map_err(wrong)?;
    let graph = graph.map(dot::graph).transpose().map_err(|why| wrong(format!("its graph, {why}")))?;
    draw::drawing(&layout, graph.as_ref(), settings).map_err(wrong)?.into_map()
}

/// Most bytes of a layout or a graph.
#[cfg(feature = "drawings")]
const MOST_BYTES: u64 = 16 << 20;

/// Without the feature `drawings`, nothing is read.
///
/// # Errors
/// Always [`MapError::NoMapFiles`].
#[cfg(not(feature = "drawings"))]
pub fn read_subt(file: &Path, _: Option<&Path>, _: &SubtConfig) -> Result<Map, MapError> {
    Err(MapError::NoMapFiles { file: file.to_owned() })
}
