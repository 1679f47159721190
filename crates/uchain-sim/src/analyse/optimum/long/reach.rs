//! How far a link reaches at a level.

use crate::analyse::optimum::Losses;

/// Added to a reach (m), and per metre of it: what rounding to f32 may take away.
const MARGIN_M: f64 = 1e-3;
const MARGIN: f64 = 1e-5;
/// Halvings of the interval a reach lies in.
const HALVINGS: usize = 60;
/// Where nobody knows the least loss over a distance, links from so many places along the tunnel are asked for,
const PLACES: u32 = 24;
/// each this much longer than the one before (1), from the shortest on (m),
const LONGER: f64 = 1.25;
const SHORTEST_M: f64 = 0.05;
/// and the longest that holds is taken to be short of the reach by this factor.
const UNSEEN: f64 = 1.5;

/// Distance in a straight line beyond which no link is that good (m), at most the tunnel's length; `None` where not
/// even the shortest link is.
///
/// Read off the least loss that the model tells; of one that does not, off links all along the tunnel.
pub(crate) fn reach_m(losses: &impl Losses, depth_m: f64, level_db: f64) -> Option<f64> {
    if losses.least_at_db(depth_m) == f64::NEG_INFINITY {
        return found_m(losses, depth_m, level_db);
    }
    let holds = |apart_m: f64| losses.least_at_db(apart_m) <= level_db;
    if !holds(0.0) {
        return None;
    }
    let (mut near_m, mut far_m) = (0.0, depth_m);
    if holds(far_m) {
        near_m = far_m;
    }
    for _ in 0..HALVINGS {
        let middle_m = f64::midpoint(near_m, far_m);
        if holds(middle_m) {
            near_m = middle_m;
        } else {
            far_m = middle_m;
        }
    }
    Some((far_m * (1.0 + MARGIN) + MARGIN_M).min(depth_m))
}

fn found_m(losses: &impl Losses, depth_m: f64, level_db: f64) -> Option<f64> {
    let mut longest_m: Option<f64> = None;
    for place in 0..PLACES {
        let from_m = depth_m * f64::from(place) / f64::from(PLACES);
        let from = losses.place(from_m);
        let mut along_m = SHORTEST_M;
        while from_m + along_m <= depth_m {
            let to = losses.place(from_m + along_m);
            if losses.holds(&from, &to, level_db) {
                let apart_m = f64::from(losses.spot(&from).distance(losses.spot(&to)));
                longest_m = Some(longest_m.map_or(apart_m, |longest_m| longest_m.max(apart_m)));
            }
            along_m *= LONGER;
        }
    }
    longest_m.map(|longest_m| (UNSEEN * longest_m).min(depth_m))
}
