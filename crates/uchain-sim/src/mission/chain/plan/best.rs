//! The best chains for many depths of the head.

#[cfg(feature = "sweep")]
use rayon::prelude::*;
use uchain_core::bounded;

use super::MOST_LISTED;
use crate::mission::chain::CourseOptimum;

/// The best chains for one depth of the head.
pub(super) struct Best {
    /// The fewest links that keep within the limit.
    pub(super) links: Option<usize>,
    /// The least worst link with 1, 2, … of them (dB), and with so many.
    pub(super) by_links_db: Vec<f64>,
    pub(super) bottleneck_db: Option<f64>,
}

/// One after the other, worked out on all processors.
pub(super) fn best_chains(optimum: &CourseOptimum<'_>, depths_m: &[f64], uavs: Option<usize>) -> Vec<Best> {
    let one = |&depth_m: &f64| {
        let head = optimum.head(depth_m);
        let links = head.links_needed();
        // How bad the worst of 16 links is where it takes 30 helps nobody.
        let listed = match links {
            Some(links) if links > MOST_LISTED => 0,
            Some(links) => links,
            None => bounded(uavs.unwrap_or(MOST_LISTED), 1, MOST_LISTED),
        };
        let bottleneck = |links| head.optimum(links).bottleneck_db;
        Best {
            links,
            by_links_db: (1..=listed).map(bottleneck).collect(),
            bottleneck_db: links.map(bottleneck),
        }
    };
    #[cfg(feature = "sweep")]
    return depths_m.par_iter().map(one).collect();
    #[cfg(not(feature = "sweep"))]
    depths_m.iter().map(one).collect()
}

/// The deepest place between one that can be done and one that cannot (m), by halves; `None` if that is the very first
/// centimetre of all.
pub(super) fn deepest_m(from_m: f64, to_m: f64, can_be: impl Fn(f64) -> bool) -> Option<f64> {
    let (mut low_m, mut high_m) = (from_m, to_m);
    while high_m - low_m > 0.01 {
        let middle_m = low_m.midpoint(high_m);
        if can_be(middle_m) {
            low_m = middle_m;
        } else {
            high_m = middle_m;
        }
    }
    (low_m > 0.0).then_some(low_m)
}
