//! A rectangle in square cells, for what is asked cell by cell: where a robot fits, what it reaches, what it has seen.

use glam::{IVec2, Vec2};

/// Square cells, counted row by row from the lower left.
///
/// Here the cells themselves are what is asked about; the grids of [`Map`](super::Map) and of
/// [`GridRays`](crate::sense::GridRays) only find walls.
#[derive(Debug, Clone)]
pub struct CellGrid {
    low: Vec2,
    cell_m: f32,
    cols: i32,
    rows: i32,
}

impl CellGrid {
    /// To the four cells beside a cell.
    pub const STEPS: [IVec2; 4] = [IVec2::X, IVec2::NEG_X, IVec2::Y, IVec2::NEG_Y];

    /// Columns and rows of cells so wide (m) from their lower left corner (m) on. Both are at least 1, and together few
    /// enough to be counted in `i32`.
    pub(crate) fn new(low: Vec2, cell_m: f32, size: IVec2) -> Self {
        let IVec2 { x: cols, y: rows } = size.max(IVec2::ONE);
        Self { low, cell_m, cols, rows }
    }

    /// The lower left corner of the first cell (m).
    pub fn low(&self) -> Vec2 {
        self.low
    }

    /// Side of a cell (m).
    pub fn cell_m(&self) -> f32 {
        self.cell_m
    }

    /// Area of a cell (m²).
    pub fn cell_m2(&self) -> f64 {
        f64::from(self.cell_m) * f64::from(self.cell_m)
    }

    /// Columns and rows.
    pub fn size(&self) -> [usize; 2] {
        [self.cols as usize, self.rows as usize]
    }

    /// How many cells there are.
    pub fn count(&self) -> usize {
        self.cols as usize * self.rows as usize
    }

    /// The middle of a cell (m).
    pub fn middle_of(&self, index: usize) -> Vec2 {
        let cols = self.cols as usize;
        let cell = Vec2::new((index % cols) as f32, (index / cols) as f32);
        self.low + (cell + 0.5) * self.cell_m
    }

    /// The cells around a place, as far as a distance reaches (m).
    pub fn near(&self, at: Vec2, reach_m: f32) -> impl Iterator<Item = usize> + use<> {
        let (low, high) = (self.cell_of(at - reach_m), self.cell_of(at + reach_m));
        let (cols, rows) = (self.cols, self.rows);
        let across = low.x.max(0)..=high.x.min(cols - 1);
        (low.y.max(0)..=high.y.min(rows - 1))
            .flat_map(move |row| across.clone().map(move |col| (row * cols + col) as usize))
    }

    /// Column and row of the cell a place lies in, which may be none of these.
    pub(crate) fn cell_of(&self, at: Vec2) -> IVec2 {
        ((at - self.low) / self.cell_m).floor().as_ivec2()
    }

    /// The cell of a column and a row.
    pub(crate) fn index_of(&self, cell: IVec2) -> Option<usize> {
        let inside = cell.x >= 0 && cell.y >= 0 && cell.x < self.cols && cell.y < self.rows;
        inside.then(|| (cell.y * self.cols + cell.x) as usize)
    }

    /// The cell next to a cell in a direction.
    pub(crate) fn beside(&self, index: usize, step: IVec2) -> Option<usize> {
        let (cols, index) = (self.cols, i32::try_from(index).ok()?);
        let cell = IVec2::new(index % cols, index / cols);
        self.index_of(cell + step)
    }

    /// A cell and the eight around it.
    pub(crate) fn around(&self, index: usize) -> impl Iterator<Item = usize> {
        let steps = (-1..=1).flat_map(|x| (-1..=1).map(move |y| IVec2::new(x, y)));
        steps.filter_map(move |step| self.beside(index, step))
    }

    /// Takes the cells out of `open` that are connected with one of them through others, corners included; none if that
    /// one is not open (flood fill, depth first).
    pub(crate) fn take_connected(&self, first: usize, open: &mut [bool]) -> Vec<usize> {
        let (mut connected, mut next) = (Vec::new(), Vec::new());
        if open.get(first) == Some(&true) {
            next.push(first);
        }
        while let Some(index) = next.pop() {
            if open.get_mut(index).is_some_and(std::mem::take) {
                connected.push(index);
                next.extend(self.around(index));
            }
        }
        connected
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cells() -> CellGrid {
        CellGrid::new(Vec2::new(-1.0, 2.0), 0.5, IVec2::new(4, 3))
    }

    #[test]
    fn the_middle_of_every_cell_lies_in_it() {
        let cells = cells();
        assert_eq!((cells.count(), cells.size()), (12, [4, 3]));
        assert_eq!(cells.middle_of(0), Vec2::new(-0.75, 2.25));
        for index in 0..cells.count() {
            assert_eq!(cells.index_of(cells.cell_of(cells.middle_of(index))), Some(index));
        }
        assert_eq!(cells.index_of(cells.cell_of(Vec2::new(-1.1, 2.1))), None);
    }

    #[test]
    fn cells_at_the_border_have_none_beyond_it() {
        let cells = cells();
        let around = |index| cells.around(index).collect::<std::collections::BTreeSet<_>>();
        assert_eq!(around(0), [0, 1, 4, 5].into());
        assert_eq!(around(5), (0..3).chain(4..7).chain(8..11).collect());
        assert_eq!(cells.beside(3, IVec2::X), None);
        assert_eq!(cells.beside(3, IVec2::Y), Some(7));
        assert_eq!(cells.near(Vec2::new(0.9, 2.1), 0.3).collect::<Vec<_>>(), [3]);
        assert_eq!(cells.near(Vec2::new(9.0, 9.0), 0.3).count(), 0);
    }

    #[test]
    fn connected_cells_are_taken_together_and_once() {
        let cells = cells();
        // x . . x
        // . x . x
        // x . . .
        let mut open = [0, 5, 7, 8, 11].into_iter().fold(vec![false; 12], |mut open, index| {
            open[index] = true;
            open
        });
        let mut take = |first| {
            let mut taken = cells.take_connected(first, &mut open);
            taken.sort_unstable();
            taken
        };
        assert_eq!(take(1), [0_usize; 0]);
        assert_eq!(take(8), [0, 5, 8]);
        assert_eq!(take(0), [0_usize; 0]);
        assert_eq!(take(7), [7, 11]);
    }
}
