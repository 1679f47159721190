//! Contacts, by rapier: walls and bodies, each body switched on only within reach of a contact.

use glam::Vec2;
use rapier2d::prelude::*;

use super::{
    crowd::Crowd,
    gate::{Gate, GateMode},
    motion::{Body, MotionParams},
};
use crate::{clock::TICK_S, map::Map};

/// How near surfaces must come to count as touching (m); rapier holds them this close.
const TOUCH_M: f32 = 0.001;
/// Sub-steps of one tick.
const SUBSTEPS: usize = 4;
/// How far they must part for the contact to be over (m).
const PART_M: f32 = 0.002;

pub(super) struct Contacts {
    physics: PhysicsWorld,
    handles: Vec<RigidBodyHandle>,
    radius_m: f32,
    gate: Gate,
    on_wall: Vec<bool>,
    /// Pairs that touch, ascending, lower index first.
    touching: Vec<(u32, u32)>,
    still_touching: Vec<(u32, u32)>,
    steps: u64,
}

impl core::fmt::Debug for Contacts {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Contacts")
            .field("gate", &self.gate)
            .field("touching", &self.touching)
            .finish_non_exhaustive()
    }
}

impl Contacts {
    pub(super) fn new(map: &Map, params: &MotionParams, count: usize, mode: GateMode) -> Self {
        let mut physics = PhysicsWorld::new();
        physics.gravity = Vec2::ZERO;
        let settings = &mut physics.integration_parameters;
        settings.dt = TICK_S;
        settings.num_solver_iterations = SUBSTEPS;
        // A UAV is 0.12 m wide: tolerances in tenths of a millimetre, and contacts foreseen as far as
        // one tick can carry a body.
        settings.normalized_allowed_linear_error = 0.0002;
        settings.normalized_prediction_distance = 0.1;
        settings.contact_recycling = false;

        if let Some(walls) = map.collider_shape() {
            physics.insert_collider(ColliderBuilder::new(walls).friction(0.0).restitution(0.0), None);
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
            gate: Gate::new(count, mode),
            on_wall: vec![false; count],
            touching: Vec::with_capacity(count),
            still_touching: Vec::with_capacity(count),
            steps: 0,
        }
    }

    /// Moves every body by one tick and counts the contacts that begin. `crowd` knows where everybody is.
    pub(super) fn advance(&mut self, map: &Map, crowd: &Crowd, bodies: &mut [Body]) {
        self.gate.look(map, crowd, bodies, self.radius_m);
        for (i, body) in bodies.iter_mut().enumerate() {
            if body.airborne && !self.gate.is_near(i) {
                let from = body.at;
                body.glide(TICK_S);
                self.gate.spend(i, body.at.distance(from));
            } else if !body.airborne {
                self.gate.forget(i);
            }
        }
        self.take_out();
        if !self.gate.near().is_empty() {
            self.solve(bodies);
        }
        self.count_walls(map, bodies);
        self.count_uavs(bodies);
    }

    /// Ticks in which rapier had anything to do.
    pub(super) fn steps(&self) -> u64 {
        self.steps
    }

    /// Takes those out of rapier who are near nothing any more.
    fn take_out(&mut self) {
        for &uav in self.gate.near_before().iter().filter(|uav| !self.gate.is_near(**uav as usize)) {
            self.on_wall[uav as usize] = false;
            if let Some(rigid) = self.physics.bodies.get_mut(self.handles[uav as usize]) {
                rigid.set_enabled(false);
            }
        }
    }

    /// Lets rapier move those who are near something.
    fn solve(&mut self, bodies: &mut [Body]) {
        for &uav in self.gate.near() {
            if let Some(rigid) = self.physics.bodies.get_mut(self.handles[uav as usize]) {
                rigid.set_enabled(true);
                rigid.set_translation(bodies[uav as usize].at, true);
                rigid.set_linvel(bodies[uav as usize].velocity_mps, true);
            }
        }
        self.physics.step();
        self.steps += 1;
        for uav in 0..self.gate.near().len() {
            let uav = self.gate.near()[uav] as usize;
            if let Some(rigid) = self.physics.bodies.get(self.handles[uav]) {
                bodies[uav].follow(rigid.translation(), rigid.linvel(), TICK_S);
            }
            self.gate.forget(uav);
        }
    }

    /// One begin-touch is one contact.
    fn count_walls(&mut self, map: &Map, bodies: &mut [Body]) {
        for &uav in self.gate.near() {
            let (body, on_wall) = (&mut bodies[uav as usize], &mut self.on_wall[uav as usize]);
            let limit_m = self.radius_m + if *on_wall { PART_M } else { TOUCH_M };
            let touches = map.clearance_m(body.at) <= limit_m;
            body.wall_contacts += u32::from(touches && !*on_wall);
            *on_wall = touches;
        }
    }

    fn count_uavs(&mut self, bodies: &mut [Body]) {
        self.still_touching.clear();
        for &pair in self.gate.pairs() {
            let (i, j) = (pair.0 as usize, pair.1 as usize);
            let touched = self.touching.binary_search(&pair).is_ok();
            let limit_m = 2.0 * self.radius_m + if touched { PART_M } else { TOUCH_M };
            if bodies[i].at.distance(bodies[j].at) <= limit_m {
                self.still_touching.push(pair);
                bodies[i].uav_contacts += u32::from(!touched);
                bodies[j].uav_contacts += u32::from(!touched);
            }
        }
        std::mem::swap(&mut self.touching, &mut self.still_touching);
    }
}
