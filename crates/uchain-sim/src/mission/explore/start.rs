//! Robots at their starts, before they have decided anything.

use glam::Vec2;
use uchain_core::explore::{ExploreParams, Purpose};

use super::{RobotFrame, Site, VehicleKind};
use crate::{
    seed::{Seed, Source},
    world::{MotionParams, PointMass, Quadrotor, Vehicle, Waypoint, World},
};

/// Where the seed puts the robots.
pub(super) fn starts(site: &Site, seed: Seed) -> Vec<Waypoint> {
    let (team, params) = (&site.scenario.team, &site.scenario.params);
    let z_m = params.height_m(ExploreParams::USUAL_LEVEL);
    let start = |(i, &at): (u32, &Vec2)| {
        let mut stream = seed.stream(i, Source::Start);
        let mut aside = || team.scatter_m * (2.0 * stream.uniform() - 1.0);
        let at = at + Vec2::new(aside(), aside());
        Waypoint { at, z_m, heading_rad: team.heading_deg.to_radians() }
    };
    (0..u32::from(team.robots)).zip(&site.spawns).map(start).collect()
}

/// Robots at their starts.
pub(super) fn world(site: &Site, seed: Seed) -> World {
    let (team, params) = (&site.scenario.team, &site.scenario.params);
    let body = |at| -> Box<dyn Vehicle> {
        match team.vehicle {
            VehicleKind::PointMass => Box::new(PointMass::new(at, team.v_mps, team.climb_mps)),
            VehicleKind::Quadrotor => {
                Box::new(Quadrotor::new(at, &team.quadrotor, team.v_mps, team.climb_mps))
            }
        }
    };
    let motion = MotionParams { radius_m: params.r_body_m, ..MotionParams::default() };
    World::new(site.map.clone(), motion, starts(site, seed).into_iter().map(body))
}

/// A robot that has decided nothing yet.
pub(super) fn at_rest(body: Waypoint) -> RobotFrame {
    RobotFrame {
        x_m: body.at.x,
        y_m: body.at.y,
        z_m: body.z_m,
        heading_rad: body.heading_rad,
        level: ExploreParams::USUAL_LEVEL,
        purpose: Purpose::Wait,
        moves: false,
        holds: false,
        mfl: false,
        wall_contacts: 0,
        robot_contacts: 0,
        level_passes: 0,
    }
}
