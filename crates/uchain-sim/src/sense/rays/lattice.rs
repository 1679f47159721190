//! Square cells in blocks of 8 × 8: which cell lies where, and which cells lie near a wall.

use core::ops::Range;

use glam::Vec2;
use uchain_core::bounded;

use crate::map::Segment;

/// Cells along the side of a block.
const SIDE: usize = 8;
/// Cells in a block.
pub(super) const BLOCK_CELLS: usize = SIDE * SIDE;

/// Square cells over a rectangle.
///
/// A grid of its own beside that of [`Map`](crate::map::Map): in f32, for a million looks a second, and in blocks, so
/// that ground without walls takes no memory.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lattice {
    low: Vec2,
    cells_per_m: f32,
    /// Columns and rows as numbers.
    size: Vec2,
    cell_m: f32,
    columns: usize,
    rows: usize,
    block_columns: usize,
}

/// A cell: its block, and its place in the block.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Cell {
    pub(super) block: usize,
    pub(super) place: usize,
}

impl Lattice {
    /// Cells of one size from `low` to at least `high`, or `None` if they make more blocks than `most_blocks`.
    pub(super) fn new(low: Vec2, high: Vec2, cell_m: f32, most_blocks: usize) -> Option<Self> {
        let cells = (high - low) / cell_m;
        let blocks = (cells / SIDE as f32 + 1.0).as_dvec2();
        (blocks.x * blocks.y <= most_blocks as f64).then(|| {
            let (columns, rows) = (cells.x as usize + 1, cells.y as usize + 1);
            let block_columns = columns.div_ceil(SIDE);
            let size = Vec2::new(columns as f32, rows as f32);
            Self { low, cells_per_m: 1.0 / cell_m, size, cell_m, columns, rows, block_columns }
        })
    }

    pub(super) fn cell_m(&self) -> f32 {
        self.cell_m
    }

    pub(super) fn blocks(&self) -> usize {
        self.block_columns * self.rows.div_ceil(SIDE)
    }

    /// The least and the greatest corner.
    pub(super) fn bounds(&self) -> (Vec2, Vec2) {
        (self.low, self.low + self.cell_m * self.size)
    }

    /// The cell a point lies in. `None` outside, and for what is no point.
    #[inline]
    pub(super) fn cell_at(&self, p: Vec2) -> Option<Cell> {
        let at = (p - self.low) * self.cells_per_m;
        let inside = at.x >= 0.0 && at.y >= 0.0 && at.x < self.size.x && at.y < self.size.y;
        // A cast truncates, which is floor above zero; `f32::floor` is a library call in the default build.
        inside.then(|| self.cell(at.x as u32 as usize, at.y as u32 as usize))
    }

    #[inline]
    fn cell(&self, x: usize, y: usize) -> Cell {
        let block = (y / SIDE) * self.block_columns + x / SIDE;
        Cell { block, place: (y % SIDE) * SIDE + x % SIDE }
    }

    /// Visits every cell that has a point within `reach_m` of a wall, and a few more, until `visit` says to stop.
    /// Whether it came to the end.
    pub(super) fn near(&self, wall: &Segment, reach_m: f32, mut visit: impl FnMut(Cell) -> bool) -> bool {
        // From the centre of such a cell.
        let reach_m = reach_m + core::f32::consts::FRAC_1_SQRT_2 * self.cell_m;
        let (a, b) = (wall.a - self.low, wall.b - self.low);
        for y in self.indices(a.y.min(b.y) - reach_m, a.y.max(b.y) + reach_m, self.rows) {
            // Only this much of the wall comes within reach of the row.
            let middle_m = (y as f32 + 0.5) * self.cell_m;
            let share =
                |y_m: f32| if a.y == b.y { 0.5 } else { bounded((y_m - a.y) / (b.y - a.y), 0.0, 1.0) };
            let ends = [share(middle_m - reach_m), share(middle_m + reach_m)].map(|s| a.x + (b.x - a.x) * s);
            let [from_m, to_m] = if a.y == b.y { [a.x, b.x] } else { ends };
            for x in self.indices(from_m.min(to_m) - reach_m, from_m.max(to_m) + reach_m, self.columns) {
                let centre = self.low + self.cell_m * (Vec2::new(x as f32, y as f32) + 0.5);
                if wall.distance_m(centre) <= reach_m && !visit(self.cell(x, y)) {
                    return false;
                }
            }
        }
        true
    }

    /// The cells along one side that a stretch of it touches (m), a little rounding allowed for.
    fn indices(&self, from_m: f32, to_m: f32, count: usize) -> Range<usize> {
        let index = |m: f32, more: f32| (m * self.cells_per_m + more).max(0.0) as usize;
        index(from_m, -0.01).min(count)..(index(to_m, 0.01) + 1).min(count)
    }
}
