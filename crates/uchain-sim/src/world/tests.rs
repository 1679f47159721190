use glam::Vec2;
use rapier2d::prelude::{ColliderBuilder, PhysicsWorld, RigidBodyBuilder};
use uchain_core::chain::Command;

use super::*;
use crate::{
    map::{Map, Vertex, corridor},
    seed::{Seed, Source},
};

fn straight(width_m: f64) -> Arc<Map> {
    let vertex = |x| Vertex { x, y: 0.0, bend_radius_m: 0.0 };
    corridor(&[vertex(0.0), vertex(10.0)], width_m, false).unwrap().0.into()
}

/// Heading east.
fn at_rest(at: Vec2) -> Body {
    Body::new(Waypoint { at, z_m: 0.0, heading_rad: 0.0 }, false)
}

fn fly(world: &mut World, asked: &[Command], ticks: usize) {
    for _ in 0..ticks {
        world.act(asked);
        world.advance();
    }
}

fn ahead(forward_mps: f32) -> Command {
    Command { forward_mps, airborne: true, ..Command::default() }
}

#[test]
fn a_uav_flown_into_a_wall_is_stopped_at_its_radius_and_counts_one_contact() {
    let map = straight(1.0);
    for (heading, speed) in [(0.3_f32, 0.3), (1.57, 0.05), (1.57, 0.5), (-0.8, 1.0), (-1.57, 0.3)] {
        let mut world = World::new(map.clone(), MotionParams::default(), [(Vec2::new(2.0, 0.0), heading)]);
        for _ in 0..400 {
            fly(&mut world, &[ahead(speed)], 1);
            let gap_mm = (map.clearance_m(world.bodies()[0].at) - 0.06) * 1000.0;
            assert!(gap_mm > -1.0, "{gap_mm} mm at heading {heading}, {speed} m/s");
        }
        let body = world.bodies()[0];
        let gap_mm = (map.clearance_m(body.at) - 0.06) * 1000.0;
        assert!(gap_mm.abs() < 1.0, "rests {gap_mm} mm from the wall at heading {heading}, {speed} m/s");
        assert_eq!((body.wall_contacts, body.uav_contacts), (1, 0), "heading {heading}, {speed} m/s");
    }
}

#[test]
fn touching_leaving_and_touching_again_are_two_contacts() {
    let map = straight(1.0);
    let spawn = (Vec2::new(2.0, 0.0), core::f32::consts::FRAC_PI_2);
    let mut world = World::new(map.clone(), MotionParams::default(), [spawn]);
    for _ in 0..2 {
        fly(&mut world, &[ahead(0.3)], 60);
        fly(&mut world, &[ahead(-0.3)], 20);
    }
    assert_eq!(world.bodies()[0].wall_contacts, 2);
}

#[test]
fn uavs_cannot_pass_through_one_another() {
    // Too narrow for two abreast.
    let map = straight(0.2);
    let spawns = [(Vec2::new(4.0, 0.0), core::f32::consts::PI), (Vec2::new(2.0, 0.0), 0.0)];
    let mut world = World::new(map.clone(), MotionParams::default(), spawns);
    for _ in 0..400 {
        fly(&mut world, &[ahead(0.3), ahead(0.3)], 1);
        let apart_m = world.bodies()[0].at.distance(world.bodies()[1].at);
        assert!(apart_m > 0.119, "{apart_m} m apart");
    }
    let [a, b] = [world.bodies()[0], world.bodies()[1]];
    assert!(a.at.x > b.at.x, "{} and {}", a.at, b.at);
    assert_eq!((a.uav_contacts, b.uav_contacts), (1, 1));
}

#[test]
fn a_uav_on_the_ground_neither_moves_nor_blocks() {
    let map = straight(1.0);
    let spawns = [(Vec2::new(2.0, 0.0), 0.0), (Vec2::new(3.0, 0.0), 0.0)];
    let mut world = World::new(map.clone(), MotionParams::default(), spawns);
    fly(&mut world, &[ahead(0.3), Command { forward_mps: 0.3, ..Command::default() }], 200);
    assert!(world.bodies()[0].at.x > 4.0);
    assert_eq!(world.bodies()[1].at, Vec2::new(3.0, 0.0));
    assert_eq!(world.bodies()[0].uav_contacts, 0);
}

#[test]
fn a_free_body_that_went_through_rapier_has_the_very_bits_of_one_that_glides() {
    let mut random = Seed(3).stream(0, Source::Start);
    for far_m in [0.0, 10.0, 1e3, 1e5] {
        let mut moved_otherwise = 0;
        for _ in 0..200 {
            let mut physics = PhysicsWorld::new();
            physics.gravity = Vec2::ZERO;
            physics.integration_parameters.dt = TICK_S;
            let at = Vec2::new(far_m * random.normal(), far_m * random.normal());
            let body = RigidBodyBuilder::dynamic().lock_rotations().can_sleep(false).translation(at);
            let (handle, _) = physics.insert(body, ColliderBuilder::ball(0.06));
            let (mut ours, mut through) = (at_rest(at), at_rest(at));
            for _ in 0..20 {
                ours.velocity_mps = Vec2::new(0.3 * random.normal(), 0.3 * random.normal());
                physics.bodies[handle].set_translation(through.at, true);
                physics.bodies[handle].set_linvel(ours.velocity_mps, true);
                physics.step();
                ours.glide(TICK_S);
                let there = physics.bodies[handle].translation();
                through.follow(there, physics.bodies[handle].linvel(), TICK_S);
                assert_eq!(through, ours, "{far_m} m");
                moved_otherwise += u32::from(there != ours.at);
            }
        }
        // Rapier's own sum is another one: without `follow` the bits would differ.
        assert!(moved_otherwise > 100, "{far_m} m: {moved_otherwise}");
    }
}

#[test]
fn what_pushes_a_body_along_one_axis_leaves_its_way_along_the_other() {
    let (at, velocity_mps) = (Vec2::new(9e4, -7.0), Vec2::new(0.1, 0.0));
    let mut body = at_rest(at);
    for _ in 0..1000 {
        // A plain sum stands still along x, and is pushed along y.
        body.follow(Vec2::new(body.at.x, body.at.y + 0.001), velocity_mps, TICK_S);
    }
    assert!((body.at.x - at.x - 5.0).abs() < 0.005, "{}", body.at.x - at.x);
    assert!((body.at.y - at.y - 1.0).abs() < 1e-3, "{}", body.at.y);
}

#[test]
fn velocity_follows_its_command_with_the_lag_and_within_the_acceleration_limit() {
    let map = straight(3.0);
    let spawn = (Vec2::new(1.0, 0.0), 0.0);
    let mut world = World::new(map.clone(), MotionParams::default(), [spawn]);
    let mut last_mps = 0.0;
    for _ in 0..40 {
        fly(&mut world, &[ahead(1.0)], 1);
        let now_mps = world.bodies()[0].forward_mps();
        assert!(now_mps - last_mps <= 2.0 * TICK_S + 1e-6);
        last_mps = now_mps;
    }
    assert!((last_mps - 1.0).abs() < 0.01, "{last_mps}");
}

#[test]
fn a_world_owns_its_map_and_flies_on_another_thread() {
    let (map, spawn) = (straight(1.0), (Vec2::new(1.0, 0.0), 0.0));
    let mut here = World::new(map.clone(), MotionParams::default(), [spawn]);
    let mut there = World::new(map, MotionParams::default(), [spawn]);
    let flown = std::thread::spawn(move || {
        fly(&mut there, &[ahead(0.3)], 40);
        there.bodies()[0]
    });
    fly(&mut here, &[ahead(0.3)], 40);
    assert_eq!(flown.join().unwrap(), here.bodies()[0]);
    assert_ne!(here.bodies()[0].at, spawn.0);
}
