//! Best chains in tunnels of kilometres: hundreds or thousands of links, each a small share of the way.
//!
//! A table over the whole tunnel would be too coarse for its links, or too large. But a link that is good enough
//! reaches only so far. So for one level of the worst link a [`Sweep`] finds the fewest links to every place, with
//! samples as fine as a share of that reach, asking only for links within it; and the best level for a number of
//! links is searched for on a grid of levels.

mod reach;
mod sweep;
#[cfg(test)]
mod tests;

use std::{
    collections::VecDeque,
    sync::{Mutex, PoisonError},
};

use uchain_core::bounded;

pub(crate) use reach::reach_m;
use sweep::Sweep;

use super::{Losses, Optimum, RESOLUTION_M, level, refine};

/// Distance between levels that are tried (dB): by no more than this a chain's worst link falls short of the best.
const GRID_DB: f64 = 0.01;
/// Most steps of the grid away from the limit that links are to keep.
const STEPS_MOST: i64 = 1 << 18;
/// Samples of all sweeps that are kept: a hundred bytes each.
const KEPT_SAMPLES: usize = 600_000;
/// Shortest stretch of a tunnel that is swept (m).
const SHORTEST_M: f64 = 1.0;
/// Chains of up to so many links are made equal to a hair, and those of up to so many are moved to the best place
/// nearby; longer ones are within a grid step of that.
const EQUAL_LINKS: usize = 128;
const REFINED_LINKS: usize = 48;

/// A long tunnel.
#[derive(Debug)]
pub(crate) struct Long<P> {
    depth_m: f64,
    /// Samples within the reach of a link.
    share: f64,
    sweeps: Mutex<VecDeque<Sweep<P>>>,
}

impl<P: Clone> Long<P> {
    /// A tunnel of so many metres, looked at on so many samples within a link's reach.
    pub(crate) fn new(depth_m: f64, share: f64) -> Self {
        Self { depth_m, share, sweeps: Mutex::default() }
    }

    /// The least number of links to a head at a depth (m), each of at most this level (dB).
    pub(crate) fn links_needed(
        &self,
        losses: &impl Losses<Place = P>,
        head_m: f64,
        level_db: f64,
    ) -> Option<usize> {
        self.at_level(losses, head_m, level_db, |sweep| sweep.links_to(losses, head_m))
    }

    /// The chain of so many links to a head at a depth (m) whose worst link is best; the search starts at `near_db`.
    pub(crate) fn optimum(
        &self,
        losses: &impl Losses<Place = P>,
        head_m: f64,
        links: usize,
        near_db: f64,
    ) -> Optimum {
        let level_db = |step: i64| near_db + step as f64 * GRID_DB;
        let fits = |step: i64| {
            let needed = self.links_needed(losses, head_m, level_db(step));
            needed.is_some_and(|needed| needed <= links)
        };
        // Relays equally far apart are a chain that can be had.
        let even = || (0..=links).map(|i| head_m * i as f64 / links as f64).collect::<Vec<f64>>();
        let (mut enough, mut too_few) = if fits(0) {
            // In growing strides to a level that takes more.
            let (mut enough, mut stride) = (0, 1);
            while fits(-stride) && stride < STEPS_MOST {
                (enough, stride) = (-stride, 2 * stride);
            }
            (enough, -stride)
        } else {
            let worse_db = Optimum::of(losses, even()).bottleneck_db - near_db;
            let mut enough = bounded((worse_db / GRID_DB).ceil(), 1.0, STEPS_MOST as f64) as i64;
            while !fits(enough) && enough < STEPS_MOST {
                enough *= 2;
            }
            (enough, 0)
        };
        while enough - too_few > 1 {
            let middle = i64::midpoint(enough, too_few);
            if fits(middle) {
                enough = middle;
            } else {
                too_few = middle;
            }
        }
        let chain = self.at_level(losses, head_m, level_db(enough), |sweep| sweep.chain(losses, head_m));
        let mut chain = chain.filter(|chain| chain.len() <= links + 1).unwrap_or_else(even);
        // Relays that are not needed stay at the base.
        let used = chain.len() - 1;
        let whole = |chain: Vec<f64>| Optimum::of(losses, [vec![0.0; links - used], chain].concat());
        if used <= REFINED_LINKS {
            let step_m = head_m / (used as f64 * self.share);
            refine::refine(losses, &mut chain, step_m, RESOLUTION_M);
        }
        let found = whole(chain);
        if used > EQUAL_LINKS {
            return found;
        }
        let equal = level::level(losses, head_m, used, found.bottleneck_db).map(whole);
        equal.filter(|equal| equal.bottleneck_db <= found.bottleneck_db).unwrap_or(found)
    }

    /// Asks a sweep at this level as far as this head, or up to twice as far: none that is known has to begin anew
    /// for a head a little deeper, and none is laid out over kilometres for one nearby.
    fn at_level<T>(
        &self,
        losses: &impl Losses<Place = P>,
        head_m: f64,
        level_db: f64,
        ask: impl FnOnce(&mut Sweep<P>) -> Option<T>,
    ) -> Option<T> {
        let mut depth_m = self.depth_m;
        while depth_m / 2.0 >= head_m.max(SHORTEST_M) {
            depth_m /= 2.0;
        }
        // Nobody panics while holding the lock; were it so, a sweep would only have to go on.
        let mut sweeps = self.sweeps.lock().unwrap_or_else(PoisonError::into_inner);
        let known = sweeps.iter().position(|sweep| sweep.is_of(depth_m, level_db));
        let sweep = match known.and_then(|at| sweeps.remove(at)) {
            Some(sweep) => sweep,
            None => Sweep::new(losses, depth_m, self.share, level_db)?,
        };
        // The one asked for last goes to the end, so that the one nobody asks for is the first to go.
        sweeps.push_back(sweep);
        while sweeps.len() > 1 && sweeps.iter().map(Sweep::samples).sum::<usize>() > KEPT_SAMPLES {
            sweeps.pop_front();
        }
        sweeps.back_mut().and_then(ask)
    }
}
