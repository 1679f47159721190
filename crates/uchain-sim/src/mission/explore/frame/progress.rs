//! How far an exploration has come.

use glam::DVec2;
use serde::Serialize;

use super::way::Way;
use crate::mission::explore::{ExploreFrame, RobotFrame};

/// An exploration so far, in a few numbers.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Progress {
    /// Simulated time at the end of the tick (s).
    pub time_s: f64,
    /// Rounds begun.
    pub rounds: u32,
    /// Nodes scanned.
    pub nodes: u32,
    /// Edges of the roadmap.
    pub edges: u32,
    /// Nodes with a frontier.
    pub hubs: u32,
    /// Robots that fly to another place this round.
    pub moving: u32,
    /// Ways over ground of all robots, added up (m).
    pub distance_m: f64,
    /// Contacts with walls begun.
    pub wall_contacts: u32,
    /// Contacts between robots on one level begun.
    pub robot_contacts: u32,
}

/// Adds up an exploration frame by frame.
#[derive(Debug, Clone, Default)]
pub(crate) struct Odometer {
    now: Progress,
    ways: Vec<Way>,
}

impl Odometer {
    /// Takes the next frame; how far it has come with it.
    pub(crate) fn add(&mut self, frame: &ExploreFrame) -> Progress {
        if self.ways.is_empty() {
            // Where they stood before the first tick, they scanned.
            let scanned = |i: usize| frame.nodes.get(i).map(|node| DVec2::from(node.at_m.map(f64::from)));
            let start = |(i, robot): (usize, &RobotFrame)| scanned(i).unwrap_or_else(|| place_m(robot));
            self.ways =
                frame.robots.iter().enumerate().map(start).map(|at_m| Way::from(at_m.extend(0.0))).collect();
        }
        for (way, robot) in self.ways.iter_mut().zip(&frame.robots) {
            way.go(place_m(robot).extend(0.0), frame.decision);
        }
        let sum = |count: fn(&RobotFrame) -> u32| frame.robots.iter().map(count).sum::<u32>();
        self.now = Progress {
            time_s: frame.time_s(),
            rounds: frame.rounds,
            nodes: self.now.nodes + frame.nodes.len() as u32,
            edges: self.now.edges + frame.edges.len() as u32,
            hubs: frame.hubs,
            moving: sum(|robot| robot.moves.into()),
            distance_m: self.ways.iter().map(Way::over_ground_m).sum(),
            wall_contacts: sum(|robot| robot.wall_contacts),
            robot_contacts: sum(|robot| robot.robot_contacts) / 2,
        };
        self.now
    }
}

fn place_m(robot: &RobotFrame) -> DVec2 {
    DVec2::new(robot.x_m.into(), robot.y_m.into())
}
