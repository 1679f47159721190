use proptest::prelude::*;

use super::*;
use crate::explore::{self, Purpose};

fn target(robot: u16, from: [f32; 2], to: [f32; 2], level: u16) -> Target {
    let point = |[x_m, y_m]: [f32; 2]| Point { x_m, y_m };
    Target { robot, purpose: Purpose::Explore, hub: None, from: point(from), to: point(to), level }
}

/// Targets in index order, all on the usual level.
fn fresh(moves: &[([f32; 2], [f32; 2])]) -> Vec<Target> {
    (0..).zip(moves).map(|(i, &(from, to))| target(i, from, to, ExploreParams::USUAL_LEVEL)).collect()
}

fn given(targets: &[Target]) -> Vec<u16> {
    rule(targets, &ExploreParams::default()).into_iter().map(|ruling| ruling.level).collect()
}

#[test]
fn two_that_cross_fly_low_and_high_a_third_stays_in_the_middle_and_a_fourth_flies_above() {
    let crossing = [
        ([-0.8, 0.0], [0.0, 0.0]),
        ([0.8, 0.0], [0.0, 0.0]),
        ([0.0, -0.8], [0.0, 0.0]),
        ([0.0, 0.8], [0.0, 0.0]),
    ];
    assert_eq!(given(&fresh(&crossing[..2])), [0, 2]);
    assert_eq!(given(&fresh(&crossing[..3])), [0, 2, 1]);
    assert_eq!(given(&fresh(&crossing)), [0, 2, 1, 3]);
    let params = ExploreParams::default();
    assert_eq!([0, 1, 2, 3].map(|level| params.height_m(level)), [0.5, 1.0, 1.5, 2.0]);
    let mfl: Vec<bool> = rule(&fresh(&crossing), &params).iter().map(|ruling| ruling.mfl).collect();
    assert_eq!(mfl, [true, true, false, true]);
}

#[test]
fn a_level_is_kept_until_nobody_is_near_and_not_swapped_in_mid_air() {
    let side_by_side = |levels: [u16; 2]| {
        [target(0, [0.0, 0.0], [0.8, 0.0], levels[0]), target(1, [0.0, 0.0], [0.8, 0.1], levels[1])]
    };
    assert_eq!(given(&side_by_side([0, 2])), [0, 2]);
    assert_eq!(given(&side_by_side([2, 0])), [2, 0]);
    assert_eq!(given(&side_by_side([2, 1])), [2, 0]);
    assert_eq!(given(&side_by_side([1, 0])), [2, 0]);
    assert_eq!(given(&side_by_side([0, 0])), [0, 2]);
    assert_eq!(given(&[target(0, [0.0, 0.0], [0.8, 0.0], 0), target(1, [0.0, 1.0], [0.8, 1.0], 2)]), [1, 1]);
}

#[test]
fn who_stays_is_passed_and_who_is_out_of_reach_is_not() {
    let pass = |y: f32| given(&fresh(&[([0.0, 0.0], [0.0, 0.0]), ([-0.8, y], [0.8, y])]));
    assert_eq!(pass(0.24), [0, 2]);
    assert_eq!(pass(0.26), [1, 1]);
    // The second comes to the place of the first after that has gone.
    assert_eq!(given(&fresh(&[([0.0, 0.0], [0.8, 0.0]), ([-0.8, 0.0], [0.0, 0.0])])), [1, 1]);
}

#[test]
fn where_robots_hold_the_later_of_two_moving_ones_does_and_is_passed_without_counting() {
    let params = ExploreParams { strategy: explore::StrategyKind::SRG, ..ExploreParams::default() };
    let ruled = |moves: &[_]| rule(&fresh(moves), &params);
    let (left, right, middle) = ([-0.8, 0.0], [0.8, 0.0], [0.0, 0.0]);
    let both = ruled(&[(left, middle), (right, middle)]);
    assert_eq!(both.iter().map(|r| (r.hold, r.mfl)).collect::<Vec<_>>(), [(false, false), (true, false)]);
    assert_eq!([both[0].level, both[1].level], [1, 1], "the one that holds is out of the way");
    // Past a parked robot nobody holds, but not on its level; nor does that count.
    let parked = ruled(&[(left, right), (middle, middle)]);
    assert!(parked.iter().all(|r| !r.hold && !r.mfl));
    assert_ne!(parked[0].level, parked[1].level);
    // The third would meet the second only, which holds already.
    let queue = ruled(&[(left, middle), (right, middle), ([1.6, 0.0], [1.06, 0.0])]);
    assert_eq!(queue.iter().map(|r| r.hold).collect::<Vec<_>>(), [false, true, false]);
}

#[test]
fn moves_that_are_none_meet_nobody() {
    let far = f32::MAX;
    let odd = [[f32::NAN, 0.0], [far, -far], [f32::INFINITY, 0.0], [f32::MIN_POSITIVE, 0.0], [0.0, 0.0]];
    let targets: Vec<Target> = odd.iter().flat_map(|&a| odd.map(|b| target(0, a, b, u16::MAX))).collect();
    assert_eq!(rule(&targets, &ExploreParams::default()).len(), 25);
    assert_eq!(rule(&[], &ExploreParams::default()), []);
}

/// Places on a few streets, so that moves cross, meet and follow one another.
fn place() -> impl Strategy<Value = [f32; 2]> {
    (-8..=8_i8, -3..=3_i8).prop_map(|(x, y)| [f32::from(x) * 0.13, f32::from(y) * 0.3])
}

/// Where a robot is that has flown so far.
fn after(t: &Target, flown_m: f32) -> Point {
    let share = (flown_m / t.from.distance_m(t.to).max(1e-9)).min(1.0);
    let along = |from: f32, to: f32| from + share * (to - from);
    Point { x_m: along(t.from.x_m, t.to.x_m), y_m: along(t.from.y_m, t.to.y_m) }
}

proptest! {
    #[test]
    fn the_closest_approach_is_that_of_dense_samples(a in (place(), place()), b in (place(), place())) {
        let (a, b) = (target(0, a.0, a.1, 1), target(1, b.0, b.1, 1));
        let sampled_m = (0..=4000)
            .map(|i| i as f32 * 1e-3)
            .map(|m| after(&a, m).distance_m(after(&b, m)))
            .fold(f32::INFINITY, f32::min);
        let closest_m = closest_m(&a, &b);
        // Between two samples, 1 mm of flight each, the distance changes by 2 mm at most.
        prop_assert!(closest_m <= sampled_m + 1e-5 && closest_m >= sampled_m - 2e-3, "{} {}", closest_m, sampled_m);
    }

    #[test]
    fn nobody_is_on_the_level_of_one_it_would_meet_and_nobody_leaves_the_usual_one_for_nothing(
        moves in prop::collection::vec((place(), place(), 0..4_u16), 1..12), holds in any::<bool>(),
    ) {
        let strategy = if holds { explore::StrategyKind::SRG } else { explore::StrategyKind::CSSG };
        let params = ExploreParams { strategy, ..ExploreParams::default() };
        let mut targets: Vec<Target> =
            (0..).zip(&moves).map(|(i, &(from, to, level))| target(i, from, to, level)).collect();
        let rulings = rule(&targets, &params);
        for (target, ruling) in targets.iter_mut().zip(&rulings) {
            prop_assert!(holds || !ruling.hold);
            target.to = if ruling.hold { target.from } else { target.to };
        }
        for (j, b) in targets.iter().enumerate() {
            let meets = |(i, a): (usize, &Target)| i != j && closest_m(a, b) < params.conflict_m();
            let met: Vec<u16> = targets.iter().enumerate().filter(|&pair| meets(pair)).map(|(_, a)| a.robot).collect();
            prop_assert!(met.iter().all(|&i| rulings[usize::from(i)].level != rulings[j].level));
            prop_assert!(!met.is_empty() || rulings[j].level == ExploreParams::USUAL_LEVEL);
            let moving = |t: &Target| t.from != t.to;
            prop_assert!(!holds || !moving(b) || met.iter().all(|&i| !moving(&targets[usize::from(i)])));
        }
    }
}
