//! Where robots start if nobody says: side by side, in the roomiest place there is or around one that is given.

use std::collections::VecDeque;

use glam::{IVec2, Vec2};

use crate::map::{CellGrid, Map};

/// Most places that are looked at.
const PLACES_MAX: f32 = 1.0e6;

/// A lattice of places at which a robot has room, so far apart that two of them have room beside each other.
pub(super) struct Lattice<'m> {
    map: &'m Map,
    /// Places are the middles of cells: off the bounds, where walls are.
    cells: CellGrid,
    /// Room up to the nearest wall (m); none where a robot has not enough.
    room_m: Vec<Option<f32>>,
}

impl<'m> Lattice<'m> {
    /// Robots need so much air up to walls, and up to each other (m).
    pub(super) fn new(map: &'m Map, wall_m: f32, apart_m: f32) -> Self {
        let (low, high) = map.bounds();
        let size = high - low;
        let step_m = (1.001 * apart_m).max((size.x * size.y / PLACES_MAX).sqrt()).max(0.01);
        let cells = CellGrid::new(low, step_m, (size / step_m).as_ivec2() + IVec2::ONE);
        let room = |index| {
            let at = cells.middle_of(index);
            let room_m = if map.in_rock(at) { -1.0 } else { map.clearance_m(at) };
            (room_m >= wall_m).then_some(room_m)
        };
        let room_m = (0..cells.count()).map(room).collect();
        Self { map, cells, room_m }
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
        with_room.min_by(|&a, &b| {
            self.cells
                .middle_of(a)
                .distance_squared(to)
                .total_cmp(&self.cells.middle_of(b).distance_squared(to))
        })
    }

    /// So many places around one that a robot can fly to from it, the nearest by steps first.
    pub(super) fn places(&self, first: usize, count: usize) -> Vec<Vec2> {
        let found = self.around(first, count, &mut vec![false; self.room_m.len()]);
        found.into_iter().map(|index| self.cells.middle_of(index)).collect()
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
            for next in CellGrid::STEPS.into_iter().filter_map(|step| self.cells.beside(index, step)) {
                if !asked[next]
                    && self.room_m[next].is_some()
                    && self.map.sees(self.cells.middle_of(index), self.cells.middle_of(next))
                {
                    asked[next] = true;
                    open.push_back(next);
                }
            }
        }
        found
    }
}
