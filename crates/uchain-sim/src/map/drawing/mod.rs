//! What somebody has drawn or surveyed, and the map that it comes to: free areas, solid pieces and walls of some thickness,
//! which may cross and lie over one another. The readers of drawings make a [`Drawing`] and know no more of geometry.

mod apart;
mod crossings;
mod free;
mod made_of;
pub(in crate::map) mod reading;
#[cfg(test)]
mod tests;

use geo::{Coord, LineString, Orient, Polygon, orient::Direction};
use glam::DVec2;

use super::{HeardAcross, Import, Map, MapError, Material, Outside, Place, RemarkKind, import::printable};

/// Most corners of a drawing.
pub(crate) const MOST_CORNERS: usize = 1_000_000;
/// Farthest place in a drawing's own frame (m), and its greatest size along x and y (m).
const FARTHEST_M: f64 = super::FRAME_MAX_M;
const LARGEST_M: f64 = super::FARTHEST_M as f64;

/// A closed area (m), in the file's own frame.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Shape {
    pub(crate) outline: Vec<[f64; 2]>,
    pub(crate) holes: Vec<Vec<[f64; 2]>>,
}

/// A piece of rock.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Solid {
    pub(crate) shape: Shape,
    /// By [`Drawing::material`].
    pub(crate) material: Option<usize>,
}

/// A wall along a line (m), half of its thickness on either side; its ends are cut off square.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Wall {
    pub(crate) line: Vec<[f64; 2]>,
    /// Whether the last point joins the first.
    pub(crate) closed: bool,
    pub(crate) thickness_m: f64,
    /// By [`Drawing::material`].
    pub(crate) material: Option<usize>,
}

/// What a file shows, as it shows it.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Drawing {
    /// Free areas; without any, free is what solids and walls leave.
    pub(crate) free: Vec<Shape>,
    pub(crate) solids: Vec<Solid>,
    pub(crate) walls: Vec<Wall>,
    pub(crate) outside: Outside,
    /// Edges shorter than this are drawn together (m).
    pub(crate) snap_m: f64,
    pub(crate) materials: Vec<Material>,
    pub(crate) places: Vec<Place>,
    /// What it costs to be heard across passages.
    pub(crate) heard_across: Vec<HeardAcross>,
    pub(crate) import: Import,
}

impl Drawing {
    /// The number of a material, a new one if nobody has named it before.
    pub(crate) fn material(&mut self, name: &str, loss_db: Option<f32>) -> usize {
        let name = printable(name);
        let known = self.materials.iter().position(|known| known.name == name && known.loss_db == loss_db);
        known.unwrap_or_else(|| {
            self.materials.push(Material { name, loss_db });
            self.materials.len() - 1
        })
    }

    /// The map: free areas without solids and walls. The map frame's origin is the middle of the drawing; the offset is kept.
    ///
    /// # Errors
    /// Nothing is drawn, or too much; a coordinate that is not a number, or too far out; no free space is left.
    pub(crate) fn into_map(mut self) -> Result<Map, MapError> {
        let middle = self.middle()?;
        crossings::few(self.lines(), middle)?;
        let local = Local { middle };
        let solids: Vec<(Polygon, Option<usize>)> = self
            .solids
            .iter()
            .map(|solid| (local.polygon(&solid.shape), solid.material))
            .chain(self.walls.iter().flat_map(|wall| local.wall(wall)))
            .collect();
        let drawn: Vec<Polygon> = self.free.iter().map(|shape| local.polygon(shape)).collect();
        let free = free::free(&drawn, &solids, self.outside, &mut self.import)?;
        let loops = apart::loops(&free, self.snap_m, &mut self.import)?;
        let mut map = Map::from_loops(loops)?.with_offset_m(middle.into());
        if map.first_crossing().is_some() {
            // Areas that touch, or slivers that numbers of 32 bits cannot tell apart: a little less of each is free.
            let loops = apart::loops(&apart::shrunk(&free), self.snap_m, &mut self.import)?;
            map = Map::from_loops(loops)?.with_offset_m(middle.into());
            self.import.say(
                RemarkKind::Separated,
                1,
                "drawing whose areas touch: all walls moved in by 0.4 mm",
            );
        }
        if let Some(at) = map.first_crossing() {
            let (x, y) = (f64::from(at.x) + middle.x, f64::from(at.y) + middle.y);
            return Err(MapError::WallsCross { x, y });
        }
        if !self.materials.is_empty() {
            map.made_of = made_of::made_of(&map, &solids);
        }
        map.materials = self.materials;
        for place in &mut self.places {
            place.name = printable(&place.name);
        }
        map.places = self.places;
        map.heard_across = self.heard_across;
        map.import = self.import;
        Ok(map)
    }

    /// All lines of it, and whether each is closed.
    fn lines(&self) -> impl Iterator<Item = (&[[f64; 2]], bool)> {
        let shapes = self.free.iter().chain(self.solids.iter().map(|solid| &solid.shape));
        let of_shapes = shapes.flat_map(|shape| std::iter::once(&shape.outline).chain(&shape.holes));
        let of_shapes = of_shapes.map(|line| (&line[..], true));
        of_shapes.chain(self.walls.iter().map(|wall| (&wall.line[..], wall.closed)))
    }

    /// The middle of all corners (m).
    fn middle(&self) -> Result<DVec2, MapError> {
        let rings = |shape: &Shape| shape.holes.iter().map(Vec::len).sum::<usize>() + shape.outline.len();
        let corners = self.free.iter().map(rings).sum::<usize>()
            + self.solids.iter().map(|solid| rings(&solid.shape)).sum::<usize>()
            + self.walls.iter().map(|wall| wall.line.len()).sum::<usize>();
        if corners == 0 || corners > MOST_CORNERS {
            let what = "corners of all that is drawn";
            return Err(MapError::Count { what, got: corners, least: 1, most: MOST_CORNERS });
        }
        let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for (index, &[x, y]) in self.lines().flat_map(|(line, _)| line.iter().enumerate()) {
            if !(x.abs() <= FARTHEST_M && y.abs() <= FARTHEST_M) {
                return Err(MapError::Coordinate { index, x, y, most: FARTHEST_M });
            }
            (low, high) = (low.min(DVec2::new(x, y)), high.max(DVec2::new(x, y)));
        }
        let size_m = (high - low).max_element();
        if size_m > LARGEST_M {
            let what = "size of the drawing (m)";
            return Err(MapError::Range { what, got: size_m, low: 0.0, high: LARGEST_M });
        }
        Ok((low + high) / 2.0)
    }
}

/// From the file's frame into one around the middle of the drawing.
struct Local {
    middle: DVec2,
}

impl Local {
    fn line(&self, line: &[[f64; 2]]) -> LineString {
        line.iter().map(|&[x, y]| Coord { x: x - self.middle.x, y: y - self.middle.y }).collect()
    }

    fn polygon(&self, shape: &Shape) -> Polygon {
        let holes = shape.holes.iter().map(|hole| self.line(hole)).collect();
        // A hole that runs the way of its outline would count as filled.
        Polygon::new(self.line(&shape.outline), holes).orient(Direction::Default)
    }

    fn wall(&self, wall: &Wall) -> Vec<(Polygon, Option<usize>)> {
        let mut line = self.line(&wall.line);
        if wall.closed {
            line.close();
        }
        free::thick(&line, wall.thickness_m).into_iter().map(|polygon| (polygon, wall.material)).collect()
    }
}
