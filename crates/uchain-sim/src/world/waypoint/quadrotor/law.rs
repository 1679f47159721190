//! How a quadrotor is flown: a go-to loop asks for tilt and heading, PD loops turn the body to them.

use core::f32::consts::{PI, TAU};

use glam::{Vec2, Vec3};
use uchain_core::bounded;

use super::{
    QuadrotorParams,
    airframe::{Asked, GRAVITY_MPS2, State},
};

/// Least cosine of a tilt that thrust makes up for.
const COS_MIN: f32 = 0.3;

/// Gains on an error and on its rate.
#[derive(Debug, Clone, Copy)]
struct Pd {
    per_s2: f32,
    per_s: f32,
}

/// The law with its gains.
#[derive(Debug, Clone)]
pub(super) struct Law {
    roll: Pd,
    pitch: Pd,
    height: Pd,
    yaw: Pd,
    go_to_per_s: f32,
    speed_per_s: f32,
    v_mps: f32,
    climb_mps: f32,
    yaw_max_radps: f32,
    /// Greatest acceleration over ground (m/s²): the tangent of the greatest tilt, times gravity.
    level_max_mps2: f32,
}

impl Pd {
    fn follow(self, error: f32, rate_error: f32) -> f32 {
        self.per_s2 * error + self.per_s * rate_error
    }

    /// The same for a set-point at rest, with the rate held within a limit. Far from it, the rate is the limit.
    fn approach(self, error: f32, rate: f32, limit: f32) -> f32 {
        self.per_s * (bounded(self.per_s2 / self.per_s * error, -limit, limit) - rate)
    }
}

impl Law {
    pub(super) fn new(params: &QuadrotorParams, v_mps: f32, climb_mps: f32) -> Self {
        Self {
            roll: Pd { per_s2: params.roll_p_per_s2, per_s: params.roll_d_per_s },
            pitch: Pd { per_s2: params.pitch_p_per_s2, per_s: params.pitch_d_per_s },
            height: Pd { per_s2: params.height_p_per_s2, per_s: params.height_d_per_s },
            yaw: Pd { per_s2: params.yaw_p_per_s2, per_s: params.yaw_d_per_s },
            go_to_per_s: params.go_to_per_s,
            speed_per_s: params.speed_per_s,
            v_mps,
            climb_mps,
            yaw_max_radps: params.yaw_max_radps,
            level_max_mps2: GRAVITY_MPS2 * libm::tanf(params.tilt_max_deg.to_radians()),
        }
    }

    /// What is asked to come to the origin, and to a heading.
    ///
    /// PD loops on roll and pitch follow the tilt that the go-to loop asks for *and its rate*: with the published gains
    /// and no rate, roll and pitch lag by a third of a second, and the go-to loop swings. The error is the turn from
    /// the body's axis to the axis asked for, so that a change of heading disturbs neither.
    pub(super) fn fly(&self, state: &State, heading_rad: f32, step_s: f32) -> Asked {
        let up = state.up();
        let level_mps2 = up.truncate() * (GRAVITY_MPS2 / up.z.max(COS_MIN));
        let (at_m, velocity_mps) = (state.at_m.truncate(), state.velocity_mps.truncate());
        let [now, soon] = [0.0, step_s].map(|in_s| {
            let asked_mps2 = self.go_to(at_m + velocity_mps * in_s, velocity_mps + level_mps2 * in_s);
            asked_mps2.extend(GRAVITY_MPS2).normalize()
        });
        let to_body = state.attitude.inverse();
        let error = to_body * up.cross(now);
        let asked_radps = to_body * now.cross(soon - now) / step_s;
        let rates = state.rates_radps;
        let yaw_radps = (state.attitude * rates).z;
        let climb = self.height.approach(-state.at_m.z, state.velocity_mps.z, self.climb_mps);
        Asked {
            lift_mps2: ((GRAVITY_MPS2 + climb) / up.z.max(COS_MIN)).max(0.0),
            // What is asked for stands still in the world, and turns in the body's axes.
            turn_radps2: Vec3::new(
                self.roll.follow(error.x, asked_radps.x - rates.x) + rates.z * asked_radps.y,
                self.pitch.follow(error.y, asked_radps.y - rates.y) - rates.z * asked_radps.x,
                self.yaw.approach(turn_rad(state.heading_rad(), heading_rad), yaw_radps, self.yaw_max_radps),
            ),
        }
    }

    /// Acceleration over ground towards the origin (m/s²).
    fn go_to(&self, at_m: Vec2, velocity_mps: Vec2) -> Vec2 {
        let wish_mps = (at_m * -self.go_to_per_s).clamp_length_max(self.v_mps);
        ((wish_mps - velocity_mps) * self.speed_per_s).clamp_length_max(self.level_max_mps2)
    }
}

/// The turn from one heading to another, the short way round (rad).
pub(super) fn turn_rad(from_rad: f32, to_rad: f32) -> f32 {
    let turn = to_rad - from_rad;
    turn - TAU * ((turn + PI) / TAU).floor()
}
