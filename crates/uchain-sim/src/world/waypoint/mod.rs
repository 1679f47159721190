//! Bodies that fly to waypoints: vehicles, and what they touch on their way.

mod overlap;
mod point_mass;
mod quadrotor;
#[cfg(test)]
mod tests;

use glam::Vec2;

pub(super) use overlap::Overlaps;
pub use point_mass::PointMass;
pub use quadrotor::{Quadrotor, QuadrotorParams};

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

/// What flies to where it is told.
pub trait Vehicle: std::fmt::Debug + Send {
    /// From now on it is here, at rest, as if new.
    fn place(&mut self, at: Waypoint);
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
