//! How a quadrotor is flown: PD loops on roll, pitch, height and yaw (Kim 2021, §7.1), led by a go-to loop.
//!
//! Axes of the body: x to the front, y to the left, z up.
//!
//! ```
//! use uchain_core::flight::{Attitude, FlightState, GRAVITY_MPS2, PdLaw, QuadrotorParams};
//! let law = PdLaw::new(&QuadrotorParams::default(), 0.5, 0.5);
//! let there = FlightState { attitude: Attitude::level(0.0), ..FlightState::default() };
//! assert_eq!(law.demand(&there, 0.0, 0.005).lift_mps2, GRAVITY_MPS2);
//! let too_low = FlightState { at_m: [0.0, 0.0, -0.1], ..there };
//! assert!(law.demand(&too_low, 0.0, 0.005).lift_mps2 > GRAVITY_MPS2);
//! ```

mod params;
mod pd;
mod vector;

use core::f32::consts::{PI, TAU};

pub use params::QuadrotorParams;
pub use pd::PdLaw;
use vector::{add, cross, dot, scaled};

/// Standard gravity (m/s²).
pub const GRAVITY_MPS2: f32 = 9.806_65;

/// How a body is turned: a unit quaternion that takes its axes to the world's.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Attitude {
    /// Vector part: axis times the sine of half the angle (1).
    pub xyz: [f32; 3],
    /// Scalar part: cosine of half the angle (1).
    pub w: f32,
}

/// What the law knows of its quadrotor.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FlightState {
    /// Place, counted from where it is to be (m).
    pub at_m: [f32; 3],
    /// Velocity in the world (m/s).
    pub velocity_mps: [f32; 3],
    /// How it is turned.
    pub attitude: Attitude,
    /// Rates about the body's axes (rad/s).
    pub rates_radps: [f32; 3],
}

/// What the law asks of an airframe.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Demand {
    /// Acceleration along the body's z axis, gravity not taken off (m/s²); at least 0.
    pub lift_mps2: f32,
    /// Angular acceleration about the body's axes (rad/s²).
    pub turn_radps2: [f32; 3],
}

impl Default for Attitude {
    fn default() -> Self {
        Self { xyz: [0.0; 3], w: 1.0 }
    }
}

impl Attitude {
    /// Upright, with its front in this direction, counter-clockwise from the world's x axis (rad).
    pub fn level(heading_rad: f32) -> Self {
        let (sin, cos) = libm::sincosf(heading_rad / 2.0);
        Self { xyz: [0.0, 0.0, sin], w: cos }
    }

    /// The other way round: takes the world's axes to the body's.
    #[must_use]
    #[inline]
    pub fn inverse(self) -> Self {
        Self { xyz: self.xyz.map(|part| -part), w: self.w }
    }

    /// A vector of the body as the world has it.
    #[inline]
    pub fn turned(self, vector: [f32; 3]) -> [f32; 3] {
        let Self { xyz, w } = self;
        let along = scaled(vector, w * w - dot(xyz, xyz));
        let across = scaled(xyz, dot(vector, xyz) * 2.0);
        add(add(along, across), scaled(cross(xyz, vector), w * 2.0))
    }

    /// Where the body's x axis points to, counter-clockwise from the world's (rad).
    #[inline]
    pub fn heading_rad(self) -> f32 {
        let Self { xyz: [x, y, z], w } = self;
        libm::atan2f(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))
    }
}

/// The turn from one heading to another, the short way round: in [−π, π) (rad).
#[inline]
pub fn turn_rad(from_rad: f32, to_rad: f32) -> f32 {
    let turn = to_rad - from_rad;
    turn - TAU * libm::floorf((turn + PI) / TAU)
}

#[cfg(test)]
mod tests;
