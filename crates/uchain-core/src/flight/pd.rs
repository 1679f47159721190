//! The PD law, and the go-to loop above it.

use super::{
    Demand, FlightState, GRAVITY_MPS2, QuadrotorParams, turn_rad,
    vector::{add, cross, less, no_longer, normalized, scaled},
};
use crate::bounded;

/// Least cosine of a tilt that thrust makes up for.
const COS_MIN: f32 = 0.3;

/// Gains on an error and on its rate: `u = k_p e + k_d ė` (Kim 2021, §7.1).
#[derive(Debug, Clone, Copy)]
struct Pd {
    per_s2: f32,
    per_s: f32,
}

/// The law with its gains. In Kim 2021, §7.1, each of roll φ, pitch θ, yaw ψ and height z is led by its own PD loop,
///
/// ```text
/// φ̈ = k_p,φ (φ_d − φ) + k_d,φ (φ̇_d − φ̇),   and so for θ, ψ and z.
/// ```
///
/// The tilt (`φ_d`, `θ_d`) is what a go-to loop of ours asks for: speed over ground in proportion to the distance to go,
/// acceleration in proportion to the error of that speed, each within its limit. Yaw and climb are held within limits too.
#[derive(Debug, Clone)]
pub struct PdLaw {
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

impl PdLaw {
    /// The law for a quadrotor with its greatest speeds over ground and of climb (m/s).
    pub fn new(params: &QuadrotorParams, v_mps: f32, climb_mps: f32) -> Self {
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

    /// What is asked to come to the origin, and to a heading (rad). It is asked again `step_s` later (s).
    ///
    /// PD loops on roll and pitch follow the tilt that the go-to loop asks for *and its rate*: with the published gains
    /// and no rate, roll and pitch lag by a third of a second, and the go-to loop swings. The error is the turn from
    /// the body's axis to the axis asked for, so that a change of heading disturbs neither.
    // Asked 200 times per second and robot by another crate.
    #[inline]
    pub fn demand(&self, state: &FlightState, heading_rad: f32, step_s: f32) -> Demand {
        let FlightState { at_m: [x_m, y_m, z_m], velocity_mps: [vx_mps, vy_mps, climb_mps], .. } = *state;
        let up = state.attitude.turned([0.0, 0.0, 1.0]);
        let [up_x, up_y, up_z] = up;
        let level_mps2 = scaled([up_x, up_y], GRAVITY_MPS2 / up_z.max(COS_MIN));
        let (at_m, velocity_mps) = ([x_m, y_m], [vx_mps, vy_mps]);
        let [now, soon] = [0.0, step_s].map(|in_s| {
            let at_m = add(at_m, scaled(velocity_mps, in_s));
            let [x_mps2, y_mps2] = self.go_to(at_m, add(velocity_mps, scaled(level_mps2, in_s)));
            normalized([x_mps2, y_mps2, GRAVITY_MPS2])
        });
        let to_body = state.attitude.inverse();
        let [roll, pitch, _] = to_body.turned(cross(up, now));
        let asked = to_body.turned(cross(now, less(soon, now)));
        let [roll_radps, pitch_radps, _] = asked.map(|turn_rad| turn_rad / step_s);
        let [x_radps, y_radps, z_radps] = state.rates_radps;
        let [_, _, yaw_radps] = state.attitude.turned(state.rates_radps);
        let yaw_rad = turn_rad(state.attitude.heading_rad(), heading_rad);
        let climb_mps2 = self.height.approach(-z_m, climb_mps, self.climb_mps);
        Demand {
            lift_mps2: ((GRAVITY_MPS2 + climb_mps2) / up_z.max(COS_MIN)).max(0.0),
            // What is asked for stands still in the world, and turns in the body's axes.
            turn_radps2: [
                self.roll.follow(roll, roll_radps - x_radps) + z_radps * pitch_radps,
                self.pitch.follow(pitch, pitch_radps - y_radps) - z_radps * roll_radps,
                self.yaw.approach(yaw_rad, yaw_radps, self.yaw_max_radps),
            ],
        }
    }

    /// Acceleration over ground towards the origin (m/s²).
    #[inline]
    fn go_to(&self, at_m: [f32; 2], velocity_mps: [f32; 2]) -> [f32; 2] {
        let wish_mps = no_longer(scaled(at_m, -self.go_to_per_s), self.v_mps);
        no_longer(scaled(less(wish_mps, velocity_mps), self.speed_per_s), self.level_max_mps2)
    }
}
