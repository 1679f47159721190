//! A way through free space that keeps to its middle, for maps that come without a centre line.

use std::{cmp::Reverse, collections::BinaryHeap};

use glam::{DVec2, Vec2};
use uchain_core::bounded;

use super::settle::settle;
use crate::map::{CentreLine, Map, MapError};

/// Most cells of the search.
const MOST_CELLS: f64 = 4_000_000.0;
/// Largest and smallest cell (m).
const CELL_M: (f64, f64) = (0.01, 0.1);
/// Cells across the narrower of the two ends' clearances.
const CELLS_PER_CLEARANCE: f64 = 3.0;
/// A wall farther away than this no longer pushes (m): a UAV's oblique beams of 2 m do not see it.
pub(super) const OPEN_M: f64 = 1.4;
/// Two places nearer to each other than this have no way between them worth the name (m).
const SHORTEST_M: f64 = 1e-3;
/// No cell.
const NONE: u32 = u32::MAX;

impl Map {
    /// The middle of the tunnel from `from` to `to`, as an open line of short straights.
    ///
    /// Dijkstra over a grid of cells (1 to 10 cm where 4 million of them are enough, by the clearance at the two
    /// ends), where a metre costs the more the nearer the walls (1 / clearance², clearance up to 1.4 m); then
    /// every point settles where the walls on both sides are equally far. The line runs through free space all
    /// along. Gaps narrower than about a cell may be overlooked.
    ///
    /// # Errors
    /// An end in rock; ends less than 1 mm apart; no way between them.
    pub fn centre_path(&self, from: Vec2, to: Vec2) -> Result<CentreLine, MapError> {
        are_two_places(self, from, to)?;
        let mut search = Search::new(self, from, to);
        let rough = search.run(from, to).ok_or_else(|| MapError::NoWay {
            from_x: from.x.into(),
            from_y: from.y.into(),
            to_x: to.x.into(),
            to_y: to.y.into(),
            cell_m: search.cell_m,
        })?;
        Ok(CentreLine::through(&settle(self, &rough, search.cell_m)))
    }
}

/// Two places of free space with a way to speak of between them.
pub(super) fn are_two_places(map: &Map, from: Vec2, to: Vec2) -> Result<(), MapError> {
    for p in [from, to] {
        if map.in_rock(p) {
            return Err(MapError::InRock { x: f64::from(p.x), y: f64::from(p.y) });
        }
    }
    let apart_m = f64::from(from.distance(to));
    if apart_m < SHORTEST_M {
        return Err(MapError::OnePlace { apart_m, least_m: SHORTEST_M });
    }
    Ok(())
}

/// Side of the cells that the clearance at the two ends asks for (m).
fn cell_wanted_m(map: &Map, from: Vec2, to: Vec2) -> f64 {
    let nearest_m = f64::from(map.clearance_m(from).min(map.clearance_m(to)));
    bounded(nearest_m / CELLS_PER_CLEARANCE, CELL_M.0, CELL_M.1)
}

/// How many cells a search between two places would be over, were there no limit.
pub(super) fn cells_wanted(map: &Map, from: Vec2, to: Vec2) -> f64 {
    let (low, high) = map.bounds();
    let cells = ((high - low).as_dvec2() / cell_wanted_m(map, from, to)).floor() + 1.0;
    cells.x * cells.y
}

/// Dijkstra's algorithm over the cells themselves, in f64: as a graph they would be up to 32 million arcs, of which most
/// are never looked at, and what one costs is known only once its ends' clearances are.
struct Search<'m> {
    map: &'m Map,
    low: DVec2,
    cell_m: f64,
    cols: usize,
    rows: usize,
    /// Of each cell's middle (m): NaN while unknown, negative in rock.
    clearance_m: Vec<f32>,
    cost: Vec<f64>,
    before: Vec<u32>,
}

impl<'m> Search<'m> {
    fn new(map: &'m Map, from: Vec2, to: Vec2) -> Self {
        let (low, high) = map.bounds();
        let (low, size) = (low.as_dvec2(), (high - low).as_dvec2());
        let mut cell_m = cell_wanted_m(map, from, to);
        let count = |cell_m: f64| ((size.x / cell_m).floor() + 1.0, (size.y / cell_m).floor() + 1.0);
        let (mut cols, mut rows) = count(cell_m);
        while cols * rows > MOST_CELLS {
            cell_m *= 1.25;
            (cols, rows) = count(cell_m);
        }
        let (cols, rows) = (cols as usize, rows as usize);
        let cells = cols * rows;
        Self {
            map,
            low,
            cell_m,
            cols,
            rows,
            clearance_m: vec![f32::NAN; cells],
            cost: vec![f64::INFINITY; cells],
            before: vec![NONE; cells],
        }
    }

    fn middle(&self, cell: usize) -> DVec2 {
        let (col, row) = ((cell % self.cols) as f64, (cell / self.cols) as f64);
        self.low + self.cell_m * DVec2::new(col + 0.5, row + 0.5)
    }

    /// Clearance of a cell's middle (m); `None` in rock.
    fn clearance_m(&mut self, cell: usize) -> Option<f64> {
        if self.clearance_m[cell].is_nan() {
            let p = self.middle(cell).as_vec2();
            self.clearance_m[cell] = if self.map.in_rock(p) { -1.0 } else { self.map.clearance_m(p) };
        }
        let clearance_m = f64::from(self.clearance_m[cell]);
        (clearance_m >= 0.0).then_some(clearance_m)
    }

    /// Cost of a metre.
    fn price(&self, clearance_m: f64) -> f64 {
        let clearance_m = bounded(clearance_m, 0.25 * self.cell_m, OPEN_M);
        1.0 / (clearance_m * clearance_m)
    }

    /// The cells `reach` or less away, the one itself left out.
    fn around(&self, cell: usize, reach: usize) -> impl Iterator<Item = usize> + use<> {
        let (col, row, cols) = (cell % self.cols, cell / self.cols, self.cols);
        let rows = row.saturating_sub(reach)..(row + reach + 1).min(self.rows);
        let columns = col.saturating_sub(reach)..(col + reach + 1).min(cols);
        rows.flat_map(move |r| columns.clone().map(move |c| r * cols + c)).filter(move |&other| other != cell)
    }

    /// Cells whose middles are near `p` and seen from it.
    fn doors(&mut self, p: Vec2) -> Vec<usize> {
        let at = ((p.as_dvec2() - self.low) / self.cell_m).floor().max(DVec2::ZERO);
        let cell = (at.y as usize).min(self.rows - 1) * self.cols + (at.x as usize).min(self.cols - 1);
        let near: Vec<usize> = self.around(cell, 2).chain([cell]).collect();
        near.into_iter()
            .filter(|&c| self.clearance_m(c).is_some() && self.map.sees(p, self.middle(c).as_vec2()))
            .collect()
    }

    /// The cheapest way, both ends included.
    fn run(&mut self, from: Vec2, to: Vec2) -> Option<Vec<DVec2>> {
        let goals = self.doors(to);
        let mut open = BinaryHeap::new();
        for cell in self.doors(from) {
            // Costs are positive, so their bits sort as they do.
            let here_m = self.clearance_m(cell)?;
            let cost = self.middle(cell).distance(from.as_dvec2()) * self.price(here_m);
            self.cost[cell] = cost;
            open.push(Reverse((cost.to_bits(), cell)));
        }
        while let Some(Reverse((bits, cell))) = open.pop() {
            let cost = f64::from_bits(bits);
            if cost > self.cost[cell] {
                continue;
            }
            if goals.contains(&cell) {
                return Some(self.way(cell, from, to));
            }
            let here_m = self.clearance_m(cell)?;
            for next in self.around(cell, 1) {
                let Some(there_m) = self.clearance_m(next) else { continue };
                let (a, b) = (self.middle(cell), self.middle(next));
                let apart_m = a.distance(b);
                let total = cost + apart_m * 0.5 * (self.price(here_m) + self.price(there_m));
                // Two discs of free space that overlap need no look.
                let free = here_m + there_m > apart_m;
                if total < self.cost[next] && (free || self.map.sees(a.as_vec2(), b.as_vec2())) {
                    self.cost[next] = total;
                    self.before[next] = cell as u32;
                    open.push(Reverse((total.to_bits(), next)));
                }
            }
        }
        None
    }

    fn way(&self, last: usize, from: Vec2, to: Vec2) -> Vec<DVec2> {
        let mut way = vec![to.as_dvec2()];
        let mut cell = last as u32;
        while cell != NONE {
            way.push(self.middle(cell as usize));
            cell = self.before[cell as usize];
        }
        way.push(from.as_dvec2());
        way.reverse();
        way
    }
}
