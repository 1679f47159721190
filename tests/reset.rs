use std::sync::Arc;

use allocation_counter::measure;
use uchain_sim::{
    config::builtin,
    mission::{
        Mission, Scene,
        chain::Chain,
        explore::{Exploration, Site},
    },
};

use crate::{
    course,
    ring::{self, Ring, RingScene},
};

/// The frames of so many ticks, or fewer if the mission is over before.
pub(crate) fn frames<M: Mission>(mission: &mut M, ticks: usize) -> Vec<M::Frame> {
    let mut frames = Vec::new();
    for _ in 0..ticks {
        let stopped = mission.step(&mut ()).unwrap();
        frames.push(mission.frame().clone());
        if stopped.is_some() {
            break;
        }
    }
    frames
}

pub(crate) fn site(name: &str, sets: &[&str]) -> Arc<Site> {
    let sets: Vec<String> = sets.iter().map(ToString::to_string).collect();
    Site::read(&builtin(name).unwrap(), &sets).unwrap_or_else(|error| panic!("{error}"))
}

pub(crate) fn ring() -> Arc<RingScene> {
    RingScene::read(&ring::source(), &[]).unwrap_or_else(|error| panic!("{error}"))
}

/// A mission that has flown and is reset, against a new one with the same seed; and, as the control, one that has flown
/// and flies on.
fn flies_as_new<M: Mission>(scene: &Arc<M::Scene>, ticks: usize) {
    let of_new = frames(&mut M::start(scene.clone(), 2), ticks);
    for flown in [0, 1, 7, ticks / 2, ticks] {
        let mut mission = M::start(scene.clone(), 1);
        frames(&mut mission, flown);
        mission.reset(2);
        let again = frames(&mut mission, ticks);
        assert_eq!(again.len(), of_new.len(), "{}, reset after {flown} ticks", scene.name());
        for (tick, (again, new)) in again.iter().zip(&of_new).enumerate() {
            assert_eq!(again, new, "{}, reset after {flown} ticks, frame {tick}", scene.name());
        }
        // The other way round as well: what the second run left behind is gone.
        mission.reset(1);
        assert!(frames(&mut mission, ticks) == frames(&mut M::start(scene.clone(), 1), ticks));
    }
    let mut mission = M::start(scene.clone(), 2);
    frames(&mut mission, 7);
    assert!(frames(&mut mission, ticks) != of_new, "the control: {} without a reset", scene.name());
}

#[test]
fn a_chain_that_is_reset_flies_as_a_new_one() {
    for (name, sets) in [
        ("corner", vec![]),
        ("staircase", vec!["chain.uavs=5"]),
        ("circuit", vec!["preset=cavemod", "faults.burst_rate=0.1"]),
        ("straight", vec!["faults.dead=[{ uav = 1, start_s = 20 }]", "takeoff.s_min_db=-50"]),
        // Walls are touched: what rapier keeps counts.
        ("corner", vec!["center.c_t_per_s=0", "center.c_r_rad_per_s_m=0"]),
    ] {
        flies_as_new::<Chain>(&course(name, &sets), 800);
    }
}

#[test]
fn an_exploration_that_is_reset_flies_as_a_new_one() {
    for (name, sets) in [
        ("apartment", vec![]),
        ("apartment", vec!["explore.robots=4", "explore.position_sigma_m=0.02", "explore.scatter_m=0.05"]),
        ("corridors", vec!["explore.vehicle=quadrotor"]),
    ] {
        flies_as_new::<Exploration>(&site(name, &sets), 1000);
    }
}

#[test]
fn a_ring_that_is_reset_flies_as_a_new_one() {
    flies_as_new::<Ring>(&ring(), 800);
}

#[test]
fn a_chain_that_is_reset_asks_for_far_less_memory_than_a_new_one() {
    for name in ["corner", "circuit"] {
        let course = course(name, &[]);
        let new = measure(|| drop(Chain::start(course.clone(), 1)));
        let mut chain = Chain::start(course.clone(), 1);
        frames(&mut chain, 400);
        let reset = measure(|| chain.reset(2));
        println!(
            "{name}: a new start {} bytes in {} calls, a reset {} bytes in {} calls",
            new.bytes_total, new.count_total, reset.bytes_total, reset.count_total
        );
        assert!(10 * reset.bytes_total < new.bytes_total, "{name}: {reset:?}, and a new start {new:?}");
    }
}
