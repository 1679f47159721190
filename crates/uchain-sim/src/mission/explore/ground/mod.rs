//! What of a map a robot can reach, in square cells.

mod coverage;
mod passages;
mod ros_map;

use glam::{IVec2, Vec2};
use uchain_core::explore::ExploreParams;

use crate::map::{CellGrid, Map};

pub use coverage::{Coverage, Unseen};
pub(crate) use passages::width_but_for_m;
pub use passages::{Passage, Passages, Width};
pub use ros_map::RosMap;

/// Side of a cell (m), on maps small enough for it.
const CELL_M: f32 = 0.05;
/// Most cells.
const CELLS_MAX: f32 = 4.0e6;
/// A robot fits where its radius does, but for this (m).
const TOUCH_M: f32 = 1e-4;

/// The four lines through a cell and two of its neighbours.
const LINES: [IVec2; 4] = [IVec2::X, IVec2::Y, IVec2::ONE, IVec2::new(1, -1)];
/// Places along a side of a cell where its greatest clearance is looked for.
const SAMPLES: u8 = 5;

/// The reachable free area: the cells whose middles are at least `r_body_m` away from all walls and connected with a
/// start, side by side, through such cells. Cells are 0.05 m wide, wider on maps of more than 10,000 m².
#[derive(Debug, Clone)]
pub struct Ground {
    cells: CellGrid,
    reachable: Vec<bool>,
    count: usize,
    /// Cells that a robot fits in and a thinner one could reach.
    shut_off: usize,
    /// What stars may not look through.
    passages: Passages,
}

impl Ground {
    /// Walks over a map from all starts.
    pub fn survey(map: &Map, starts: &[Vec2], params: &ExploreParams) -> Self {
        let r_body_m = params.r_body_m;
        let (low, high) = map.bounds();
        let size = high - low;
        let cell_m = CELL_M.max((size.x * size.y / CELLS_MAX).sqrt());
        let cells = CellGrid::new(low, cell_m, (size / cell_m).ceil().as_ivec2());
        let mut ground = Self {
            reachable: vec![false; cells.count()],
            cells,
            count: 0,
            shut_off: 0,
            passages: Passages::default(),
        };
        let around = |&at: &Vec2| {
            let middle = ground.cells.cell_of(at);
            (-1..=1).flat_map(move |x| (-1..=1).map(move |y| middle + IVec2::new(x, y)))
        };
        let starts: Vec<IVec2> = starts.iter().flat_map(around).collect();
        // Where a point could go, and where of that the robot fits; then where the robot gets to.
        let mut fits = vec![false; ground.reachable.len()];
        let mut clearances_m = vec![0.0; fits.len()];
        let mut fitting = 0;
        ground.flood(starts.clone(), |ground, index| {
            let at = ground.cells.middle_of(index);
            let free = !map.in_rock(at);
            let clearance_m = if free { map.clearance_m(at) } else { -1.0 };
            fits[index] = clearance_m >= r_body_m - TOUCH_M;
            clearances_m[index] = clearance_m;
            fitting += usize::from(fits[index]);
            free
        });
        let reached = ground.flood(starts.clone(), |_, index| fits[index]);
        ground.count = reached.iter().filter(|&&reached| reached).count();
        ground.shut_off = fitting - ground.count;
        ground.reachable = reached;
        let starts = starts.into_iter().filter_map(|cell| ground.cells.index_of(cell));
        let starts: Vec<usize> = starts.filter(|&index| ground.reachable[index]).collect();
        ground.sharpen(map, &mut clearances_m);
        ground.passages = Passages::survey(&ground, &clearances_m, &starts, &Width::seen(params));
        ground
    }

    /// Middles of cells miss the middle line of a hall by up to half a cell. Where clearance is greatest along a line
    /// of cells it is looked for within the cell as well, so that the widths of passages come out to a centimetre.
    fn sharpen(&self, map: &Map, clearances_m: &mut [f32]) {
        let crest = |index: usize| {
            let below_m =
                |step| clearances_m[index] - self.cells.beside(index, step).map_or(0.0, |i| clearances_m[i]);
            // Along a wall clearance neither rises nor falls.
            let is_top = |step: IVec2| {
                let [a_m, b_m] = [below_m(step), below_m(-step)];
                a_m.min(b_m) >= 0.0 && a_m.max(b_m) > 0.01 * self.cells.cell_m()
            };
            self.reachable[index] && LINES.into_iter().any(is_top)
        };
        let crests: Vec<usize> = (0..clearances_m.len()).filter(|&index| crest(index)).collect();
        let aside = |k: u8| (f32::from(k) / f32::from(SAMPLES - 1) - 0.5) * self.cells.cell_m();
        for index in crests {
            let middle = self.cells.middle_of(index);
            for offset in (0..SAMPLES).flat_map(|i| (0..SAMPLES).map(move |j| Vec2::new(aside(i), aside(j))))
            {
                let at = middle + offset;
                // Of what lies nearer to walls than the middle nothing is kept, and what lies in rock does.
                let clearance_m = if map.in_rock(at) { 0.0 } else { map.clearance_m(at) };
                clearances_m[index] = clearances_m[index].max(clearance_m);
            }
        }
    }

    /// The cells that are open and connected with one of `from`, side by side, through such cells.
    fn flood(&self, from: Vec<IVec2>, mut is_open: impl FnMut(&Self, usize) -> bool) -> Vec<bool> {
        let mut reached = vec![false; self.reachable.len()];
        let mut asked = vec![false; self.reachable.len()];
        let mut open = from;
        while let Some(cell) = open.pop() {
            let Some(index) = self.cells.index_of(cell).filter(|&index| !asked[index]) else { continue };
            asked[index] = true;
            if is_open(self, index) {
                reached[index] = true;
                open.extend(CellGrid::STEPS.map(|step| cell + step));
            }
        }
        reached
    }

    /// Ground that the robots can reach (m²).
    pub fn area_m2(&self) -> f64 {
        self.count as f64 * f64::from(self.cells.cell_m()) * f64::from(self.cells.cell_m())
    }

    /// Passages that stars may not look through, and what lies in and behind them.
    pub fn passages(&self) -> &Passages {
        &self.passages
    }

    /// Ground that a robot would fit in but cannot reach: the ways there are narrower than it is, and a thinner one
    /// could pass (m²).
    pub fn shut_off_m2(&self) -> f64 {
        self.shut_off as f64 * f64::from(self.cells.cell_m()) * f64::from(self.cells.cell_m())
    }

    /// All cells of the box around the map.
    pub fn cells(&self) -> &CellGrid {
        &self.cells
    }

    /// How many cells are reachable.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Whether a cell is reachable.
    pub fn is_reachable(&self, index: usize) -> bool {
        self.reachable.get(index).copied().unwrap_or(false)
    }
}
