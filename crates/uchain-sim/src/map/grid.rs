//! A uniform grid over the walls: which walls pass near a point or along a line.

use std::ops::{ControlFlow, Range};

use glam::DVec2;
use uchain_core::bounded;

use super::geometry::Segment;

const MOST_CELLS: usize = 1 << 18;
/// How far, in cells, a wall or a line is taken to reach past its cells: far more than rounding can err.
const MARGIN_CELLS: f64 = 1e-3;

/// Cells of one size over the bounds of the walls; each lists the walls that touch it, and perhaps a few more.
///
/// A grid of its own beside that of [`GridRays`](crate::sense::GridRays): this one answers exactly, in f64, for lines,
/// boxes and the nearest wall; that one lists for each cell all walls that a beam from there can meet.
///
/// Its memory is bounded by the number of walls: cells are no smaller than a quarter of the mean wall length.
#[derive(Debug, Clone, Default)]
pub(super) struct Grid {
    origin: DVec2,
    cell_m: f64,
    cols: usize,
    rows: usize,
    /// Where each cell's walls start in `items`; one more than there are cells.
    starts: Vec<u32>,
    items: Vec<u32>,
}

impl Grid {
    pub(super) fn new(walls: &[Segment]) -> Self {
        if walls.is_empty() {
            return Self::default();
        }
        let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        let mut total_m = 0.0;
        for wall in walls {
            let (a, b) = wall.ends();
            low = low.min(a).min(b);
            high = high.max(a).max(b);
            total_m += a.distance(b);
        }
        let size = (high - low).max(DVec2::splat(1e-6));
        let count = walls.len() as f64;
        let mut cell_m = (size.x * size.y / (2.0 * count)).sqrt().max(total_m / (4.0 * count));
        let cells = |cell_m: f64| ((size.x / cell_m).floor() + 1.0, (size.y / cell_m).floor() + 1.0);
        while {
            let (cols, rows) = cells(cell_m);
            cols * rows > MOST_CELLS as f64
        } {
            cell_m *= 1.5;
        }
        let (cols, rows) = cells(cell_m);
        let mut grid =
            Self { origin: low, cell_m, cols: cols as usize, rows: rows as usize, ..Self::default() };
        grid.fill(walls);
        grid
    }

    fn fill(&mut self, walls: &[Segment]) {
        let mut counts = vec![0_u32; self.cols * self.rows + 1];
        for wall in walls {
            let (a, b) = wall.ends();
            let _ = self.along(a, b, |cell| {
                counts[cell] += 1;
                ControlFlow::Continue(())
            });
        }
        let mut total = 0;
        for count in &mut counts {
            let here = *count;
            *count = total;
            total += here;
        }
        self.starts.clone_from(&counts);
        let mut items = vec![0; total as usize];
        for (index, wall) in walls.iter().enumerate() {
            let (a, b) = wall.ends();
            let _ = self.along(a, b, |cell| {
                items[counts[cell] as usize] = index as u32;
                counts[cell] += 1;
                ControlFlow::Continue(())
            });
        }
        self.items = items;
    }

    /// Walls listed for a cell.
    pub(super) fn walls_of(&self, cell: usize) -> &[u32] {
        match (self.starts.get(cell), self.starts.get(cell + 1)) {
            (Some(&from), Some(&to)) => &self.items[from as usize..to as usize],
            _ => &[],
        }
    }

    pub(super) fn cells(&self) -> usize {
        self.cols * self.rows
    }

    /// Side of a cell (m).
    pub(super) fn cell_m(&self) -> f64 {
        self.cell_m
    }

    pub(super) fn starts_row(&self, cell: usize) -> bool {
        cell.is_multiple_of(self.cols)
    }

    /// All cells of the row that `cell` is in.
    pub(super) fn cells_of_row(&self, cell: usize) -> Range<usize> {
        let first = cell - cell % self.cols;
        first..first + self.cols
    }

    /// Column and row of the cell under `p`, which may lie outside the grid.
    pub(super) fn column_and_row(&self, p: DVec2) -> (f64, f64) {
        let at = ((p - self.origin) / self.cell_m).floor();
        (at.x, at.y)
    }

    /// The cell under `p`, if the grid reaches there.
    pub(super) fn cell_at(&self, p: DVec2) -> Option<usize> {
        // Casts truncate, which is quicker than rounding down and the same from 0 on.
        let DVec2 { x: col, y: row } = (p - self.origin) / self.cell_m;
        let inside = col >= 0.0 && row >= 0.0 && col < self.cols as f64 && row < self.rows as f64;
        inside.then(|| row as usize * self.cols + col as usize)
    }

    /// A point within a cell, a little off its centre so that walls on round coordinates miss it.
    pub(super) fn reference_of(&self, cell: usize) -> DVec2 {
        let (col, row) = ((cell % self.cols) as f64, (cell / self.cols) as f64);
        self.origin + self.cell_m * DVec2::new(col + 0.512_735_1, row + 0.487_319_3)
    }

    /// The cells in the square ring `ring` cells away from the cell under `p`, and the distance from `p` within
    /// which everything lies in this ring or in a smaller one (m). `None` when the whole ring is off the grid.
    pub(super) fn ring(&self, p: DVec2, ring: usize, mut visit: impl FnMut(usize)) -> Option<f64> {
        let (col, row) = self.column_and_row(p);
        let (cols, rows, r) = (self.cols as f64, self.rows as f64, ring as f64);
        if col - r < 0.0 && row - r < 0.0 && col + r >= cols && row + r >= rows {
            return None;
        }
        let mut y = (row - r).max(0.0);
        while y <= (row + r).min(rows - 1.0) {
            let edge = y == row - r || y == row + r;
            let mut x = (col - r).max(0.0);
            while x <= (col + r).min(cols - 1.0) {
                if edge || x == col - r || x == col + r {
                    visit(y as usize * self.cols + x as usize);
                    x += 1.0;
                } else {
                    x = col + r;
                }
            }
            y += 1.0;
        }
        let low = self.origin + self.cell_m * DVec2::new(col - r, row - r);
        let high = self.origin + self.cell_m * DVec2::new(col + r + 1.0, row + r + 1.0);
        Some((p - low).min(high - p).min_element())
    }

    /// Visits the walls of every cell that the box from `low` to `high` touches, some of them more than once.
    pub(super) fn within(&self, low: DVec2, high: DVec2, mut visit: impl FnMut(u32)) {
        let (low, high) = ((low - self.origin) / self.cell_m, (high - self.origin) / self.cell_m);
        let (Some(cols), Some(rows)) = (clip(low.x, high.x, self.cols), clip(low.y, high.y, self.rows))
        else {
            return;
        };
        for row in rows.0..=rows.1 {
            for col in cols.0..=cols.1 {
                self.walls_of(row * self.cols + col).iter().for_each(|&wall| visit(wall));
            }
        }
    }

    /// Visits every cell the segment `a b` passes, from `a`'s row to `b`'s; a few neighbours may be visited too.
    pub(super) fn along(
        &self,
        a: DVec2,
        b: DVec2,
        mut visit: impl FnMut(usize) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        if self.cols == 0 {
            return ControlFlow::Continue(());
        }
        let from = (a - self.origin) / self.cell_m;
        let step = (b - a) / self.cell_m;
        let (low_y, high_y) = (from.y.min(from.y + step.y), from.y.max(from.y + step.y));
        let Some((first, last)) = clip(low_y, high_y, self.rows) else { return ControlFlow::Continue(()) };
        for count in 0..=(last - first) {
            let row = if step.y < 0.0 { last - count } else { first + count };
            let (enter, leave) = if step.y == 0.0 {
                (0.0, 1.0)
            } else {
                let low = (row as f64 - MARGIN_CELLS - from.y) / step.y;
                let high = (row as f64 + 1.0 + MARGIN_CELLS - from.y) / step.y;
                (bounded(low.min(high), 0.0, 1.0), bounded(low.max(high), 0.0, 1.0))
            };
            let (x0, x1) = (from.x + enter * step.x, from.x + leave * step.x);
            let Some((left, right)) = clip(x0.min(x1), x0.max(x1), self.cols) else { continue };
            for col in left..=right {
                visit(row * self.cols + col)?;
            }
        }
        ControlFlow::Continue(())
    }
}

/// The whole cells `low..=high` covers among `count`, margin included.
fn clip(low: f64, high: f64, count: usize) -> Option<(usize, usize)> {
    let (low, high) = (low - MARGIN_CELLS, high + MARGIN_CELLS);
    let inside = high >= 0.0 && low < count as f64;
    // Casts truncate, which is quicker than rounding down and the same from 0 on.
    inside.then(|| (low.max(0.0) as usize, (high as usize).min(count - 1)))
}
