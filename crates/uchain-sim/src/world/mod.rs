//! Bodies in a tunnel: the only room that moves anything.

mod contact;
mod fleet;
mod motion;

use glam::Vec2;
use uchain_core::chain::Command;

use crate::{map::Map, record::TICK_S};
use contact::Contacts;
pub use fleet::{Fleet, PointMass, Touches, Vehicle, Waypoint};
pub use motion::{Body, MotionParams};

/// All UAVs of a run and the walls around them.
#[derive(Debug)]
pub struct World<'a> {
    map: &'a Map,
    params: MotionParams,
    bodies: Vec<Body>,
    contacts: Contacts,
}

impl<'a> World<'a> {
    /// UAVs on the ground at these places and headings (m, rad).
    pub fn new(map: &'a Map, params: MotionParams, spawns: impl Iterator<Item = (Vec2, f32)>) -> Self {
        let bodies: Vec<Body> = spawns.map(|(at, heading_rad)| Body::new(at, heading_rad)).collect();
        let contacts = Contacts::new(map, &params, bodies.len());
        Self { map, params, bodies, contacts }
    }

    /// The tunnel.
    pub fn map(&self) -> &'a Map {
        self.map
    }

    /// All UAVs, those on the ground included.
    pub fn bodies(&self) -> &[Body] {
        &self.bodies
    }

    /// Radius of every UAV (m).
    pub fn radius_m(&self) -> f32 {
        self.params.radius_m
    }

    /// Turns each command into the body's velocity for the coming tick.
    pub fn act(&mut self, asked: &[Command]) {
        for (body, command) in self.bodies.iter_mut().zip(asked) {
            body.steer(command, TICK_S, &self.params);
        }
    }

    /// One tick: free bodies glide, those within reach of a contact go through rapier.
    pub fn advance(&mut self) {
        self.contacts.advance(self.map, &mut self.bodies);
        for body in &mut self.bodies {
            body.turn(TICK_S);
        }
    }
}

#[cfg(test)]
mod tests;
