//! Bodies in a tunnel: the only room that moves anything.

mod contact;
mod crowd;
mod fleet;
mod gate;
mod motion;
mod quadrotor;

use std::sync::Arc;

use glam::Vec2;
use uchain_core::chain::Command;

use crate::{clock::TICK_S, map::Map};
use contact::Contacts;
use crowd::Crowd;
pub use fleet::{Fleet, PointMass, Touches, Vehicle, Waypoint};
use gate::{Gate, GateMode};
pub use motion::{Body, MotionParams};
pub use quadrotor::{Quadrotor, QuadrotorParams};

/// All UAVs of a run and the walls around them.
#[derive(Debug)]
pub struct World {
    map: Arc<Map>,
    params: MotionParams,
    bodies: Vec<Body>,
    crowd: Crowd,
    contacts: Contacts,
}

impl World {
    /// UAVs on the ground at these places and headings (m, rad).
    pub fn new(map: Arc<Map>, params: MotionParams, spawns: impl Iterator<Item = (Vec2, f32)>) -> Self {
        Self::with_gate(map, params, spawns, GateMode::Near)
    }

    /// The same world with every UAV in the air going through rapier at every tick, near something or not: slow,
    /// and the measure of the other.
    pub fn ungated(map: Arc<Map>, params: MotionParams, spawns: impl Iterator<Item = (Vec2, f32)>) -> Self {
        Self::with_gate(map, params, spawns, GateMode::Open)
    }

    fn with_gate(
        map: Arc<Map>,
        params: MotionParams,
        spawns: impl Iterator<Item = (Vec2, f32)>,
        mode: GateMode,
    ) -> Self {
        let bodies: Vec<Body> = spawns.map(|(at, heading_rad)| Body::new(at, heading_rad)).collect();
        let contacts = Contacts::new(&map, &params, bodies.len(), mode);
        let crowd = Crowd::new(bodies.len(), Gate::reach_m(&params));
        let mut world = Self { map, params, bodies, crowd, contacts };
        world.crowd.sort(&world.bodies);
        world
    }

    /// The tunnel.
    pub fn map(&self) -> &Arc<Map> {
        &self.map
    }

    /// All UAVs, those on the ground included.
    pub fn bodies(&self) -> &[Body] {
        &self.bodies
    }

    /// Radius of every UAV (m).
    pub fn radius_m(&self) -> f32 {
        self.params.radius_m
    }

    /// Ticks so far in which somebody was near something, so that rapier stepped.
    pub fn solver_steps(&self) -> u64 {
        self.contacts.steps()
    }

    /// The places of all other UAVs in the air that are nearer than `reach_m` to this one (m).
    pub fn others_near(&self, uav: usize, reach_m: f32) -> impl Iterator<Item = Vec2> {
        let near = self.bodies.get(uav).map(|body| self.crowd.near(body.at, reach_m));
        near.into_iter().flatten().filter_map(move |(other, at)| (other != uav).then_some(at))
    }

    /// Turns each command into the body's velocity for the coming tick.
    pub fn act(&mut self, asked: &[Command]) {
        let mut changed = false;
        for (body, command) in self.bodies.iter_mut().zip(asked) {
            changed |= body.airborne != command.airborne;
            body.steer(command, TICK_S, &self.params);
        }
        if changed {
            self.crowd.sort(&self.bodies);
        }
    }

    /// A UAV that fails is on the ground at once: it stands, and is in nobody's way or sight.
    pub fn ground(&mut self, uav: usize) {
        if let Some(body) = self.bodies.get_mut(uav).filter(|body| body.airborne) {
            body.steer(&Command::default(), TICK_S, &self.params);
            self.crowd.sort(&self.bodies);
        }
    }

    /// One tick: free bodies glide, those within reach of a contact go through rapier.
    pub fn advance(&mut self) {
        self.contacts.advance(&self.map, &self.crowd, &mut self.bodies);
        for body in &mut self.bodies {
            body.turn(TICK_S);
        }
        self.crowd.sort(&self.bodies);
    }
}

#[cfg(test)]
mod far_tests;
#[cfg(test)]
mod gate_tests;
#[cfg(test)]
mod tests;
