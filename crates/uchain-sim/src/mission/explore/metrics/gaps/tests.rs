use uchain_core::explore::Purpose;

use super::*;
use crate::seed::{Seed, Source};

fn at(x_m: f32, z_m: f32) -> RobotFrame {
    RobotFrame {
        x_m,
        y_m: 0.0,
        z_m,
        heading_rad: 0.0,
        level: 1,
        purpose: Purpose::Wait,
        moves: false,
        holds: false,
        mfl: false,
        wall_contacts: 0,
        robot_contacts: 0,
        level_passes: 0,
    }
}

#[test]
fn the_lower_of_two_is_in_the_downwash_and_two_side_by_side_are_not() {
    let mut gaps = Gaps::new(3, 0.1, 0.3);
    // Robot 1 flies under robot 0; robot 2 stays away, then comes beside robot 0.
    gaps.look(&[at(0.0, 1.5), at(0.25, 0.5), at(3.0, 1.5)]);
    gaps.look(&[at(0.0, 1.5), at(0.0, 1.0), at(0.4, 1.5)]);
    assert_eq!(gaps.downwash_s(), [0.0, 0.1, 0.0]);
    let [near, beside, far] = gaps.gaps().try_into().unwrap();
    assert_eq!(near.robots, [0, 2]);
    assert!((near.beside_m.unwrap() - 0.4).abs() < 1e-6 && near.below_m.is_none(), "{near:?}");
    assert_eq!((beside.robots, beside.below_m, beside.beside_m), ([0, 1], Some(0.5), None));
    assert_eq!((beside.least_m, beside.downwash_s), (0.5, 0.1));
    assert_eq!((far.robots, far.downwash_s, far.beside_m), ([1, 2], 0.0, None));
}

/// All pairs, looked at in every tick.
fn look_at_all(gaps: &mut Gaps, robots: &[RobotFrame]) {
    let place = |robot: &RobotFrame| DVec3::new(robot.x_m.into(), robot.y_m.into(), robot.z_m.into());
    for (j, under) in gaps.under.iter_mut().enumerate() {
        let own = place(&robots[j]);
        let is_above = |other: &RobotFrame| {
            let way = place(other) - own;
            way.z > gaps.body_m && way.truncate().length() <= gaps.downwash_m
        };
        *under += u64::from(robots.iter().any(is_above));
    }
    let ends = robots.iter().enumerate().flat_map(|(j, b)| robots.iter().take(j).map(move |a| (a, b)));
    for (pair, (a, b)) in gaps.pairs.iter_mut().zip(ends) {
        let way = place(b) - place(a);
        let (over_m, up_m) = (way.truncate().length(), way.z.abs());
        pair.least_m = pair.least_m.min(way.length());
        if up_m <= gaps.body_m {
            pair.beside_m = pair.beside_m.min(over_m);
        } else if over_m <= gaps.downwash_m {
            pair.below_m = pair.below_m.min(up_m);
            pair.ticks += 1;
        }
    }
}

#[test]
fn few_looks_find_what_all_looks_find() {
    for seed in 0..8 {
        let mut random = Seed(seed).stream(0, Source::Start);
        let count = 2 + 6 * seed as usize;
        let spread_m = [0.8, 4.0, 30.0][(seed % 3) as usize];
        let mut place = |z_m: f32| {
            let side = |share: f32| spread_m * (share - 0.5);
            RobotFrame { y_m: side(random.uniform()), ..at(side(random.uniform()), z_m) }
        };
        let mut robots: Vec<RobotFrame> = (0..count).map(|_| place(1.0)).collect();
        let (mut few, mut all) = (Gaps::new(count as u16, 0.1, 0.3), Gaps::new(count as u16, 0.1, 0.3));
        let mut targets = robots.clone();
        let mut looks = 0;
        for tick in 0..600 {
            if tick % 30 == 0 {
                for (i, target) in targets.iter_mut().enumerate() {
                    // Some rest for a while.
                    if (i + tick / 30) % 4 != 0 {
                        *target = place([0.5, 1.0, 1.5][(i + tick / 30) % 3]);
                    }
                }
                // Some fly as one, others with a place or a height in common.
                if count > 6 && tick % 60 == 0 {
                    targets[1] = targets[0];
                    (targets[3].x_m, targets[3].y_m) = (targets[2].x_m, targets[2].y_m);
                    targets[5].z_m = targets[4].z_m;
                }
            }
            for (robot, target) in robots.iter_mut().zip(&targets) {
                let way =
                    glam::Vec3::new(target.x_m - robot.x_m, target.y_m - robot.y_m, target.z_m - robot.z_m);
                let step = way.clamp_length_max(0.05);
                (robot.x_m, robot.y_m, robot.z_m) =
                    (robot.x_m + step.x, robot.y_m + step.y, robot.z_m + step.z);
            }
            few.look(&robots);
            look_at_all(&mut all, &robots);
            looks += few.due_m.iter().filter(|due_m| **due_m > f64::NEG_INFINITY).count();
            assert_eq!(few.gaps(), all.gaps(), "seed {seed}, tick {tick}");
            assert_eq!(few.downwash_s(), all.downwash_s(), "seed {seed}, tick {tick}");
        }
        assert!(looks > 0, "nobody is ever let alone");
    }
}
