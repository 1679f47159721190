//! Centering as printed (Laclau 2021, Eq. 20 and 21): both walls, or one where the other is lost.

use nalgebra::{Matrix2x4, Vector2, Vector4};

use super::{CenterParams, Follow, Walls};
use crate::larger;

/// Lateral speed (m/s) and yaw rate (rad/s) before their limits, of the beams (NW, NE, SW, SE) (m): Eq. 20 between both
/// walls, Eq. 21 along one.
pub(super) fn along(walls: Walls, beams: [f32; 4], backward: bool, params: &CenterParams) -> (f32, f32) {
    let (law, aim) = map(walls, backward, params);
    let wish = law * Vector4::from(beams) - aim;
    (wish.x, wish.y)
}

/// How far a side's beams differ, relative to their mean (1).
pub(super) fn ratio(front_m: f32, rear_m: f32) -> f32 {
    (front_m - rear_m).abs() / larger(0.5 * (front_m + rear_m), 1.0e-6)
}

/// The law as a linear map of the beams (NW, NE, SW, SE), and what to subtract: rows ẏ and ω.
fn map(walls: Walls, backward: bool, params: &CenterParams) -> (Matrix2x4<f32>, Vector2<f32>) {
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
pub(super) fn walls([nw, ne, sw, se]: [f32; 4], follow: Follow, params: &CenterParams) -> Walls {
    match follow {
        Follow::Left => return Walls::Left,
        Follow::Right => return Walls::Right,
        Follow::Centre => {}
    }
    let (left, right) = (ratio(nw, sw), ratio(ne, se));
    if (left - right).abs() < params.invalid_ratio {
        Walls::Both
    } else if left > right {
        Walls::Right
    } else {
        Walls::Left
    }
}
