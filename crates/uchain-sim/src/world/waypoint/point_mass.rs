//! The simplest vehicle: it flies as fast as it may, and stops at once.

use super::{Vehicle, Waypoint};
use crate::clock::TICK_S;

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
    /// A point at rest, that flies over ground and climbs at these speeds (m/s, both above 0).
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
    fn place(&mut self, at: Waypoint) {
        (self.from, self.to, self.ticks) = (at, at, 0);
    }

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
