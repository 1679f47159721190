//! Of many places the nearest one in sight.

use std::{cmp::Reverse, collections::BinaryHeap};

use glam::Vec2;

use crate::map::Map;

/// Most cells along a side.
const MOST_SIDE: f32 = 256.0;
/// After so many places out of sight the search is given up.
const MOST_LOOKS: usize = 4_096;
/// Most steps of a climb, and its headings.
const CLIMB_STEPS: usize = 32;
const CLIMB_HEADINGS: u8 = 16;

/// Places sorted into square cells.
#[derive(Debug)]
pub(crate) struct Near<'p> {
    places: &'p [Vec2],
    low: Vec2,
    cell_m: f32,
    cols: usize,
    rows: usize,
    /// Where each cell's places start in `items`; one more than there are cells.
    starts: Vec<u32>,
    items: Vec<u32>,
}

impl<'p> Near<'p> {
    pub(crate) fn new(places: &'p [Vec2]) -> Self {
        let (mut low, mut high) = (Vec2::ZERO, Vec2::ZERO);
        if let Some(&first) = places.first() {
            (low, high) = places.iter().fold((first, first), |(low, high), &at| (low.min(at), high.max(at)));
        }
        let size = high - low;
        let cell_m = (size.max_element() / MOST_SIDE).max(1e-3);
        let side = |length_m: f32| (length_m / cell_m) as usize + 1;
        let mut near = Self {
            places,
            low,
            cell_m,
            cols: side(size.x),
            rows: side(size.y),
            starts: Vec::new(),
            items: vec![0; places.len()],
        };
        let mut counts = vec![0_u32; near.cols * near.rows + 1];
        for &place in places {
            counts[near.cell_of(place) + 1] += 1;
        }
        for cell in 1..counts.len() {
            counts[cell] += counts[cell - 1];
        }
        near.starts.clone_from(&counts);
        for (index, &place) in places.iter().enumerate() {
            let next = &mut counts[near.cell_of(place)];
            near.items[*next as usize] = index as u32;
            *next += 1;
        }
        near
    }

    fn column_and_row(&self, at: Vec2) -> (usize, usize) {
        let cell = ((at - self.low) / self.cell_m).max(Vec2::ZERO);
        ((cell.x as usize).min(self.cols - 1), (cell.y as usize).min(self.rows - 1))
    }

    fn cell_of(&self, at: Vec2) -> usize {
        let (col, row) = self.column_and_row(at);
        row * self.cols + col
    }

    /// The nearest place that is seen from a place by somebody who needs so much room (m), if it is among the nearest few
    /// thousand; of equally near ones the first.
    pub(crate) fn seen_from(&self, map: &Map, from: Vec2, radius_m: f32) -> Option<usize> {
        let room_m = map.clearance_m(from).min(radius_m);
        let (col, row) = self.column_and_row(from);
        let mut open = BinaryHeap::new();
        let mut looks = 0;
        for ring in 0..=self.cols.max(self.rows) {
            let whole = ring == self.cols.max(self.rows);
            self.ring(col, row, ring, |index| {
                let distance_m = self.places[index as usize].distance(from);
                open.push(Reverse((distance_m.to_bits(), index)));
            });
            // Seen from outside the grid, everything is farther than from the nearest point of it.
            let sure_m = ring as f32 * self.cell_m;
            while let Some(&Reverse((bits, index))) = open.peek() {
                if !whole && f32::from_bits(bits) > sure_m {
                    break;
                }
                open.pop();
                if is_clear(map, from, self.places[index as usize], room_m) {
                    return Some(index as usize);
                }
                looks += 1;
                if looks == MOST_LOOKS {
                    return None;
                }
            }
        }
        None
    }

    /// Visits the places in the square ring of cells so many cells away from one.
    fn ring(&self, col: usize, row: usize, ring: usize, mut visit: impl FnMut(u32)) {
        let mut look = |x: usize, y: usize| {
            let cell = y * self.cols + x;
            let span = self.starts[cell] as usize..self.starts[cell + 1] as usize;
            self.items[span].iter().for_each(|&index| visit(index));
        };
        for y in row.saturating_sub(ring)..=(row + ring).min(self.rows - 1) {
            if y.abs_diff(row) == ring {
                (col.saturating_sub(ring)..=(col + ring).min(self.cols - 1)).for_each(|x| look(x, y));
            } else {
                let beside = [col.checked_sub(ring), Some(col + ring).filter(|&x| x < self.cols)];
                beside.into_iter().flatten().for_each(|x| look(x, y));
            }
        }
    }

    /// The way to the nearest place in sight: the places on the way there, and the place's index. Where none is in sight,
    /// it first climbs to where the walls are farther off.
    pub(crate) fn way_from(&self, map: &Map, from: Vec2, radius_m: f32) -> Option<(Vec<Vec2>, usize)> {
        let (mut here, mut way) = (from, vec![from]);
        for _ in 0..CLIMB_STEPS {
            if let Some(index) = self.seen_from(map, here, radius_m) {
                return Some((way, index));
            }
            let room_m = map.clearance_m(here);
            let steps = (0..CLIMB_HEADINGS).map(|heading| {
                let angle = f32::from(heading) * (std::f32::consts::TAU / f32::from(CLIMB_HEADINGS));
                here + Vec2::new(libm::cosf(angle), libm::sinf(angle)) * (0.9 * room_m)
            });
            let best = steps.max_by(|p, q| map.clearance_m(*p).total_cmp(&map.clearance_m(*q)))?;
            if map.clearance_m(best) <= room_m || !map.sees(here, best) {
                return None;
            }
            here = best;
            way.push(here);
        }
        None
    }
}

/// Whether one place sees another, and the straight line between them keeps so far from the walls (m).
pub(super) fn is_clear(map: &Map, from: Vec2, to: Vec2, least_m: f32) -> bool {
    if !map.sees(from, to) {
        return false;
    }
    let length_m = from.distance(to);
    let mut along_m = 0.0;
    // No wall is nearer than the clearance: as far as that exceeds what is asked, there is no need to look.
    while along_m < length_m && least_m > 0.0 {
        let spare_m = map.clearance_m(from.lerp(to, along_m / length_m)) - least_m;
        if spare_m.is_nan() || spare_m < -1e-3 * least_m {
            return false;
        }
        along_m += spare_m.max(0.05 * least_m);
    }
    true
}
