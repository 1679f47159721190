//! A GeoJSON file as walls, rock and free space.

mod frame;
#[cfg(test)]
mod tests;

use std::path::Path;

use geojson::{Feature, GeoJson, GeometryValue, JsonObject, Position};

use self::frame::Frame;
use super::GeojsonConfig;
use crate::map::{
    Import, Map, MapError, Place, RemarkKind,
    drawing::{
        Drawing, Shape, Solid, Wall,
        reading::{
            names::{Kind, kind_of, material_of_layer},
            passage::passage,
        },
    },
    raster,
};

/// Most bytes of a file.
const MOST_BYTES: u64 = 32 << 20;
/// Most values in it.
const MOST_VALUES: usize = 2_400_000;
/// Most objects in it; a feature is three.
const MOST_OBJECTS: usize = 120_000;
/// Edges shorter than this are drawn together, unless a key says otherwise (m).
const SNAP_M: f64 = 0.01;
/// Longest name that is kept, in letters.
const LONGEST: usize = 80;

/// The map of a file.
pub(super) fn of_file(file: &Path, config: &GeojsonConfig) -> Result<Map, MapError> {
    let bytes =
        raster::read(file, MOST_BYTES).map_err(|why| MapError::Read { file: file.to_owned(), why })?;
    geojson_in_memory(file, &bytes, config)
}

/// A GeoJSON file in memory as a map; `file` is what messages call it, whatever the file of `config` is.
///
/// # Errors
/// What is no GeoJSON, or too much of it, with what was expected and what helps; nothing is in it that leaves free space.
pub fn geojson_in_memory(file: &Path, bytes: &[u8], config: &GeojsonConfig) -> Result<Map, MapError> {
    let drawing = read(bytes, config).map_err(|why| MapError::Read { file: file.to_owned(), why })?;
    drawing.into_map()
}

fn read(bytes: &[u8], config: &GeojsonConfig) -> Result<Drawing, String> {
    let text = std::str::from_utf8(bytes).map_err(|error| {
        format!("no text in UTF-8 from byte {} on; expected GeoJSON", error.valid_up_to())
    })?;
    let text = text.trim_start_matches('\u{feff}');
    scan(text)?;
    let parsed: GeoJson = serde_json::from_str(text).map_err(|error| format!("no GeoJSON: {error}"))?;
    let (features, members) = match parsed {
        GeoJson::FeatureCollection(all) => (all.features, all.foreign_members),
        GeoJson::Feature(mut one) => {
            let members = one.foreign_members.take();
            (vec![one], members)
        }
        GeoJson::Geometry(mut geometry) => {
            let members = geometry.foreign_members.take();
            (vec![Feature::from(geometry)], members)
        }
    };
    let mut drawing =
        Drawing { outside: config.outside, import: Import::of(super::FORMAT.name), ..Drawing::default() };
    let members = members.unwrap_or_default();
    let frame = Frame::of(&features, &members, config.metres, &mut drawing.import)?;
    drawing.snap_m = config.snap_m.unwrap_or(if members.contains_key("uchain") { 0.0 } else { SNAP_M });
    let mut reader = Reader { drawing, frame, wall_m: config.wall_m, counts: Counts::default() };
    for (index, feature) in features.iter().enumerate() {
        let wrong = |why: String| format!("feature {}: {why}", index + 1);
        let said = Said::of(feature.properties.as_ref(), &mut reader).map_err(wrong)?;
        match &feature.geometry {
            Some(geometry) => reader.geometry(&geometry.value, &said).map_err(wrong)?,
            None => reader.counts.nowhere += 1,
        }
    }
    reader.finished()
}

/// Counts what a parser would build, before it does.
fn scan(text: &str) -> Result<(), String> {
    let (mut values, mut objects, mut in_text, mut escaped) = (0_usize, 0_usize, false, false);
    for byte in text.bytes() {
        match byte {
            _ if escaped => escaped = false,
            b'\\' if in_text => escaped = true,
            b'"' => in_text = !in_text,
            b',' | b'[' if !in_text => values += 1,
            b'{' if !in_text => (values, objects) = (values + 1, objects + 1),
            _ => {}
        }
    }
    for (what, got, most) in [("values", values, MOST_VALUES), ("objects", objects, MOST_OBJECTS)] {
        if got > most {
            return Err(format!(
                "{got} {what}; expected {most} at most: simplify it, or cut it into several"
            ));
        }
    }
    Ok(())
}

/// What the properties of a feature say.
struct Said {
    kind: Option<Kind>,
    material: Option<usize>,
    thickness_m: f64,
    name: Option<String>,
}

#[derive(Default)]
struct Counts {
    walls: usize,
    rock: usize,
    free: usize,
    ignored: usize,
    nameless: usize,
    nowhere: usize,
    small: usize,
    strange: usize,
}

struct Reader {
    drawing: Drawing,
    frame: Frame,
    wall_m: f64,
    counts: Counts,
}

impl Said {
    fn of(properties: Option<&JsonObject>, reader: &mut Reader) -> Result<Self, String> {
        let text = |key: &str| properties?.get(key)?.as_str();
        let strange = ["kind", "material", "layer", "name"].iter().filter(|key| {
            properties
                .and_then(|all| all.get(**key))
                .is_some_and(|value| !value.is_string() && !value.is_null())
        });
        reader.counts.strange += strange.count();
        let number = |key: &str, most: f64| match properties.and_then(|all| all.get(key)) {
            None | Some(serde_json::Value::Null) => Ok(None),
            Some(value) => match value.as_f64().filter(|number| (0.0..=most).contains(number)) {
                Some(number) => Ok(Some(number)),
                None => Err(format!("{key} = {value}: expected a number from 0 to {most}")),
            },
        };
        let kind = match text("kind") {
            None => text("layer").and_then(kind_of),
            Some(word) => Some(kind_of(word).ok_or_else(|| {
                let word: String = word.chars().take(LONGEST).collect();
                format!("kind = {word:?}: expected rock, free, wall, place or ignore")
            })?),
        };
        let loss_db = number("loss_db", 1000.0)?.map(|loss_db| loss_db as f32);
        let name = |name: &str| name.trim().chars().take(LONGEST).collect::<String>();
        let material = text("material").map(name).or_else(|| text("layer").and_then(material_of_layer));
        let material =
            material.or_else(|| loss_db.map(|_| "unnamed".to_owned())).filter(|name| !name.is_empty());
        Ok(Self {
            kind,
            material: material.map(|name| reader.drawing.material(&name, loss_db)),
            thickness_m: number("thickness_m", 1000.0)?.unwrap_or(reader.wall_m),
            name: text("name").map(name).filter(|name| !name.is_empty()),
        })
    }
}

impl Reader {
    fn geometry(&mut self, value: &GeometryValue, said: &Said) -> Result<(), String> {
        if said.kind == Some(Kind::Ignored) {
            self.counts.ignored += 1;
            return Ok(());
        }
        match value {
            GeometryValue::Point { coordinates } => self.point(coordinates, said),
            GeometryValue::MultiPoint { coordinates } => {
                coordinates.iter().try_for_each(|at| self.point(at, said))
            }
            GeometryValue::LineString { coordinates } => self.line(coordinates, said),
            GeometryValue::MultiLineString { coordinates } => {
                coordinates.iter().try_for_each(|line| self.line(line, said))
            }
            GeometryValue::Polygon { coordinates } => self.polygon(coordinates, said),
            GeometryValue::MultiPolygon { coordinates } => {
                coordinates.iter().try_for_each(|rings| self.polygon(rings, said))
            }
            GeometryValue::GeometryCollection { geometries } => {
                geometries.iter().try_for_each(|geometry| self.geometry(&geometry.value, said))
            }
        }
    }

    fn places(&self, positions: &[Position]) -> Result<Vec<[f64; 2]>, String> {
        positions.iter().map(|at| self.frame.place(at.as_slice())).collect()
    }

    fn point(&mut self, at: &Position, said: &Said) -> Result<(), String> {
        let Some(name) = &said.name else {
            self.counts.nameless += 1;
            return Ok(());
        };
        let at_m = self.frame.place(at.as_slice())?;
        let height_m = at.as_slice().get(2).copied().filter(|height_m| height_m.is_finite());
        self.drawing.places.push(Place { name: name.clone(), at_m, height_m });
        Ok(())
    }

    /// A wall, or a passage as wide as it is thick.
    fn line(&mut self, positions: &[Position], said: &Said) -> Result<(), String> {
        let mut line = self.places(positions)?;
        let closed = line.len() > 3 && line.first() == line.last();
        if closed {
            line.pop();
        }
        line.dedup();
        if line.len() < 2 {
            self.counts.small += 1;
        } else if said.kind == Some(Kind::Free) {
            self.counts.free += 1;
            self.drawing.free.extend(passage(&line, closed, said.thickness_m));
        } else {
            self.counts.walls += 1;
            let (thickness_m, material) = (said.thickness_m, said.material);
            self.drawing.walls.push(Wall { line, closed, thickness_m, material });
        }
        Ok(())
    }

    fn polygon(&mut self, rings: &[Vec<Position>], said: &Said) -> Result<(), String> {
        let rings: Vec<Vec<[f64; 2]>> =
            rings.iter().map(|ring| self.places(ring)).collect::<Result<_, _>>()?;
        if said.kind == Some(Kind::Wall) {
            self.counts.walls += 1;
            let (thickness_m, material) = (said.thickness_m, said.material);
            let wall = |line| Wall { line, closed: true, thickness_m, material };
            self.drawing.walls.extend(rings.into_iter().filter(|ring| ring.len() > 2).map(wall));
            return Ok(());
        }
        let mut rings = rings.into_iter();
        let Some(outline) = rings.next().filter(|outline| outline.len() > 3) else {
            self.counts.small += 1;
            return Ok(());
        };
        let shape = Shape { outline, holes: rings.filter(|hole| hole.len() > 3).collect() };
        if said.kind == Some(Kind::Free) {
            self.counts.free += 1;
            self.drawing.free.push(shape);
        } else {
            self.counts.rock += 1;
            self.drawing.solids.push(Solid { shape, material: said.material });
        }
        Ok(())
    }

    fn finished(self) -> Result<Drawing, String> {
        let Self { mut drawing, counts, .. } = self;
        let read = [
            (counts.walls, "lines as walls"),
            (counts.rock, "polygons as rock"),
            (counts.free, "shapes as free space"),
        ];
        for (count, what) in read {
            drawing.import.say(RemarkKind::Read, count, what);
        }
        let dropped = [
            (counts.ignored, "features of the kind ignore, notes or background"),
            (counts.nameless, "points without a name"),
            (counts.nowhere, "features without a geometry"),
            (counts.small, "shapes without an extent"),
            (counts.strange, "properties kind, material, layer or name that are no text"),
        ];
        for (count, what) in dropped {
            drawing.import.say(RemarkKind::Dropped, count, what);
        }
        if drawing.free.is_empty() && drawing.solids.is_empty() && drawing.walls.is_empty() {
            let points = drawing.places.len() + counts.nameless;
            return Err(format!(
                "no line and no polygon in it ({points} points, {} features without a geometry, {} without an extent); expected \
                 polygons, or lines that enclose something",
                counts.nowhere, counts.small
            ));
        }
        Ok(drawing)
    }
}
