//! The exact optimum of a chain (Laclau 2021, Eq. 1, 2, 9–11): what every run is measured by.
//!
//! Given how loss depends on two depths along the tunnel, where must the relays stand so that the worst link is as
//! good as can be? [`BottleneckTable`] searches the whole tunnel on samples, [`optimum`] makes one answer exact.
//! [`CourseOptimum`](crate::mission::chain::CourseOptimum) binds both to a course.

mod cache;
mod fewest;
mod head;
mod level;
mod long;
mod losses;
mod near;
mod refine;
mod table;
#[cfg(test)]
mod tests;

pub use cache::TableCache;
pub(crate) use cache::TableKey;
pub use fewest::fewest_links;
pub(crate) use head::AtHead;
pub(crate) use long::{Long, reach_m};
pub(crate) use losses::Losses;
pub use table::{BottleneckTable, MOST_LINKS, MOST_SAMPLES};

use uchain_core::bounded;

use losses::{Plain, known};

/// How closely the relays of an optimum are placed (m).
pub const RESOLUTION_M: f64 = 1e-4;
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
    fn of(losses: &impl Losses, base_first_m: Vec<f64>) -> Self {
        let mut depths_m = base_first_m;
        depths_m.reverse();
        let places: Vec<_> = depths_m.iter().map(|&depth_m| losses.place(depth_m)).collect();
        let pairs = places.iter().zip(places.iter().skip(1));
        let link_loss_db: Vec<f64> = pairs.map(|(front, back)| known(losses.db(back, front))).collect();
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
    AtHead::new(Plain(loss_db), table, head_depth_m).optimum(links)
}

/// The chain of the paper's bisection on the level alone: the least level at which relays placed as far apart as it
/// allows reach the head; the optimum where loss grows with distance. Elsewhere it may be worse than [`optimum`], or
/// `None` where no level reaches the head.
pub fn equal_links(loss_db: &impl Fn(f64, f64) -> f64, head_depth_m: f64, links: usize) -> Option<Optimum> {
    let links = bounded(links, 1, MOST_LINKS);
    let losses = Plain(loss_db);
    let chain = level::level(&losses, head_depth_m, links, known(loss_db(0.0, head_depth_m)))?;
    Some(Optimum::of(&losses, chain))
}

/// The least number of links, n*, with which the worst link is at most `s_min_db`; `None` where no number is enough.
pub fn links_needed(
    loss_db: &impl Fn(f64, f64) -> f64,
    table: &BottleneckTable,
    head_depth_m: f64,
    s_min_db: f64,
) -> Option<usize> {
    AtHead::new(Plain(loss_db), table, head_depth_m).links_needed(s_min_db)
}
