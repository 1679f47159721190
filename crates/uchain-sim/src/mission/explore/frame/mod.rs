//! What one instant of an exploration leaves behind.

use uchain_core::explore::{Label, NodeId, Purpose, Sector};

mod compare;
mod progress;
mod way;

use crate::{
    clock,
    mission::Stopped,
    record::{Difference, Snapshot},
};

pub(crate) use progress::Odometer;
pub use progress::Progress;
pub(crate) use way::Way;

/// One robot at one instant. Places are true ones, in the map's frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RobotFrame {
    /// Position (m).
    pub x_m: f32,
    /// Position (m).
    pub y_m: f32,
    /// Height (m).
    pub z_m: f32,
    /// Heading, counter-clockwise from the map's x axis (rad).
    pub heading_rad: f32,
    /// Level it is to be on at the end of the round, from 0.
    pub level: u16,
    /// Why it flies this round, or does not.
    pub purpose: Purpose,
    /// It flies to another place this round.
    pub moves: bool,
    /// It stays this round to let another one pass.
    pub holds: bool,
    /// It is on another level than the usual one to keep clear of others (Kim 2021, §6.2).
    pub mfl: bool,
    /// Wall contacts begun so far.
    pub wall_contacts: u32,
    /// Contacts with other robots on its level begun so far.
    pub robot_contacts: u32,
    /// Robots on their way from or to another level that it came as near to, so far.
    pub level_passes: u32,
}

/// A node that was scanned at the start of the tick.
#[derive(Debug, Clone, PartialEq)]
pub struct NodeFrame {
    /// Its name.
    pub id: NodeId,
    /// Where the robot was, in the map's frame (m).
    pub at_m: [f32; 2],
    /// Where the robot believed it was (m).
    pub believed_m: [f32; 2],
    /// Label and radius of every sector, before any other node was looked at.
    pub sectors: Vec<Sector>,
}

/// A label that changed at the start of the tick.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LabelFrame {
    /// The node.
    pub node: NodeId,
    /// Its sector.
    pub sector: u16,
    /// What it is from now on.
    pub label: Label,
}

/// One instant of an exploration.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ExploreFrame {
    /// Ticks since the start. A frame shows the world at the end of its tick; what was decided in it was decided at
    /// its start, [`ExploreFrame::decided_s`].
    pub tick: u64,
    /// Rounds begun so far.
    pub rounds: u32,
    /// Whether robots looked around and decided at the start of this tick; then only, `nodes`, `labels` and `edges`
    /// may hold something.
    pub decision: bool,
    /// All robots.
    pub robots: Vec<RobotFrame>,
    /// New nodes, in order.
    pub nodes: Vec<NodeFrame>,
    /// Labels that changed, those of new nodes included.
    pub labels: Vec<LabelFrame>,
    /// New edges of the roadmap.
    pub edges: Vec<[NodeId; 2]>,
    /// Nodes with a frontier, of all that any robot knows.
    pub hubs: u32,
    /// Why the exploration is over; it is the last frame.
    pub stopped: Option<Stopped>,
}

impl ExploreFrame {
    /// Simulated time at the end of the tick (s).
    pub fn time_s(&self) -> f64 {
        clock::time_s(self.tick)
    }

    /// Simulated time at the start of the tick (s): when robots scanned and decided.
    pub fn decided_s(&self) -> f64 {
        clock::start_s(self.tick)
    }
}

impl Snapshot for ExploreFrame {
    const CREW: &'static str = "robots";

    fn tick(&self) -> u64 {
        self.tick
    }

    fn crew(&self) -> usize {
        self.robots.len()
    }

    fn is_decision(&self) -> bool {
        self.decision
    }

    fn hash(&self, bytes: &mut Vec<u8>) {
        bytes.extend_from_slice(&self.tick.to_le_bytes());
        bytes.extend_from_slice(&self.rounds.to_le_bytes());
        for robot in &self.robots {
            for value in [robot.x_m, robot.y_m, robot.z_m, robot.heading_rad] {
                number(bytes, value);
            }
            bytes.extend_from_slice(&robot.level.to_le_bytes());
            bytes.extend_from_slice(&[
                robot.purpose as u8,
                robot.moves.into(),
                robot.holds.into(),
                robot.mfl.into(),
            ]);
            bytes.extend_from_slice(&robot.wall_contacts.to_le_bytes());
            bytes.extend_from_slice(&robot.robot_contacts.to_le_bytes());
            bytes.extend_from_slice(&robot.level_passes.to_le_bytes());
        }
        for node in &self.nodes {
            bytes.extend_from_slice(&node.id.robot.to_le_bytes());
            for value in node.believed_m {
                number(bytes, value);
            }
            for sector in &node.sectors {
                bytes.extend_from_slice(&[sector.label as u8]);
                number(bytes, sector.r_m);
            }
        }
        for change in &self.labels {
            bytes.extend_from_slice(&change.node.robot.to_le_bytes());
            bytes.extend_from_slice(&change.node.number.to_le_bytes());
            bytes.extend_from_slice(&change.sector.to_le_bytes());
        }
        for end in self.edges.iter().flatten() {
            bytes.extend_from_slice(&end.robot.to_le_bytes());
            bytes.extend_from_slice(&end.number.to_le_bytes());
        }
        bytes.extend_from_slice(&self.hubs.to_le_bytes());
        bytes.extend_from_slice(&[self.stopped.map_or(u8::MAX, |stopped| stopped as u8)]);
    }

    fn differences(&self, there: &Self, found: &mut dyn FnMut(Difference)) {
        compare::differences(self, there, found);
    }
}

/// Appends the bits of a number.
fn number(bytes: &mut Vec<u8>, value: f32) {
    bytes.extend_from_slice(&value.to_bits().to_le_bytes());
}
