//! What a body is told to do, and where it starts.

use glam::Vec2;
use uchain_core::chain::Command;

use super::{Vehicle, Waypoint};

/// What a body does until it is told something else.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Motion {
    /// Fly with this velocity, or stand on the ground.
    Velocity(Command),
    /// Fly there, and stay.
    Waypoint(Waypoint),
}

impl From<Command> for Motion {
    fn from(command: Command) -> Self {
        Self::Velocity(command)
    }
}

impl From<Waypoint> for Motion {
    fn from(to: Waypoint) -> Self {
        Self::Waypoint(to)
    }
}

/// A body at the start of a run.
#[derive(Debug)]
pub struct Start {
    pub(super) at: Waypoint,
    pub(super) vehicle: Option<Box<dyn Vehicle>>,
}

impl Start {
    /// A body that takes velocities. It stands on the ground at this place and heading until it is told to fly, and then
    /// flies at this height (m), which is its level.
    pub fn by_velocity(at: Waypoint) -> Self {
        Self { at, vehicle: None }
    }

    /// A body that flies to waypoints. It is in the air, where its vehicle says.
    pub fn by_waypoint(vehicle: Box<dyn Vehicle>) -> Self {
        Self { at: vehicle.now(), vehicle: Some(vehicle) }
    }
}

/// Place (m) and heading (rad) of a body that takes velocities; its level is 0 m.
impl From<(Vec2, f32)> for Start {
    fn from((at, heading_rad): (Vec2, f32)) -> Self {
        Self::by_velocity(Waypoint { at, z_m: 0.0, heading_rad })
    }
}

impl From<Box<dyn Vehicle>> for Start {
    fn from(vehicle: Box<dyn Vehicle>) -> Self {
        Self::by_waypoint(vehicle)
    }
}

/// What a world cannot do.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum WorldError {
    /// No such body.
    #[error("body {body} does not exist: this world has {count}, counted from 0")]
    NoBody {
        /// Which was meant.
        body: usize,
        /// How many there are.
        count: usize,
    },
    /// A velocity for a body that flies to waypoints.
    #[error("body {body} flies to waypoints and takes no velocity")]
    FliesToWaypoints {
        /// Which.
        body: usize,
    },
    /// A waypoint for a body that takes velocities.
    #[error("body {body} takes velocities and flies to no waypoint")]
    TakesVelocities {
        /// Which.
        body: usize,
    },
    /// More or fewer starts than bodies.
    #[error("{got} starts for {count} bodies: expected one for each")]
    Starts {
        /// How many starts were given.
        got: usize,
        /// How many bodies there are.
        count: usize,
    },
}
