//! From a chain on samples to the best chain near it.

use uchain_core::bounded;

use super::table::known;

/// Places tried on each side of a relay.
const REACH: usize = 4;
/// How much finer each stage is than the one before.
const FINER: f64 = 3.0;
/// Most times a stage is repeated while it still gains.
const ROUNDS: usize = 12;

/// Moves the relays of `depths_m` (base first, base and head fixed) to the best chain in a window round each, all
/// relays at once (dynamic programming over the windows); windows follow as long as that gains, then shrink, until
/// places are `finest_m` apart.
pub(super) fn refine(loss_db: &impl Fn(f64, f64) -> f64, depths_m: &mut [f64], step_m: f64, finest_m: f64) {
    if depths_m.len() < 3 {
        return;
    }
    let pairs = depths_m.iter().zip(depths_m.iter().skip(1));
    let mut worst_db = pairs.map(|(&a, &b)| known(loss_db(a, b))).fold(f64::NEG_INFINITY, f64::max);
    let mut step_m = step_m / FINER;
    loop {
        let last = step_m <= finest_m;
        step_m = step_m.max(finest_m);
        for _ in 0..ROUNDS {
            let (better, better_db) = best_in_windows(loss_db, depths_m, step_m);
            if better_db >= worst_db {
                break;
            }
            depths_m.copy_from_slice(&better);
            worst_db = better_db;
        }
        if last {
            return;
        }
        step_m /= FINER;
    }
}

/// A place a relay may take: depth, the worst link behind it, and which place of the relay behind it that takes.
#[derive(Clone, Copy)]
struct Place {
    depth_m: f64,
    worst_db: f64,
    behind: usize,
}

fn best_in_windows(loss_db: &impl Fn(f64, f64) -> f64, depths_m: &[f64], step_m: f64) -> (Vec<f64>, f64) {
    let head_m = depths_m.last().copied().unwrap_or_default();
    let fixed = |depth_m| vec![Place { depth_m, worst_db: f64::NEG_INFINITY, behind: 0 }];
    let mut columns = vec![fixed(0.0)];
    for (i, &middle_m) in depths_m.iter().enumerate().skip(1) {
        let mut column =
            if i + 1 == depths_m.len() { fixed(head_m) } else { window(middle_m, head_m, step_m) };
        let behind = columns.last().map(Vec::as_slice).unwrap_or_default();
        for place in &mut column {
            place.worst_db = f64::INFINITY;
            for (j, from) in behind.iter().enumerate() {
                if from.depth_m > place.depth_m || from.worst_db >= place.worst_db {
                    continue;
                }
                let worst_db = known(loss_db(from.depth_m, place.depth_m)).max(from.worst_db);
                if worst_db < place.worst_db {
                    (place.worst_db, place.behind) = (worst_db, j);
                }
            }
        }
        columns.push(column);
    }
    let mut place = columns.last().and_then(|c| c.first()).copied();
    let worst_db = place.map_or(f64::INFINITY, |place| place.worst_db);
    let mut best = Vec::with_capacity(depths_m.len());
    for i in (0..columns.len()).rev() {
        let Some(here) = place else { break };
        best.push(here.depth_m);
        place = i.checked_sub(1).and_then(|i| columns.get(i)?.get(here.behind).copied());
    }
    best.reverse();
    (best, worst_db)
}

fn window(middle_m: f64, head_m: f64, step_m: f64) -> Vec<Place> {
    let offset = |k: usize| (k as f64 - REACH as f64) * step_m;
    let place = |k| Place { depth_m: bounded(middle_m + offset(k), 0.0, head_m), worst_db: 0.0, behind: 0 };
    (0..=2 * REACH).map(place).collect()
}
