//! Contacts, by rapier: walls and bodies, each body switched on only within reach of a contact.

use glam::Vec2;
use rapier2d::prelude::*;

use super::motion::{Body, MotionParams, SUBSTEPS};
use crate::{map::Map, record::TICK_S};

/// How near surfaces must come to count as touching (m); rapier holds them this close.
const TOUCH_M: f32 = 0.001;
/// How far they must part for the contact to be over (m).
const PART_M: f32 = 0.002;
/// Slack of "within reach" over what one tick's motion can close (m).
const REACH_SLACK_M: f32 = 0.01;

pub(super) struct Contacts {
    physics: PhysicsWorld,
    handles: Vec<RigidBodyHandle>,
    radius_m: f32,
    near: Vec<bool>,
    on_wall: Vec<bool>,
    touching: Vec<(u32, u32)>,
    still_touching: Vec<(u32, u32)>,
}

impl core::fmt::Debug for Contacts {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Contacts")
            .field("near", &self.near)
            .field("touching", &self.touching)
            .finish_non_exhaustive()
    }
}

impl Contacts {
    pub(super) fn new(map: &Map, params: &MotionParams, count: usize) -> Self {
        let mut physics = PhysicsWorld::new();
        physics.gravity = Vec2::ZERO;
        let settings = &mut physics.integration_parameters;
        settings.dt = TICK_S;
        settings.num_solver_iterations = SUBSTEPS as usize;
        // A UAV is 0.12 m wide: tolerances in tenths of a millimetre, and contacts foreseen as far as
        // one tick can carry a body.
        settings.normalized_allowed_linear_error = 0.0002;
        settings.normalized_prediction_distance = 0.1;
        settings.contact_recycling = false;

        let corners: Vec<Vec2> = map.walls().iter().flat_map(|wall| [wall.a, wall.b]).collect();
        let edges: Vec<[u32; 2]> = (0..map.walls().len() as u32).map(|i| [2 * i, 2 * i + 1]).collect();
        if !edges.is_empty() {
            physics.insert_collider(
                ColliderBuilder::polyline(corners, Some(edges)).friction(0.0).restitution(0.0),
                None,
            );
        }
        let handles = (0..count)
            .map(|_| {
                let body = RigidBodyBuilder::dynamic().lock_rotations().can_sleep(false).enabled(false);
                let disc = ColliderBuilder::ball(params.radius_m).friction(0.0).restitution(0.0);
                physics.insert(body, disc).0
            })
            .collect();
        Self {
            physics,
            handles,
            radius_m: params.radius_m,
            near: vec![false; count],
            on_wall: vec![false; count],
            touching: Vec::new(),
            still_touching: Vec::new(),
        }
    }

    /// Moves every body by one tick and counts the contacts that begin.
    pub(super) fn advance(&mut self, map: &Map, bodies: &mut [Body]) {
        self.find_near(map, bodies);
        let mut any = false;
        for (i, body) in bodies.iter_mut().enumerate() {
            self.switch(i, body);
            any |= self.near[i];
            if body.airborne && !self.near[i] {
                body.glide(TICK_S);
            }
        }
        if any {
            self.physics.step();
            for (i, body) in bodies.iter_mut().enumerate().filter(|(i, _)| self.near[*i]) {
                if let Some(rigid) = self.physics.bodies.get(self.handles[i]) {
                    body.at = rigid.translation();
                    body.velocity_mps = rigid.linvel();
                }
            }
        }
        self.count(map, bodies);
    }

    /// Who could touch something within the coming tick.
    fn find_near(&mut self, map: &Map, bodies: &[Body]) {
        self.near.fill(false);
        for (i, body) in bodies.iter().enumerate().filter(|(_, b)| b.airborne) {
            let stride_m = body.velocity_mps.length() * TICK_S;
            self.near[i] |= map.clearance_m(body.at) < self.radius_m + stride_m + REACH_SLACK_M;
            for (j, other) in bodies.iter().enumerate().skip(i + 1).filter(|(_, b)| b.airborne) {
                let reach_m =
                    2.0 * self.radius_m + stride_m + other.velocity_mps.length() * TICK_S + REACH_SLACK_M;
                if body.at.distance_squared(other.at) < reach_m * reach_m {
                    self.near[i] = true;
                    self.near[j] = true;
                }
            }
        }
    }

    /// Hands a near body to rapier, takes a far one out of it.
    fn switch(&mut self, i: usize, body: &Body) {
        let Some(rigid) = self.physics.bodies.get_mut(self.handles[i]) else { return };
        if self.near[i] {
            rigid.set_enabled(true);
            rigid.set_translation(body.at, true);
            rigid.set_linvel(body.velocity_mps, true);
        } else if rigid.is_enabled() {
            rigid.set_enabled(false);
        }
    }

    /// One begin-touch is one contact; walls and UAVs apart.
    fn count(&mut self, map: &Map, bodies: &mut [Body]) {
        for (i, body) in bodies.iter_mut().enumerate() {
            let limit_m = self.radius_m + if self.on_wall[i] { PART_M } else { TOUCH_M };
            let touches = self.near[i] && map.clearance_m(body.at) <= limit_m;
            body.wall_contacts += u32::from(touches && !self.on_wall[i]);
            self.on_wall[i] = touches;
        }
        self.still_touching.clear();
        for i in 0..bodies.len() {
            for j in (i + 1..bodies.len()).filter(|j| self.near[i] && self.near[*j]) {
                let pair = (i as u32, j as u32);
                let touched = self.touching.contains(&pair);
                let limit_m = 2.0 * self.radius_m + if touched { PART_M } else { TOUCH_M };
                if bodies[i].at.distance(bodies[j].at) <= limit_m {
                    self.still_touching.push(pair);
                    if !touched {
                        bodies[i].uav_contacts += 1;
                        bodies[j].uav_contacts += 1;
                    }
                }
            }
        }
        std::mem::swap(&mut self.touching, &mut self.still_touching);
    }
}
