//! Where robots start if nobody says: side by side, in the roomiest place there is or around one that is given.

use std::collections::VecDeque;

use glam::Vec2;

use crate::map::Map;

/// Most places that are looked at.
const PLACES_MAX: f32 = 1.0e6;

/// A lattice of places at which a robot has room, so far apart that two of them have room beside each other.
pub(super) struct Lattice<'m> {
    map: &'m Map,
    low: Vec2,
    step_m: f32,
    cols: usize,
    rows: usize,
    /// Room up to the nearest wall (m); none where a robot has not enough.
    room_m: Vec<Option<f32>>,
}

impl<'m> Lattice<'m> {
    /// Robots need so much air up to walls, and up to each other (m).
    pub(super) fn new(map: &'m Map, wall_m: f32, apart_m: f32) -> Self {
        let (low, high) = map.bounds();
        let size = high - low;
        let step_m = (1.001 * apart_m).max((size.x * size.y / PLACES_MAX).sqrt()).max(0.01);
        let (cols, rows) = ((size.x / step_m) as usize + 1, (size.y / step_m) as usize + 1);
        let mut lattice = Self { map, low, step_m, cols, rows, room_m: Vec::new() };
        let room = |index| {
            let at = lattice.at(index);
            let room_m = if map.in_rock(at) { -1.0 } else { map.clearance_m(at) };
            (room_m >= wall_m).then_some(room_m)
        };
        lattice.room_m = (0..cols * rows).map(room).collect();
        lattice
    }

    fn at(&self, index: usize) -> Vec2 {
        // Off the bounds, where walls are.
        let cell = Vec2::new((index % self.cols) as f32, (index / self.cols) as f32);
        self.low + (cell + 0.5) * self.step_m
    }

    /// The place with the most room in the largest connected part; of equal ones the lowest, then the leftmost.
    pub(super) fn roomiest(&self) -> Option<usize> {
        let mut part = vec![false; self.room_m.len()];
        let mut largest: Vec<usize> = Vec::new();
        for first in 0..self.room_m.len() {
            if !part[first] && self.room_m[first].is_some() {
                let found = self.around(first, usize::MAX, &mut part);
                if found.len() > largest.len() {
                    largest = found;
                }
            }
        }
        let room_m = |index: &usize| self.room_m[*index].unwrap_or(0.0);
        largest.sort_unstable();
        largest.into_iter().reduce(|best, next| if room_m(&next) > room_m(&best) { next } else { best })
    }

    /// The place nearest to one (m).
    pub(super) fn nearest(&self, to: Vec2) -> Option<usize> {
        let with_room = (0..self.room_m.len()).filter(|&index| self.room_m[index].is_some());
        with_room.min_by(|&a, &b| self.at(a).distance_squared(to).total_cmp(&self.at(b).distance_squared(to)))
    }

    /// So many places around one that a robot can fly to from it, the nearest by steps first.
    pub(super) fn places(&self, first: usize, count: usize) -> Vec<Vec2> {
        let found = self.around(first, count, &mut vec![false; self.room_m.len()]);
        found.into_iter().map(|index| self.at(index)).collect()
    }

    /// Breadth first, through air; at most `count`.
    fn around(&self, first: usize, count: usize, asked: &mut [bool]) -> Vec<usize> {
        let mut found = Vec::new();
        let mut open = VecDeque::from([first]);
        asked[first] = true;
        while let Some(index) = open.pop_front() {
            found.push(index);
            if found.len() >= count {
                break;
            }
            let (col, row) = (index % self.cols, index / self.cols);
            let beside = [
                (col + 1 < self.cols).then_some(index + 1),
                (col > 0).then(|| index - 1),
                (row + 1 < self.rows).then_some(index + self.cols),
                (row > 0).then(|| index - self.cols),
            ];
            for next in beside.into_iter().flatten() {
                if !asked[next] && self.room_m[next].is_some() && self.map.sees(self.at(index), self.at(next))
                {
                    asked[next] = true;
                    open.push_back(next);
                }
            }
        }
        found
    }
}
