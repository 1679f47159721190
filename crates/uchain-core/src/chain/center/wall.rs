//! Centering that gets out of corners: both walls while they run alike, else along the nearer one.
//!
//! Eq. 21 ignores the side whose beams differ most, and in a corner that is often the side that tells of the wall ahead:
//! what is left looks like a wall that runs alike, and the UAV goes on. Facing the end wall, both sides differ as much,
//! and Eq. 20 centers the UAV on a dead end. This law ignores the side that is farther away, so never a wall that
//! comes nearer, and a way that is closed ahead on both sides always makes it turn.

use super::{CenterParams, Follow, Walls, paper};
use crate::{bounded, smaller};

/// The two beams of one side (m).
#[derive(Debug, Clone, Copy)]
struct Side {
    front_m: f32,
    rear_m: f32,
}

impl Side {
    fn nearest_m(self) -> f32 {
        smaller(self.front_m, self.rear_m)
    }

    fn sum_m(self) -> f32 {
        self.front_m + self.rear_m
    }

    fn ratio(self) -> f32 {
        paper::ratio(self.front_m, self.rear_m)
    }

    /// Whether the wall ahead, or the side's own wall, comes nearer.
    fn closes(self, backward: bool, closed_share: f32) -> bool {
        let (lead_m, trail_m) =
            if backward { (self.rear_m, self.front_m) } else { (self.front_m, self.rear_m) };
        lead_m < closed_share * trail_m
    }
}

/// Lateral speed (m/s) and yaw rate (rad/s) before their limits, by these walls, of the beams (NW, NE, SW, SE) (m).
pub(super) fn along(walls: Walls, beams: [f32; 4], backward: bool, params: &CenterParams) -> (f32, f32) {
    let [left, right] = sides(beams);
    match walls {
        Walls::Both => paper::along(Walls::Both, beams, backward, params),
        Walls::Left => toward(left, right, params),
        Walls::Right => {
            let (lateral_mps, yaw_rate_radps) = toward(right, left, params);
            (-lateral_mps, -yaw_rate_radps)
        }
    }
}

fn sides([nw, ne, sw, se]: [f32; 4]) -> [Side; 2] {
    [Side { front_m: nw, rear_m: sw }, Side { front_m: ne, rear_m: se }]
}

/// The walls it steers by, of the beams (NW, NE, SW, SE) (m).
pub(super) fn walls(beams: [f32; 4], backward: bool, follow: Follow, params: &CenterParams) -> Walls {
    let [left, right] = sides(beams);
    chosen(left, right, backward, follow, params)
}

/// Wall choice: the pilot's, or both walls while they run alike and the way ahead is open, else the nearer one.
fn chosen(left: Side, right: Side, backward: bool, follow: Follow, params: &CenterParams) -> Walls {
    match follow {
        Follow::Left => return Walls::Left,
        Follow::Right => return Walls::Right,
        Follow::Centre => {}
    }
    let closed = |side: Side| side.closes(backward, params.closed_share);
    let alike = (left.ratio() - right.ratio()).abs() < params.invalid_ratio;
    if alike && !(closed(left) && closed(right)) {
        Walls::Both
    } else if left.sum_m() < right.sum_m() {
        Walls::Left
    } else {
        Walls::Right
    }
}

/// Lateral speed toward a wall (m/s) and turn toward it (rad/s) that keep along it: in the middle, where the other wall
/// is near, and no farther than the largest distance.
fn toward(wall: Side, other: Side, params: &CenterParams) -> (f32, f32) {
    let wall_m = wall.nearest_m();
    let keep_m = smaller(0.5 * (wall_m + other.nearest_m()), params.follow_distance_m);
    let max_mps = params.follow_lateral_max_mps;
    let lateral_mps = bounded(params.follow_lateral_per_s * (wall_m - keep_m), -max_mps, max_mps);
    (lateral_mps, 2.0 * params.c_r_rad_per_s_m * (wall.front_m - wall.rear_m))
}
