//! A tunnel: walls, free space, and the way through it.
//!
//! Free space is what an odd number of closed wall loops surrounds; all the rest, out to infinity, is rock. Walls
//! themselves belong to free space. Coordinates are metres in the map frame, x to the right, y up.
//!
//! The parts: [`Map`] answers what is rock and what sees what; [`FORMATS`] are the kinds of maps that a scenario may have:
//! [`corridor`] builds a tunnel from a centre line; [`drawn`] takes wall loops as they are; [`read_ros`] reads a
//! `map_server` map, [`read_moving_ai`] a MovingAI grid;
//! [`Map::centre_path`] finds the middle of a tunnel nobody drew;
//! [`Map::tunnel_graph`] finds the middle of all passages, [`Map::numbers`] counts and measures them;
//! [`Geodesic`] measures the way through free space, [`Tunnel`] the depth along the middle.

mod cells;
#[cfg(feature = "drawings")]
mod drawing;
mod error;
mod formats;
mod geodesic;
mod geometry;
mod grid;
mod import;
pub mod make;
mod numbers;
mod raster;
mod rays;
mod skeleton;
#[cfg(test)]
mod tests;
mod tunnel;
mod ways;
pub mod write;

use std::{ops::ControlFlow, sync::OnceLock};

use glam::{DVec2, Vec2};
use rapier2d::prelude::SharedShape;
use serde::{Deserialize, Serialize};

pub use cells::CellGrid;
pub use error::MapError;
#[cfg(feature = "schema")]
pub(crate) use formats::shape;
pub use formats::{
    CorridorConfig, CsvConfig, DxfConfig, FORMATS, Format, GeojsonConfig, MapConfig, MovingAiConfig,
    RosConfig, SNIFFED, SubtConfig, SurvexConfig, SvgConfig, Vertex, WallsConfig, corridor, drawn,
    kind_of_map, map_files, read_moving_ai, read_ros, read_subt, read_survex,
};
pub(crate) use formats::{FRAME_MAX_M, Fault, tables};
#[cfg(feature = "drawings")]
pub use formats::{dxf_in_memory, geojson_in_memory, svg_in_memory};
#[cfg(feature = "maps")]
pub use formats::{ros_in_memory, ros_picture};
#[cfg(feature = "drawings")]
pub use formats::{subt_in_memory, survex_in_memory};
pub use geodesic::{Geodesic, MOST_CORNERS, Trail};
pub use geometry::Segment;
pub use import::{HeardAcross, Import, Material, Outside, Place, Remark, RemarkKind};
pub use numbers::{MapNumbers, Narrowest, STAR_WIDTH_M, UAV_MARGIN_M, Widths};
pub use skeleton::{GraphEdge, GraphNode, NARROWEST_M, NodeKind, TunnelGraph, WayTree};
pub use tunnel::{CentreLine, Tunnel};
pub use ways::Ways;

use geometry::{distance_squared, touch};
use grid::Grid;

/// Most walls a map may have.
pub const MOST_WALLS: usize = 1_000_000;
/// Farthest a wall may lie from the origin of the map frame, along x or y (m).
pub const FARTHEST_M: f32 = 100_000.0;

/// Longest wall of rapier's (m), on maps whose walls make no more than [`MOST_PIECES`] of them.
const COLLIDER_WALL_M: f64 = 4096.0;
/// By how many long walls may grow more when they are cut (1).
const MOST_PIECES: f64 = 100_000.0;

/// What cells of unknown state in a map file are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Unknown {
    /// Nobody has seen it: solid.
    #[default]
    Rock,
    /// Open space.
    Free,
}

/// Walls and the free space between them.
#[derive(Debug, Clone)]
pub struct Map {
    walls: Vec<Segment>,
    /// Where each loop starts in `walls`.
    loops: Vec<usize>,
    bounds: (Vec2, Vec2),
    offset_m: [f64; 2],
    /// How it came out of its file.
    import: Import,
    /// Places that its file names.
    places: Vec<Place>,
    /// What its file says of how hard it is to be heard.
    heard_across: Vec<HeardAcross>,
    materials: Vec<Material>,
    /// For each wall the number of its material; empty where nobody says any.
    made_of: Vec<Option<u16>>,
    grid: Grid,
    /// For each grid cell, whether its reference point is in rock; `None` where that point is on a wall.
    rock_at: Vec<Option<bool>>,
    /// The walls as rapier takes them; made when first asked for, shared by all runs.
    collider_shape: OnceLock<SharedShape>,
}

impl Map {
    /// A map from closed loops of corners (m); the last corner of a loop joins its first.
    ///
    /// Free space is the even-odd interior, whatever the loops' direction and nesting. Equal corners in a row
    /// count once. Loops should neither cross nor touch: where they touch, sight passes a gap of width zero.
    ///
    /// # Errors
    /// No loop, a loop of fewer than three distinct corners, more than [`MOST_WALLS`] walls, or a coordinate that
    /// is not a number within ±[`FARTHEST_M`].
    pub fn from_loops(loops: Vec<Vec<Vec2>>) -> Result<Self, MapError> {
        if loops.is_empty() {
            return Err(MapError::Count { what: "wall loops", got: 0, least: 1, most: MOST_WALLS });
        }
        let mut walls = Vec::new();
        let mut starts = Vec::with_capacity(loops.len());
        for mut corners in loops {
            for (index, p) in corners.iter().enumerate() {
                if !(p.x.abs() <= FARTHEST_M && p.y.abs() <= FARTHEST_M) {
                    let (x, y, most) = (f64::from(p.x), f64::from(p.y), f64::from(FARTHEST_M));
                    return Err(MapError::Coordinate { index, x, y, most });
                }
            }
            corners.dedup();
            while corners.len() > 1 && corners.first() == corners.last() {
                corners.pop();
            }
            let (got, most) = (corners.len(), MOST_WALLS);
            if got < 3 {
                return Err(MapError::Count { what: "distinct corners of a wall loop", got, least: 3, most });
            }
            let got = got + walls.len();
            if got > most {
                return Err(MapError::Count { what: "walls", got, least: 3, most });
            }
            starts.push(walls.len());
            let next = corners.iter().skip(1).chain(&corners);
            walls.extend(corners.iter().zip(next).map(|(&a, &b)| Segment { a, b }));
        }
        let low = walls.iter().fold(Vec2::INFINITY, |low, wall| low.min(wall.a));
        let high = walls.iter().fold(Vec2::NEG_INFINITY, |high, wall| high.max(wall.a));
        let grid = Grid::new(&walls);
        let mut map = Self {
            walls,
            loops: starts,
            bounds: (low, high),
            offset_m: [0.0; 2],
            import: Import::default(),
            places: Vec::new(),
            heard_across: Vec::new(),
            materials: Vec::new(),
            made_of: Vec::new(),
            grid,
            rock_at: Vec::new(),
            collider_shape: OnceLock::new(),
        };
        map.rock_at = map.rock_at_references();
        Ok(map)
    }

    /// All walls, loop after loop; within a loop each wall starts where the one before ends.
    pub fn walls(&self) -> &[Segment] {
        &self.walls
    }

    /// The walls loop by loop.
    pub fn loops(&self) -> impl Iterator<Item = &[Segment]> {
        let ends = self.loops.iter().skip(1).copied().chain([self.walls.len()]);
        self.loops.iter().zip(ends).map(|(&from, to)| &self.walls[from..to])
    }

    /// The least and the greatest corner of the box around all walls (m).
    pub fn bounds(&self) -> (Vec2, Vec2) {
        self.bounds
    }

    /// Where the map frame's origin lies in the frame of the map's file or scenario (m).
    pub fn offset_m(&self) -> [f64; 2] {
        self.offset_m
    }

    /// The same map, its origin standing at `offset_m` of the frame its description uses (m).
    #[must_use]
    pub fn with_offset_m(mut self, offset_m: [f64; 2]) -> Self {
        self.offset_m = offset_m;
        self
    }

    /// How it came out of its file.
    pub fn import(&self) -> &Import {
        &self.import
    }

    /// The same map, and how it came out of its file.
    #[must_use]
    pub fn with_import(mut self, import: Import) -> Self {
        self.import = import;
        self
    }

    /// Places that its file has names for.
    pub fn places(&self) -> &[Place] {
        &self.places
    }

    /// The same map with named places.
    #[must_use]
    pub fn with_places(mut self, places: Vec<Place>) -> Self {
        self.places = places;
        self
    }

    /// What it costs to be heard across passages between tiles, as far as its file says.
    pub fn heard_across(&self) -> &[HeardAcross] {
        &self.heard_across
    }

    /// The same map with costs of being heard.
    #[must_use]
    pub fn with_heard_across(mut self, heard_across: Vec<HeardAcross>) -> Self {
        self.heard_across = heard_across;
        self
    }

    /// What its walls are made of, as far as its file says.
    pub fn materials(&self) -> &[Material] {
        &self.materials
    }

    /// What a wall is made of, by its number in [`Map::walls`].
    pub fn material_of_wall(&self, wall: usize) -> Option<&Material> {
        self.materials.get(usize::from((*self.made_of.get(wall)?)?))
    }

    /// What a loop of walls is made of, by its number among [`Map::loops`], if all its walls are of one material.
    pub fn material_of_loop(&self, index: usize) -> Option<&Material> {
        let start = *self.loops.get(index)?;
        let end = self.loops.get(index + 1).copied().unwrap_or(self.walls.len());
        let first = self.made_of.get(start)?;
        let is_one = self.made_of.get(start..end)?.iter().all(|made_of| made_of == first);
        is_one.then(|| self.materials.get(usize::from((*first)?))).flatten()
    }

    /// A point of the map file's own frame (m) in the map frame (m).
    pub fn to_local(&self, [x, y]: [f64; 2]) -> Vec2 {
        Vec2::new((x - self.offset_m[0]) as f32, (y - self.offset_m[1]) as f32)
    }

    /// A point of the map frame (m) in the map file's own frame (m).
    pub fn to_file(&self, at: Vec2) -> [f64; 2] {
        [f64::from(at.x) + self.offset_m[0], f64::from(at.y) + self.offset_m[1]]
    }

    /// The walls as one shape of rapier's; `None` without walls.
    ///
    /// Where on a wall a body touches it is a share of the wall's length in `f32`: along 200 km that is off by
    /// centimetres, and the wall pushes askew. So long walls are several here.
    pub(crate) fn collider_shape(&self) -> Option<SharedShape> {
        let polyline = || {
            let total_m: f64 = self.walls.iter().map(|wall| f64::from(wall.a.distance(wall.b))).sum();
            let most_m = COLLIDER_WALL_M.max(total_m / MOST_PIECES);
            let corners: Vec<Vec2> =
                self.walls.iter().flat_map(|wall| wall.pieces(most_m)).flatten().collect();
            let edges = (0..corners.len() as u32 / 2).map(|i| [2 * i, 2 * i + 1]).collect();
            SharedShape::polyline(corners, Some(edges))
        };
        (!self.walls.is_empty()).then(|| self.collider_shape.get_or_init(polyline).clone())
    }

    /// Distance from `p` to the nearest wall (m), on whichever side of it `p` lies. NaN for a `p` that is no point.
    pub fn clearance_m(&self, p: Vec2) -> f32 {
        self.clearance_f64_m(p.as_dvec2()) as f32
    }

    /// [`Map::clearance_m`] without rounding.
    fn clearance_f64_m(&self, p: DVec2) -> f64 {
        if !p.is_finite() {
            return f64::NAN;
        }
        let mut best = f64::INFINITY;
        if self.grid.cell_at(p).is_none() {
            for wall in &self.walls {
                let (a, b) = wall.ends();
                best = best.min(distance_squared(a, b, p));
            }
            return best.sqrt();
        }
        for ring in 0.. {
            let sure_m = self.grid.ring(p, ring, |cell| {
                for &wall in self.grid.walls_of(cell) {
                    let (a, b) = self.walls[wall as usize].ends();
                    best = best.min(distance_squared(a, b, p));
                }
            });
            match sure_m {
                Some(sure_m) if best > sure_m * sure_m => {}
                _ => break,
            }
        }
        best.sqrt()
    }

    /// Visits every wall that comes within `reach_m` of a place, a few that do not, and some more than once.
    pub(crate) fn each_wall_near(&self, at: Vec2, reach_m: f64, mut visit: impl FnMut(&Segment)) {
        let (at, reach) = (at.as_dvec2(), DVec2::splat(reach_m));
        if at.is_finite() {
            self.grid.within(at - reach, at + reach, |wall| visit(&self.walls[wall as usize]));
        }
    }

    /// A place where two walls cross or touch other than end to end along their loop (m), if there is one. Exact.
    pub fn first_crossing(&self) -> Option<Vec2> {
        let mut at = None;
        let _ = self.each_crossing(|wall, _| {
            at = self.walls.get(wall).map(|wall| wall.a.midpoint(wall.b));
            ControlFlow::Break(())
        });
        at
    }

    /// Visits every pair of walls that cross or touch other than end to end along their loop, perhaps more than once.
    fn each_crossing(&self, mut visit: impl FnMut(usize, usize) -> ControlFlow<()>) -> ControlFlow<()> {
        let next_of = self.next_walls();
        for (index, wall) in self.walls.iter().enumerate() {
            let (a, b) = wall.ends();
            self.grid.along(a, b, |cell| {
                for &other in self.grid.walls_of(cell) {
                    let other = other as usize;
                    if other <= index {
                        continue;
                    }
                    let (c, d) = self.walls[other].ends();
                    let crossing = if next_of[index] == other {
                        folds_back(a, b, d)
                    } else if next_of[other] == index {
                        folds_back(c, d, b)
                    } else {
                        touch((a, b), (c, d))
                    };
                    if crossing {
                        visit(index, other)?;
                    }
                }
                ControlFlow::Continue(())
            })?;
        }
        ControlFlow::Continue(())
    }

    /// For each wall, the wall that starts where it ends.
    fn next_walls(&self) -> Vec<usize> {
        let mut next: Vec<usize> = (1..=self.walls.len()).collect();
        let ends = self.loops.iter().skip(1).copied().chain([self.walls.len()]);
        for (&from, to) in self.loops.iter().zip(ends) {
            next[to - 1] = from;
        }
        next
    }
}

/// Whether `b → c` runs back over `a → b`.
fn folds_back(a: DVec2, b: DVec2, c: DVec2) -> bool {
    geometry::orient(a, b, c) == 0.0 && (b - a).dot(c - b) < 0.0
}
