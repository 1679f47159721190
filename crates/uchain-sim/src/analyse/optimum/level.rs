//! Bisection on the level with the farthest reachable placement: the exact answer where loss grows with distance.

use super::losses::Losses;

/// How closely the level is found (dB).
const LEVEL_DB: f64 = 1e-6;
/// How closely a relay is placed (m).
const PLACE_M: f64 = 1e-8;
/// Most halvings of any interval.
const HALVINGS: usize = 60;

/// Relays placed from the base on, each as far as a link of `level_db` reaches, and the head at `head_m`: base
/// first. `None` when the head is out of reach with that many links.
pub(super) fn farthest(losses: &impl Losses, head_m: f64, links: usize, level_db: f64) -> Option<Vec<f64>> {
    let mut depths_m = Vec::with_capacity(links + 1);
    let mut here_m = 0.0;
    let head = losses.place(head_m);
    for _ in 0..links {
        depths_m.push(here_m);
        let here = losses.place(here_m);
        let reaches = |there_m| losses.holds(&here, &losses.place(there_m), level_db);
        let (mut near_m, mut far_m) = (here_m, head_m);
        if losses.holds(&here, &head, level_db) {
            near_m = head_m;
        } else {
            for _ in 0..HALVINGS {
                let middle_m = f64::midpoint(near_m, far_m);
                if far_m - near_m <= PLACE_M {
                    break;
                }
                if reaches(middle_m) {
                    near_m = middle_m;
                } else {
                    far_m = middle_m;
                }
            }
        }
        here_m = near_m;
    }
    depths_m.push(head_m);
    (here_m == head_m).then_some(depths_m)
}

/// The least level at which [`farthest`] reaches the head, no worse than `worst_db`, and its chain. `None` when it
/// does not reach it at `worst_db`.
pub(super) fn level(losses: &impl Losses, head_m: f64, links: usize, worst_db: f64) -> Option<Vec<f64>> {
    let mut best = farthest(losses, head_m, links, worst_db)?;
    let (mut high_db, mut width_db) = (worst_db, 1e-3);
    // Down from what is known in growing strides, then halve.
    let mut low_db = loop {
        let low_db = high_db - width_db;
        match farthest(losses, head_m, links, low_db) {
            Some(chain) if width_db < 1e4 => (best, high_db) = (chain, low_db),
            _ => break low_db,
        }
        width_db *= 4.0;
    };
    for _ in 0..HALVINGS {
        let middle_db = f64::midpoint(low_db, high_db);
        if high_db - low_db <= LEVEL_DB {
            break;
        }
        match farthest(losses, head_m, links, middle_db) {
            Some(chain) => (best, high_db) = (chain, middle_db),
            None => low_db = middle_db,
        }
    }
    Some(best)
}
