//! The best chains for one place of the head.

use std::{cell::RefCell, collections::BTreeMap};

use uchain_core::bounded;

use super::{BottleneckTable, Losses, MOST_LINKS, Optimum, RESOLUTION_M, level, refine};

/// Chains whose worst links differ by no more than this are equally good (dB); of those the one with equal links
/// is preferred.
const EQUAL_DB: f64 = 1e-3;
/// How many of the table's best chains are refined, by the place of the relay next to the head, and how much worse
/// than the best one they may start (dB).
const DIPS: usize = 4;
const DIP_DB: f64 = 10.0;

/// A head in a tunnel with a table. What several questions about it share is worked out once.
pub(crate) struct AtHead<'a, L> {
    losses: L,
    table: &'a BottleneckTable,
    head_m: f64,
    to_head_db: Vec<f64>,
    known: RefCell<BTreeMap<usize, Optimum>>,
}

impl<'a, L: Losses> AtHead<'a, L> {
    /// A head at a depth (m), clamped to the tunnel.
    pub(crate) fn new(losses: L, table: &'a BottleneckTable, depth_m: f64) -> Self {
        let head_m = if depth_m > 0.0 { depth_m.min(table.depth_m()) } else { 0.0 };
        let to_head_db = table.losses_to(&losses, head_m);
        Self { losses, table, head_m, to_head_db, known: RefCell::default() }
    }

    /// [`optimum`](super::optimum) for this head.
    pub(crate) fn optimum(&self, links: usize) -> Optimum {
        let links = bounded(links, 1, MOST_LINKS);
        if let Some(known) = self.known.borrow().get(&links) {
            return known.clone();
        }
        let optimum = self.searched(links);
        self.known.borrow_mut().insert(links, optimum.clone());
        optimum
    }

    fn searched(&self, asked: usize) -> Optimum {
        let (losses, table, head_m) = (&self.losses, self.table, self.head_m);
        // Beyond what the table knows no relay helps; the rest stay at the base.
        let links = asked.min(table.links_max() + 1);
        let whole = |depths_m: Vec<f64>| Optimum::of(losses, [vec![0.0; asked - links], depths_m].concat());
        let refined = starts(&table.by_last_relay(&self.to_head_db, links)).into_iter().map(|last_relay| {
            let mut depths_m = table.chain(last_relay, head_m, links);
            refine::refine(losses, &mut depths_m, table.step_m(), RESOLUTION_M);
            whole(depths_m)
        });
        let refined = refined.min_by(|a, b| a.bottleneck_db.total_cmp(&b.bottleneck_db));
        let refined = refined.unwrap_or_else(|| whole(table.chain(0, head_m, links)));
        let equal = level::level(losses, head_m, links, refined.bottleneck_db + EQUAL_DB).map(whole);
        equal.filter(|equal| equal.bottleneck_db <= refined.bottleneck_db + EQUAL_DB).unwrap_or(refined)
    }

    /// [`links_needed`](super::links_needed) for this head.
    pub(crate) fn links_needed(&self, s_min_db: f64) -> Option<usize> {
        let on_samples = |&links: &usize| {
            self.table.by_last_relay(&self.to_head_db, links).iter().any(|&db| db <= s_min_db)
        };
        // With one link more than the table knows, the relay next to the head still has all samples to stand on.
        let most = self.table.links_max() + 1;
        let mut needed = match (1..=most).find(on_samples) {
            Some(links) => links,
            None if self.within(most, s_min_db) => most,
            None => return None,
        };
        while needed > 1 && self.within(needed - 1, s_min_db) {
            needed -= 1;
        }
        Some(needed)
    }

    /// Whether the optimum of so many links is good enough.
    fn within(&self, links: usize, s_min_db: f64) -> bool {
        // The first is far cheaper, and mostly right where the answer is yes.
        level::farthest(&self.losses, self.head_m, links, s_min_db).is_some()
            || self.optimum(links).bottleneck_db <= s_min_db
    }
}

/// The dips of a curve, deepest first, as far as refining them may pay.
fn starts(worst_db: &[f64]) -> Vec<usize> {
    let at = |i: usize| worst_db.get(i).copied().unwrap_or(f64::INFINITY);
    let is_dip = |&i: &usize| (i == 0 || at(i - 1) > at(i)) && at(i + 1) >= at(i);
    let mut dips: Vec<usize> = (0..worst_db.len()).filter(is_dip).collect();
    dips.sort_by(|&i, &j| at(i).total_cmp(&at(j)));
    let least_db = dips.first().map_or(f64::INFINITY, |&i| at(i));
    dips.retain(|&i| at(i) <= least_db + DIP_DB);
    dips.truncate(DIPS);
    dips
}
