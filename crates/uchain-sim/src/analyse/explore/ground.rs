//! What of a map a robot can reach, in square cells.

use glam::{IVec2, Vec2};
use uchain_core::explore::ExploreParams;

use crate::map::Map;

/// Side of a cell (m), on maps small enough for it.
const CELL_M: f32 = 0.05;
/// Most cells.
const CELLS_MAX: f32 = 4.0e6;
/// A robot fits where its radius does, but for this (m).
const TOUCH_M: f32 = 1e-4;

/// To the four cells beside a cell.
const STEPS: [IVec2; 4] = [IVec2::X, IVec2::NEG_X, IVec2::Y, IVec2::NEG_Y];

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
    /// Cells that a robot fits in and a thinner one could reach.
    shut_off: usize,
    /// Reachable cells in passages, or behind them, that a robot may not see through.
    narrow: usize,
}

impl Ground {
    /// Walks over a map from all starts.
    pub fn survey(map: &Map, starts: &[Vec2], params: &ExploreParams) -> Self {
        let (r_body_m, seen_m) = (params.r_body_m, Self::seen_m(params) / 2.0);
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
            shut_off: 0,
            narrow: 0,
        };
        let around = |&at: &Vec2| {
            let middle = ground.cell_of(at);
            (-1..=1).flat_map(move |x| (-1..=1).map(move |y| middle + IVec2::new(x, y)))
        };
        let starts: Vec<IVec2> = starts.iter().flat_map(around).collect();
        // Where a point could go, and where of that the robot fits; then where the robot gets to.
        let mut fits = vec![false; ground.reachable.len()];
        let mut wide = fits.clone();
        let mut fitting = 0;
        ground.flood(starts.clone(), |ground, index| {
            let at = ground.middle_of(index);
            let free = !map.in_rock(at);
            let clearance_m = if free { map.clearance_m(at) } else { -1.0 };
            fits[index] = clearance_m >= r_body_m - TOUCH_M;
            wide[index] = clearance_m >= seen_m;
            fitting += usize::from(fits[index]);
            free
        });
        let reached = ground.flood(starts, |_, index| fits[index]);
        ground.count = reached.iter().filter(|&&reached| reached).count();
        ground.shut_off = fitting - ground.count;
        ground.reachable = reached;
        ground.narrow = ground.count - ground.beside_the_wide(&wide, seen_m - r_body_m);
        ground
    }

    /// Width from which on passages are surely seen (m): where a body and a whole sector of a star, at its end, fit
    /// beside each other.
    pub fn seen_m(params: &ExploreParams) -> f32 {
        2.0 * params.r_body_m + core::f32::consts::TAU * params.r_s_m / f32::from(params.sectors)
    }

    /// How many cells are reachable that lie in the largest wide part, or beside it no farther than so much.
    fn beside_the_wide(&self, wide: &[bool], aside_m: f32) -> usize {
        let mut found = vec![false; wide.len()];
        let mut largest: Vec<usize> = Vec::new();
        for first in 0..wide.len() {
            if found[first] || !wide[first] || !self.reachable[first] {
                continue;
            }
            found[first] = true;
            let (mut part, mut next) = (vec![first], 0);
            while let Some(&index) = part.get(next) {
                next += 1;
                for beside in STEPS.iter().filter_map(|&step| self.beside(index, step)) {
                    if !found[beside] && wide[beside] && self.reachable[beside] {
                        found[beside] = true;
                        part.push(beside);
                    }
                }
            }
            if part.len() > largest.len() {
                largest = part;
            }
        }
        // Out to the walls again, a ring of cells at a time.
        found.fill(false);
        for &index in &largest {
            found[index] = true;
        }
        let (mut count, mut ring) = (largest.len(), largest);
        for _ in 0..=(aside_m / self.cell_m).ceil() as usize {
            let mut outer = Vec::new();
            for index in ring {
                let around = (-1..=1).flat_map(|x| (-1..=1).map(move |y| IVec2::new(x, y)));
                for beside in around.filter_map(|step| self.beside(index, step)) {
                    if !found[beside] && self.reachable[beside] {
                        found[beside] = true;
                        outer.push(beside);
                    }
                }
            }
            count += outer.len();
            ring = outer;
        }
        count
    }

    /// The cells that are open and connected with one of `from`, side by side, through such cells.
    fn flood(&self, from: Vec<IVec2>, mut is_open: impl FnMut(&Self, usize) -> bool) -> Vec<bool> {
        let mut reached = vec![false; self.reachable.len()];
        let mut asked = vec![false; self.reachable.len()];
        let mut open = from;
        while let Some(cell) = open.pop() {
            let Some(index) = self.index_of(cell).filter(|&index| !asked[index]) else { continue };
            asked[index] = true;
            if is_open(self, index) {
                reached[index] = true;
                open.extend(STEPS.map(|step| cell + step));
            }
        }
        reached
    }

    /// Ground that the robots can reach (m²).
    pub fn area_m2(&self) -> f64 {
        self.count as f64 * f64::from(self.cell_m) * f64::from(self.cell_m)
    }

    /// Ground in or behind passages narrower than [`Ground::seen_m`], where a frontier may be missed (m²).
    pub fn narrow_m2(&self) -> f64 {
        self.narrow as f64 * f64::from(self.cell_m) * f64::from(self.cell_m)
    }

    /// Ground that a robot would fit in but cannot reach: the ways there are narrower than it is, and a thinner one
    /// could pass (m²).
    pub fn shut_off_m2(&self) -> f64 {
        self.shut_off as f64 * f64::from(self.cell_m) * f64::from(self.cell_m)
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
