//! Heads come round the corners of the shipped scenarios.
//!
//! The gate flies 150 seeds of each. Of 3,000 (`uchain sweep corner --replicates 3000 --out corner`, column
//! `head_reach_m` of `corner/runs.parquet`; the same for `circuit`) none stays in a corner: at most 0.1 % do (95 %).

use uchain_sim::{mission::chain::Summary, run::run};

use crate::course;

/// Past the corner, 3.5 m into `corner` and 2.4 m into `circuit`, and on to where the pilot stops, 7.4 m and more. What
/// sticks in a corner is no farther than 4.3 m, what slides along the wall of the next leg no farther than 6.5 m.
const ARRIVED_M: f32 = 7.0;

/// The runs whose head has not arrived.
fn left_behind(name: &str, seeds: impl Iterator<Item = u64>, sets: &[&str]) -> Vec<Summary> {
    let course = course(name, sets);
    seeds.map(|seed| run(&course, seed, &mut ()).unwrap()).filter(|s| s.head_reach_m < ARRIVED_M).collect()
}

#[test]
fn no_head_stays_in_a_corner() {
    for name in ["corner", "circuit"] {
        let stuck = left_behind(name, 1..=150, &[]);
        assert!(stuck.is_empty(), "{name}: {} of 150 heads did not arrive: {stuck:?}", stuck.len());
    }
}

/// Seeds whose heads stay in a corner by Eq. 20 and 21 as printed: the negative control, and the cause.
#[test]
fn heads_that_stay_in_a_corner_by_the_law_as_printed_come_round_it_by_the_default() {
    let seeds = [("corner", [220, 426, 451]), ("circuit", [52, 66, 118])];
    for (name, seeds) in seeds {
        let printed = left_behind(name, seeds.into_iter(), &["center.law=\"paper\""]);
        assert_eq!(printed.len(), seeds.len(), "{name}: {printed:?}");
        let stuck = left_behind(name, seeds.into_iter(), &[]);
        assert!(stuck.is_empty(), "{name}: {stuck:?}");
    }
}

/// Rounding a corner, nobody comes near a wall.
#[test]
fn nobody_touches_a_wall_in_a_corner() {
    for name in ["corner", "circuit"] {
        let course = course(name, &[]);
        for seed in 151..=250 {
            let s = run(&course, seed, &mut ()).unwrap();
            assert_eq!((s.wall_contacts, s.uav_contacts), (0, 0), "{name}, seed {seed}");
        }
    }
}
