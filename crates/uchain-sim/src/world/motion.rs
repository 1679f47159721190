//! How a commanded velocity becomes motion where nothing is in the way.

use core::f32::consts::{PI, TAU};

use glam::Vec2;
use uchain_core::chain::Command;

uchain_core::params! {
    /// The body of a UAV: a disc that follows velocity commands with a lag.
    #[derive(serde::Serialize, serde::Deserialize)]
    #[serde(default, deny_unknown_fields)]
    pub struct MotionParams {
        /// Radius of the disc (m).
        /// - Source: Laclau 2021, Fig. 5 (a Crazyflie is 0.12 m wide)
        pub radius_m: f32 = 0.06, in 0.01..=1.0;
        /// Time constant of the velocity's first-order lag (s).
        /// - Source: ours
        pub velocity_lag_s: f32 = 0.2, in 0.05..=10.0;
        /// Time constant of the yaw rate's first-order lag (s).
        /// - Source: ours
        pub yaw_lag_s: f32 = 0.1, in 0.05..=10.0;
        /// Largest acceleration (m/s²).
        /// - Source: ours
        pub accel_max_mps2: f32 = 2.0, in 0.01..=100.0;
    }
}

/// One UAV's state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Body {
    /// Position (m).
    pub at: Vec2,
    /// What `at` leaves of the position (m): a tick's way is less than the spacing of `f32` where coordinates are large.
    remainder_m: Vec2,
    /// Velocity in the map's frame (m/s).
    pub velocity_mps: Vec2,
    /// Direction of the body's x axis, counter-clockwise, in (−π, π] (rad).
    heading_rad: f32,
    /// Unit vector of the body's x axis: asked for many times a tick, so kept.
    forward: Vec2,
    /// Yaw rate (rad/s).
    pub yaw_rate_radps: f32,
    /// In the air. On the ground a UAV does not move and is in nobody's way.
    pub airborne: bool,
    /// Wall contacts begun so far.
    pub wall_contacts: u32,
    /// Contacts with other UAVs begun so far.
    pub uav_contacts: u32,
}

impl Body {
    /// A UAV standing on the ground.
    pub fn new(at: Vec2, heading_rad: f32) -> Self {
        let heading_rad = wrap(heading_rad);
        Self {
            at,
            remainder_m: Vec2::ZERO,
            velocity_mps: Vec2::ZERO,
            heading_rad,
            forward: unit(heading_rad),
            yaw_rate_radps: 0.0,
            airborne: false,
            wall_contacts: 0,
            uav_contacts: 0,
        }
    }

    /// Unit vector of the body's x axis.
    pub fn forward(&self) -> Vec2 {
        self.forward
    }

    /// Direction of the body's x axis, counter-clockwise, in (−π, π] (rad).
    pub fn heading_rad(&self) -> f32 {
        self.heading_rad
    }

    /// Forward speed over ground (m/s).
    pub fn forward_mps(&self) -> f32 {
        self.velocity_mps.dot(self.forward)
    }

    /// Leftward speed over ground (m/s).
    pub fn lateral_mps(&self) -> f32 {
        self.velocity_mps.dot(self.forward.perp())
    }

    /// Velocity and yaw rate follow the command with their lags, within the acceleration limit.
    pub(super) fn steer(&mut self, command: &Command, tick_s: f32, params: &MotionParams) {
        self.airborne = command.airborne;
        if !self.airborne {
            self.velocity_mps = Vec2::ZERO;
            self.yaw_rate_radps = 0.0;
            return;
        }
        let wish_mps = self.forward * command.forward_mps + self.forward.perp() * command.lateral_mps;
        let change = (wish_mps - self.velocity_mps) * (tick_s / params.velocity_lag_s);
        self.velocity_mps += change.clamp_length_max(params.accel_max_mps2 * tick_s);
        self.yaw_rate_radps += (command.yaw_rate_radps - self.yaw_rate_radps) * (tick_s / params.yaw_lag_s);
    }

    /// Moves freely for one tick. The sum is compensated (Kahan 1965): over any number of ticks it is off by one
    /// rounding, however far from the map's middle.
    pub(super) fn glide(&mut self, tick_s: f32) {
        let way_m = self.velocity_mps * tick_s + self.remainder_m;
        let at = self.at + way_m;
        self.remainder_m = way_m - (at - self.at);
        self.at = at;
    }

    /// Moves to where a solver has put the body, with the velocity the solver has left it.
    ///
    /// The solver's place is a plain sum of `f32`. Along each axis on which it is as far as that velocity carries the
    /// body, but for rounding, nothing has pushed the body there, and it glides: with the very bits of one that no
    /// solver has moved. Elsewhere the solver's place holds, and the remainder stays what it was.
    pub(super) fn follow(&mut self, at: Vec2, velocity_mps: Vec2, tick_s: f32) {
        let from = *self;
        self.velocity_mps = velocity_mps;
        self.glide(tick_s);
        let way_m = velocity_mps * tick_s;
        let rounding_m = (from.at.abs().max(at.abs()) + way_m.abs()) * (4.0 * f32::EPSILON);
        let pushed = (at - from.at - way_m).abs().cmpgt(rounding_m);
        self.at = Vec2::select(pushed, at, self.at);
        self.remainder_m = Vec2::select(pushed, from.remainder_m, self.remainder_m);
    }

    /// Turns for one tick. The heading is ours: nothing physical turns a UAV.
    pub(super) fn turn(&mut self, tick_s: f32) {
        if self.yaw_rate_radps == 0.0 {
            return;
        }
        self.heading_rad = wrap(self.heading_rad + self.yaw_rate_radps * tick_s);
        self.forward = unit(self.heading_rad);
    }
}

/// The same direction in (−π, π], for one that is off by less than a turn.
fn wrap(heading_rad: f32) -> f32 {
    if heading_rad > PI {
        heading_rad - TAU
    } else if heading_rad <= -PI {
        heading_rad + TAU
    } else {
        heading_rad
    }
}

fn unit(heading_rad: f32) -> Vec2 {
    let (sin, cos) = libm::sincosf(heading_rad);
    Vec2::new(cos, sin)
}
