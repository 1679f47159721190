//! A quadrotor with six degrees of freedom under a PD law (Kim 2021, §7.1).

mod airframe;
#[cfg(test)]
mod tests;

use glam::Vec3;
pub use uchain_core::flight::QuadrotorParams;
use uchain_core::flight::{PdLaw, turn_rad};

use super::{Vehicle, Waypoint};
use crate::clock::TICK_S;
use airframe::{Airframe, State};

/// Steps of one tick. The fastest pole of the published gains, 20.7 per second, is a tenth of what they can hold.
const SUBSTEPS: u32 = 10;
const STEP_S: f32 = TICK_S / SUBSTEPS as f32;

/// A quadrotor that flies to where it is told, and hovers there.
///
/// There is neither wind nor a floor, and no robot feels the downwash of another one.
#[derive(Debug, Clone)]
pub struct Quadrotor {
    airframe: Airframe,
    law: PdLaw,
    /// Its place is counted from where it is to be, so that a millimetre counts anywhere on a large map.
    state: State,
    to: Waypoint,
    near: Near,
    snap: bool,
}

/// What counts as being there.
#[derive(Debug, Clone, Copy)]
struct Near {
    m: f32,
    mps: f32,
    rad: f32,
}

impl Quadrotor {
    /// A quadrotor that hovers, with its greatest speeds over ground and of climb (m/s).
    pub fn new(at: Waypoint, params: &QuadrotorParams, v_mps: f32, climb_mps: f32) -> Self {
        Self {
            airframe: Airframe::new(params),
            law: PdLaw::new(params, v_mps, climb_mps),
            state: State::hovering(at.heading_rad),
            to: at,
            near: Near { m: params.arrive_m, mps: params.arrive_mps, rad: params.arrive_deg.to_radians() },
            snap: params.snap,
        }
    }
}

impl Vehicle for Quadrotor {
    fn place(&mut self, at: Waypoint) {
        (self.state, self.to) = (State::hovering(at.heading_rad), at);
    }

    fn fly_to(&mut self, to: Waypoint) {
        self.state.move_by((self.to.at - to.at).extend(self.to.z_m - to.z_m));
        self.to = to;
    }

    fn advance(&mut self) {
        for _ in 0..SUBSTEPS {
            let asked = self.law.demand(&self.state.known(), self.to.heading_rad, STEP_S);
            let rotors_n = self.airframe.rotors_n(&asked);
            self.state.step(&self.airframe, &rotors_n, STEP_S);
        }
    }

    fn now(&self) -> Waypoint {
        let Vec3 { x, y, z } = self.state.at_m;
        Waypoint {
            at: self.to.at + glam::Vec2::new(x, y),
            z_m: self.to.z_m + z,
            heading_rad: self.state.heading_rad(),
        }
    }

    fn has_arrived(&self) -> bool {
        let Near { m, mps, rad } = self.near;
        let turn_rad = turn_rad(self.state.heading_rad(), self.to.heading_rad);
        self.state.at_m.length_squared() <= m * m
            && self.state.velocity_mps.length_squared() <= mps * mps
            && turn_rad.abs() <= rad
    }

    fn stands(&self) -> Waypoint {
        if self.snap { self.to } else { self.now() }
    }
}
