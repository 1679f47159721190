//! Bodies under velocity commands: a lag, an integrator, and rapier where something is in the way.

mod broad_phase;
#[cfg(test)]
mod broad_phase_tests;
mod contact;

use glam::Vec2;
use uchain_core::chain::Command;

use super::{Body, neighbours::NeighbourGrid};
pub(super) use broad_phase::{BroadPhase, Solved};
pub(super) use contact::Contacts;

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

impl Body {
    /// Velocity and yaw rate follow the command with their lags, within the acceleration limit.
    pub(super) fn steer(&mut self, command: &Command, tick_s: f32, params: &MotionParams) {
        if !self.airborne || self.kinematic {
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
}
