//! Centering: stay in mid-tunnel and turn with it by four diagonal ToF beams (Laclau 2021, §5).

mod firmware;
mod paper;
mod wall;

use super::{Follow, Tof, WallSide};
use crate::{bounded, smaller};

/// Whose centering.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum CenterLaw {
    /// Both walls by Eq. 20 while they run alike, else along the nearer one, and away from a wall ahead.
    #[default]
    Wall,
    /// Eq. 20 and 21 as printed.
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
        /// - Source: "paper": Laclau 2021, Eq. 20 and 21; "firmware": the authors' firmware; "wall": Eq. 20, the rest is ours
        pub law: CenterLaw = CenterLaw::Wall;
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
        /// "paper": distance kept from a followed wall, along the beam (m).
        /// - Symbol: `D`
        /// - Equation: `v_y = C_t (d_NW - D)` along the left wall
        /// - Source: Laclau 2021, Eq. 21; the value is ours
        pub wall_distance_m: f32 = 0.28, in 0.0..=2.0;
        /// "wall" and "paper": difference of the two sides' front-to-rear ratios from which one wall is ignored (1).
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
        /// "wall": share of the trailing beam below which a side's leading beam counts as closed; with both
        /// sides closed there is a wall ahead, and the UAV turns away from the nearer side (1).
        /// - Equation: `d_lead < closed_share d_trail`
        /// - Source: ours; no head of 1,000 gets stuck in `corner` or `circuit` from 0.5 to 0.9
        pub closed_share: f32 = 0.7, in 0.0..=1.0;
        /// "wall": largest distance kept from a followed wall, by the nearer of its two beams (m).
        /// - Equation: `D = min(follow_distance_m, (m + o) / 2)`, m and o the nearest beams of the wall's and of the other side
        /// - Source: ours
        pub follow_distance_m: f32 = 0.45, in 0.0..=2.0;
        /// "wall": lateral gain along a followed wall (1/s).
        /// - Equation: `v_y = follow_lateral_per_s (m - D)` along the left wall
        /// - Source: ours
        pub follow_lateral_per_s: f32 = 1.0, in 0.0..=20.0;
        /// "wall": largest lateral speed along a followed wall (m/s).
        /// - Source: ours
        pub follow_lateral_max_mps: f32 = 0.25, in 0.0..=1.0;
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
pub enum Walls {
    /// It keeps to the middle (Laclau 2021, Eq. 20).
    Both,
    /// It runs along the left one (Eq. 21).
    Left,
    /// It runs along the right one (Eq. 21).
    Right,
}

impl Walls {
    /// In a word, for people and programs.
    pub fn word(self) -> &'static str {
        match self {
            Self::Both => "both",
            Self::Left => "left",
            Self::Right => "right",
        }
    }
}

/// Lateral speed and yaw rate that keep a UAV in mid-tunnel (Eq. 20), or along one wall where the other
/// is lost or a wall is chosen (Eq. 21, or the default law's wall following). Flying `backward` it is the
/// same law in the frame turned by half a turn: the rear beams lead, the yaw rate is unchanged. A beam that
/// is not finite, negative or longer than the sensors' `range_m` counts as one that sees nothing: it reads
/// the range (m).
///
/// ```
/// use uchain_core::chain::{CenterParams, Follow, TOF_RANGE_M, Tof, center};
/// let nearer_the_right_wall = Tof { nw_m: 0.9, ne_m: 0.5, sw_m: 0.9, se_m: 0.5 };
/// let asked = center(&nearer_the_right_wall, TOF_RANGE_M, false, Follow::Centre, &CenterParams::default());
/// assert!(asked.lateral_mps > 0.0); // to the left
/// assert_eq!(asked.yaw_rate_radps, 0.0); // aligned already
/// ```
pub fn center(tof: &Tof, range_m: f32, backward: bool, follow: Follow, params: &CenterParams) -> Centering {
    center_by(tof, range_m, backward, follow, params).0
}

/// What made [`center`] ask for what it asks.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct SteeredBy {
    /// The walls of the law; `None` if it steers by none.
    pub(super) walls: Option<Walls>,
    /// The wall it is pushed away from, whatever the law says.
    pub(super) pushed_by: Option<WallSide>,
}

/// [`center`], with what made it ask for that.
pub(super) fn center_by(
    tof: &Tof,
    range_m: f32,
    backward: bool,
    follow: Follow,
    params: &CenterParams,
) -> (Centering, SteeredBy) {
    let beams = beams_of(tof, range_m);
    let [nw, ne, sw, se] = beams;
    let (lead_left, lead_right) = if backward { (sw, se) } else { (nw, ne) };

    let (walls, (lateral, yaw_rate)) = match params.law {
        CenterLaw::Wall => {
            let walls = wall::walls(beams, backward, follow, params);
            (Some(walls), wall::along(walls, beams, backward, params))
        }
        CenterLaw::Paper => {
            let walls = paper::walls(beams, follow, params);
            (Some(walls), paper::along(walls, beams, backward, params))
        }
        CenterLaw::Firmware => firmware::steer(beams, range_m, follow, params),
    };
    let lateral_mps = bounded(lateral, -params.lateral_max_mps, params.lateral_max_mps);
    let yaw_rate_radps = bounded(yaw_rate, -params.yaw_rate_max_radps, params.yaw_rate_max_radps);

    let nearest_ahead = smaller(lead_left, lead_right);
    let speed_share =
        bounded((nearest_ahead - params.slow_from_m) / params.slow_over_m, params.slow_floor, 1.0);
    let pushed_by = push(smaller(nw, sw), smaller(ne, se), params);
    let lateral_mps = match pushed_by {
        None => lateral_mps,
        Some(WallSide::Left) => -params.push_mps,
        Some(WallSide::Right) => params.push_mps,
    };
    (Centering { lateral_mps, yaw_rate_radps, speed_share }, SteeredBy { walls, pushed_by })
}

/// Front left, front right, rear left, rear right (m).
fn beams_of(tof: &Tof, range_m: f32) -> [f32; 4] {
    let seen = |d: f32| if d >= 0.0 { smaller(d, range_m) } else { range_m };
    [seen(tof.nw_m), seen(tof.ne_m), seen(tof.sw_m), seen(tof.se_m)]
}

/// The walls that [`center`] steers by; `None` if by none.
pub(super) fn walls_of(
    tof: &Tof,
    range_m: f32,
    backward: bool,
    follow: Follow,
    params: &CenterParams,
) -> Option<Walls> {
    let beams = beams_of(tof, range_m);
    match params.law {
        CenterLaw::Wall => Some(wall::walls(beams, backward, follow, params)),
        CenterLaw::Paper => Some(paper::walls(beams, follow, params)),
        CenterLaw::Firmware => firmware::walls(beams, range_m, follow, params),
    }
}

/// The wall to be pushed away from: where a beam on one side, and none on the other, is too short.
fn push(left_m: f32, right_m: f32, params: &CenterParams) -> Option<WallSide> {
    match (left_m < params.push_below_m, right_m < params.push_below_m) {
        (true, false) => Some(WallSide::Left),
        (false, true) => Some(WallSide::Right),
        _ => None,
    }
}

#[cfg(test)]
mod tests;
