//! The kinds of maps there are, in one table: how each is called within `[map]`, which keys it has, which files are known
//! as one by the ends of their names, and how it is read. A new one is a file in this folder and a line in the table.

mod corridor;
mod csv;
mod dxf;
mod geojson;
#[cfg(all(test, feature = "drawings"))]
mod hostile;
mod moving_ai;
pub(in crate::map) mod ros;
#[cfg(feature = "schema")]
pub(crate) mod shape;
mod subt;
mod survex;
mod svg;
#[cfg(test)]
mod tests;
mod walls;

use std::{ffi::OsStr, fs::File, io::Read as _, path::Path};

use serde::{Deserialize, Serialize};
use uchain_core::params::{Key, OutOfRange};

use super::{CentreLine, Map, MapError};

pub use corridor::{CorridorConfig, Vertex, corridor};
pub use csv::CsvConfig;
pub use dxf::DxfConfig;
#[cfg(feature = "drawings")]
pub use dxf::dxf_in_memory;
pub use geojson::GeojsonConfig;
#[cfg(feature = "drawings")]
pub use geojson::geojson_in_memory;
pub use moving_ai::{MovingAiConfig, read_moving_ai};
pub use ros::{RosConfig, read_ros};
#[cfg(feature = "maps")]
pub use ros::{ros_in_memory, ros_picture};
#[cfg(feature = "drawings")]
pub use subt::subt_in_memory;
pub use subt::{SubtConfig, read_subt};
#[cfg(feature = "drawings")]
pub use survex::survex_in_memory;
pub use survex::{SurvexConfig, read_survex};
pub use svg::SvgConfig;
#[cfg(feature = "drawings")]
pub use svg::svg_in_memory;
pub use walls::{WallsConfig, drawn};

/// Farthest place in a map's own frame (m): a surveyor's coordinates; `f64` keeps a millimetre there with ease.
pub(crate) const FRAME_MAX_M: f64 = 1e9;

/// Farthest corner of a corridor (m); `f32` keeps a centimetre there.
pub(crate) const COORDINATE_MAX_M: f64 = 100_000.0;

/// A kind of maps: a row of [`FORMATS`].
#[derive(Debug, Clone, Copy)]
#[non_exhaustive]
pub struct Format {
    /// Its table in a scenario: `map.ros`.
    pub table: &'static str,
    /// What people call such a file: "ROS map". Of maps that stand in the scenario itself, what they are.
    pub name: &'static str,
    /// The keys of that table. Where a map is a file, `file` is its path.
    pub keys: &'static [Key],
    /// Ends of the names of files that are such maps; empty for maps that stand in the scenario itself.
    pub ends: &'static [&'static str],
    /// Whether a file is such a map, by how it begins: its first [`SNIFFED`] bytes, without a byte order mark.
    pub sniff: fn(&[u8]) -> bool,
}

/// How much of a file is looked at to tell its kind (bytes).
pub const SNIFFED: usize = 4096;

/// Of maps that are no files.
fn is_no_file(_: &[u8]) -> bool {
    false
}

impl Format {
    /// What it is called within `[map]`: `ros`.
    pub fn word(&self) -> &'static str {
        self.table.strip_prefix("map.").unwrap_or(self.table)
    }

    /// The key that a fault of the map is a fault of.
    pub(crate) fn fault_key(&self) -> String {
        if self.ends.is_empty() { self.table.to_owned() } else { format!("{}.file", self.table) }
    }
}

/// A value of a map's table that is not legal.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Fault {
    /// Its key within the table.
    pub(crate) key: String,
    /// What was found.
    pub(crate) got: String,
    /// What was expected.
    pub(crate) expected: String,
}

impl Fault {
    /// A number by its legal range, both ends included.
    fn range(key: &str, got: f64, low: f64, high: f64) -> Result<(), Self> {
        if (low..=high).contains(&got) {
            return Ok(());
        }
        let expected = format!("must lie in {low}..={high}");
        Err(Self { key: key.to_owned(), got: got.to_string(), expected })
    }
}

impl From<OutOfRange> for Fault {
    fn from(OutOfRange { key, got, low, high }: OutOfRange) -> Self {
        Self { key: key.to_owned(), got: got.to_string(), expected: format!("must lie in {low}..={high}") }
    }
}

/// What the values of a map's table come to.
trait MapFormat {
    /// The first value that is not legal.
    fn legal(&self) -> Result<(), Fault>;

    /// Places in the map's own frame (m) that stand among the values, with their keys within the table.
    fn places(&self) -> Vec<(String, [f64; 2])> {
        Vec::new()
    }

    /// The map, and its middle if it is known by the way it is made. Files are read from `folder`; what has no place of its
    /// own is built around `around_m`.
    fn lay(&self, folder: &Path, around_m: [f64; 2]) -> Result<(Map, Option<CentreLine>), MapError>;
}

macro_rules! formats {
    ($($(#[$meta:meta])* $Name:ident($Config:ty) = $row:path;)*) => {
        /// Where the map comes from: one of the tables of [`FORMATS`].
        #[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
        #[serde(rename_all = "kebab-case", deny_unknown_fields)]
        #[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
        #[non_exhaustive]
        pub enum MapConfig {
            $($(#[$meta])* $Name($Config),)*
        }

        /// The kinds of maps, in the order in which messages name them.
        pub const FORMATS: &[Format] = &[$($row),*];

        impl MapConfig {
            /// Its row of the table.
            pub fn format(&self) -> &'static Format {
                match self {
                    $(Self::$Name(_) => &$row,)*
                }
            }

            fn values(&self) -> &dyn MapFormat {
                match self {
                    $(Self::$Name(config) => config,)*
                }
            }
        }
    };
}

formats! {
    /// A corridor of one width along a centre line.
    Corridor(CorridorConfig) = corridor::FORMAT;
    /// Walls drawn one by one.
    Walls(WallsConfig) = walls::FORMAT;
    /// A grid map of the MovingAI benchmarks.
    Movingai(MovingAiConfig) = moving_ai::FORMAT;
    /// A ROS `map_server` map.
    Ros(RosConfig) = ros::FORMAT;
    /// Wall loops as a table of their corners.
    Csv(CsvConfig) = csv::FORMAT;
    /// A cave survey of Survex.
    Survex(SurvexConfig) = survex::FORMAT;
    /// A tunnel of SubT tiles.
    Subt(SubtConfig) = subt::FORMAT;
    /// An SVG drawing.
    Svg(SvgConfig) = svg::FORMAT;
    /// A GeoJSON file.
    Geojson(GeojsonConfig) = geojson::FORMAT;
    /// A DXF drawing.
    Dxf(DxfConfig) = dxf::FORMAT;
}

impl MapConfig {
    /// The map, and its middle if it is a corridor, which is built around a place (m). Files are read from `folder`.
    ///
    /// # Errors
    /// [`MapError`]: no such file, or no map.
    pub fn lay(&self, folder: &Path, around_m: [f64; 2]) -> Result<(Map, Option<CentreLine>), MapError> {
        let (mut map, line) = self.values().lay(folder, around_m)?;
        if !self.format().ends.is_empty() {
            map.import.format = self.format().name;
        }
        Ok((map, line))
    }

    /// The first value that is not legal.
    pub(crate) fn legal(&self) -> Result<(), Fault> {
        self.values().legal()
    }

    /// Places in the map's own frame (m) that stand among the values, with their keys within the table.
    pub(crate) fn places(&self) -> Vec<(String, [f64; 2])> {
        self.values().places()
    }
}

/// The kind of a map file, as its table within `[map]` is called: by what it holds where it can be read, else by the end of
/// its name. `None` for what is no map; what ends in `.toml` is a scenario.
///
/// ```
/// use uchain_sim::config::kind_of_map;
/// assert_eq!(kind_of_map("city.map".as_ref()), Some("movingai"));
/// assert_eq!(kind_of_map("mine.toml".as_ref()), None);
/// ```
pub fn kind_of_map(path: &Path) -> Option<&'static str> {
    let end = path.extension().and_then(OsStr::to_str).unwrap_or_default();
    if end.eq_ignore_ascii_case("toml") {
        return None;
    }
    let ends_so = |format: &&Format| format.ends.iter().any(|known| end.eq_ignore_ascii_case(known));
    let by_content = beginning(path).and_then(|bytes| {
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&bytes);
        let begins_so = |format: &&Format| (format.sniff)(bytes);
        // Where two kinds begin alike, the name decides.
        let mut known = FORMATS.iter().filter(begins_so);
        known.clone().find(ends_so).or_else(|| known.next())
    });
    by_content.or_else(|| FORMATS.iter().find(ends_so)).map(Format::word)
}

/// How a file begins; `None` where that cannot be read.
fn beginning(path: &Path) -> Option<Vec<u8>> {
    if !path.is_file() {
        return None;
    }
    let mut bytes = Vec::new();
    File::open(path).ok()?.take(SNIFFED as u64).read_to_end(&mut bytes).ok()?;
    Some(bytes)
}

/// The kinds of map files there are, in words: "ROS map (.yaml, .pgm), SVG (.svg)".
pub fn map_files() -> String {
    let files = FORMATS.iter().filter(|format| !format.ends.is_empty());
    let words = files.map(|format| {
        let ends: Vec<String> = format.ends.iter().map(|end| format!(".{end}")).collect();
        format!("{} ({})", format.name, ends.join(", "))
    });
    words.collect::<Vec<_>>().join(", ")
}

/// All tables in words, each between quotes: "[map.corridor], [map.walls] and [map.ros]".
pub(crate) fn tables(quote: &str) -> String {
    let names: Vec<String> =
        FORMATS.iter().map(|format| format!("{quote}[{}]{quote}", format.table)).collect();
    match names.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} and {last}", rest.join(", ")),
        _ => names.concat(),
    }
}
