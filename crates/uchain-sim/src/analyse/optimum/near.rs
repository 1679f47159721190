//! What is near a place, by square cells.

use std::collections::BTreeMap;

use glam::Vec2;

/// Smallest cell (m).
const CELL_LEAST_M: f64 = 1e-2;

/// Things by place, in cells as wide as whoever asks can see: all it can see lies in the nine cells around it.
#[derive(Debug)]
pub(super) struct Near {
    cell_m: f64,
    cells: BTreeMap<[i64; 2], Vec<u32>>,
}

impl Near {
    pub(super) fn new(reach_m: f64) -> Self {
        Self { cell_m: reach_m.max(CELL_LEAST_M), cells: BTreeMap::new() }
    }

    fn cell_of(&self, at: Vec2) -> [i64; 2] {
        // Casts saturate, and what is no number is 0.
        (at.as_dvec2() / self.cell_m).floor().to_array().map(|index| index as i64)
    }

    pub(super) fn enter(&mut self, at: Vec2, which: u32) {
        self.cells.entry(self.cell_of(at)).or_default().push(which);
    }

    /// Takes out whoever came last to the cell of a place.
    pub(super) fn leave(&mut self, at: Vec2) {
        if let Some(cell) = self.cells.get_mut(&self.cell_of(at)) {
            cell.pop();
        }
    }

    /// All in the cells around a place.
    pub(super) fn around(&self, at: Vec2, found: &mut Vec<u32>) {
        found.clear();
        let [col, row] = self.cell_of(at);
        for row in row.saturating_sub(1)..=row.saturating_add(1) {
            for col in col.saturating_sub(1)..=col.saturating_add(1) {
                found.extend(self.cells.get(&[col, row]).into_iter().flatten());
            }
        }
    }
}
