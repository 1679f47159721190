//! The broad phase against rapier alone: what it lets by must move as if it had not.

use glam::Vec2;
use uchain_core::chain::Command;

use super::{super::World, *};
use crate::{
    map::{Map, Vertex, corridor},
    seed::{Seed, Source, Stream},
};
use std::sync::Arc;

/// A ring with corners, 1 m wide.
fn ring() -> Map {
    let corners = [[0.0, 0.0], [8.0, 0.0], [6.0, 4.0], [8.0, 8.0], [0.0, 8.0], [1.5, 4.0]];
    let corners = corners.map(|[x, y]| Vertex { x, y, bend_radius_m: 0.0 });
    corridor(&corners, 1.0, true).unwrap().0
}

fn free_place(map: &Map, random: &mut Stream, others: &[(Vec2, f32)]) -> (Vec2, f32) {
    loop {
        let at = Vec2::new(10.0 * random.uniform() - 1.0, 10.0 * random.uniform() - 1.0);
        let apart = others.iter().all(|(other, _)| other.distance(at) > 0.2);
        if apart && !map.in_rock(at) && map.clearance_m(at) > 0.1 {
            return (at, 6.3 * random.uniform());
        }
    }
}

/// Two worlds that differ in their broad phase, with the same UAVs under the same random commands; calls `compare` after
/// every tick.
fn fly_both(
    seed: u64,
    count: usize,
    modes: [Solved; 2],
    ticks: usize,
    mut compare: impl FnMut(usize, &[Body], &[Body]),
) {
    let map = Arc::new(ring());
    let mut random = Seed(seed).stream(0, Source::Start);
    let mut spawns = Vec::new();
    for _ in 0..count {
        spawns.push(free_place(&map, &mut random, &spawns));
    }
    let world =
        |mode| World::with_broad_phase(map.clone(), MotionParams::default(), spawns.iter().copied(), mode);
    let [mut one, mut other] = modes.map(world);
    let mut asked = vec![Command::default(); count];
    for tick in 0..ticks {
        for command in &mut asked {
            // Everybody soon in the air, one in a hundred decisions back on the ground.
            if random.uniform() < 0.05 {
                *command = Command {
                    forward_mps: 0.8 * random.uniform() - 0.2,
                    lateral_mps: 0.2 * random.uniform() - 0.1,
                    yaw_rate_radps: 2.0 * random.uniform() - 1.0,
                    airborne: random.uniform() > 0.01,
                };
            }
        }
        for world in [&mut one, &mut other] {
            world.act(&asked);
            world.advance();
        }
        compare(tick, one.bodies(), other.bodies());
    }
}

/// The tick at which the first contact begins in `fly_both`'s second world, and the first at which the two differ in
/// a bit.
fn first_contact_and_difference(seed: u64, count: usize, mode: Solved) -> (usize, usize) {
    let (mut contact, mut difference) = (usize::MAX, usize::MAX);
    fly_both(seed, count, [mode, Solved::Everybody], 300, |tick, one, other| {
        if other.iter().any(|body| body.wall_contacts + body.uav_contacts > 0) {
            contact = contact.min(tick);
        }
        if one != other {
            difference = difference.min(tick);
        }
    });
    (contact, difference)
}

#[test]
fn until_something_touches_uavs_with_and_without_a_broad_phase_have_the_same_bits() {
    let mut compared = 0;
    for seed in 0..60 {
        let count = [1, 2, 5, 30][seed as usize % 4];
        let (contact, difference) = first_contact_and_difference(seed, count, Solved::Near);
        assert!(difference >= contact, "seed {seed}: {difference} before the contact at {contact}");
        compared += contact.min(300);
    }
    assert!(compared > 3000, "{compared} ticks without contact");
}

#[test]
fn with_a_broad_phase_that_finds_nobody_the_comparison_fails() {
    let found = (0..60).step_by(4).any(|seed| {
        let (contact, difference) = first_contact_and_difference(seed, 1, Solved::Nobody);
        contact != usize::MAX && difference != usize::MAX
    });
    assert!(found);
}

#[test]
fn in_contact_uavs_with_and_without_a_broad_phase_stay_within_a_millimetre_and_count_alike() {
    let mut contacts = 0;
    for seed in 0..60 {
        let mut worst_mm = 0.0_f32;
        fly_both(seed, 2, [Solved::Near, Solved::Everybody], 600, |tick, one, other| {
            for (a, b) in one.iter().zip(other) {
                worst_mm = worst_mm.max(1000.0 * a.at.distance(b.at));
                let counts = |body: &Body| (body.wall_contacts, body.uav_contacts);
                assert_eq!(counts(a), counts(b), "seed {seed}, tick {tick}, {} {}", a.at, b.at);
            }
        });
        assert!(worst_mm < 1.0, "seed {seed}: {worst_mm} mm apart");
        fly_both(seed, 2, [Solved::Near, Solved::Near], 600, |tick, one, _| {
            if tick == 599 {
                contacts += one.iter().map(|body| body.wall_contacts + body.uav_contacts).sum::<u32>();
            }
        });
    }
    assert!(contacts > 60, "{contacts} contacts");
}
