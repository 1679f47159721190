//! How far an exploration has come.

use serde::Serialize;

use super::{ExploreFrame, RobotFrame};

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
    places_m: Vec<[f32; 2]>,
}

impl Odometer {
    /// Takes the next frame; how far it has come with it.
    pub(crate) fn add(&mut self, frame: &ExploreFrame) -> Progress {
        if self.places_m.is_empty() {
            // Where they stood before the first tick, they scanned.
            self.places_m = frame.robots.iter().map(|robot| [robot.x_m, robot.y_m]).collect();
            for (place_m, node) in self.places_m.iter_mut().zip(&frame.nodes) {
                *place_m = node.at_m;
            }
        }
        for (place_m, robot) in self.places_m.iter_mut().zip(&frame.robots) {
            let [dx_m, dy_m] = [robot.x_m - place_m[0], robot.y_m - place_m[1]].map(f64::from);
            self.now.distance_m += (dx_m * dx_m + dy_m * dy_m).sqrt();
            *place_m = [robot.x_m, robot.y_m];
        }
        let sum = |count: fn(&RobotFrame) -> u32| frame.robots.iter().map(count).sum::<u32>();
        self.now = Progress {
            time_s: frame.time_s(),
            rounds: frame.rounds,
            nodes: self.now.nodes + frame.nodes.len() as u32,
            edges: self.now.edges + frame.edges.len() as u32,
            hubs: frame.hubs,
            moving: sum(|robot| robot.moves.into()),
            distance_m: self.now.distance_m,
            wall_contacts: sum(|robot| robot.wall_contacts),
            robot_contacts: sum(|robot| robot.robot_contacts) / 2,
        };
        self.now
    }
}
