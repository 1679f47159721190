use std::sync::Arc;

use glam::Vec2;
use uchain_core::chain::Command;
use uchain_sim::{
    mission::{Mission, Scene as _, chain::Chain, explore::Exploration},
    world::Waypoint,
};

use crate::{
    course,
    reset::{frames, ring, site},
    ring::Ring,
};

/// The frames of so many ticks in halves, with so many looks in each.
fn in_halves<M: Mission>(scene: &Arc<M::Scene>, seed: u64, looks: usize, ticks: usize) -> Vec<M::Frame> {
    let (mut mission, mut commands, mut frames) = (M::start(scene.clone(), seed), Vec::new(), Vec::new());
    for _ in 0..ticks {
        for _ in 0..looks {
            mission.sense();
        }
        mission.decide(&mut commands);
        let stopped = mission.act(&commands);
        frames.push(mission.frame().clone());
        if stopped.is_some() {
            break;
        }
    }
    frames
}

fn are_the_whole<M: Mission>(scene: &Arc<M::Scene>, ticks: usize) {
    let whole = |seed| frames(&mut M::start(scene.clone(), seed), ticks);
    let first = whole(1);
    for looks in [1, 2, 5] {
        let halves = in_halves::<M>(scene, 1, looks, ticks);
        assert_eq!(halves.len(), first.len());
        for (tick, (halves, whole)) in halves.iter().zip(&first).enumerate() {
            assert_eq!(halves, whole, "{}, {looks} looks a tick, frame {tick}", scene.name());
        }
    }
    assert!(whole(2) != first, "the control: {} with other noise", scene.name());
}

#[test]
fn sense_decide_and_act_are_a_step_however_often_one_looks() {
    for (name, sets) in [("corner", vec![]), ("circuit", vec!["preset=cavemod", "faults.burst_rate=0.1"])] {
        are_the_whole::<Chain>(&course(name, &sets), 800);
    }
    are_the_whole::<Exploration>(
        &site("apartment", &["explore.position_sigma_m=0.02", "explore.scatter_m=0.05"]),
        2000,
    );
    are_the_whole::<Ring>(&ring(), 800);
}

#[test]
fn a_second_look_in_a_tick_sees_the_same_and_the_next_tick_something_else() {
    let mut chain = Chain::start(course("corner", &[]), 1);
    let mut commands = Vec::new();
    let mut changed = 0;
    for _ in 0..400 {
        let first = chain.sense().to_vec();
        assert_eq!(chain.sense(), first);
        chain.decide(&mut commands);
        chain.act(&commands);
        changed += u32::from(chain.sense() != first);
    }
    assert!(changed > 300, "the control: noise is drawn at every tick, and {changed} looks differ");
}

#[test]
fn a_chain_whose_head_is_told_to_stay_on_the_ground_flies_nothing() {
    let flying = |is_grounded: bool| {
        let (mut chain, mut commands) = (Chain::start(course("corner", &[]), 1), Vec::new());
        for _ in 0..1600 {
            chain.sense();
            chain.decide(&mut commands);
            if is_grounded {
                commands[0] = Command::default();
            }
            chain.act(&commands);
            if is_grounded {
                assert!(chain.frame().uavs.iter().all(|uav| !uav.airborne), "tick {}", chain.frame().tick);
            }
        }
        chain.frame().uavs.iter().filter(|uav| uav.airborne).count()
    };
    assert_eq!(flying(true), 0);
    assert!(flying(false) > 1, "the control: by its own decisions it flies, relays as well");
}

#[test]
fn a_robot_flies_where_somebody_else_tells_it() {
    let scene = ring();
    let mut ring = Ring::start(scene.clone(), 1);
    ring.sense();
    let mut commands = Vec::new();
    ring.decide(&mut commands);
    let [x_m, y_m] = [2.0, 2.0];
    let to = Waypoint { at: scene.map().to_local([x_m, y_m]), ..commands[1] };
    commands[1] = to;
    ring.act(&commands);
    // Told nothing, all fly on to where they were told to be, and stay.
    for _ in 0..200 {
        ring.sense();
        ring.act(&[]);
    }
    let at = |i: usize| Vec2::new(ring.frame().robots[i].x_m, ring.frame().robots[i].y_m);
    assert_eq!([at(0), at(1), at(2)], [commands[0].at, to.at, commands[2].at]);
}
