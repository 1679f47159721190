//! Which nodes are near a place: a spatial index of square cells.

use alloc::{collections::BTreeMap, vec::Vec};

use super::super::Point;

/// Ends a chain of slots.
const NONE: u32 = u32::MAX;

/// Nodes by cell.
///
/// A grid of its own: nodes come one by one and nobody knows how far they will reach, so that cells are kept in an
/// ordered map; the simulator's grids lie flat over bounds that are known.
#[derive(Debug, Clone, Default)]
pub(super) struct Grid {
    cell_m: f32,
    /// Last node put into each cell, by column and row.
    last: BTreeMap<(i32, i32), u32>,
    /// Node put into the same cell before, by slot.
    before: Vec<u32>,
    at: Vec<Point>,
}

impl Grid {
    pub(super) fn new(cell_m: f32) -> Self {
        Self { cell_m, ..Self::default() }
    }

    /// Column or row of a coordinate; the cast saturates.
    fn cell(&self, coordinate_m: f32) -> i32 {
        libm::floorf(coordinate_m / self.cell_m) as i32
    }

    /// The next slot lies here.
    pub(super) fn push(&mut self, at: Point) {
        let slot = self.at.len() as u32;
        let before = self.last.insert((self.cell(at.x_m), self.cell(at.y_m)), slot);
        self.before.push(before.unwrap_or(NONE));
        self.at.push(at);
    }

    /// Nodes nearer to a place than so much.
    pub(super) fn within(&self, at: Point, radius_m: f32) -> impl Iterator<Item = usize> + '_ {
        let radius_m = radius_m.max(0.0);
        let cells = |x_m: f32| (self.cell(x_m - radius_m), self.cell(x_m + radius_m));
        let ((left, right), (low, high)) = (cells(at.x_m), cells(at.y_m));
        let columns = (left..=right).flat_map(move |column| self.last.range((column, low)..=(column, high)));
        let chain = |slot: u32| {
            let before = |slot: &u32| self.before.get(*slot as usize).copied().filter(|&slot| slot != NONE);
            core::iter::successors(Some(slot), before)
        };
        columns
            .flat_map(move |(_, &slot)| chain(slot))
            .map(|slot| slot as usize)
            .filter(move |&slot| self.at.get(slot).is_some_and(|p| p.distance2_m2(at) < radius_m * radius_m))
    }
}
