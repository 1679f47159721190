//! From a chain on samples to the best chain near it.

use uchain_core::bounded;

use super::losses::{Losses, known};

/// Places tried on each side of a relay.
const REACH: usize = 4;
/// How much finer each stage is than the one before.
const FINER: f64 = 3.0;
/// Most times a stage is repeated while it still gains.
const ROUNDS: usize = 12;

/// Moves the relays of `depths_m` (base first, base and head fixed) to the best chain in a window round each, all
/// relays at once (dynamic programming over the windows); windows follow as long as that gains, then shrink, until
/// places are `finest_m` apart.
pub(super) fn refine(losses: &impl Losses, depths_m: &mut [f64], step_m: f64, finest_m: f64) {
    if depths_m.len() < 3 {
        return;
    }
    let places: Vec<_> = depths_m.iter().map(|&depth_m| losses.place(depth_m)).collect();
    let pairs = places.iter().zip(places.iter().skip(1));
    let mut worst_db = pairs.map(|(a, b)| known(losses.db(a, b))).fold(f64::NEG_INFINITY, f64::max);
    let mut step_m = step_m / FINER;
    loop {
        let last = step_m <= finest_m;
        step_m = step_m.max(finest_m);
        for _ in 0..ROUNDS {
            let (better, better_db) = best_in_windows(losses, depths_m, step_m, worst_db);
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
struct Place<P> {
    at: P,
    depth_m: f64,
    worst_db: f64,
    behind: usize,
}

/// The best chain in a window round each relay, if all its links are better than `least_db`: whatever is not cannot
/// become part of it, and most of it is never asked for.
fn best_in_windows<L: Losses>(losses: &L, depths_m: &[f64], step_m: f64, least_db: f64) -> (Vec<f64>, f64) {
    let head_m = depths_m.last().copied().unwrap_or_default();
    let place = |depth_m| Place { at: losses.place(depth_m), depth_m, worst_db: least_db, behind: 0 };
    let mut columns = vec![vec![Place { worst_db: f64::NEG_INFINITY, ..place(0.0) }]];
    for (i, &middle_m) in depths_m.iter().enumerate().skip(1) {
        let mut column: Vec<_> = if i + 1 == depths_m.len() {
            vec![place(head_m)]
        } else {
            window(middle_m, head_m, step_m).map(place).collect()
        };
        let behind = columns.last().map(Vec::as_slice).unwrap_or_default();
        for place in &mut column {
            for (j, from) in behind.iter().enumerate() {
                if from.depth_m > place.depth_m
                    || from.worst_db >= place.worst_db
                    || losses.least_db(&from.at, &place.at) >= place.worst_db
                {
                    continue;
                }
                let worst_db = known(losses.db(&from.at, &place.at)).max(from.worst_db);
                if worst_db < place.worst_db {
                    (place.worst_db, place.behind) = (worst_db, j);
                }
            }
        }
        columns.push(column);
    }
    let mut place = columns.last().and_then(|column| column.first());
    let worst_db = place.map_or(f64::INFINITY, |place| place.worst_db);
    let mut best = Vec::with_capacity(depths_m.len());
    for i in (0..columns.len()).rev() {
        let Some(here) = place else { break };
        best.push(here.depth_m);
        place = i.checked_sub(1).and_then(|i| columns.get(i)?.get(here.behind));
    }
    best.reverse();
    (best, worst_db)
}

fn window(middle_m: f64, head_m: f64, step_m: f64) -> impl Iterator<Item = f64> {
    let offset = move |k: usize| (k as f64 - REACH as f64) * step_m;
    (0..=2 * REACH).map(move |k| bounded(middle_m + offset(k), 0.0, head_m))
}
