//! Contacts of bodies that fly to waypoints: nothing stops them there, so they are counted where bodies overlap.

use glam::Vec2;

use crate::{
    map::Map,
    world::{Body, neighbours::NeighbourGrid},
};

/// Overlap of bodies that still counts as none (m): what `f32` makes of distances in a map.
pub(super) const TOUCH_M: f32 = 1e-4;

/// How much farther apart than in touch bodies are listed as near (m).
const SKIN_M: f32 = 0.5;

/// What overlaps: bodies that fly to waypoints with walls and with each other, and any two bodies on their way past each
/// other on different levels. Pairs come from a list of neighbours that holds until somebody has flown out of its skin
/// (Verlet list).
#[derive(Debug, Default)]
pub(in crate::world) struct Overlaps {
    walls: Vec<Wall>,
    /// Pairs that overlap, lower index first, and whether they are to be on one level; in order. Now, and a tick ago.
    pairs: Vec<([usize; 2], bool)>,
    before: Vec<([usize; 2], bool)>,
    /// Pairs that may overlap before they are listed again, in order.
    near: Vec<[usize; 2]>,
    /// By how much any two bodies may still come nearer to each other before that (m).
    slack_m: f32,
}

/// One body and the walls.
#[derive(Debug, Clone, Copy)]
struct Wall {
    /// Way it may still fly before its distance from walls is of interest again (m).
    room_m: f32,
    last: Vec2,
    touches: bool,
}

impl Overlaps {
    /// Nobody has been looked at yet.
    pub(in crate::world) fn reset(&mut self, bodies: &[Body]) {
        self.walls.clear();
        self.walls.extend(bodies.iter().map(|body| Wall { room_m: 0.0, last: body.at, touches: false }));
        self.pairs.clear();
        self.near.clear();
        self.list_again();
    }

    /// Somebody has come from the ground, or gone there.
    pub(in crate::world) fn list_again(&mut self) {
        self.slack_m = -1.0;
    }

    /// Counts the contacts and passes that have begun in this tick. A body is a ball; a wall goes up to the ceiling.
    pub(in crate::world) fn count(
        &mut self,
        map: &Map,
        radius_m: f32,
        neighbours: &NeighbourGrid,
        bodies: &mut [Body],
    ) {
        let mut longest_m: f32 = 0.0;
        for (body, wall) in bodies.iter_mut().zip(&mut self.walls) {
            let flown_m = body.at.distance(wall.last);
            longest_m = longest_m.max(flown_m);
            wall.room_m -= flown_m;
            wall.last = body.at;
            if wall.room_m <= 0.0 && body.kinematic {
                wall.room_m = map.clearance_m(body.at) - radius_m + TOUCH_M;
                let touches = wall.room_m < 0.0 || map.in_rock(body.at);
                body.wall_contacts += u32::from(touches && !wall.touches);
                wall.touches = touches;
            }
        }
        self.meet(radius_m, neighbours, bodies, longest_m);
    }

    /// Pairs that overlap, after a tick in which none flew farther than `longest_m`.
    fn meet(&mut self, radius_m: f32, neighbours: &NeighbourGrid, bodies: &mut [Body], longest_m: f32) {
        let near_m = 2.0 * radius_m - TOUCH_M;
        self.slack_m -= 2.0 * longest_m;
        if self.slack_m <= 0.0 {
            neighbours.pairs(near_m + SKIN_M, &mut self.near);
            // Less what rounding may make of distances.
            self.slack_m = 0.99 * SKIN_M;
        }
        std::mem::swap(&mut self.pairs, &mut self.before);
        self.pairs.clear();
        for &[i, j] in &self.near {
            let (a, b) = (bodies[i], bodies[j]);
            let (over2, up) = (a.at.distance_squared(b.at), a.z_m - b.z_m);
            let one_level = a.level_m == b.level_m;
            if over2 + if one_level { 0.0 } else { up * up } >= near_m * near_m {
                continue;
            }
            // On one level with somebody who can be pushed: there the solver counts.
            if one_level && !(a.kinematic && b.kinematic) {
                continue;
            }
            if self.before.binary_search(&([i, j], one_level)).is_err() {
                for body in [i, j] {
                    let Body { uav_contacts, level_passes, .. } = &mut bodies[body];
                    *(if one_level { uav_contacts } else { level_passes }) += 1;
                }
            }
            self.pairs.push(([i, j], one_level));
        }
    }
}
