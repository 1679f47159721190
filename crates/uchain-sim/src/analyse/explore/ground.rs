//! What of a map a robot can reach, in square cells.

use glam::{IVec2, Vec2};

use crate::map::Map;

/// Side of a cell (m), on maps small enough for it.
const CELL_M: f32 = 0.05;
/// Most cells.
const CELLS_MAX: f32 = 4.0e6;
/// A robot fits where its radius does, but for this (m).
const TOUCH_M: f32 = 1e-4;

/// The reachable free area: the cells whose middles are at least `r_body_m` away from all walls and connected with a
/// start, side by side, through such cells. Cells are 0.05 m wide, wider on maps of more than 10,000 m².
#[derive(Debug, Clone)]
pub struct Ground {
    low: Vec2,
    cell_m: f32,
    cols: i32,
    rows: i32,
    /// Row by row.
    reachable: Vec<bool>,
    count: usize,
}

impl Ground {
    /// Walks over a map from all starts.
    pub fn survey(map: &Map, starts: &[Vec2], r_body_m: f32) -> Self {
        let (low, high) = map.bounds();
        let size = high - low;
        let cell_m = CELL_M.max((size.x * size.y / CELLS_MAX).sqrt());
        let cells = (size / cell_m).ceil().as_ivec2().max(IVec2::ONE);
        let mut ground = Self {
            low,
            cell_m,
            cols: cells.x,
            rows: cells.y,
            reachable: vec![false; cells.x as usize * cells.y as usize],
            count: 0,
        };
        let around = |&at: &Vec2| {
            let middle = ground.cell_of(at);
            (-1..=1).flat_map(move |x| (-1..=1).map(move |y| middle + IVec2::new(x, y)))
        };
        let mut open: Vec<IVec2> = starts.iter().flat_map(around).collect();
        while let Some(cell) = open.pop() {
            let Some(index) = ground.index_of(cell).filter(|&index| !ground.reachable[index]) else {
                continue;
            };
            let at = ground.middle_of(index);
            if map.in_rock(at) || map.clearance_m(at) < r_body_m - TOUCH_M {
                continue;
            }
            ground.reachable[index] = true;
            ground.count += 1;
            open.extend([IVec2::X, IVec2::NEG_X, IVec2::Y, IVec2::NEG_Y].map(|step| cell + step));
        }
        ground
    }

    /// Side of a cell (m).
    pub fn cell_m(&self) -> f32 {
        self.cell_m
    }

    /// Columns and rows of the box around the map.
    pub fn size(&self) -> [usize; 2] {
        [self.cols as usize, self.rows as usize]
    }

    /// The lower left corner of the first cell (m).
    pub fn low(&self) -> Vec2 {
        self.low
    }

    /// How many cells are reachable.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Whether a cell is reachable; cells are counted row by row from the lower left.
    pub fn is_reachable(&self, index: usize) -> bool {
        self.reachable.get(index).copied().unwrap_or(false)
    }

    /// The middle of a cell (m).
    pub fn middle_of(&self, index: usize) -> Vec2 {
        let cols = self.cols as usize;
        let cell = Vec2::new((index % cols) as f32, (index / cols) as f32);
        self.low + (cell + 0.5) * self.cell_m
    }

    /// The cells around a place, as far as a distance reaches (m).
    pub fn cells_near(&self, at: Vec2, reach_m: f32) -> impl Iterator<Item = usize> + use<> {
        let (low, high) = (self.cell_of(at - reach_m), self.cell_of(at + reach_m));
        let (cols, rows) = (self.cols, self.rows);
        let across = low.x.max(0)..=high.x.min(cols - 1);
        (low.y.max(0)..=high.y.min(rows - 1))
            .flat_map(move |row| across.clone().map(move |col| (row * cols + col) as usize))
    }

    /// The cell next to a cell in a direction, within the box.
    pub(super) fn beside(&self, index: usize, step: IVec2) -> Option<usize> {
        // Cells are counted in i32: there are at most a few million.
        let (cols, index) = (self.cols, i32::try_from(index).ok()?);
        let cell = IVec2::new(index % cols, index / cols);
        self.index_of(cell + step)
    }

    fn cell_of(&self, at: Vec2) -> IVec2 {
        ((at - self.low) / self.cell_m).floor().as_ivec2()
    }

    fn index_of(&self, cell: IVec2) -> Option<usize> {
        let inside = cell.x >= 0 && cell.y >= 0 && cell.x < self.cols && cell.y < self.rows;
        inside.then(|| (cell.y * self.cols + cell.x) as usize)
    }
}
