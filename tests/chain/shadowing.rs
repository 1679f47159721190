use std::sync::Arc;

use uchain_sim::{
    mission::{
        Mission as _, Scene as _,
        chain::{Chain, Course, plan},
    },
    run::run,
    seed::Seed,
};

use crate::course;

const SHADOWED: &str = "radio.sigma_static_db=6";

/// Losses between depths of the tunnel, as a run of a seed has them; of nobody's if there is none.
fn losses_db(course: &Arc<Course>, seed: Option<u64>) -> Vec<f64> {
    let of_run = seed.map_or_else(|| course.clone(), |seed| course.seeded(seed));
    let depths_m = (1..8).map(|i| f64::from(i) * 1.1);
    depths_m.map(|depth_m| of_run.loss_at_depths_db(0.5 * depth_m, depth_m + 0.3).unwrap()).collect()
}

#[test]
fn all_treatments_of_a_replicate_fly_through_the_same_shadows_and_replicates_through_others() {
    let treatments = [
        &[SHADOWED][..],
        &[SHADOWED, "takeoff.s_min_db=55"],
        &[SHADOWED, "radio.sigma_db=1", "packets.drop_rate=0.4"],
    ];
    // What shadows add: treatments may well differ in the mean.
    let shadows = |sets: &[&str], replicate| {
        let course = course("corner", sets);
        let seed = Seed(42).replicate(replicate).0;
        let mean_db = losses_db(&course, None);
        losses_db(&course, Some(seed))
            .iter()
            .zip(mean_db)
            .map(|(db, mean_db)| db - mean_db)
            .collect::<Vec<_>>()
    };
    let first = shadows(treatments[0], 0);
    assert!(first.iter().any(|db| db.abs() > 1.0), "{first:?}");
    for treatment in treatments {
        assert_eq!(shadows(treatment, 0), first, "{treatment:?}");
        assert_ne!(shadows(treatment, 1), first, "{treatment:?}");
    }
    // Without what stays in place a seed changes no loss.
    assert_eq!(shadows(&[], 0), [0.0; 7]);
}

#[test]
fn a_plan_knows_nothing_of_shadows_unless_it_is_told_their_seed() {
    let planned = |sets: &[&str]| plan(&course("corner", sets), None, 1.0, None).unwrap().rows;
    let plain = planned(&[]);
    assert_eq!(planned(&[SHADOWED]), plain);
    let told = planned(&[SHADOWED, "radio.shadowing_seed=7"]);
    assert_ne!(told, plain);
    assert_ne!(told, planned(&[SHADOWED, "radio.shadowing_seed=8"]));
}

#[test]
fn runs_fly_through_the_shadows_that_the_plan_was_told_and_their_seeds_move_the_rest() {
    let told = course("corner", &[SHADOWED, "radio.shadowing_seed=7"]);
    let own = course("corner", &[SHADOWED]);
    assert_eq!(losses_db(&told, Some(1)), losses_db(&told, None));
    assert_eq!(losses_db(&told, Some(1)), losses_db(&own, Some(7)));
    let digest = |course: &Arc<Course>, seed| run(course, seed, &mut ()).unwrap().digest;
    assert_ne!(digest(&told, 1), digest(&told, 2));
    assert_ne!(digest(&told, 1), digest(&own, 1));
}

#[test]
fn the_gap_of_a_run_is_measured_against_the_best_chain_in_its_own_shadows() {
    let flown = course("straight", &[SHADOWED]);
    let summary = run(&flown, 3, &mut ()).unwrap();
    let gap_db = f64::from(summary.bottleneck_gap_db.unwrap());
    let worst_db = summary.links.iter().map(|link| f64::from(link.true_db)).fold(f64::NEG_INFINITY, f64::max);
    let best_db = |course: &Arc<Course>| {
        let head_m = f64::from(summary.head_reach_m);
        course.optimum().unwrap().optimum(head_m, summary.links.len()).bottleneck_db
    };
    let [knowing_db, plain_db] = [best_db(&flown.seeded(3)), best_db(&flown)];
    assert!((knowing_db - plain_db).abs() > 0.5, "{knowing_db} {plain_db}");
    // The head hovers within centimetres of where it was at its deepest.
    assert!((worst_db - knowing_db - gap_db).abs() < 1.5, "gap {gap_db} of {worst_db} over {knowing_db}");
    assert!(gap_db > -1.0, "nobody beats the optimum: {gap_db}");
}

#[test]
fn a_mission_that_is_reset_flies_through_the_shadows_of_its_new_seed() {
    let flown = course("corner", &[SHADOWED, "radio.antenna_offset_db=2", "radio.yaw_db=7", "duration_s=30"]);
    let frames = |mut chain: Chain| {
        (0..400)
            .map(|_| {
                chain.step(&mut ()).unwrap();
                chain.frame().clone()
            })
            .collect::<Vec<_>>()
    };
    let mut again = Chain::start(flown.clone(), 1);
    for _ in 0..100 {
        again.step(&mut ()).unwrap();
    }
    again.reset(2);
    let (again, new) = (frames(again), frames(Chain::start(flown.clone(), 2)));
    assert!(again == new);
    assert!(frames(Chain::start(flown, 1)) != new, "another seed is another flight");
}

#[test]
fn who_waits_on_the_floor_hears_the_chain_worse_by_the_penalty_and_takes_off_earlier() {
    let launch_s = |sets: &[&str]| run(&course("straight", sets), 1, &mut ()).unwrap().launches_s[1];
    let (plain_s, grounded_s) = (launch_s(&[]), launch_s(&["radio.ground_db=10"]));
    assert!(grounded_s < plain_s - 1.0, "{grounded_s} {plain_s}");
    // The base stands on the floor only if its antenna is lower than 0.1 m.
    let base_db = |sets: &[&str]| course("straight", sets).loss_at_depths_db(0.0, 3.0).unwrap();
    let plain_db = base_db(&[]);
    assert_eq!(base_db(&["radio.ground_db=10"]), plain_db);
    assert_eq!(base_db(&["radio.ground_db=10", "chain.base_height_m=0.1"]), plain_db);
    assert_eq!(base_db(&["radio.ground_db=10", "chain.base_height_m=0.05"]), plain_db + 10.0);
}
