//! Losses between depths, as the search for the best chain asks for them: hundreds of thousands of times.

use glam::Vec2;

/// What a link between two depths of a tunnel loses.
pub(crate) trait Losses {
    /// A depth, with whatever of it is worth working out once.
    type Place: Clone;

    /// The place at a depth (m).
    fn place(&self, depth_m: f64) -> Self::Place;

    /// Loss of a link, the shallower end first (dB); what is not a number is no connection at all.
    fn db(&self, shallow: &Self::Place, deep: &Self::Place) -> f64;

    /// No more than [`Self::db`], and found without a look at the map: what a link that far loses at best.
    fn least_db(&self, _: &Self::Place, _: &Self::Place) -> f64 {
        f64::NEG_INFINITY
    }

    /// The same of any two places so far apart in a straight line (m).
    fn least_at_db(&self, _apart_m: f64) -> f64 {
        f64::NEG_INFINITY
    }

    /// Where a place lies in the plane (m), as far as anybody knows.
    fn spot(&self, place: &Self::Place) -> Vec2;

    /// Whether a link is that good.
    fn holds(&self, shallow: &Self::Place, deep: &Self::Place, level_db: f64) -> bool {
        self.least_db(shallow, deep) <= level_db && known(self.db(shallow, deep)) <= level_db
    }
}

/// A function of two depths.
pub(super) struct Plain<'a, F>(pub(super) &'a F);

impl<F: Fn(f64, f64) -> f64> Losses for Plain<'_, F> {
    type Place = f64;

    fn place(&self, depth_m: f64) -> f64 {
        depth_m
    }

    fn db(&self, &shallow: &f64, &deep: &f64) -> f64 {
        (self.0)(shallow, deep)
    }

    fn spot(&self, &depth_m: &f64) -> Vec2 {
        Vec2::new(depth_m as f32, 0.0)
    }
}

/// A loss, or no connection at all.
pub(super) fn known(loss_db: f64) -> f64 {
    if loss_db.is_nan() { f64::INFINITY } else { loss_db }
}
