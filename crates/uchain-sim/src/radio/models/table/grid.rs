//! Losses between the places of a grid, and between what lies among them.

use std::{cmp::Ordering, collections::BTreeSet};

use super::{PLACES_MAX, TableError, axis::Axis};
use crate::radio::NO_LINK_DB;

/// Most crossings of a grid's lines; most of them may lie in rock and be no places.
const CROSSINGS_MAX: usize = 1 << 20;
/// A crossing that is no place.
const NO_PLACE: u16 = u16::MAX;
/// How far the losses of a pair may lie apart from end to end (dB).
const SAME_DB: f32 = 1e-3;

/// Losses between the places of a regular rectangular grid.
pub(super) struct Grid {
    axes: [Axis; 2],
    /// The place at each crossing, row by row.
    place_of: Vec<u16>,
    places: usize,
    /// Of each place to each (dB), the same both ways; not a number where there is no link.
    losses_db: Vec<f32>,
    /// The least loss from so many `bin_m` on (dB).
    least_db: Vec<f32>,
    bin_m: f64,
}

/// Places that nothing is known of but where they are, each once. Coordinates as bits in the order of their values.
#[derive(Default)]
pub(super) struct Places(BTreeSet<(i64, i64)>);

/// Bits that are ordered as [`f64::total_cmp`] orders numbers; twice gives them back.
fn ordered(bits: i64) -> i64 {
    bits ^ ((bits >> 63).cast_unsigned() >> 1).cast_signed()
}

impl Places {
    /// One more.
    pub(super) fn add(&mut self, [x_m, y_m]: [f64; 2]) -> Result<(), TableError> {
        // What rounding tells apart counts as several here, and as one later.
        if self.0.len() > 4 * PLACES_MAX {
            return Err(TableError::TooManyPlaces);
        }
        // Zero has one sign here.
        self.0.insert(([x_m + 0.0, y_m + 0.0]).map(|at_m| ordered(at_m.to_bits().cast_signed())).into());
        Ok(())
    }

    fn each(&self) -> impl Iterator<Item = [f64; 2]> {
        self.0.iter().map(|&(x, y)| [x, y].map(|bits| f64::from_bits(ordered(bits).cast_unsigned())))
    }

    /// A grid that has them all, without losses yet.
    pub(super) fn grid(&self) -> Result<Grid, TableError> {
        let axes = [
            Axis::of("x", self.each().map(|[x_m, _]| x_m).collect())?,
            Axis::of("y", self.each().map(|[_, y_m]| y_m).collect())?,
        ];
        let crossings = axes[0].lines.saturating_mul(axes[1].lines);
        if crossings > CROSSINGS_MAX {
            let got = crossings as f64;
            return Err(TableError::TooManyLines { axis: "x and y", got, most: CROSSINGS_MAX });
        }
        let (mut place_of, mut places) = (vec![NO_PLACE; crossings], 0);
        for at in self.each() {
            let place = &mut place_of[crossing(&axes, at)];
            if *place == NO_PLACE {
                if places == PLACES_MAX {
                    return Err(TableError::TooManyPlaces);
                }
                *place = places as u16;
                places += 1;
            }
        }
        if places < 2 {
            return Err(TableError::TooFewPlaces { got: places });
        }
        let losses_db = vec![f32::NAN; places * places];
        Ok(Grid { axes, place_of, places, losses_db, least_db: Vec::new(), bin_m: f64::INFINITY })
    }
}

/// The crossing next to a place of the grid.
fn crossing([x, y]: &[Axis; 2], [x_m, y_m]: [f64; 2]) -> usize {
    y.nearest(y_m) * x.lines + x.nearest(x_m)
}

impl Grid {
    /// Writes down what a link between two of its places loses (dB), both ways. The smaller of two that are nearly the same.
    ///
    /// # Errors
    /// The loss that is there already, if it is another one.
    pub(super) fn put(&mut self, from: [f64; 2], to: [f64; 2], loss_db: f32) -> Result<(), f32> {
        let [from, to] =
            [from, to].map(|at| usize::from(self.place_of[crossing(&self.axes, at)]).min(self.places - 1));
        let there_db = self.losses_db[from * self.places + to];
        if (there_db - loss_db).abs() > SAME_DB {
            return Err(there_db);
        }
        let loss_db = if there_db < loss_db { there_db } else { loss_db };
        self.losses_db[from * self.places + to] = loss_db;
        self.losses_db[to * self.places + from] = loss_db;
        Ok(())
    }

    /// The grid with all its losses.
    pub(super) fn whole(mut self) -> Result<Self, TableError> {
        if self.losses_db.iter().all(|loss_db| loss_db.is_nan()) {
            return Err(TableError::Empty);
        }
        // Few tables say what a link of no length loses: no more than any other from there.
        for (place, row_db) in self.losses_db.chunks_exact_mut(self.places).enumerate() {
            if row_db[place].is_nan() {
                row_db[place] = row_db.iter().copied().fold(f32::NAN, f32::min);
            }
        }
        self.bound();
        Ok(self)
    }

    /// Works out the least losses by distance.
    fn bound(&mut self) {
        let [x, y] = self.axes;
        if x.lines > 1 && y.lines > 1 {
            self.bin_m = (x.step_m * x.step_m + y.step_m * y.step_m).sqrt();
        }
        // Along a single line of places, the same losses hold beside it: the distance between places says nothing there.
        let bin = |apart_m: f64| (apart_m / self.bin_m) as usize;
        let mut at_m = vec![[0.0; 2]; self.places];
        for (crossing, &place) in self.place_of.iter().enumerate() {
            if let Some(at_m) = at_m.get_mut(usize::from(place)) {
                *at_m = [(crossing % x.lines) as f64 * x.step_m, (crossing / x.lines) as f64 * y.step_m];
            }
        }
        let mut least_db = vec![NO_LINK_DB; 1];
        for (row_db, [from_x_m, from_y_m]) in self.losses_db.chunks_exact(self.places).zip(&at_m) {
            for (loss_db, [to_x_m, to_y_m]) in row_db.iter().zip(&at_m) {
                if loss_db.is_nan() {
                    continue;
                }
                let [x_m, y_m] = [from_x_m - to_x_m, from_y_m - to_y_m];
                let bin = bin((x_m * x_m + y_m * y_m).sqrt());
                if bin >= least_db.len() {
                    least_db.resize(bin + 1, NO_LINK_DB);
                }
                least_db[bin] = least_db[bin].min(*loss_db);
            }
        }
        for nearer in (1..least_db.len()).rev() {
            least_db[nearer - 1] = least_db[nearer - 1].min(least_db[nearer]);
        }
        self.least_db = least_db;
    }

    /// What no link over a distance (m) falls short of (dB).
    pub(super) fn least_loss_db(&self, apart_m: f64) -> f32 {
        // Places at the corners of the cells of both ends may lie nearer to each other than the ends, by a diagonal each.
        // A little more, for rounding.
        let apart_m = apart_m * (1.0 - 1e-6) - 2.001 * self.bin_m;
        let bin = if apart_m > 0.0 { (apart_m / self.bin_m) as usize } else { 0 };
        self.least_db.get(bin).copied().unwrap_or(NO_LINK_DB)
    }

    /// The four places around a place, if any, and their shares; `None` beyond the grid.
    fn around(&self, [x_m, y_m]: [f64; 2]) -> Option<[(usize, f64); 4]> {
        let [x, y] = &self.axes;
        let ((left, right), (low, high)) = (x.between(x_m)?, y.between(y_m)?);
        let place = |column: (usize, f64), row: (usize, f64)| {
            let place = self.place_of.get(row.0 * x.lines + column.0).copied().unwrap_or(NO_PLACE);
            (usize::from(place), column.1 * row.1)
        };
        Some([place(left, low), place(right, low), place(left, high), place(right, high)])
    }

    /// What a link between two places loses (dB): the mean of the pairs around its ends, by their shares; [`NO_LINK_DB`] where
    /// pairs without a link have more than half of them.
    pub(super) fn loss_db(&self, from: [f64; 2], to: [f64; 2]) -> f32 {
        // The same sums both ways, to the last bit.
        let order = from[0].total_cmp(&to[0]).then(from[1].total_cmp(&to[1]));
        let (from, to) = if order == Ordering::Greater { (to, from) } else { (from, to) };
        let (Some(from), Some(to)) = (self.around(from), self.around(to)) else { return NO_LINK_DB };
        let (mut shares, mut sum_db, mut least_db) = (0.0, 0.0, NO_LINK_DB);
        for (from, from_share) in from {
            for (to, to_share) in to {
                let share = from_share * to_share;
                if share <= 0.0 || from >= self.places || to >= self.places {
                    continue;
                }
                let loss_db = self.losses_db[from * self.places + to];
                if !loss_db.is_nan() {
                    shares += share;
                    sum_db += share * f64::from(loss_db);
                    least_db = least_db.min(loss_db);
                }
            }
        }
        // Half of it counts, whatever rounding says.
        if shares < 0.5 - 1e-9 { NO_LINK_DB } else { ((sum_db / shares) as f32).max(least_db) }
    }
}
