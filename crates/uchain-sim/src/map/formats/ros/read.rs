//! ROS `map_server` maps: a yaml file and the picture it names.
//!
//! A pixel's darkness `p` is `(255 − mean of its colours) / 255`, or the mean over 255 if `negate` is set; above
//! `occupied_thresh` it is rock, below `free_thresh` free, else unknown (mode `trinary`). Mode `scale` grades the
//! cells between the thresholds; here they are unknown as well, and so is, in that mode alone, what is not wholly opaque.
//! `origin` is the pose of the lower-left corner of the
//! picture: yaw turns the picture counter-clockwise about that corner.
//! Format: <https://wiki.ros.org/map_server>.

use std::{
    collections::BTreeMap,
    fmt, fs,
    path::{Path, PathBuf},
};

use glam::DVec2;
use serde::{Deserialize, de::IgnoredAny};

use super::{super::beginning, is_picture};
use crate::map::{
    Import, Map, MapError, RemarkKind, Unknown,
    raster::{
        cells::{Cells, Levels},
        read, to_map, words,
    },
};

/// Most bytes of a yaml file.
const MOST_YAML_BYTES: u64 = 1 << 16;
/// Ends of the names of pictures.
const PICTURES: [&str; 2] = ["pgm", "png"];
/// Most bytes of a picture file.
const MOST_PICTURE_BYTES: u64 = 1 << 28;

/// Reads a `map_server` map. `cell_m` counts instead of the file's own `resolution` (m). A picture (pgm, png) stands
/// for itself, with `map_saver`'s thresholds and its lower-left corner at the origin, and needs `cell_m`.
///
/// Walls are the edges between free cells and all others, each kept within `simplify_m` (0 to 1 m) of the cells'
/// own edge; 0 keeps every step. Simplified walls never cross or touch, and every speck of rock and pocket of free
/// space stays. Free cells that meet only at a corner are kept apart there, by an eighth of a cell. The map frame's
/// origin is the middle of the free area; [`Map::to_local`] converts from the file's own frame.
///
/// # Errors
/// A file that is absent, too large or not what it should be; a key that is absent or out of range, named with what
/// it holds; a picture without a free cell, with more than 4,000,000 corners of cell edges, or with more than
/// [`MOST_WALLS`](crate::map::MOST_WALLS) walls once simplified.
pub fn read_ros(
    yaml: &Path,
    unknown: Unknown,
    cell_m: Option<f64>,
    simplify_m: f64,
) -> Result<Map, MapError> {
    if !(0.0..=1.0).contains(&simplify_m) {
        return Err(MapError::Range { what: "simplify_m", got: simplify_m, low: 0.0, high: 1.0 });
    }
    let end = yaml.extension().unwrap_or_default();
    let is_called_so = PICTURES.iter().any(|picture| end.eq_ignore_ascii_case(picture));
    let mut meta = if is_called_so || beginning(yaml).is_some_and(|bytes| is_picture(&bytes)) {
        let cell_m = match (cell_m, fs::metadata(yaml)) {
            (Some(cell_m), _) => cell_m,
            (None, Ok(_)) => return Err(MapError::NoScale { file: yaml.to_owned() }),
            (None, Err(error)) => {
                return Err(MapError::Read { file: yaml.to_owned(), why: error.to_string() });
            }
        };
        Meta::of_picture(yaml, cell_m)
    } else {
        let bytes =
            read(yaml, MOST_YAML_BYTES).map_err(|why| MapError::Read { file: yaml.to_owned(), why })?;
        Meta::parse(yaml, &bytes)?
    };
    meta.resolution_m = cell_m.unwrap_or(meta.resolution_m);
    let image = yaml.parent().unwrap_or(Path::new("")).join(&meta.image);
    let picture = read(&image, MOST_PICTURE_BYTES).map_err(|why| MapError::Image {
        file: yaml.to_owned(),
        image: image.clone(),
        why,
    })?;
    meta.build(yaml, &image, &picture, unknown, simplify_m)
}

/// The name of the picture that a `map_server` yaml file names; `file` is what messages call the yaml.
///
/// # Errors
/// Those of [`read_ros`] about the yaml file.
pub fn ros_picture(file: &Path, yaml: &[u8]) -> Result<PathBuf, MapError> {
    Meta::parse(file, yaml).map(|meta| meta.image)
}

/// Like [`read_ros`], of files in memory: a yaml file, and the bytes of the picture that it names. Unknown cells are rock.
/// `file` is what messages call the yaml.
///
/// # Errors
/// Those of [`read_ros`].
pub fn ros_in_memory(file: &Path, yaml: &[u8], picture: &[u8], simplify_m: f64) -> Result<Map, MapError> {
    let meta = Meta::parse(file, yaml)?;
    let image = meta.image.clone();
    meta.build(file, &image, picture, Unknown::Rock, simplify_m)
}

/// What the yaml file says, checked.
pub(in crate::map) struct Meta {
    image: PathBuf,
    resolution_m: f64,
    corner: DVec2,
    /// Cosine and sine of the yaw.
    turn: DVec2,
    levels: Levels,
}

impl Meta {
    pub(in crate::map) fn parse(file: &Path, bytes: &[u8]) -> Result<Self, MapError> {
        let unreadable = |why: String| MapError::Read { file: file.to_owned(), why };
        let text = std::str::from_utf8(bytes).map_err(|error| {
            unreadable(format!("no text from byte {} on; expected a map_server yaml", error.valid_up_to()))
        })?;
        let values = serde_saphyr::from_str(text).map_err(|error| unreadable(words::yaml(&error, text)))?;
        let keys = Keys { file, values };
        let image = match keys.get("image", "the path of a png or pgm picture")? {
            Value::Text(path) if !path.is_empty() => PathBuf::from(path),
            _ => return Err(keys.wrong("image", "the path of a png or pgm picture")),
        };
        let resolution_m = keys.number("resolution", 1e-3, 10.0, "metres per cell, 0.001 to 10")?;
        let expected = "[x, y, yaw]: metres within ±1e7 and radians";
        let (x, y, yaw_rad) = match keys.get("origin", expected)? {
            Value::List(pose) => match pose[..] {
                [x, y, yaw] if x.abs() <= 1e7 && y.abs() <= 1e7 && yaw.abs() <= 1e3 => (x, y, yaw),
                _ => return Err(keys.wrong("origin", expected)),
            },
            _ => return Err(keys.wrong("origin", expected)),
        };
        let negate = match keys.get("negate", "0 or 1")? {
            Value::Flag(flag) => *flag,
            Value::Number(0.0) => false,
            Value::Number(1.0) => true,
            _ => return Err(keys.wrong("negate", "0 or 1")),
        };
        let occupied = keys.number("occupied_thresh", 0.0, 1.0, "a share of darkness, 0 to 1")?;
        let free = keys.number("free_thresh", 0.0, 1.0, "a share of darkness, 0 to 1")?;
        if free > occupied {
            let expected = format!("at most occupied_thresh, {occupied}; are the two exchanged?");
            return Err(keys.wrong("free_thresh", &expected));
        }
        let by_opacity = match keys.values.get("mode") {
            None => false,
            Some(Value::Text(mode)) if mode == "trinary" => false,
            Some(Value::Text(mode)) if mode == "scale" => true,
            Some(_) => return Err(keys.wrong("mode", "trinary or scale; raw cells say nothing about walls")),
        };
        let turn = DVec2::new(libm::cos(yaw_rad), libm::sin(yaw_rad));
        let levels = Levels { negate, occupied, free, by_opacity };
        Ok(Self { image, resolution_m, corner: DVec2::new(x, y), turn, levels })
    }

    /// What `map_saver` writes, for a picture without a yaml file.
    fn of_picture(picture: &Path, resolution_m: f64) -> Self {
        let image = PathBuf::from(picture.file_name().unwrap_or_default());
        let levels = Levels { negate: false, occupied: 0.65, free: 0.196, by_opacity: false };
        Self { image, resolution_m, corner: DVec2::ZERO, turn: DVec2::X, levels }
    }

    /// The walls in the bytes of its picture; messages call the files by their names.
    fn build(
        &self,
        file: &Path,
        image: &Path,
        picture: &[u8],
        unknown: Unknown,
        simplify_m: f64,
    ) -> Result<Map, MapError> {
        let wrong = |why: String| MapError::Image { file: file.to_owned(), image: image.to_owned(), why };
        let cells = Cells::decode(picture, self.levels, unknown).map_err(|error| wrong(error.to_string()))?;
        let map = to_map(&cells, self.resolution_m, simplify_m, |corner| self.place(corner), wrong)?;
        let count = cells.cols() * cells.rows();
        let taken = if unknown == Unknown::Rock { "rock" } else { "free" };
        let percent = (100.0 * cells.unknown() as f64 / count as f64).round();
        let cells = format!(
            "cells of {} m; {percent} % of them are unknown, and taken as {taken}",
            self.resolution_m
        );
        let mut import = Import::of("ROS map");
        import.say(RemarkKind::Read, count, cells);
        Ok(map.with_import(import))
    }

    /// A place in cells from the picture's lower-left corner, in the file's own frame (m).
    fn place(&self, cells: DVec2) -> DVec2 {
        self.corner + self.turn.rotate(cells * self.resolution_m)
    }
}

struct Keys<'a> {
    file: &'a Path,
    values: BTreeMap<String, Value>,
}

impl Keys<'_> {
    fn get(&self, key: &'static str, expected: &str) -> Result<&Value, MapError> {
        self.values.get(key).ok_or_else(|| self.wrong(key, expected))
    }

    fn number(&self, key: &'static str, low: f64, high: f64, expected: &str) -> Result<f64, MapError> {
        match self.get(key, expected)? {
            Value::Number(number) if (low..=high).contains(number) => Ok(*number),
            _ => Err(self.wrong(key, expected)),
        }
    }

    fn wrong(&self, key: &'static str, expected: &str) -> MapError {
        let got = self.values.get(key).map_or_else(|| "(absent)".to_owned(), ToString::to_string);
        MapError::Key { file: self.file.to_owned(), key, got, expected: expected.to_owned() }
    }
}

/// A yaml value of any of the shapes a map file holds. Keys nobody asks for may hold anything.
#[derive(Deserialize)]
#[serde(untagged)]
enum Value {
    Flag(bool),
    Number(f64),
    Text(String),
    List(Vec<f64>),
    Nothing(()),
    Mixed(Vec<IgnoredAny>),
    Other(IgnoredAny),
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Flag(flag) => write!(f, "{flag}"),
            Self::Number(number) => write!(f, "{number}"),
            Self::Text(text) => write!(f, "{text:?}"),
            Self::List(numbers) => write!(f, "{numbers:?}"),
            Self::Nothing(()) => f.write_str("(empty)"),
            Self::Mixed(items) => write!(f, "a list of {}, not all of them numbers", items.len()),
            Self::Other(_) => f.write_str("a value of another kind"),
        }
    }
}
