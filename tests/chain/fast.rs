//! The fast way of a mission against the plain one, which leaves everything to rapier.

use uchain_sim::{
    analyse::Digest,
    clock::total_ticks,
    mission::{Mission, chain::Chain},
    sense::Rays,
};

use crate::course;

/// All bits of a mission, and how many of its ticks needed a solver.
fn flown(mut sim: Chain<impl Rays>, ticks: u64) -> (String, u64) {
    let mut digest = Digest::default();
    for _ in 0..ticks {
        sim.step(&mut digest).unwrap();
    }
    (digest.hex(), sim.world().solver_steps())
}

#[test]
fn whole_missions_have_the_same_bits_with_every_uav_in_rapier_at_every_tick() {
    for (name, sets) in [
        ("straight", vec![]),
        ("corner", vec![]),
        ("circuit", vec!["chain.uavs=5"]),
        ("circuit", vec!["preset=cavemod"]),
        ("staircase", vec!["duration_s=120"]),
    ] {
        let course = course(name, &sets);
        let ticks = total_ticks(course.scenario.duration_s);
        for seed in 1..=3 {
            let (fast, steps) = flown(<Chain as Mission>::start(course.clone(), seed), ticks);
            let (plain, plain_steps) = flown(Chain::plain(&course, seed, course.rays.clone()), ticks);
            assert_eq!(fast, plain, "{name} {sets:?}, seed {seed}");
            assert!(steps < ticks / 10 && plain_steps == ticks, "{name}: {steps} of {plain_steps}");
        }
    }
}
