//! The index of neighbours: a uniform grid with the list of each cell's bodies (cell lists).

use glam::Vec2;

use super::Body;

/// Up to here one cell holds everybody: looking at all is quicker than sorting.
const ONE_CELL: usize = 16;
/// Cells per body, at most.
const CELLS_PER_BODY: usize = 4;

/// Bodies in the air at one instant, cell after cell. Keeps its memory from one instant to the next.
///
/// A grid of its own: what it holds moves, so that it is sorted anew in every tick; the map's grids are laid once.
#[derive(Debug, Clone)]
pub(super) struct NeighbourGrid {
    /// Least side of a cell (m).
    least_cell_m: f32,
    low: Vec2,
    cells_per_m: f32,
    cols: usize,
    rows: usize,
    /// Where each cell's bodies start; one more than there are cells.
    starts: Vec<u32>,
    /// The bodies of all cells, and where they are (m).
    indices: Vec<u32>,
    at: Vec<Vec2>,
}

impl NeighbourGrid {
    /// For `count` bodies and questions that mostly reach `reach_m` far.
    pub(super) fn new(count: usize, reach_m: f32) -> Self {
        Self {
            least_cell_m: reach_m,
            low: Vec2::ZERO,
            cells_per_m: 0.0,
            cols: 1,
            rows: 1,
            starts: Vec::with_capacity(CELLS_PER_BODY * count + 2),
            indices: Vec::with_capacity(count),
            at: Vec::with_capacity(count),
        }
    }

    /// Takes everybody's place anew.
    pub(super) fn sort(&mut self, bodies: &[Body]) {
        let flying = || bodies.iter().enumerate().filter(|(_, body)| body.airborne);
        let count = flying().count();
        self.indices.clear();
        self.at.clear();
        self.starts.clear();
        let (mut low, mut high) = (Vec2::INFINITY, Vec2::NEG_INFINITY);
        if count > ONE_CELL {
            for (_, body) in flying() {
                (low, high) = (low.min(body.at), high.max(body.at));
            }
        }
        // Infinite for few, and where somebody is nowhere.
        if !(high - low).is_finite() {
            (self.low, self.cells_per_m, self.cols, self.rows) = (Vec2::ZERO, 0.0, 1, 1);
            self.indices.extend(flying().map(|(i, _)| i as u32));
            self.at.extend(flying().map(|(_, body)| body.at));
            self.starts.extend([0, count as u32]);
            return;
        }
        self.lay_cells(low, high - low, CELLS_PER_BODY * count);
        // Counts, then sums: each cell's end, which filling from behind turns into its start.
        self.starts.resize(self.cols * self.rows + 1, 0);
        for (_, body) in flying() {
            let cell = self.cell_of(body.at);
            self.starts[cell] += 1;
        }
        let mut total = 0;
        for start in &mut self.starts {
            total += *start;
            *start = total;
        }
        self.indices.resize(count, 0);
        self.at.resize(count, Vec2::ZERO);
        for (i, body) in bodies.iter().enumerate().rev().filter(|(_, body)| body.airborne) {
            let cell = self.cell_of(body.at);
            self.starts[cell] -= 1;
            let place = self.starts[cell] as usize;
            self.indices[place] = i as u32;
            self.at[place] = body.at;
        }
    }

    /// Cells over a box, as small as allowed and at most `most` of them.
    fn lay_cells(&mut self, low: Vec2, size: Vec2, most: usize) {
        let cells = |length_m: f32, cell_m: f32| ((length_m / cell_m) as usize).saturating_add(1);
        let mut cell_m = self.least_cell_m;
        while {
            (self.cols, self.rows) = (cells(size.x, cell_m), cells(size.y, cell_m));
            self.cols.saturating_mul(self.rows) > most
        } {
            cell_m *= 1.5;
        }
        self.low = low;
        self.cells_per_m = 1.0 / cell_m;
    }

    fn column_and_row(&self, at: Vec2) -> (usize, usize) {
        // A truncating cast: below 0 is 0.
        let at = (at - self.low) * self.cells_per_m;
        ((at.x as usize).min(self.cols - 1), (at.y as usize).min(self.rows - 1))
    }

    fn cell_of(&self, at: Vec2) -> usize {
        let (col, row) = self.column_and_row(at);
        row * self.cols + col
    }

    /// Every body nearer than `reach_m` to `at`, whoever stands right there included, and its place (m).
    pub(super) fn near(&self, at: Vec2, reach_m: f32) -> impl Iterator<Item = (usize, Vec2)> {
        let (left, bottom) = self.column_and_row(at - reach_m);
        let (right, top) = self.column_and_row(at + reach_m);
        (bottom..=top).flat_map(move |row| {
            let from = self.starts[row * self.cols + left] as usize;
            let to = self.starts[row * self.cols + right + 1] as usize;
            let near = move |place: Vec2| place.distance_squared(at) < reach_m * reach_m;
            let here = self.indices[from..to].iter().zip(&self.at[from..to]);
            here.filter_map(move |(index, place)| near(*place).then_some((*index as usize, *place)))
        })
    }

    /// All pairs nearer than `reach_m` to each other (m), lower index first, ascending.
    pub(super) fn pairs(&self, reach_m: f32, pairs: &mut Vec<[usize; 2]>) {
        pairs.clear();
        for (&i, &at) in self.indices.iter().zip(&self.at) {
            let others = self.near(at, reach_m).map(|(j, _)| j).filter(|&j| j > i as usize);
            pairs.extend(others.map(|j| [i as usize, j]));
        }
        pairs.sort_unstable();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::seed::{Seed, Source};
    use crate::world::Waypoint;

    fn body(at: Vec2, airborne: bool) -> Body {
        let mut body = Body::new(Waypoint { at, z_m: 0.0, heading_rad: 0.0 }, false);
        body.airborne = airborne;
        body
    }

    fn grid_of(bodies: &[Body], reach_m: f32) -> NeighbourGrid {
        let mut grid = NeighbourGrid::new(bodies.len(), reach_m);
        grid.sort(bodies);
        grid
    }

    #[test]
    fn everybody_near_is_found_once_and_nobody_else() {
        let mut random = Seed(1).stream(0, Source::Start);
        for (count, spread_m) in [(3, 1.0), (16, 5.0), (17, 5.0), (200, 0.0), (200, 10.0), (300, 4000.0)] {
            let bodies: Vec<Body> = (0..count)
                .map(|i| {
                    let at = Vec2::new(random.uniform() - 0.7, random.uniform() - 0.2) * spread_m;
                    body(at, i % 5 != 0)
                })
                .collect();
            let grid = grid_of(&bodies, 0.5);
            assert!(grid.cols * grid.rows <= CELLS_PER_BODY * count);
            for reach_m in [0.2, 0.5, 3.0, 1e9] {
                let at = Vec2::new(random.uniform() - 0.7, random.uniform() - 0.2) * spread_m * 1.2;
                let mut found: Vec<(usize, Vec2)> = grid.near(at, reach_m).collect();
                found.sort_by_key(|(uav, _)| *uav);
                let near = |body: &Body| body.airborne && body.at.distance_squared(at) < reach_m * reach_m;
                let expected: Vec<(usize, Vec2)> =
                    bodies.iter().enumerate().filter(|(_, b)| near(b)).map(|(i, b)| (i, b.at)).collect();
                assert_eq!(found, expected, "{count} over {spread_m} m, {reach_m} m around {at}");
            }
            let (mut pairs, mut expected) = (Vec::new(), Vec::new());
            grid.pairs(0.5, &mut pairs);
            for (i, a) in bodies.iter().enumerate().filter(|(_, body)| body.airborne) {
                let later = bodies.iter().enumerate().skip(i + 1).filter(|(_, body)| body.airborne);
                let near = later.filter(|(_, b)| a.at.distance_squared(b.at) < 0.25);
                expected.extend(near.map(|(j, _)| [i, j]));
            }
            assert_eq!(pairs, expected, "{count} over {spread_m} m");
        }
    }

    #[test]
    fn a_place_that_is_none_has_nobody_near() {
        let bodies = vec![body(Vec2::ZERO, true); 40];
        let grid = grid_of(&bodies, 1.0);
        for at in [Vec2::NAN, Vec2::INFINITY, Vec2::NEG_INFINITY] {
            assert_eq!(grid.near(at, 1.0).next(), None, "near {at}");
        }
        assert_eq!(grid_of(&[], 1.0).near(Vec2::ZERO, 1.0).next(), None);
    }
}
