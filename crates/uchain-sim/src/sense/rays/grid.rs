//! Rays in lists of the walls within reach of each cell.

use glam::Vec2;

use super::{
    Rays,
    batch::{Batch, Nearest},
    lists::{Counts, Lists},
};
use crate::map::Map;

/// Walls that a list may hold on average (1) where one list answers a whole ray (half as many cost the rays of a
/// winding tunnel half as much again) …
const LONG_LIST: f32 = 100.0;
/// … and where a ray goes on from list to list. Both measured: somewhat more or less costs little.
const LONG_LISTS: f32 = 10.0;
/// Memory for the lists: this much (bytes) …
const BASE_BYTES: usize = 1 << 20;
/// … and this much for each wall (bytes).
const WALL_BYTES: usize = 192;
/// How far rounding can carry a hit off its wall and a point off its cell, over the largest number in the sum; twice
/// what it comes to.
const ROUNDING: f32 = 2e-6;
/// How far the length of a direction may be from 1.
const UNIT: f32 = 1e-3;

/// Rays in lists: each cell of a grid lists every wall within reach of it, so that a look at one list answers all rays
/// that are no longer than the reach, whatever their number and direction. Longer rays go on from list to list.
///
/// Every distance is that of one and the same test, so that it does not depend on the lists
/// to the bit, nor on the processor. It is within a few millionths of the numbers it is made of: 10 µm at 30 m.
///
/// It never changes once built: all runs share one. It takes at most 192 bytes a wall and 1 MiB, however far the walls
/// are spread.
#[derive(Debug, Clone)]
pub struct GridRays {
    lists: Lists,
    /// What the list of a cell covers around any of its points (m).
    reach_m: f32,
    bounds: (Vec2, Vec2),
    most_steps: u32,
}

impl GridRays {
    /// Rays in the walls of a map, at their best up to `range_m` (m); longer ones may be cast too.
    pub fn new(map: &Map, range_m: f32) -> Self {
        let (walls, bounds) = (map.walls(), map.bounds());
        // No sum has a number larger than this.
        let span_m = bounds.0.distance(bounds.1) + bounds.0.abs().max(bounds.1.abs()).length();
        let least_m = (1e-5 * span_m).max(1e-3);
        // NaN becomes the whole span.
        let range_m = range_m.min(span_m).max(least_m);
        let most_bytes = WALL_BYTES * walls.len() + BASE_BYTES;
        // A list covers a stretch of two reaches: one ray takes 1, 2, 3 … lists if they reach 1/1, 1/3, 1/5 … as far.
        let mut share = 1.0;
        let (reach_m, counts) = loop {
            let reach_m = range_m / share;
            let listed_m = reach_m + UNIT * reach_m + ROUNDING * span_m;
            let counts = Counts::new(walls, bounds, listed_m, reach_m, most_bytes);
            // Where memory sets the size of the cells, shorter lists are not to be had.
            let long = if share == 1.0 { LONG_LIST } else { LONG_LISTS };
            if counts.mean() <= long || counts.cell_m() > 2.0 * reach_m || reach_m < least_m {
                break (reach_m, counts);
            }
            share += 2.0;
        };
        let lists = Lists::new(walls, counts);
        let bounds = lists.lattice().bounds();
        let most_steps = (bounds.0.distance(bounds.1) / (2.0 * reach_m)) as u32 + 2;
        Self { lists, reach_m, bounds, most_steps }
    }

    /// The walls to try first, and how far they cover a ray that long (m).
    #[inline]
    fn first(&self, from: Vec2, range_m: f32) -> (&[Batch], f32) {
        match self.lists.near(from) {
            Some(near) => (near, self.reach_m),
            // Nothing within reach.
            None if range_m <= self.reach_m => (&[], range_m),
            None => (self.lists.all(), range_m),
        }
    }

    /// Looks on from the end of the first list's reach.
    fn walk(&self, from: Vec2, direction: Vec2, mut nearest_m: f32) -> f32 {
        let mut covered_m = self.reach_m;
        let out_m = self.way_out_m(from, direction);
        for _ in 0..self.most_steps {
            if !(covered_m < nearest_m && covered_m < out_m) {
                break;
            }
            let next_m = covered_m + self.reach_m;
            let mut nearest = Nearest::within(nearest_m);
            for batch in self.lists.near(from + direction * next_m).unwrap_or_default() {
                batch.from(from).ahead(direction, &mut nearest);
            }
            nearest_m = nearest.least();
            covered_m = next_m + self.reach_m;
        }
        nearest_m
    }

    /// How far it is at most to the border of the lattice from within (m).
    fn way_out_m(&self, from: Vec2, direction: Vec2) -> f32 {
        let (low, high) = self.bounds;
        let out_m = |low: f32, high: f32, from: f32, along: f32| {
            let border = if along > 0.0 { high } else { low };
            if along == 0.0 { f32::INFINITY } else { (border - from) / along }
        };
        out_m(low.x, high.x, from.x, direction.x).min(out_m(low.y, high.y, from.y, direction.y))
    }
}

#[cfg(test)]
impl GridRays {
    /// Memory of the lists (bytes), and what is promised for a number of walls.
    pub(super) fn bytes(&self) -> usize {
        self.lists.bytes()
    }

    pub(super) fn most_bytes(walls: usize) -> usize {
        WALL_BYTES * walls + BASE_BYTES
    }
}

impl Rays for GridRays {
    fn cast(&self, from: Vec2, direction: Vec2, range_m: f32) -> f32 {
        let (batches, covered_m) = self.first(from, range_m);
        let mut nearest = Nearest::within(range_m);
        for batch in batches {
            batch.from(from).ahead(direction, &mut nearest);
        }
        let nearest_m = nearest.least();
        if nearest_m > covered_m { self.walk(from, direction, nearest_m) } else { nearest_m }
    }

    fn fan<const N: usize>(
        &self,
        from: Vec2,
        lines: impl Iterator<Item = [Vec2; N]> + Clone,
        range_m: f32,
    ) -> [[f32; 2]; N] {
        let (batches, covered_m) = self.first(from, range_m);
        let mut nearest = [[Nearest::within(range_m); 2]; N];
        for bundles in lines.clone() {
            for batch in batches {
                let seen = batch.from(from);
                for (nearest, line) in nearest.iter_mut().zip(bundles) {
                    seen.both(line, nearest);
                }
            }
        }
        let mut nearest_m = nearest.map(|both| both.map(Nearest::least));
        if nearest_m.as_flattened().iter().any(|nearest_m| *nearest_m > covered_m) {
            for bundles in lines {
                for ([ahead_m, behind_m], line) in nearest_m.iter_mut().zip(bundles) {
                    *ahead_m = self.walk(from, line, *ahead_m);
                    *behind_m = self.walk(from, -line, *behind_m);
                }
            }
        }
        nearest_m
    }
}
