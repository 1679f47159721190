//! What a radio loses from one place to all others of a map, and to the places along a tunnel; noise off.

#[cfg(feature = "draw")]
mod picture;
#[cfg(test)]
mod tests;

use std::fmt::Write as _;
use uchain_core::bounded;

use glam::{DVec2, Vec2};
use serde::Serialize;

use crate::{
    map::Map,
    radio::{Antenna, RadioModel, finite_db},
};

/// About how many cells the free area is looked at in, and where a loss takes a search.
const CELLS: f64 = 40_000.0;
const CELLS_WHERE_COSTLY: f64 = 3_000.0;
/// Most cells, those in rock among them.
const MOST_CELLS: f64 = 400_000.0;
/// Smallest cell (m).
const CELL_LEAST_M: f64 = 0.02;

/// Losses from one place to the middles of cells.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LossMap {
    /// From where, in the map file's own frame (m).
    pub from_m: [f64; 2],
    /// Loss that a relay's link may have (dB).
    pub limit_db: f64,
    /// Side of a cell (m).
    pub cell_m: f64,
    /// Lower left corner of the first cell, in the map file's own frame (m).
    pub low_m: [f64; 2],
    /// Columns and rows.
    pub size: [usize; 2],
    /// Row by row from below; `None` in rock.
    pub loss_db: Vec<Option<f32>>,
    /// Share of the free cells within the limit (1).
    pub share_within: f64,
    /// Distance of the farthest cell within the limit (m).
    pub farthest_m: f64,
}

impl LossMap {
    /// From a place of the map frame.
    pub fn of(map: &Map, radio: &dyn RadioModel, from: Vec2, limit_db: f64) -> Self {
        let (low, high) = map.bounds();
        let (low, size_m) = (low.as_dvec2(), (high - low).as_dvec2().max(DVec2::splat(CELL_LEAST_M)));
        let free_m2: f64 = map.free_areas_m2().iter().sum();
        let free_m2 = if free_m2 > 0.0 { free_m2 } else { size_m.x * size_m.y };
        let cells = if radio.is_costly() { CELLS_WHERE_COSTLY } else { CELLS };
        let least_m = (size_m.x * size_m.y / MOST_CELLS).sqrt();
        let cell_m = (free_m2 / cells).sqrt().max(least_m).max(CELL_LEAST_M);
        let count = |side_m: f64| bounded((side_m / cell_m).ceil(), 1.0, MOST_CELLS) as usize;
        let (columns, rows) = (count(size_m.x), count(size_m.y));
        let antenna = Antenna::from(from);
        let mut loss_db = Vec::with_capacity(columns * rows);
        let (mut free, mut within, mut farthest_m) = (0_usize, 0_usize, 0.0_f64);
        for row in 0..rows {
            for column in 0..columns {
                let middle = low + (DVec2::new(column as f64, row as f64) + 0.5) * cell_m;
                let at = middle.as_vec2();
                if map.in_rock(at) {
                    loss_db.push(None);
                    continue;
                }
                let db = finite_db(radio.loss_db(map, &antenna, &Antenna::from(at)));
                free += 1;
                if f64::from(db) <= limit_db {
                    within += 1;
                    farthest_m = farthest_m.max(f64::from(from.distance(at)));
                }
                loss_db.push(Some(db));
            }
        }
        let offset = DVec2::from(map.offset_m());
        Self {
            from_m: (from.as_dvec2() + offset).into(),
            limit_db,
            cell_m,
            low_m: (low + offset).into(),
            size: [columns, rows],
            loss_db,
            share_within: within as f64 / free.max(1) as f64,
            farthest_m,
        }
    }

    /// The loss of a cell (dB).
    pub fn at(&self, column: usize, row: usize) -> Option<f32> {
        (column < self.size[0]).then(|| self.loss_db.get(row * self.size[0] + column).copied().flatten())?
    }

    /// The middle of a cell, in the map file's own frame (m).
    pub fn middle_m(&self, column: usize, row: usize) -> [f64; 2] {
        [
            self.low_m[0] + (column as f64 + 0.5) * self.cell_m,
            self.low_m[1] + (row as f64 + 0.5) * self.cell_m,
        ]
    }

    /// A table in CSV: a row for every free cell.
    pub fn csv(&self) -> String {
        let mut text = "x_m,y_m,loss_db\n".to_owned();
        for row in 0..self.size[1] {
            for column in 0..self.size[0] {
                let Some(loss_db) = self.at(column, row) else { continue };
                let [x, y] = self.middle_m(column, row);
                // Writing to a String cannot fail.
                let _ = writeln!(text, "{x:.3},{y:.3},{loss_db:.2}");
            }
        }
        text
    }
}

/// Losses from one place to the middle of a tunnel.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LossAlong {
    /// From where, in the map file's own frame (m).
    pub from_m: [f64; 2],
    /// Loss that a relay's link may have (dB).
    pub limit_db: f64,
    /// Depths at which the loss passes the limit, out of it or back (m).
    pub passes_m: Vec<f64>,
    /// From the base on.
    pub points: Vec<Along>,
}

/// A place in mid-tunnel.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Along {
    /// Way from the base along the tunnel (m).
    pub depth_m: f64,
    /// Where that is, in the map file's own frame (m).
    pub at_m: [f64; 2],
    /// Loss from there (dB).
    pub loss_db: f64,
}

impl LossAlong {
    /// Of places of the map frame, with their depths.
    pub fn of(
        map: &Map,
        radio: &dyn RadioModel,
        from: Vec2,
        limit_db: f64,
        places: impl IntoIterator<Item = (f64, Vec2)>,
    ) -> Self {
        let offset = DVec2::from(map.offset_m());
        let antenna = Antenna::from(from);
        let point = |(depth_m, at): (f64, Vec2)| Along {
            depth_m,
            at_m: (at.as_dvec2() + offset).into(),
            loss_db: f64::from(finite_db(radio.loss_db(map, &antenna, &Antenna::from(at)))),
        };
        let points: Vec<Along> = places.into_iter().map(point).collect();
        let passes = points.windows(2).filter_map(|pair| {
            let [before, after] = pair else { return None };
            let (over, is_over) = (before.loss_db - limit_db, after.loss_db - limit_db);
            let passes = (over > 0.0) != (is_over > 0.0);
            passes.then(|| before.depth_m + (after.depth_m - before.depth_m) * over / (over - is_over))
        });
        Self { from_m: (from.as_dvec2() + offset).into(), limit_db, passes_m: passes.collect(), points }
    }

    /// A table in CSV: a row for every place.
    pub fn csv(&self) -> String {
        let mut text = "depth_m,x_m,y_m,loss_db\n".to_owned();
        for Along { depth_m, at_m: [x, y], loss_db } in &self.points {
            // Writing to a String cannot fail.
            let _ = writeln!(text, "{depth_m:.3},{x:.3},{y:.3},{loss_db:.2}");
        }
        text
    }
}
