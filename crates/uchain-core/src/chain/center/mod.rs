//! Centering: stay in mid-tunnel and turn with it by four diagonal ToF beams (Laclau 2021, §5).

mod firmware;

use nalgebra::{Matrix2x4, Vector2, Vector4};

use super::{Follow, Tof};
use crate::bounded;

/// Whose centering.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum CenterLaw {
    /// Eq. 20 and 21.
    #[default]
    Paper,
    /// The authors' flight firmware, branch "cavemod".
    Firmware,
}

crate::params! {
    /// Gains and limits of [`center`].
    #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
    #[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
    pub struct CenterParams {
        /// Whose centering.
        /// - Source: Laclau 2021, Eq. 20 and 21 ("paper"); the authors' firmware ("firmware")
        pub law: CenterLaw = CenterLaw::Paper;
        /// Lateral gain (1/s).
        /// - Symbol: `C_t`
        /// - Equation: `v_y = C_t (d_NW - d_NE)`
        /// - Source: Laclau 2021, Eq. 20; the value is ours
        pub c_t_per_s: f32 = 0.5, in 0.0..=20.0;
        /// Yaw gain (rad/(s·m)).
        /// - Symbol: `C_r`
        /// - Equation: `w = C_r (d_NW - d_SW) + C_r (d_SE - d_NE)`
        /// - Source: Laclau 2021, Eq. 20; the value is ours
        pub c_r_rad_per_s_m: f32 = 3.5, in 0.0..=50.0;
        /// Largest lateral speed (m/s).
        /// - Source: ours
        pub lateral_max_mps: f32 = 0.4, in 0.0..=1.0;
        /// Largest yaw rate (rad/s); the default is 60°/s.
        /// - Source: ours
        pub yaw_rate_max_radps: f32 = core::f32::consts::FRAC_PI_3, in 0.0..=20.0;
        /// Distance kept from a followed wall, along the beam (m).
        /// - Symbol: `D`
        /// - Equation: `v_y = C_t (d_NW - D)` along the left wall
        /// - Source: Laclau 2021, Eq. 21; the value is ours
        pub wall_distance_m: f32 = 0.28, in 0.0..=2.0;
        /// Difference of the two sides' front-to-rear ratios from which one wall is ignored (1).
        /// - Equation: `ratio = |d_front - d_rear| / mean`
        /// - Source: Laclau 2021, §5
        pub invalid_ratio: f32 = 0.4, in 0.0..=10.0;
        /// Leading beam at which forward speed is cut to its floor (m).
        /// - Equation: `share = clamp((d_lead - slow_from_m) / slow_over_m, slow_floor, 1)`
        /// - Source: ours
        pub slow_from_m: f32 = 0.2, in 0.0..=2.0;
        /// Length of leading beam over which forward speed recovers (m).
        /// - Equation: `share = clamp((d_lead - slow_from_m) / slow_over_m, slow_floor, 1)`
        /// - Source: ours
        pub slow_over_m: f32 = 0.3, in 0.001..=2.0;
        /// Smallest share of the forward speed that is left (1).
        /// - Equation: `share = clamp((d_lead - slow_from_m) / slow_over_m, slow_floor, 1)`
        /// - Source: ours
        pub slow_floor: f32 = 0.2, in 0.0..=1.0;
        /// Beam below which the UAV is pushed to the other side, whatever the law says (m).
        /// - Source: the authors' firmware
        pub push_below_m: f32 = 0.2, in 0.0..=2.0;
        /// Speed of that push (m/s).
        /// - Source: the authors' firmware
        pub push_mps: f32 = 0.2, in 0.0..=1.0;
        /// "firmware": lateral gain (1/s).
        /// - Source: the authors' firmware
        pub firmware_lateral_per_s: f32 = 2.0, in 0.0..=20.0;
        /// "firmware": yaw rate per relative difference of a side's beams (rad/s); the default is 30°/s.
        /// - Source: the authors' firmware
        pub firmware_yaw_radps: f32 = core::f32::consts::FRAC_PI_6, in 0.0..=20.0;
        /// "firmware": width from which the nearer wall is followed instead of centering (m).
        /// - Source: the authors' firmware
        pub firmware_wide_m: f32 = 1.0, in 0.0..=20.0;
        /// "firmware": distance kept from a followed wall (m).
        /// - Source: the authors' firmware
        pub firmware_goal_m: f32 = 0.39, in 0.0..=2.0;
    }
}

/// What centering asks for until the next distances.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Centering {
    /// Leftward speed (m/s).
    pub lateral_mps: f32,
    /// Yaw rate, counter-clockwise (rad/s).
    pub yaw_rate_radps: f32,
    /// Share of the wished forward speed that is safe, 0 to 1.
    pub speed_share: f32,
}

impl Default for Centering {
    fn default() -> Self {
        Self { lateral_mps: 0.0, yaw_rate_radps: 0.0, speed_share: 1.0 }
    }
}

/// Which walls the law steers by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Walls {
    Both,
    Left,
    Right,
}

/// Lateral speed and yaw rate that keep a UAV in mid-tunnel (Eq. 20), or along one wall where the other
/// is lost or a wall is chosen (Eq. 21). Flying `backward` it is the same law in the frame turned by
/// half a turn: the rear beams lead, the yaw rate is unchanged. A beam that is not finite, negative or
/// longer than the sensors' `range_m` counts as one that sees nothing: it reads the range (m).
///
/// ```
/// use uchain_core::chain::{CenterParams, Follow, TOF_RANGE_M, Tof, center};
/// let nearer_the_right_wall = Tof { nw_m: 0.9, ne_m: 0.5, sw_m: 0.9, se_m: 0.5 };
/// let asked = center(&nearer_the_right_wall, TOF_RANGE_M, false, Follow::Centre, &CenterParams::default());
/// assert!(asked.lateral_mps > 0.0); // to the left
/// assert_eq!(asked.yaw_rate_radps, 0.0); // aligned already
/// ```
pub fn center(tof: &Tof, range_m: f32, backward: bool, follow: Follow, params: &CenterParams) -> Centering {
    let seen = |d: f32| if d >= 0.0 { d.min(range_m) } else { range_m };
    let beams = Vector4::new(seen(tof.nw_m), seen(tof.ne_m), seen(tof.sw_m), seen(tof.se_m));
    let [nw, ne, sw, se] = beams.data.0[0];
    let (lead_left, lead_right) = if backward { (sw, se) } else { (nw, ne) };

    let (lateral, yaw_rate) = match params.law {
        CenterLaw::Paper => {
            let (law, aim) = steering(walls(nw, sw, ne, se, follow, params), backward, params);
            let wish = law * beams - aim;
            (wish.x, wish.y)
        }
        CenterLaw::Firmware => firmware::steer([nw, ne, sw, se], range_m, follow, params),
    };
    let lateral_mps = bounded(lateral, -params.lateral_max_mps, params.lateral_max_mps);
    let yaw_rate_radps = bounded(yaw_rate, -params.yaw_rate_max_radps, params.yaw_rate_max_radps);

    let nearest_ahead = lead_left.min(lead_right);
    let speed_share =
        bounded((nearest_ahead - params.slow_from_m) / params.slow_over_m, params.slow_floor, 1.0);
    let pushed_mps = push(nw.min(sw), ne.min(se), params);
    Centering { lateral_mps: pushed_mps.unwrap_or(lateral_mps), yaw_rate_radps, speed_share }
}

/// The law as a linear map of the beams (NW, NE, SW, SE), and what to subtract: rows ẏ and ω.
fn steering(walls: Walls, backward: bool, params: &CenterParams) -> (Matrix2x4<f32>, Vector2<f32>) {
    // Shares of the leading and of the trailing beams in the lateral speed.
    let (f, r) = if backward { (0.0, params.c_t_per_s) } else { (params.c_t_per_s, 0.0) };
    let c_r = params.c_r_rad_per_s_m;
    let at_wall = Vector2::new(params.c_t_per_s * params.wall_distance_m, 0.0);
    match walls {
        Walls::Both => (Matrix2x4::new(f, -f, r, -r, c_r, -c_r, -c_r, c_r), Vector2::zeros()),
        Walls::Left => (Matrix2x4::new(f, 0.0, r, 0.0, 2.0 * c_r, 0.0, -2.0 * c_r, 0.0), at_wall),
        Walls::Right => (Matrix2x4::new(0.0, -f, 0.0, -r, 0.0, -2.0 * c_r, 0.0, 2.0 * c_r), -at_wall),
    }
}

/// Wall choice: the pilot's, or the two walls unless one side's beams disagree far more than the other's.
fn walls(nw: f32, sw: f32, ne: f32, se: f32, follow: Follow, params: &CenterParams) -> Walls {
    match follow {
        Follow::Left => return Walls::Left,
        Follow::Right => return Walls::Right,
        Follow::Centre => {}
    }
    let ratio = |front: f32, rear: f32| (front - rear).abs() / (0.5 * (front + rear)).max(1.0e-6);
    let (left, right) = (ratio(nw, sw), ratio(ne, se));
    if (left - right).abs() < params.invalid_ratio {
        Walls::Both
    } else if left > right {
        Walls::Right
    } else {
        Walls::Left
    }
}

/// The lateral speed that replaces the law's where a beam on one side, and none on the other, is too short.
fn push(left_m: f32, right_m: f32, params: &CenterParams) -> Option<f32> {
    match (left_m < params.push_below_m, right_m < params.push_below_m) {
        (true, false) => Some(-params.push_mps),
        (false, true) => Some(params.push_mps),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chain::TOF_RANGE_M;

    fn tof(nw_m: f32, ne_m: f32, sw_m: f32, se_m: f32) -> Tof {
        Tof { nw_m, ne_m, sw_m, se_m }
    }

    fn forward(t: &Tof) -> Centering {
        center(t, TOF_RANGE_M, false, Follow::Centre, &CenterParams::default())
    }

    #[test]
    fn eq_20_as_printed() {
        let p = CenterParams::default();
        let c = forward(&tof(0.8, 0.7, 0.75, 0.72));
        assert!((c.lateral_mps - p.c_t_per_s * 0.1).abs() < 1e-6);
        assert!((c.yaw_rate_radps - p.c_r_rad_per_s_m * (0.05 + 0.02)).abs() < 1e-5);
    }

    #[test]
    fn where_the_right_wall_opens_the_left_one_is_followed_as_in_eq_21() {
        let p = CenterParams::default();
        let c = forward(&tof(0.5, 1.8, 0.52, 0.6));
        assert!((c.lateral_mps - p.c_t_per_s * (0.5 - 0.28)).abs() < 1e-6);
        assert!((c.yaw_rate_radps - 2.0 * p.c_r_rad_per_s_m * (0.5 - 0.52)).abs() < 1e-5);
    }

    #[test]
    fn mirrored_distances_give_the_mirrored_command() {
        for d in [(0.8, 0.7, 0.75, 0.72), (0.5, 1.8, 0.52, 0.6), (0.1, 0.5, 0.4, 0.3)] {
            let c = forward(&tof(d.0, d.1, d.2, d.3));
            let m = forward(&tof(d.1, d.0, d.3, d.2));
            assert!((c.lateral_mps + m.lateral_mps).abs() < 1e-6);
            assert!((c.yaw_rate_radps + m.yaw_rate_radps).abs() < 1e-6);
            assert_eq!(c.speed_share, m.speed_share);
        }
    }

    #[test]
    fn backward_is_the_same_law_turned_by_half_a_turn() {
        let p = CenterParams::default();
        for d in [(0.8, 0.7, 0.75, 0.72), (0.5, 1.8, 0.52, 0.6), (0.6, 0.5, 1.9, 0.55)] {
            let back = center(&tof(d.0, d.1, d.2, d.3), TOF_RANGE_M, true, Follow::Centre, &p);
            // Turned by 180°, front left is rear right, and left is right.
            let turned = forward(&tof(d.3, d.2, d.1, d.0));
            assert!((back.lateral_mps + turned.lateral_mps).abs() < 1e-6);
            assert!((back.yaw_rate_radps - turned.yaw_rate_radps).abs() < 1e-5);
            assert_eq!(back.speed_share, turned.speed_share);
        }
    }

    #[test]
    fn a_chosen_wall_is_followed_whatever_the_other_one_does() {
        let p = CenterParams::default();
        let c = center(&tof(1.0, 0.4, 1.0, 0.4), TOF_RANGE_M, false, Follow::Left, &p);
        assert!(c.lateral_mps > 0.0);
        let c = center(&tof(0.4, 1.0, 0.4, 1.0), TOF_RANGE_M, false, Follow::Right, &p);
        assert!(c.lateral_mps < 0.0);
    }

    #[test]
    fn a_short_beam_pushes_to_the_other_side_and_slows_down() {
        for (tof, backward) in [(tof(0.19, 0.5, 0.5, 0.5), false), (tof(0.5, 0.5, 0.19, 0.5), true)] {
            let c = center(&tof, TOF_RANGE_M, backward, Follow::Centre, &CenterParams::default());
            assert_eq!((c.lateral_mps, c.speed_share), (-0.2, 0.2));
        }
        // Squeezed from both sides, the law decides.
        assert_eq!(forward(&tof(0.1, 0.1, 0.5, 0.5)).lateral_mps, 0.0);
    }

    #[test]
    fn blind_it_flies_straight_on_and_rubbish_is_blindness() {
        let blind = forward(&tof(2.0, 2.0, 2.0, 2.0));
        assert_eq!(blind, Centering::default());
        let rubbish = tof(f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0);
        assert_eq!(forward(&rubbish), blind);
    }

    #[test]
    fn a_beam_that_reads_the_sensors_range_is_no_wall_whatever_the_range() {
        let ask = |open_m, range_m| {
            let seen = tof(1.0, open_m, 1.0, open_m);
            center(&seen, range_m, false, Follow::Centre, &CenterParams::default())
        };
        assert_eq!(ask(1.5, 1.5), ask(9.0, 1.5), "beyond its range a sensor sees nothing");
        assert_ne!(ask(1.5, 9.0), ask(9.0, 9.0), "within a longer range it is a wall");
    }
}
