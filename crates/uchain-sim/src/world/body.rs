//! A body: where it is, how it moves, and what it has touched.

use glam::Vec2;

use crate::clock::TICK_S;

use super::Waypoint;

/// One body's state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Body {
    /// Position (m).
    pub at: Vec2,
    /// What `at` leaves of the position (m): a tick's way is less than the spacing of `f32` where coordinates are large.
    pub(super) remainder_m: Vec2,
    /// Height (m).
    pub z_m: f32,
    /// Height it is told to be at (m). Bodies touch on one level only.
    pub level_m: f32,
    /// Velocity in the map's frame (m/s); of one that flies to waypoints, its mean over the last tick.
    pub velocity_mps: Vec2,
    /// Direction of the body's x axis, counter-clockwise (rad).
    pub(super) heading_rad: f32,
    /// Unit vector of the body's x axis: asked for many times a tick, so kept.
    pub(super) forward: Vec2,
    /// Yaw rate (rad/s); 0 for one that flies to waypoints.
    pub yaw_rate_radps: f32,
    /// Way flown forward since the start, backward taken off (m): what an odometer without a fault shows. 0 for one that flies
    /// to waypoints.
    pub forward_m: f64,
    /// In the air. On the ground a body does not move and is in nobody's way.
    pub airborne: bool,
    /// Share of the charge of its battery that is left (0 to 1); `None` without one that is measured. Nothing drains it yet
    /// but whoever flies it: [`World::set_battery`](super::World::set_battery).
    pub battery: Option<f32>,
    /// Flies to waypoints: others move it nowhere.
    pub(super) kinematic: bool,
    /// Wall contacts begun so far.
    pub wall_contacts: u32,
    /// Contacts with others on its level begun so far.
    pub uav_contacts: u32,
    /// Others on another level, which it has passed nearer through the air than two radii.
    pub level_passes: u32,
}

impl Body {
    /// A body at its start: in the air, where it flies to waypoints, or on the ground below the level it will fly on.
    pub(super) fn new(start: Waypoint, kinematic: bool) -> Self {
        let heading_rad = if kinematic { start.heading_rad } else { wrap(start.heading_rad) };
        Self {
            at: start.at,
            remainder_m: Vec2::ZERO,
            z_m: start.z_m,
            level_m: start.z_m,
            velocity_mps: Vec2::ZERO,
            heading_rad,
            forward: unit(heading_rad),
            yaw_rate_radps: 0.0,
            forward_m: 0.0,
            airborne: kinematic,
            battery: None,
            kinematic,
            wall_contacts: 0,
            uav_contacts: 0,
            level_passes: 0,
        }
    }

    /// Unit vector of the body's x axis.
    pub fn forward(&self) -> Vec2 {
        self.forward
    }

    /// Direction of the body's x axis, counter-clockwise (rad): in (−π, π] under velocity commands, else as told.
    pub fn heading_rad(&self) -> f32 {
        self.heading_rad
    }

    /// Forward speed over ground (m/s).
    pub fn forward_mps(&self) -> f32 {
        self.velocity_mps.dot(self.forward)
    }

    /// Leftward speed over ground (m/s).
    pub fn lateral_mps(&self) -> f32 {
        self.velocity_mps.dot(self.forward.perp())
    }

    /// Where it is, as a place to fly to.
    pub fn pose(&self) -> Waypoint {
        Waypoint { at: self.at, z_m: self.z_m, heading_rad: self.heading_rad }
    }

    /// In the air, or on the ground: there it stands at once.
    pub(super) fn lift(&mut self, airborne: bool) {
        self.airborne = airborne;
        if !airborne {
            self.velocity_mps = Vec2::ZERO;
            self.yaw_rate_radps = 0.0;
        }
    }

    /// Is about to be where its vehicle says, at the end of this tick.
    pub(super) fn aim(&mut self, there: Waypoint) {
        self.velocity_mps = (there.at - self.at) / TICK_S;
    }

    /// Is where its vehicle says.
    pub(super) fn put(&mut self, there: Waypoint) {
        (self.at, self.remainder_m) = (there.at, Vec2::ZERO);
        self.z_m = there.z_m;
        if self.heading_rad != there.heading_rad {
            self.heading_rad = there.heading_rad;
            self.forward = unit(there.heading_rad);
        }
    }

    /// Counts the way of a tick, before the body turns.
    pub(super) fn roll(&mut self, tick_s: f32) {
        if self.airborne && !self.kinematic {
            self.forward_m += f64::from(self.forward_mps() * tick_s);
        }
    }

    /// Turns for one tick. The heading is ours: nothing physical turns a body.
    pub(super) fn turn(&mut self, tick_s: f32) {
        if self.yaw_rate_radps == 0.0 {
            return;
        }
        self.heading_rad = wrap(self.heading_rad + self.yaw_rate_radps * tick_s);
        self.forward = unit(self.heading_rad);
    }
}

/// Whether bodies can be on different levels.
pub(super) fn on_levels(bodies: &[Body]) -> bool {
    bodies
        .iter()
        .any(|body| body.kinematic || bodies.first().is_some_and(|first| first.level_m != body.level_m))
}

/// The same direction in (−π, π], for one that is off by less than a turn.
fn wrap(heading_rad: f32) -> f32 {
    use core::f32::consts::{PI, TAU};
    if heading_rad > PI {
        heading_rad - TAU
    } else if heading_rad <= -PI {
        heading_rad + TAU
    } else {
        heading_rad
    }
}

fn unit(heading_rad: f32) -> Vec2 {
    let (sin, cos) = libm::sincosf(heading_rad);
    Vec2::new(cos, sin)
}
