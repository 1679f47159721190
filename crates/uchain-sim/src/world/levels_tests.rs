//! Bodies under both kinds of commands in one world, on levels.

use std::sync::Arc;

use glam::Vec2;
use uchain_core::chain::Command;

use super::*;
use crate::{
    map::{Map, drawn},
    seed::{Seed, Source},
};

fn hall() -> Arc<Map> {
    drawn(&[vec![[-5.0, -5.0], [5.0, -5.0], [5.0, 5.0], [-5.0, 5.0]]]).unwrap().into()
}

fn at(x: f32, y: f32, z_m: f32) -> Waypoint {
    Waypoint { at: Vec2::new(x, y), z_m, heading_rad: 0.0 }
}

fn by_velocity(at: Waypoint) -> Start {
    Start::by_velocity(at)
}

fn point(at: Waypoint) -> Start {
    Start::by_waypoint(Box::new(PointMass::new(at, 0.3, 0.5)))
}

fn quadrotor(at: Waypoint) -> Start {
    Start::by_waypoint(Box::new(Quadrotor::new(at, &QuadrotorParams::default(), 0.3, 0.5)))
}

fn world(starts: impl IntoIterator<Item = Start>) -> World {
    World::new(hall(), MotionParams::default(), starts)
}

fn velocity(forward_mps: f32) -> Motion {
    Command { forward_mps, airborne: true, ..Command::default() }.into()
}

fn contacts(world: &World) -> Vec<(u32, u32, u32)> {
    let of = |body: &Body| (body.wall_contacts, body.uav_contacts, body.level_passes);
    world.bodies().iter().map(of).collect()
}

#[test]
fn three_bodies_under_three_kinds_of_motion_fly_in_one_world_with_the_bits_they_have_alone() {
    let starts = [by_velocity, point, quadrotor].into_iter().zip([
        at(-2.0, -2.0, 0.7),
        at(-2.0, 0.0, 1.0),
        at(-2.0, 2.0, 1.3),
    ]);
    let told = [velocity(0.2), at(2.0, 0.5, 1.0).into(), at(2.0, 2.0, 1.5).into()];
    let mut together = world(starts.clone().map(|(start, at)| start(at)));
    let mut alone: Vec<World> = starts.map(|(start, at)| world([start(at)])).collect();
    for (i, motion) in told.into_iter().enumerate() {
        together.command(i, motion).unwrap();
        alone[i].command(0, motion).unwrap();
    }
    for tick in 1..=400 {
        together.advance();
        for (i, alone) in alone.iter_mut().enumerate() {
            alone.advance();
            assert_eq!(together.bodies()[i], alone.bodies()[0], "body {i}, tick {tick}");
        }
        assert_eq!(together.tick(), tick);
    }
    assert!(together.has_arrived());
    let [flown, point, quadrotor] = [0, 1, 2].map(|i| together.bodies()[i].pose());
    assert!((flown.at.x - -2.0 - 0.2 * (20.0 - 0.2)).abs() < 0.01 && flown.z_m == 0.7, "{flown:?}");
    assert_eq!(point, at(2.0, 0.5, 1.0));
    assert!(
        quadrotor.at.distance(Vec2::splat(2.0)) < 0.02 && (quadrotor.z_m - 1.5).abs() < 0.02,
        "{quadrotor:?}"
    );
    assert_eq!(contacts(&together), [(0, 0, 0); 3]);
}

/// Two bodies that fly head-on from 2 m apart, one of them on this level (m); where they are in the end.
fn head_on(starts: [fn(Waypoint) -> Start; 2], level_m: f32) -> World {
    let places =
        [at(-1.0, 0.0, 1.0), Waypoint { heading_rad: core::f32::consts::PI, ..at(1.0, 0.0, level_m) }];
    let mut world = world([starts[0](places[0]), starts[1](places[1])]);
    for i in 0..2 {
        let to = Waypoint { at: places[1 - i].at, ..places[i] };
        let told = world.command(i, to.into()).or_else(|_| world.command(i, velocity(0.3)));
        told.unwrap();
    }
    (0..120).for_each(|_| world.advance());
    world
}

#[test]
fn bodies_on_different_levels_never_touch_and_on_one_level_they_do() {
    type Kind = fn(Waypoint) -> Start;
    let pairs: [[Kind; 2]; 4] =
        [[by_velocity, by_velocity], [by_velocity, point], [quadrotor, by_velocity], [point, quadrotor]];
    for starts in pairs {
        let apart = head_on(starts, 1.5);
        assert_eq!(contacts(&apart), [(0, 0, 0); 2]);
        assert!(apart.bodies()[0].at.x > 0.5 && apart.bodies()[1].at.x < -0.5, "{apart:?}");
        // The control.
        let met = head_on(starts, 1.0);
        assert_eq!(contacts(&met), [(0, 1, 0); 2], "{met:?}");
    }
}

#[test]
fn who_takes_velocities_is_stopped_by_who_flies_to_a_waypoint_and_who_does_so_by_nobody() {
    let mut world = world([by_velocity(at(0.5, 0.0, 1.0)), point(at(-1.0, 0.0, 1.0))]);
    world.command(0, velocity(0.0)).unwrap();
    world.command(1, at(2.0, 0.0, 1.0).into()).unwrap();
    while !world.has_arrived() {
        world.advance();
        let [a, b] = [world.bodies()[0].at, world.bodies()[1].at];
        assert!(a.x - b.x > 2.0 * world.radius_m() - 0.001, "{a} {b}");
    }
    assert_eq!(world.tick(), 200);
    assert_eq!(contacts(&world), [(0, 1, 0); 2]);
}

#[test]
fn who_comes_to_a_level_or_from_the_ground_is_in_the_way_from_then_on() {
    // Far enough for the one that flies to have room for many ticks when the other one comes.
    for (height_m, is_grounded) in [(1.5, false), (1.0, true), (1.0, false)] {
        let mut world = world([by_velocity(at(-1.0, 0.0, 1.0)), point(at(0.0, 0.0, height_m))]);
        if is_grounded {
            world.ground(1);
        }
        world.command(0, velocity(0.3)).unwrap();
        (0..54).for_each(|_| world.advance());
        assert!((world.bodies()[0].at.x + 0.25).abs() < 0.02, "{world:?}");
        world.command(1, at(0.0, 0.0, 1.0).into()).unwrap();
        (0..60).for_each(|_| world.advance());
        assert_eq!(contacts(&world), [(0, 1, 0); 2], "from {height_m} m, on the ground: {is_grounded}");
        assert!(world.bodies()[0].at.x < -0.119, "{world:?}");
    }
    // The control: whoever stays up there, or on the ground, is in nobody's way.
    for is_grounded in [false, true] {
        let mut world = world([
            by_velocity(at(-1.0, 0.0, 1.0)),
            point(at(0.0, 0.0, if is_grounded { 1.0 } else { 1.5 })),
        ]);
        if is_grounded {
            world.ground(1);
        }
        world.command(0, velocity(0.3)).unwrap();
        (0..140).for_each(|_| world.advance());
        assert_eq!(contacts(&world), [(0, 0, 0); 2]);
        assert!(world.bodies()[0].at.x > 0.9, "{world:?}");
    }
}

#[test]
fn who_is_on_another_level_or_on_the_ground_is_seen_by_nobody() {
    let mut world =
        world([by_velocity(at(0.0, 0.0, 1.0)), point(at(0.5, 0.0, 1.0)), point(at(0.0, 0.5, 1.5))]);
    world.command(0, velocity(0.0)).unwrap();
    let seen = |world: &World| world.others_near(0, 2.0).collect::<Vec<_>>();
    assert_eq!(seen(&world), [Vec2::new(0.5, 0.0)]);
    world.ground(1);
    assert_eq!(seen(&world), []);
}

#[test]
fn a_command_that_a_body_does_not_take_changes_nothing_and_says_so() {
    let mut world = world([by_velocity(at(0.0, 0.0, 1.0)), point(at(1.0, 0.0, 1.0))]);
    let before = world.bodies().to_vec();
    assert_eq!(world.command(0, at(1.0, 1.0, 1.0).into()), Err(WorldError::TakesVelocities { body: 0 }));
    assert_eq!(world.command(1, velocity(0.3)), Err(WorldError::FliesToWaypoints { body: 1 }));
    assert_eq!(world.command(2, velocity(0.3)), Err(WorldError::NoBody { body: 2, count: 2 }));
    assert_eq!(world.bodies(), before);
}

/// In a mixed world, what the broad phase lets by has the bits of what goes through rapier, until something touches.
#[test]
fn until_something_touches_mixed_worlds_with_and_without_a_broad_phase_have_the_same_bits() {
    let (mut compared, mut touched) = (0, 0);
    for seed in 0..30 {
        let mut random = Seed(seed).stream(0, Source::Start);
        let mut place = || {
            let level_m = 1.0 + (2.0 * random.uniform()).floor();
            at(8.0 * random.uniform() - 4.0, 8.0 * random.uniform() - 4.0, level_m)
        };
        let places: Vec<Waypoint> = (0..24).map(|_| place()).collect();
        let starts =
            || places.iter().enumerate().map(|(i, &at)| if i % 2 == 0 { by_velocity(at) } else { point(at) });
        let both = [Solved::Near, Solved::Everybody];
        let mut worlds =
            both.map(|solved| World::with_broad_phase(hall(), MotionParams::default(), starts(), solved));
        'flight: for tick in 0..200 {
            if tick % 20 == 0 {
                for i in 0..places.len() {
                    let motion = if i % 2 == 0 {
                        let yaw_rate_radps = place().at.x / 4.0;
                        Command { forward_mps: 0.3, yaw_rate_radps, airborne: true, ..Command::default() }
                            .into()
                    } else {
                        place().into()
                    };
                    for world in &mut worlds {
                        world.command(i, motion).unwrap();
                    }
                }
            }
            worlds.iter_mut().for_each(World::advance);
            let [one, other] = &worlds;
            if other.bodies().iter().step_by(2).any(|body| body.wall_contacts + body.uav_contacts > 0) {
                touched += 1;
                break 'flight;
            }
            assert_eq!(one.bodies(), other.bodies(), "seed {seed}, tick {tick}");
            compared += 1;
        }
    }
    assert!(compared > 500 && touched > 15, "{compared} ticks, {touched} flights");
}
