//! What a recording is of: scenario, seed, version and walls; enough to fly it again.

use std::{collections::BTreeMap, fmt::Write as _, hash::Hasher as _};

use glam::Vec2;
use twox_hash::XxHash64;

use crate::{
    map::{FARTHEST_M, MOST_WALLS, Map, MapError},
    mathematics,
};

/// Name of the metadata record.
pub(crate) const METADATA: &str = "uchain";
/// Name of the attachment that holds the walls.
pub(crate) const WALLS: &str = "walls.csv";
/// What `format` says. Another number is another layout.
const FORMAT: &str = "1";
/// This version.
pub(crate) const OURS: &str = env!("CARGO_PKG_VERSION");
/// Longest scenario with every value written out (bytes).
const TEXT_MAX_BYTES: usize = 1 << 24;

/// What a recording is of.
#[derive(Debug, Clone, PartialEq)]
pub struct About {
    /// The whole scenario in TOML, every value written out.
    pub scenario: String,
    /// The seed.
    pub seed: u64,
    /// The version of uchain that flew it.
    pub version: String,
    /// Where the origin of the frame `map` lies in the frame of the map's file or scenario (m).
    pub map_offset_m: [f64; 2],
    /// The mathematics of the program that flew it, as [`mathematics::fingerprint`] names it; older recordings do not
    /// say.
    pub mathematics: Option<String>,
}

impl About {
    /// A run of this version, with this mathematics: a whole scenario in TOML in these walls.
    pub fn of(scenario: String, map: &Map, seed: u64) -> Self {
        let version = OURS.to_owned();
        let mathematics = Some(mathematics::fingerprint());
        Self { scenario, seed, version, map_offset_m: map.offset_m(), mathematics }
    }

    /// The entries of the metadata record. No checksum of MCAP covers it in a file that was cut short, so it
    /// brings its own.
    pub(crate) fn entries(&self) -> BTreeMap<String, String> {
        let [x_m, y_m] = self.map_offset_m;
        let mut entries = BTreeMap::from([
            ("format".to_owned(), FORMAT.to_owned()),
            ("scenario".to_owned(), self.scenario.clone()),
            ("seed".to_owned(), self.seed.to_string()),
            ("version".to_owned(), self.version.clone()),
            ("map_offset_x_m".to_owned(), x_m.to_string()),
            ("map_offset_y_m".to_owned(), y_m.to_string()),
        ]);
        entries.extend(self.mathematics.iter().map(|name| ("mathematics".to_owned(), name.clone())));
        entries.insert("checksum".to_owned(), checksum(&entries));
        entries
    }

    pub(crate) fn from_entries(mut entries: BTreeMap<String, String>) -> Result<Self, String> {
        let format = entries.get("format").map_or("", String::as_str);
        if format != FORMAT {
            return Err(format!("format = {format:?}: expected {FORMAT:?}"));
        }
        let saved = entries.remove("checksum").unwrap_or_default();
        let found = checksum(&entries);
        if saved != found {
            return Err(format!("checksum = {saved:?}: its entries come to {found:?}"));
        }
        let mut take = |key: &str| entries.remove(key).ok_or_else(|| format!("{key} is missing"));
        let scenario = take("scenario")?;
        if scenario.len() > TEXT_MAX_BYTES {
            let bytes = scenario.len();
            return Err(format!("scenario has {bytes} bytes: expected at most {TEXT_MAX_BYTES}"));
        }
        let seed = take("seed")?;
        let seed = seed.parse().map_err(|_| format!("seed = {seed:?}: expected a whole number"))?;
        let mut metres = |key: &str| {
            let text = take(key)?;
            let value = text.parse().ok().filter(|value: &f64| value.is_finite());
            value.ok_or_else(|| format!("{key} = {text:?}: expected a number"))
        };
        let map_offset_m = [metres("map_offset_x_m")?, metres("map_offset_y_m")?];
        let version = take("version")?;
        let mathematics = entries.remove("mathematics");
        Ok(Self { scenario, seed, version, map_offset_m, mathematics })
    }

    /// Every value in which two recordings' scenarios, seeds or versions differ: its key, here, there; `None`
    /// where it is not written.
    pub fn differences(&self, other: &Self) -> Vec<(String, Option<String>, Option<String>)> {
        let values = |about: &Self| {
            let mut values = BTreeMap::new();
            match about.scenario.parse::<toml::Table>() {
                Ok(table) => flatten(String::new(), toml::Value::Table(table), &mut values),
                Err(_) => _ = values.insert("scenario".to_owned(), about.scenario.clone()),
            }
            // A word with a space is no key of a scenario.
            values.insert(" seed".to_owned(), about.seed.to_string());
            values.extend(about.mathematics.iter().map(|name| (" mathematics".to_owned(), name.clone())));
            // The version comes first: it may be the reason for all that follows.
            values.insert("  version".to_owned(), about.version.clone());
            values
        };
        let (here, there) = (values(self), values(other));
        let mut keys: Vec<&String> = here.keys().chain(there.keys()).collect();
        keys.sort();
        keys.dedup();
        let differ = keys.into_iter().filter(|key| here.get(*key) != there.get(*key));
        differ.map(|key| (key.trim().to_owned(), here.get(key).cloned(), there.get(key).cloned())).collect()
    }
}

/// `chain.uavs`, `pilot.0.speed_mps`. The parser bounds the depth (80).
fn flatten(key: String, value: toml::Value, into: &mut BTreeMap<String, String>) {
    let below = |step: &str| if key.is_empty() { step.to_owned() } else { format!("{key}.{step}") };
    match value {
        toml::Value::Table(table) => {
            table.into_iter().for_each(|(step, value)| flatten(below(&step), value, into));
        }
        toml::Value::Array(values) => {
            let values = values.into_iter().enumerate();
            values.for_each(|(step, value)| flatten(below(&step.to_string()), value, into));
        }
        value => _ = into.insert(key, value.to_string()),
    }
}

fn checksum(entries: &BTreeMap<String, String>) -> String {
    let mut hash = XxHash64::with_seed(0);
    for text in entries.iter().flat_map(|(key, value)| [key, value]) {
        hash.write(&(text.len() as u64).to_le_bytes());
        hash.write(text.as_bytes());
    }
    format!("{:016x}", hash.finish())
}

/// The walls as a table: a row per corner, loop by loop; the last corner of a loop joins its first. Coordinates
/// are those of the frame `map` (m), with as many digits as it takes to read the same `f32` again.
pub fn walls_to_csv(map: &Map) -> String {
    let mut text = "loop,x_m,y_m\n".to_owned();
    for (index, walls) in map.loops().enumerate() {
        for wall in walls {
            // Writing to a String cannot fail.
            let _ = writeln!(text, "{index},{},{}", wall.a.x, wall.a.y);
        }
    }
    text
}

/// The map that [`walls_to_csv`] wrote; its origin stands at that of its frame.
///
/// # Errors
/// In words: the line that is no corner, or why these are no walls.
pub fn walls_from_csv(bytes: &[u8]) -> Result<Map, String> {
    let text = std::str::from_utf8(bytes).map_err(|error| error.to_string())?;
    let mut lines = text.lines().enumerate();
    if lines.next().is_none_or(|(_, line)| line != "loop,x_m,y_m") {
        return Err("expected the columns loop,x_m,y_m".to_owned());
    }
    let mut loops: Vec<Vec<Vec2>> = Vec::new();
    for (index, line) in lines {
        let next = loops.len();
        let in_order = |number: usize| number == next || Some(number) == next.checked_sub(1);
        let Some((number, at)) = corner(line).filter(|(n, _)| in_order(*n) && index <= MOST_WALLS) else {
            let line: String = line.chars().take(60).collect();
            return Err(format!("line {}: {line:?}: expected a loop's number, x and y", index + 1));
        };
        if number == next {
            loops.push(Vec::new());
        }
        if let Some(corners) = loops.last_mut() {
            corners.push(at);
        }
    }
    Map::from_loops(loops).map_err(|error: MapError| error.to_string())
}

fn corner(line: &str) -> Option<(usize, Vec2)> {
    let mut columns = line.split(',');
    let number = columns.next()?.parse().ok()?;
    let mut metres = || columns.next()?.parse().ok().filter(|value: &f32| value.abs() <= FARTHEST_M);
    let at = Vec2::new(metres()?, metres()?);
    columns.next().is_none().then_some((number, at))
}
