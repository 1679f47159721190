//! Robots that fly from place to place, and what they touch.

use std::sync::Arc;

use glam::Vec2;

use crate::{clock::TICK_S, map::Map};

/// Overlap of bodies that still counts as none (m): what `f32` makes of distances in a map.
const TOUCH_M: f32 = 1e-4;

/// How much farther apart than in touch robots are listed as near (m).
const SKIN_M: f32 = 0.5;

/// A place to fly to, and how to be there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Waypoint {
    /// Where (m).
    pub at: Vec2,
    /// Height (m).
    pub z_m: f32,
    /// Heading (rad).
    pub heading_rad: f32,
}

/// A body that flies to where it is told. All robots of a fleet are told at once.
pub trait Vehicle: std::fmt::Debug + Send {
    /// From now on, fly there.
    fn fly_to(&mut self, to: Waypoint);
    /// One tick passes.
    fn advance(&mut self);
    /// Where it is.
    fn now(&self) -> Waypoint;
    /// Whether it is where it was told to be.
    fn has_arrived(&self) -> bool;
    /// Where it counts as being once it has arrived: from there it scans and decides.
    fn stands(&self) -> Waypoint {
        self.now()
    }
}

/// A point that flies straight: over ground at one speed, and to its new height evenly along the way. Where the way is
/// too short for that, it climbs at its greatest speed and comes to its height last.
#[derive(Debug, Clone)]
pub struct PointMass {
    v_mps: f32,
    climb_mps: f32,
    from: Waypoint,
    to: Waypoint,
    /// Ticks since the start of the way.
    ticks: u32,
}

impl PointMass {
    /// A point at rest.
    pub fn new(at: Waypoint, v_mps: f32, climb_mps: f32) -> Self {
        Self { v_mps, climb_mps, from: at, to: at, ticks: 0 }
    }

    /// Time over ground, and time to the new height (s).
    fn needed_s(&self) -> (f32, f32) {
        let ground_s = self.from.at.distance(self.to.at) / self.v_mps;
        let climb_s = (self.to.z_m - self.from.z_m).abs() / self.climb_mps;
        (ground_s, climb_s.max(ground_s))
    }

    fn passed_s(&self) -> f32 {
        self.ticks as f32 * TICK_S
    }
}

impl Vehicle for PointMass {
    fn fly_to(&mut self, to: Waypoint) {
        (self.from, self.to, self.ticks) = (self.now(), to, 0);
    }

    fn advance(&mut self) {
        self.ticks = self.ticks.saturating_add(1);
    }

    fn now(&self) -> Waypoint {
        let (passed_s, (ground_s, climb_s)) = (self.passed_s(), self.needed_s());
        let share = |needed_s: f32| if passed_s < needed_s { passed_s / needed_s } else { 1.0 };
        let (over, up) = (share(ground_s), share(climb_s));
        Waypoint {
            at: if over < 1.0 { self.from.at.lerp(self.to.at, over) } else { self.to.at },
            z_m: if up < 1.0 { self.from.z_m + up * (self.to.z_m - self.from.z_m) } else { self.to.z_m },
            heading_rad: self.to.heading_rad,
        }
    }

    fn has_arrived(&self) -> bool {
        self.passed_s() >= self.needed_s().1
    }
}

/// All robots of an exploration.
#[derive(Debug)]
pub struct Fleet {
    map: Arc<Map>,
    r_body_m: f32,
    vehicles: Vec<Box<dyn Vehicle>>,
    touch: Vec<Touch>,
    /// Pairs of robots in touch, lower index first, and whether they are to be at one height; in order.
    pairs: Vec<([usize; 2], bool)>,
    /// Pairs that may touch before they are listed again, in order.
    near: Vec<[usize; 2]>,
    /// By how much any two robots may still come nearer to each other before that (m).
    slack_m: f32,
}

/// What one robot touches.
#[derive(Debug, Clone, Copy, Default)]
struct Touch {
    /// Way it may still fly before its distance from walls is of interest again (m).
    room_m: f32,
    last: Vec2,
    at_wall: bool,
    /// Height it is told to be at (m).
    level_m: f32,
    met: Touches,
}

/// What a robot has touched so far; each is counted when it begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Touches {
    /// Walls.
    pub walls: u32,
    /// Robots on its own level: nearer over ground than two radii.
    pub robots: u32,
    /// Robots on their way from or to another level: nearer through the air than two radii.
    pub passes: u32,
}

impl Fleet {
    /// Robots of a radius in a map.
    pub fn new(map: Arc<Map>, r_body_m: f32, vehicles: Vec<Box<dyn Vehicle>>) -> Self {
        let touch: Vec<Touch> =
            vehicles.iter().map(|body| Touch { level_m: body.now().z_m, ..Touch::default() }).collect();
        let mut fleet =
            Self { map, r_body_m, vehicles, touch, pairs: Vec::new(), near: Vec::new(), slack_m: -1.0 };
        fleet.feel();
        fleet
    }

    /// One robot flies there from now on.
    pub fn fly_to(&mut self, robot: usize, to: Waypoint) {
        if let (Some(vehicle), Some(touch)) = (self.vehicles.get_mut(robot), self.touch.get_mut(robot)) {
            vehicle.fly_to(to);
            touch.level_m = to.z_m;
        }
    }

    /// One tick passes.
    pub fn advance(&mut self) {
        for vehicle in &mut self.vehicles {
            vehicle.advance();
        }
        self.feel();
    }

    /// Where robots are.
    pub fn now(&self) -> impl Iterator<Item = Waypoint> + '_ {
        self.vehicles.iter().map(|vehicle| vehicle.now())
    }

    /// Where robots count as being once they have arrived.
    pub fn stand(&self) -> impl Iterator<Item = Waypoint> + '_ {
        self.vehicles.iter().map(|vehicle| vehicle.stands())
    }

    /// Whether all are where they were told to be.
    pub fn has_arrived(&self) -> bool {
        self.vehicles.iter().all(|vehicle| vehicle.has_arrived())
    }

    /// Per robot, what it has touched so far.
    pub fn contacts(&self) -> impl Iterator<Item = Touches> + '_ {
        self.touch.iter().map(|touch| touch.met)
    }

    /// A robot is a ball. It touches a wall, which goes up to the ceiling, nearer than its radius.
    fn feel(&mut self) {
        let now: Vec<Waypoint> = self.now().collect();
        let mut longest_m: f32 = 0.0;
        for (i, here) in now.iter().enumerate() {
            let touch = &mut self.touch[i];
            let flown_m = here.at.distance(touch.last);
            longest_m = longest_m.max(flown_m);
            touch.room_m -= flown_m;
            touch.last = here.at;
            if touch.room_m <= 0.0 {
                touch.room_m = self.map.clearance_m(here.at) - self.r_body_m + TOUCH_M;
                let at_wall = touch.room_m < 0.0 || self.map.in_rock(here.at);
                touch.met.walls += u32::from(at_wall && !touch.at_wall);
                touch.at_wall = at_wall;
            }
        }
        self.meet(&now, longest_m);
    }

    /// Pairs of robots that touch, after a tick in which none flew farther than `longest_m`.
    fn meet(&mut self, now: &[Waypoint], longest_m: f32) {
        let near_m = 2.0 * self.r_body_m - TOUCH_M;
        self.slack_m -= 2.0 * longest_m;
        if self.slack_m <= 0.0 {
            self.near = nearer_than(now, near_m + SKIN_M);
            // Less what rounding may make of distances.
            self.slack_m = 0.99 * SKIN_M;
        }
        let before = std::mem::take(&mut self.pairs);
        for &[i, j] in &self.near {
            let (a, b) = (now[i], now[j]);
            let (over2, up) = (a.at.distance_squared(b.at), a.z_m - b.z_m);
            let one_level = self.touch[i].level_m == self.touch[j].level_m;
            if over2 + if one_level { 0.0 } else { up * up } >= near_m * near_m {
                continue;
            }
            if before.binary_search(&([i, j], one_level)).is_err() {
                for robot in [i, j] {
                    let met = &mut self.touch[robot].met;
                    *(if one_level { &mut met.robots } else { &mut met.passes }) += 1;
                }
            }
            self.pairs.push(([i, j], one_level));
        }
    }
}

/// Pairs of places nearer to each other over ground than so much, lower index first, in order. Places are swept from
/// west to east.
fn nearer_than(places: &[Waypoint], reach_m: f32) -> Vec<[usize; 2]> {
    let mut eastward: Vec<usize> = (0..places.len()).collect();
    eastward.sort_unstable_by(|&i, &j| places[i].at.x.total_cmp(&places[j].at.x));
    let mut pairs = Vec::new();
    for (k, &i) in eastward.iter().enumerate() {
        let from = places[i].at;
        let in_reach = eastward[k + 1..].iter().take_while(|&&j| places[j].at.x - from.x < reach_m);
        let near = in_reach.filter(|&&j| places[j].at.distance_squared(from) < reach_m * reach_m);
        pairs.extend(near.map(|&j| [i.min(j), i.max(j)]));
    }
    pairs.sort_unstable();
    pairs
}

#[cfg(test)]
mod tests;
