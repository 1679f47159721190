//! Centering as in the authors' flight firmware: nearer wall in a wide tunnel, relative yaw error.

use super::{CenterParams, Follow, Walls};

/// The two beams of one side (m); both within range, or the side counts as unseen.
#[derive(Debug, Clone, Copy)]
struct Wall {
    /// +1 left, −1 right.
    side: f32,
    front_m: f32,
    rear_m: f32,
}

impl Wall {
    fn seen(side: f32, front_m: f32, rear_m: f32, range_m: f32) -> Option<Self> {
        let valid = |d: f32| d > 0.0 && d < range_m;
        (valid(front_m) && valid(rear_m)).then_some(Self { side, front_m, rear_m })
    }

    fn mean_m(&self) -> f32 {
        0.5 * (self.front_m + self.rear_m)
    }

    /// Distance to the wall, flying along it (m).
    fn perpendicular_m(&self) -> f32 {
        self.mean_m() * core::f32::consts::FRAC_1_SQRT_2
    }

    /// Turn that aligns with the wall, relative to its distance (1).
    fn misalignment(&self) -> f32 {
        self.side * (self.front_m - self.rear_m) / self.mean_m()
    }
}

/// The walls it steers by; lateral speed (m/s) and yaw rate (rad/s) before their limits. Beams of a length of `range_m` or
/// more see nothing. The law is its own mirror image under a half-turn, so flying backward changes nothing.
pub(super) fn steer(
    beams: [f32; 4],
    range_m: f32,
    follow: Follow,
    params: &CenterParams,
) -> (Option<Walls>, (f32, f32)) {
    let Some((wall, goal_m, walls)) = chosen(beams, range_m, follow, params) else {
        return (None, (0.0, 0.0));
    };
    let lateral_mps = -wall.side * params.firmware_lateral_per_s * (goal_m - wall.perpendicular_m());
    (Some(walls), (lateral_mps, params.firmware_yaw_radps * wall.misalignment()))
}

/// The walls it steers by; `None` if it flies blind.
pub(super) fn walls(beams: [f32; 4], range_m: f32, follow: Follow, params: &CenterParams) -> Option<Walls> {
    chosen(beams, range_m, follow, params).map(|(.., walls)| walls)
}

/// The wall it measures from, the distance it keeps from it (m), and what that amounts to.
fn chosen(
    [nw, ne, sw, se]: [f32; 4],
    range_m: f32,
    follow: Follow,
    params: &CenterParams,
) -> Option<(Wall, f32, Walls)> {
    let left = Wall::seen(1.0, nw, sw, range_m).filter(|_| follow != Follow::Right);
    let right = Wall::seen(-1.0, ne, se, range_m).filter(|_| follow != Follow::Left);
    match (left, right) {
        (None, None) => None,
        (Some(wall), None) => Some((wall, params.firmware_goal_m, Walls::Left)),
        (None, Some(wall)) => Some((wall, params.firmware_goal_m, Walls::Right)),
        (Some(left), Some(right)) => {
            let width_m = left.perpendicular_m() + right.perpendicular_m();
            let (nearer, walls) =
                if left.mean_m() <= right.mean_m() { (left, Walls::Left) } else { (right, Walls::Right) };
            let is_wide = width_m > params.firmware_wide_m;
            // Half the width from the nearer wall is the middle.
            Some(if is_wide {
                (nearer, params.firmware_goal_m, walls)
            } else {
                (nearer, 0.5 * width_m, Walls::Both)
            })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chain::TOF_RANGE_M;

    #[test]
    fn a_narrow_tunnel_is_centered_by_its_nearer_wall_and_a_wide_one_followed_along_it() {
        let params = CenterParams::default();
        let root2 = core::f32::consts::SQRT_2;
        // 0.3 m from the left wall of a 0.8 m tunnel: 0.1 m off, to the right at 0.2 m/s.
        let (_, (lateral, yaw)) =
            steer([0.3 * root2, 0.5 * root2, 0.3 * root2, 0.5 * root2], TOF_RANGE_M, Follow::Centre, &params);
        assert!((lateral + 0.2).abs() < 1e-5 && yaw == 0.0);
        // 0.3 m from the left wall of a 1.2 m tunnel: the goal is a distance from that wall.
        let (_, (lateral, _)) =
            steer([0.3 * root2, 0.9 * root2, 0.3 * root2, 0.9 * root2], TOF_RANGE_M, Follow::Centre, &params);
        assert!((lateral + 2.0 * (params.firmware_goal_m - 0.3)).abs() < 1e-5);
    }

    #[test]
    fn a_side_with_one_blind_beam_is_not_followed_and_blind_it_flies_straight() {
        let params = CenterParams::default();
        let (_, (_, yaw)) = steer([2.0, 0.5, 0.5, 0.6], TOF_RANGE_M, Follow::Centre, &params);
        assert!(
            (yaw - params.firmware_yaw_radps * 0.1 / 0.55).abs() < 1e-5,
            "the right wall recedes: turn left"
        );
        assert_eq!(steer([2.0; 4], TOF_RANGE_M, Follow::Centre, &params), (None, (0.0, 0.0)));
        assert_eq!(steer([0.0; 4], TOF_RANGE_M, Follow::Centre, &params), (None, (0.0, 0.0)));
    }
}
