//! The best chains over a whole tunnel, on samples of the depth.

use uchain_core::bounded;

use super::losses::{Losses, Plain, known};

/// Most samples of a table: the losses between all pairs of them take 9 MB while it is drawn.
pub const MOST_SAMPLES: usize = 1_500;
/// Most links of a table.
pub const MOST_LINKS: usize = 1_001;

/// For every number of links and every sampled depth of the head, the least worst link.
///
/// Relays stand on samples, so a bottleneck read from here is one that can be had, and no less than the optimum.
#[derive(Debug, Clone, PartialEq)]
pub struct BottleneckTable {
    depth_m: f64,
    step_m: f64,
    /// Row after row, one per number of links, one entry per sample.
    best_db: Vec<f64>,
    /// The sample of the relay next to the head, for each entry of `best_db`.
    back: Vec<u16>,
    samples: usize,
}

impl BottleneckTable {
    /// Draws the table of a tunnel of `depth_m`, for up to `links_max` links (at most [`MOST_LINKS`]), on samples
    /// `step_m` apart; farther where that would be more than [`MOST_SAMPLES`], a little nearer so that the last
    /// one is the tunnel's end. `loss_db` of two depths, the shallower one first; what is not a number counts as
    /// no connection at all. It is asked once for every pair of samples.
    ///
    /// Dynamic programming: the best of n links at sample i is the least, over samples j, of the worse of the best
    /// of n − 1 links at j and the link from j to i. The table ends early where one more link helps nowhere.
    pub fn new(loss_db: impl Fn(f64, f64) -> f64, depth_m: f64, step_m: f64, links_max: usize) -> Self {
        Self::draw(&Plain(&loss_db), depth_m, step_m, links_max)
    }

    pub(crate) fn draw(losses: &impl Losses, depth_m: f64, step_m: f64, links_max: usize) -> Self {
        let depth_m = if depth_m.is_finite() { depth_m.max(0.0) } else { 0.0 };
        let steps = (depth_m / step_m).ceil();
        let steps = if steps >= 1.0 { (steps as usize).min(MOST_SAMPLES - 1) } else { 1 };
        let (step_m, samples) = (depth_m / steps as f64, steps + 1);
        let places: Vec<_> = (0..samples).map(|i| losses.place(i as f64 * step_m)).collect();
        // Row i holds the losses from the samples 0..=i to sample i.
        let mut links_db = Vec::with_capacity(samples * (samples + 1) / 2);
        for (i, deep) in places.iter().enumerate() {
            links_db.extend(places.iter().take(i + 1).map(|shallow| known(losses.db(shallow, deep))));
        }
        let row = |i: usize| links_db.iter().skip(i * (i + 1) / 2).take(i + 1);
        let mut best_db: Vec<f64> = (0..samples).filter_map(|i| row(i).next().copied()).collect();
        let mut back = vec![0; samples];
        for _ in 1..links_max.min(MOST_LINKS) {
            let last = best_db.len() - samples;
            let mut helped = false;
            for i in 0..samples {
                // A relay at the base or beside the head is one that is not needed.
                let mut best = (best_db[last + i], i);
                for (j, (&link_db, &rest_db)) in row(i).zip(&best_db[last..]).enumerate() {
                    let worst_db = if link_db > rest_db { link_db } else { rest_db };
                    if worst_db < best.0 {
                        best = (worst_db, j);
                    }
                }
                helped |= best.0 < best_db[last + i];
                best_db.push(best.0);
                back.push(best.1 as u16);
            }
            if !helped {
                best_db.truncate(last + samples);
                back.truncate(last + samples);
                break;
            }
        }
        Self { depth_m, step_m, best_db, back, samples }
    }

    /// Most links it knows; with more, nothing gets better (or nobody asked).
    pub fn links_max(&self) -> usize {
        self.best_db.len() / self.samples
    }

    /// Distance between two samples (m).
    pub fn step_m(&self) -> f64 {
        self.step_m
    }

    /// Depth of the last sample, the tunnel's end (m).
    pub fn depth_m(&self) -> f64 {
        self.depth_m
    }

    /// Least worst link against depth (dB): entry i is a head at depth i · [`Self::step_m`]. `links` from 1; beyond
    /// [`Self::links_max`] that of as many.
    pub fn bottleneck_db(&self, links: usize) -> &[f64] {
        let start = (bounded(links, 1, self.links_max()) - 1) * self.samples;
        self.best_db.get(start..start + self.samples).unwrap_or_default()
    }

    /// Losses from every sample that is not deeper than a head, to that head (dB).
    pub(super) fn losses_to(&self, losses: &impl Losses, head_m: f64) -> Vec<f64> {
        let depths =
            (0..self.samples).map(|i| i as f64 * self.step_m).take_while(|&depth_m| depth_m <= head_m);
        let head = losses.place(head_m);
        depths.map(|depth_m| known(losses.db(&losses.place(depth_m), &head))).collect()
    }

    /// The worst link of the best chain with relays on samples, by the sample of the relay next to the head (dB).
    /// `to_head_db` comes from [`Self::losses_to`].
    pub(super) fn by_last_relay(&self, to_head_db: &[f64], links: usize) -> Vec<f64> {
        if links < 2 {
            return to_head_db.iter().take(1).copied().collect();
        }
        let rest = self.bottleneck_db(links - 1).iter();
        to_head_db.iter().zip(rest).map(|(&link_db, &rest_db)| link_db.max(rest_db)).collect()
    }

    /// The chain behind a relay on this sample, and a head: base first.
    pub(super) fn chain(&self, last_relay: usize, head_m: f64, links: usize) -> Vec<f64> {
        let (mut depths_m, mut sample) = (vec![head_m], last_relay);
        for links in (1..links).rev() {
            depths_m.push(sample as f64 * self.step_m);
            let row = (links.min(self.links_max()) - 1) * self.samples;
            sample = self.back.get(row + sample).copied().map_or(0, usize::from);
        }
        depths_m.push(0.0);
        depths_m.reverse();
        depths_m
    }
}
