//! What lies in rock: a point, and which parts of a straight line.
//!
//! Every decision is the exact sign of an orientation. A line through a corner is read as if moved a hair to its
//! left, so that the walls it crosses alternate between rock and free space whatever it touches; a stretch along a
//! wall is free.

use std::ops::ControlFlow;

use glam::{DVec2, Vec2};
use smallvec::SmallVec;
use uchain_core::bounded;

use super::{
    Map,
    geometry::{between, opposite, orient},
    grid::Grid,
};

/// Stretches of rock no longer than this do not block sight (m): where a line touches a corner, rounding may leave
/// one.
const TOUCH_M: f64 = 1e-6;

/// Where a line crosses walls, and where it runs along them, as fractions of its length. Few cuts need no memory.
#[derive(Default)]
struct Cuts {
    crossings: SmallVec<[(f64, u32); 32]>,
    runs: SmallVec<[(f64, f64); 8]>,
}

impl Map {
    /// Whether `p` is in rock. Exact; a point on a wall is free, a `p` that is no point is in rock.
    pub fn in_rock(&self, p: Vec2) -> bool {
        !p.is_finite() || self.in_rock_f64(p.as_dvec2())
    }

    pub(super) fn in_rock_f64(&self, p: DVec2) -> bool {
        self.rock_side(p).unwrap_or(false)
    }

    /// Whether rock begins right behind a wall's face and goes on by `across`: what lies beyond a narrow cleft is another
    /// wall's rock.
    #[cfg(feature = "drawings")]
    pub(super) fn is_rock_behind(&self, face: DVec2, across: DVec2) -> bool {
        [0.125, 0.25, 0.5, 0.75, 1.0].into_iter().all(|share| self.in_rock_f64(face + share * across))
    }

    /// The share of the segment `a b` that is inside rock, 0 to 1, the same from both ends.
    ///
    /// 1 if an end is not a point. Two equal ends give 0 or 1.
    pub fn rock_fraction(&self, a: Vec2, b: Vec2) -> f32 {
        if !(a.is_finite() && b.is_finite()) {
            return 1.0;
        }
        let (a, b) = if (b.x, b.y) < (a.x, a.y) { (b, a) } else { (a, b) };
        let mut rock = 0.0;
        self.each_rock_stretch(a.as_dvec2(), b.as_dvec2(), |from, to| rock += to - from);
        bounded(rock, 0.0, 1.0) as f32
    }

    /// How many separate stretches of the segment `a b` are inside rock; stretches of 1 µm or less do not count.
    pub fn rock_stretches(&self, a: Vec2, b: Vec2) -> u32 {
        if !(a.is_finite() && b.is_finite()) {
            return 1;
        }
        let (a, b) = if (b.x, b.y) < (a.x, a.y) { (b, a) } else { (a, b) };
        let (a, b) = (a.as_dvec2(), b.as_dvec2());
        let length_m = a.distance(b);
        let mut stretches = 0;
        self.each_rock_stretch(a, b, |from, to| stretches += u32::from((to - from) * length_m > TOUCH_M));
        stretches
    }

    /// Calls `wall` for each separate stretch of rock of the segment `a b`, as [`Map::rock_stretches`] counts them, with the
    /// numbers of the walls where it begins and ends; `None` of an end of the segment that is in rock. In the same order from
    /// both ends.
    pub(crate) fn each_wall_between(&self, a: Vec2, b: Vec2, mut wall: impl FnMut([Option<usize>; 2])) {
        if !(a.is_finite() && b.is_finite()) {
            wall([None, None]);
            return;
        }
        let (a, b) = if (b.x, b.y) < (a.x, a.y) { (b, a) } else { (a, b) };
        let (a, b) = (a.as_dvec2(), b.as_dvec2());
        let length_m = a.distance(b);
        let mut cuts = Cuts::default();
        let _ = self.cut(a, b, &mut cuts, |_| false);
        let face = |at: f64| {
            let found = cuts.crossings.iter().find(|&&(t, _)| t == at);
            found.map(|&(_, index)| index as usize)
        };
        self.each_stretch(a, b, &cuts, |from, to| {
            if (to - from) * length_m > TOUCH_M {
                wall([face(from), face(to)]);
            }
        });
    }

    /// Whether the open segment `a b` crosses no wall and enters no rock; touching a corner or running along a
    /// wall is allowed. A stretch of rock of 1 µm or less counts as touching.
    pub fn sees(&self, a: Vec2, b: Vec2) -> bool {
        if !(a.is_finite() && b.is_finite()) {
            return false;
        }
        let (a, b) = (a.as_dvec2(), b.as_dvec2());
        let mut cuts = Cuts::default();
        if self.cut(a, b, &mut cuts, |clean| clean).is_break() {
            return false;
        }
        let length_m = a.distance(b);
        let mut clear = true;
        self.each_stretch(a, b, &cuts, |from, to| {
            if length_m == 0.0 || (to - from) * length_m > TOUCH_M {
                clear = false;
            }
        });
        clear
    }

    /// Calls `stretch` with the ends of each part of `a b` in rock, as fractions of the length, in order.
    fn each_rock_stretch(&self, a: DVec2, b: DVec2, stretch: impl FnMut(f64, f64)) {
        let mut cuts = Cuts::default();
        let _ = self.cut(a, b, &mut cuts, |_| false);
        self.each_stretch(a, b, &cuts, stretch);
    }

    fn each_stretch(&self, a: DVec2, b: DVec2, cuts: &Cuts, mut stretch: impl FnMut(f64, f64)) {
        let mut rock = self.rock_at_start(a, b, cuts);
        let mut from = 0.0;
        for to in cuts.crossings.iter().map(|&(t, _)| t).chain([1.0]) {
            if rock && to > from {
                outside_runs(from, to, &cuts.runs, &mut stretch);
            }
            rock = !rock;
            from = to;
        }
    }

    /// Finds where `a b` meets walls. Breaks off when `stop` says so of a wall it crosses, told whether it passes
    /// clean through.
    fn cut(&self, a: DVec2, b: DVec2, cuts: &mut Cuts, stop: impl Fn(bool) -> bool) -> ControlFlow<()> {
        if a == b {
            return ControlFlow::Continue(());
        }
        // A long wall is listed by many cells in a row: once looked at is enough.
        let mut looked_at: &[u32] = &[];
        self.grid.along(a, b, |cell| {
            let walls = self.grid.walls_of(cell);
            for &index in walls.iter().filter(|index| !looked_at.contains(index)) {
                let (u, v) = self.walls[index as usize].ends();
                let (side_u, side_v) = (orient(a, b, u), orient(a, b, v));
                if side_u == 0.0 && side_v == 0.0 {
                    let along = (b - a) / (b - a).length_squared();
                    let (t, s) =
                        (bounded((u - a).dot(along), 0.0, 1.0), bounded((v - a).dot(along), 0.0, 1.0));
                    if t != s {
                        cuts.runs.push((t.min(s), t.max(s)));
                    }
                } else if (side_u > 0.0) != (side_v > 0.0) {
                    let (side_a, side_b) = (orient(u, v, a), orient(u, v, b));
                    let apart = (side_a <= 0.0 && side_b >= 0.0) || (side_a >= 0.0 && side_b <= 0.0);
                    if apart {
                        if stop(opposite(side_u, side_v) && opposite(side_a, side_b)) {
                            return ControlFlow::Break(());
                        }
                        cuts.crossings.push((side_a / (side_a - side_b), index));
                    }
                }
            }
            looked_at = walls;
            ControlFlow::Continue(())
        })?;
        cuts.crossings.sort_unstable_by(|p, q| p.0.total_cmp(&q.0).then(p.1.cmp(&q.1)));
        cuts.crossings.dedup();
        cuts.runs.sort_unstable_by(|p, q| p.0.total_cmp(&q.0).then(p.1.total_cmp(&q.1)));
        ControlFlow::Continue(())
    }

    /// Whether `a b`, moved a hair to its left, starts in rock. Read off whichever end is clear of walls; if both
    /// ends are on walls, off a point within the longest stretch between cuts.
    fn rock_at_start(&self, a: DVec2, b: DVec2, cuts: &Cuts) -> bool {
        if let Some(rock) = self.rock_side(a) {
            return rock;
        }
        if a == b {
            return false;
        }
        if let Some(rock) = self.rock_side(b) {
            return rock != (cuts.crossings.len() % 2 == 1);
        }
        let mut ends: Vec<f64> = cuts.crossings.iter().map(|&(t, _)| t).collect();
        ends.extend(cuts.runs.iter().flat_map(|&(from, to)| [from, to]));
        ends.extend([0.0, 1.0]);
        ends.sort_unstable_by(f64::total_cmp);
        let in_run = |t: f64| cuts.runs.iter().any(|&(from, to)| from < t && t < to);
        let stretches = ends.iter().zip(ends.iter().skip(1)).map(|(&from, &to)| (from, to - from));
        let clear = stretches.filter(|&(from, length)| !in_run(from + length / 2.0));
        let Some((from, length)) = clear.max_by(|p, q| p.1.total_cmp(&q.1)) else { return false };
        let before = cuts.crossings.iter().filter(|&&(s, _)| s <= from).count();
        // A corner may touch the stretch from aside; hardly at all three points.
        let probes = [0.5, 0.381_966, 0.723_607].map(|share| a + (b - a) * (from + length * share));
        let rock = probes.into_iter().find_map(|probe| self.rock_side(probe));
        rock.unwrap_or(false) != (before % 2 == 1)
    }

    /// Whether `p` is in rock; `None` if it is on a wall. Counts the walls between `p` and its cell's reference.
    fn rock_side(&self, p: DVec2) -> Option<bool> {
        let Some(cell) = self.grid.cell_at(p) else { return Some(true) };
        let Some(mut rock) = self.rock_at.get(cell).copied().flatten() else {
            return rock_by_ray(p, self.walls.iter().map(super::Segment::ends));
        };
        let reference = self.grid.reference_of(cell);
        for &index in self.grid.walls_of(cell) {
            let (u, v) = self.walls[index as usize].ends();
            let side_p = orient(u, v, p);
            if side_p == 0.0 && between(u, v, p) {
                return None;
            }
            let (side_u, side_v) = (orient(reference, p, u), orient(reference, p, v));
            if (side_u > 0.0) != (side_v > 0.0) && opposite(side_p, orient(u, v, reference)) {
                rock = !rock;
            }
        }
        Some(rock)
    }

    /// For each grid cell, whether its reference point is in rock.
    pub(super) fn rock_at_references(&self) -> Vec<Option<bool>> {
        let grid: &Grid = &self.grid;
        let mut row = Vec::new();
        (0..grid.cells())
            .map(|cell| {
                let reference = grid.reference_of(cell);
                if grid.starts_row(cell) {
                    row.clear();
                    row.extend(grid.cells_of_row(cell).flat_map(|cell| grid.walls_of(cell)));
                    row.sort_unstable();
                    row.dedup();
                    row.retain(|&&wall| {
                        let (u, v) = self.walls[wall as usize].ends();
                        u.y.min(v.y) <= reference.y && reference.y <= u.y.max(v.y)
                    });
                }
                rock_by_ray(reference, row.iter().map(|&&wall| self.walls[wall as usize].ends()))
            })
            .collect()
    }
}

/// Whether `p` is in rock, by the number of walls to its right; `None` if it is on a wall. Walls count from their
/// lower end up to, but without, their upper end: a ray through a corner counts each corner right.
fn rock_by_ray(p: DVec2, walls: impl Iterator<Item = (DVec2, DVec2)>) -> Option<bool> {
    let mut rock = true;
    for (u, v) in walls {
        if u.y.max(v.y) < p.y || u.y.min(v.y) > p.y {
            continue;
        }
        let side = orient(u, v, p);
        if side == 0.0 && between(u, v, p) {
            return None;
        }
        if (u.y > p.y) != (v.y > p.y) && (side > 0.0) == (v.y > u.y) {
            rock = !rock;
        }
    }
    Some(rock)
}

/// Calls `stretch` with the parts of `from..to` that no run covers. `runs` are sorted.
fn outside_runs(from: f64, to: f64, runs: &[(f64, f64)], stretch: &mut impl FnMut(f64, f64)) {
    let mut at = from;
    for &(start, end) in runs {
        if start >= to {
            break;
        }
        if start > at {
            stretch(at, start);
        }
        at = at.max(end);
    }
    if at < to {
        stretch(at, to);
    }
}
