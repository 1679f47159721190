//! Maps drawn by hand: wall loops in metres.

use std::{ops::ControlFlow, path::Path};

use glam::{DVec2, Vec2};
use serde::{Deserialize, Serialize};

use super::{Fault, Format, MapFormat, is_no_file};
use crate::map::{CentreLine, FARTHEST_M, Map, MapError, geometry::orient};

pub(super) const FORMAT: Format = Format {
    table: "map.walls",
    name: "walls drawn one by one",
    keys: WallsConfig::KEYS,
    ends: &[],
    sniff: is_no_file,
};

uchain_core::params! {
    /// Walls drawn one by one, as closed loops of corners `[x, y]` (m). Loops neither cross nor touch. Rock within rock
    /// is rock, and beyond the outer wall all is.
    #[derive(Serialize, Deserialize)]
    #[serde(deny_unknown_fields)]
    pub struct WallsConfig {
        /// Corners of what surrounds the free space (m).
        #[schemars(schema_with = "super::shape::points")]
        pub outer_m: Vec<[f64; 2]>;
        /// Corners of the solid pieces that stand in it (m).
        #[serde(default)]
        #[schemars(schema_with = "super::shape::loops")]
        pub inner_m: Vec<Vec<[f64; 2]>>;
    }
}

impl MapFormat for WallsConfig {
    fn legal(&self) -> Result<(), Fault> {
        Ok(self.check()?)
    }

    fn places(&self) -> Vec<(String, [f64; 2])> {
        let outer = self.outer_m.iter().enumerate().map(|(i, &at)| (format!("outer_m.{i}"), at));
        let inner = self.inner_m.iter().enumerate().flat_map(|(loop_, corners)| {
            corners.iter().enumerate().map(move |(i, &at)| (format!("inner_m.{loop_}.{i}"), at))
        });
        outer.chain(inner).collect()
    }

    fn lay(&self, _: &Path, _: [f64; 2]) -> Result<(Map, Option<CentreLine>), MapError> {
        let loops: Vec<Vec<[f64; 2]>> =
            std::iter::once(&self.outer_m).chain(&self.inner_m).cloned().collect();
        drawn(&loops).map(|map| (map, None))
    }
}

/// A map from closed wall loops, in the drawing's own frame (m). Free space is what the first loop surrounds, but for
/// the pieces of rock that the others surround: rock within rock is rock, and beyond the first loop all is. Such loops
/// bound nothing, and are left out. The map frame's origin is the middle of the others; [`Map::to_local`] converts.
///
/// ```
/// use uchain_sim::map::drawn;
/// let room = vec![[10.0, 0.0], [14.0, 0.0], [14.0, 4.0], [10.0, 4.0]];
/// let pillar = vec![[11.0, 1.0], [11.0, 2.0], [12.0, 2.0], [12.0, 1.0]];
/// let map = drawn(&[room, pillar]).unwrap();
/// assert!(map.in_rock(map.to_local([11.5, 1.5])) && !map.in_rock(map.to_local([13.0, 3.0])));
/// ```
///
/// # Errors
/// Those of [`Map::from_loops`]; walls that cross or touch other than end to end along their loop; a piece of rock that
/// surrounds the first loop.
pub fn drawn(loops: &[Vec<[f64; 2]>]) -> Result<Map, MapError> {
    let map = place(loops)?;
    if let Some(at) = map.first_crossing() {
        let [x, y] = map.offset_m();
        return Err(MapError::WallsCross { x: f64::from(at.x) + x, y: f64::from(at.y) + y });
    }
    // No two loops touch: one of them is within another one as soon as one of its corners is.
    let around = map.loops_around();
    if let Some(&[x, y]) = around.first().and_then(|around| loops.get(*around.first()?)?.first()) {
        return Err(MapError::AllRock { x, y });
    }
    let bounds: Vec<bool> =
        around.iter().enumerate().map(|(i, around)| i == 0 || around[..] == [0]).collect();
    if bounds.iter().all(|&bounds| bounds) {
        return Ok(map);
    }
    let kept: Vec<Vec<[f64; 2]>> =
        loops.iter().zip(bounds).filter(|(_, bounds)| *bounds).map(|(corners, _)| corners.clone()).collect();
    place(&kept)
}

/// The loops around their middle.
fn place(loops: &[Vec<[f64; 2]>]) -> Result<Map, MapError> {
    let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    for (index, &[x, y]) in loops.iter().flatten().enumerate() {
        // Also for a drawing far from its own origin, where only its size counts.
        if !(x.is_finite() && y.is_finite()) {
            return Err(MapError::Coordinate { index, x, y, most: f64::from(FARTHEST_M) });
        }
        (low, high) = (low.min(DVec2::new(x, y)), high.max(DVec2::new(x, y)));
    }
    let middle = if low.is_finite() { (low + high) / 2.0 } else { DVec2::ZERO };
    let place = |&[x, y]: &[f64; 2]| (DVec2::new(x, y) - middle).as_vec2();
    let placed: Vec<Vec<Vec2>> = loops.iter().map(|corners| corners.iter().map(place).collect()).collect();
    Ok(Map::from_loops(placed)?.with_offset_m(middle.into()))
}

impl Map {
    /// For each loop, the other loops that surround its first corner, in order. For loops that do not touch.
    pub(in crate::map) fn loops_around(&self) -> Vec<Vec<usize>> {
        let mut near: Vec<u32> = Vec::new();
        let first = self.loops.iter().enumerate();
        first.map(|(own, &first)| self.loops_around_corner(own, first, &mut near)).collect()
    }

    /// Counts walls to the left of a corner, each loop's by itself: walls count from their lower end up to, but without,
    /// their upper end.
    fn loops_around_corner(&self, own: usize, first: usize, near: &mut Vec<u32>) -> Vec<usize> {
        let p = self.walls[first].a.as_dvec2();
        let west = DVec2::new(f64::from(self.bounds.0.x) - 1.0, p.y);
        near.clear();
        let _ = self.grid.along(west, p, |cell| {
            near.extend_from_slice(self.grid.walls_of(cell));
            ControlFlow::Continue(())
        });
        near.sort_unstable();
        near.dedup();
        let mut around: Vec<usize> = Vec::new();
        for &index in near.iter() {
            let (u, v) = self.walls[index as usize].ends();
            let is_west = (orient(u, v, p) > 0.0) != (v.y > u.y);
            if (u.y > p.y) == (v.y > p.y) || !is_west {
                continue;
            }
            let of = self.loops.partition_point(|&start| start <= index as usize) - 1;
            match around.last() {
                _ if of == own => {}
                // The walls of a loop come one after the other.
                Some(&last) if last == of => {
                    around.pop();
                }
                _ => around.push(of),
            }
        }
        around
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn rectangle([x0, y0, x1, y1]: [f64; 4]) -> Vec<[f64; 2]> {
        vec![[x0, y0], [x1, y0], [x1, y1], [x0, y1]]
    }

    fn is_in([x0, y0, x1, y1]: [f64; 4], [x, y]: [f64; 2]) -> bool {
        x0 <= x && x <= x1 && y0 <= y && y <= y1
    }

    #[test]
    fn rock_within_rock_is_rock_and_bounds_nothing() {
        let outer = rectangle([0.0, 0.0, 6.0, 4.0]);
        let piece = rectangle([2.0, 1.0, 5.0, 3.0]);
        let solid = drawn(&[outer.clone(), piece.clone()]).unwrap();
        // A hole, a piece within that, and one that stands outside of the outer wall.
        let more = [[3.0, 1.5, 4.0, 2.5], [3.4, 1.8, 3.6, 2.0], [8.0, 1.0, 9.0, 2.0]].map(rectangle);
        let map = drawn(&[[outer, piece].as_slice(), &more].concat()).unwrap();
        assert_eq!(
            (map.walls(), map.bounds(), map.offset_m()),
            (solid.walls(), solid.bounds(), solid.offset_m())
        );
        let local = |at| map.to_local(at);
        assert!(
            map.in_rock(local([3.5, 2.0]))
                && map.in_rock(local([3.5, 1.9]))
                && map.in_rock(local([8.5, 1.5]))
        );
        assert_eq!(map.rock_stretches(local([1.0, 2.0]), local([5.5, 2.0])), 1);
        assert!(!map.in_rock(local([1.0, 2.0])));
    }

    #[test]
    fn a_piece_around_the_outer_wall_leaves_no_free_space_and_is_refused() {
        let loops = [[0.0, 0.0, 6.0, 4.0], [-1.0, -1.0, 7.0, 5.0]].map(rectangle);
        assert_eq!(drawn(&loops).unwrap_err(), MapError::AllRock { x: -1.0, y: -1.0 });
    }

    proptest! {
        #[test]
        fn free_is_what_is_within_the_outer_wall_and_in_no_piece(
            // Odd and even halves: corners of pieces never meet, nor lie on each other's sides.
            pieces in prop::collection::vec((-4..14_i32, -4..14_i32, 1..10_i32, 1..10_i32), 0..8),
            places in prop::collection::vec((-5.0..25.0_f64, -5.0..25.0_f64), 30),
        ) {
            let outer = [0.0, 0.0, 10.0, 10.0];
            let pieces: Vec<[f64; 4]> = pieces.iter().enumerate().map(|(i, &(x, y, w, h))| {
                let off = 0.03 * (i + 1) as f64;
                let (x, y) = (f64::from(x) + off, f64::from(y) + off);
                [x, y, x + f64::from(w) + off / 2.0, y + f64::from(h) + off / 2.0]
            }).collect();
            let loops: Vec<Vec<[f64; 2]>> = std::iter::once(&outer).chain(&pieces).map(|&r| rectangle(r)).collect();
            let map = match drawn(&loops) {
                Ok(map) => map,
                Err(MapError::WallsCross { .. } | MapError::AllRock { .. }) => return Ok(()),
                Err(error) => return Err(TestCaseError::fail(error.to_string())),
            };
            for (x, y) in places {
                let free = is_in(outer, [x, y]) && !pieces.iter().any(|&piece| is_in(piece, [x, y]));
                // Beside a wall, a coordinate's last bit decides.
                if map.clearance_m(map.to_local([x, y])) > 1e-4 {
                    prop_assert_eq!(!map.in_rock(map.to_local([x, y])), free, "({}, {})", x, y);
                }
            }
        }
    }
}
