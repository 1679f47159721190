//! The exact optimum of a chain (Laclau 2021, Eq. 1, 2, 9–11): what every run is measured by.
//!
//! Given how loss depends on two depths along the tunnel, where must the relays stand so that the worst link is as
//! good as can be? [`BottleneckTable`] searches the whole tunnel on samples, [`optimum`] makes one answer exact.
//! [`CourseOptimum`](crate::mission::chain::CourseOptimum) binds both to a course.

mod cache;
mod level;
mod refine;
mod table;
#[cfg(test)]
mod tests;

pub use cache::TableCache;
pub(crate) use cache::TableKey;
pub use table::{BottleneckTable, MOST_LINKS, MOST_SAMPLES};

use uchain_core::bounded;

use table::known;

/// How closely the relays of an optimum are placed (m).
pub const RESOLUTION_M: f64 = 1e-4;
/// Chains whose worst links differ by no more than this are equally good (dB); of those the one with equal links
/// is preferred.
const EQUAL_DB: f64 = 1e-3;
/// How many of the table's best chains are refined, by the place of the relay next to the head, and how much worse
/// than the best one they may start (dB).
const DIPS: usize = 4;
const DIP_DB: f64 = 10.0;

/// A chain as good as can be. Everything is listed from the head on, as in a summary.
#[derive(Debug, Clone, PartialEq)]
pub struct Optimum {
    /// Depth of head, relays and base (m): falling, the last one 0. One more than there are links.
    pub depths_m: Vec<f64>,
    /// Loss of every link (dB), that to the base last.
    pub link_loss_db: Vec<f64>,
    /// The largest of them (dB).
    pub bottleneck_db: f64,
}

impl Optimum {
    fn of(loss_db: &impl Fn(f64, f64) -> f64, base_first_m: Vec<f64>) -> Self {
        let mut depths_m = base_first_m;
        depths_m.reverse();
        let pairs = depths_m.iter().zip(depths_m.iter().skip(1));
        let link_loss_db: Vec<f64> =
            pairs.map(|(&front_m, &back_m)| known(loss_db(back_m, front_m))).collect();
        let bottleneck_db = link_loss_db.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        Self { depths_m, link_loss_db, bottleneck_db }
    }
}

/// The chain of `links` links (1 to [`MOST_LINKS`], clamped) from the base to a head at `head_depth_m` (clamped to the
/// table's tunnel) whose worst link is best, over all ordered places of the relays. `table` is that of the same
/// `loss_db`, which takes two depths (m), the shallower one first.
///
/// * Where loss is continuous and grows with distance, all links are equal, to within 0.01 dB: the paper's `s_eq`.
/// * Where loss jumps, a least worst link may not exist, only be approached: the answer comes as near as relays
///   placed to [`RESOLUTION_M`] can. Its links are then unequal, the worst one counts.
/// * Where loss does not grow everywhere with distance (a tunnel that turns back on itself), it is still the best
///   worst link over all ordered placements, and may be far better than any chain of equal links. The search is
///   over the table's samples, so a good place narrower than the table's step may be overlooked.
///
/// In every case the answer is a chain that can be had, with the losses it has. It is the better of two: the table's,
/// refined in shrinking windows, and that of the paper's bisection on the level.
pub fn optimum(
    loss_db: &impl Fn(f64, f64) -> f64,
    table: &BottleneckTable,
    head_depth_m: f64,
    links: usize,
) -> Optimum {
    let head_m = in_tunnel(table, head_depth_m);
    let to_head_db = table.losses_to(loss_db, head_m);
    optimum_from(loss_db, table, &to_head_db, head_m, links)
}

fn in_tunnel(table: &BottleneckTable, depth_m: f64) -> f64 {
    if depth_m > 0.0 { depth_m.min(table.depth_m()) } else { 0.0 }
}

fn optimum_from(
    loss_db: &impl Fn(f64, f64) -> f64,
    table: &BottleneckTable,
    to_head_db: &[f64],
    head_m: f64,
    links: usize,
) -> Optimum {
    let asked = bounded(links, 1, MOST_LINKS);
    // Beyond what the table knows no relay helps; the rest stay at the base.
    let links = asked.min(table.links_max() + 1);
    let whole = |depths_m: Vec<f64>| Optimum::of(loss_db, [vec![0.0; asked - links], depths_m].concat());
    let refined = starts(&table.by_last_relay(to_head_db, links)).into_iter().map(|last_relay| {
        let mut depths_m = table.chain(last_relay, head_m, links);
        refine::refine(loss_db, &mut depths_m, table.step_m(), RESOLUTION_M);
        whole(depths_m)
    });
    let refined = refined.min_by(|a, b| a.bottleneck_db.total_cmp(&b.bottleneck_db));
    let refined = refined.unwrap_or_else(|| whole(table.chain(0, head_m, links)));
    let equal = level::level(loss_db, head_m, links, refined.bottleneck_db + EQUAL_DB).map(whole);
    equal.filter(|equal| equal.bottleneck_db <= refined.bottleneck_db + EQUAL_DB).unwrap_or(refined)
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

/// The chain of the paper's bisection on the level alone: the least level at which relays placed as far apart as it
/// allows reach the head; the optimum where loss grows with distance. Elsewhere it may be worse than [`optimum`], or
/// `None` where no level reaches the head.
pub fn equal_links(loss_db: &impl Fn(f64, f64) -> f64, head_depth_m: f64, links: usize) -> Option<Optimum> {
    let links = bounded(links, 1, MOST_LINKS);
    let chain = level::level(loss_db, head_depth_m, links, known(loss_db(0.0, head_depth_m)))?;
    Some(Optimum::of(loss_db, chain))
}

/// The least number of links, n*, with which the worst link is at most `s_min_db`; `None` where no number is enough.
pub fn links_needed(
    loss_db: &impl Fn(f64, f64) -> f64,
    table: &BottleneckTable,
    head_depth_m: f64,
    s_min_db: f64,
) -> Option<usize> {
    let head_m = in_tunnel(table, head_depth_m);
    let to_head_db = table.losses_to(loss_db, head_m);
    let within = |links| within(loss_db, table, &to_head_db, head_m, links, s_min_db);
    let on_samples =
        |&links: &usize| table.by_last_relay(&to_head_db, links).iter().any(|&db| db <= s_min_db);
    // With one link more than the table knows, the relay next to the head still has all samples to stand on.
    let most = table.links_max() + 1;
    let mut needed = match (1..=most).find(on_samples) {
        Some(links) => links,
        None if within(most) => most,
        None => return None,
    };
    while needed > 1 && within(needed - 1) {
        needed -= 1;
    }
    Some(needed)
}

/// Whether the optimum of so many links is good enough.
fn within(
    loss_db: &impl Fn(f64, f64) -> f64,
    table: &BottleneckTable,
    to_head_db: &[f64],
    head_m: f64,
    links: usize,
    s_min_db: f64,
) -> bool {
    // The first is far cheaper, and mostly right where the answer is yes.
    level::farthest(loss_db, head_m, links, s_min_db).is_some()
        || optimum_from(loss_db, table, to_head_db, head_m, links).bottleneck_db <= s_min_db
}
