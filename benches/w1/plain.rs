//! The baseline: rapier as it comes, every body in it all the time, rays through its query pipeline.

use core::f32::consts::{FRAC_PI_4, TAU};

use glam::Vec2;
use rapier2d::prelude::*;
use uchain_core::chain::{CenterParams, Command, Tof};
use uchain_sim::{clock::TICK_S, map::Map, world::MotionParams};

use super::{RADIUS_M, RANGE_M, Seen, command, spawns};

pub(crate) struct Plain {
    physics: PhysicsWorld,
    robots: Vec<Robot>,
    seen: Seen,
    center: CenterParams,
    motion: MotionParams,
}

struct Robot {
    body: RigidBodyHandle,
    heading_rad: f32,
    yaw_rate_radps: f32,
    command: Command,
}

impl Plain {
    pub(crate) fn new(map: &Map, count: usize, seen: Seen) -> Self {
        let mut physics = PhysicsWorld::new();
        physics.gravity = Vec2::ZERO;
        physics.integration_parameters.dt = TICK_S;
        let corners: Vec<Vec2> = map.walls().iter().flat_map(|wall| [wall.a, wall.b]).collect();
        let edges: Vec<[u32; 2]> = (0..map.walls().len() as u32).map(|i| [2 * i, 2 * i + 1]).collect();
        physics.insert_collider(ColliderBuilder::polyline(corners, Some(edges)).friction(0.0), None);
        let robots = spawns(count)
            .into_iter()
            .map(|(at, heading_rad)| {
                let body = RigidBodyBuilder::dynamic().lock_rotations().can_sleep(false).translation(at);
                let disc = ColliderBuilder::ball(RADIUS_M).friction(0.0);
                let body = physics.insert(body, disc).0;
                Robot { body, heading_rad, yaw_rate_radps: 0.0, command: Command::default() }
            })
            .collect();
        // Rays need the tree that the first step builds.
        physics.step();
        Self { physics, robots, seen, center: CenterParams::default(), motion: MotionParams::default() }
    }

    pub(crate) fn tick(&mut self) {
        for robot in &mut self.robots {
            let at = self.physics.bodies[robot.body].translation();
            let filter = match self.seen {
                Seen::Walls => QueryFilter::only_fixed(),
                Seen::Robots => QueryFilter::default().exclude_rigid_body(robot.body),
            };
            let rays = self.physics.query_pipeline_with_filter(filter);
            let beam = |mount_rad: f32| {
                let (sin, cos) = libm::sincosf(robot.heading_rad + mount_rad);
                let ray = Ray::new(at, Vec2::new(cos, sin));
                rays.cast_ray(&ray, RANGE_M, true).map_or(RANGE_M, |(_, distance_m)| distance_m)
            };
            let tof = Tof {
                nw_m: beam(FRAC_PI_4),
                ne_m: beam(-FRAC_PI_4),
                sw_m: beam(3.0 * FRAC_PI_4),
                se_m: beam(-3.0 * FRAC_PI_4),
            };
            robot.command = command(&tof, &self.center);
        }
        for robot in &mut self.robots {
            let (asked, motion) = (&robot.command, &self.motion);
            let (sin, cos) = libm::sincosf(robot.heading_rad);
            let forward = Vec2::new(cos, sin);
            let wish_mps = forward * asked.forward_mps + forward.perp() * asked.lateral_mps;
            let body = &mut self.physics.bodies[robot.body];
            let now_mps = body.linvel();
            let change = (wish_mps - now_mps) * (TICK_S / motion.velocity_lag_s);
            body.set_linvel(now_mps + change.clamp_length_max(motion.accel_max_mps2 * TICK_S), true);
            robot.yaw_rate_radps +=
                (asked.yaw_rate_radps - robot.yaw_rate_radps) * (TICK_S / motion.yaw_lag_s);
            robot.heading_rad = (robot.heading_rad + robot.yaw_rate_radps * TICK_S) % TAU;
        }
        self.physics.step();
    }
}
