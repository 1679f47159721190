//! Messages of an exploration.

use uchain_core::explore::{Label, NodeId, Purpose, Sector};

use crate::mission::explore::{ExploreFrame, LabelFrame, NodeFrame, Progress, RobotFrame, Stopped};
use crate::record::mcap::{Recordable, alike, bounded, few, number, set, small, word};

/// Words by their numbers in `uchain.proto`.
const PURPOSES: [Purpose; 5] =
    [Purpose::Explore, Purpose::Backtrack, Purpose::Home, Purpose::Park, Purpose::Wait];
const LABELS: [Label; 3] = [Label::Obstacle, Label::Free, Label::Frontier];
const STOPPED: [Stopped; 5] =
    [Stopped::Explored, Stopped::Unreachable, Stopped::Full, Stopped::Stuck, Stopped::Time];

/// `uchain.ExploreFrame`.
#[derive(Clone, PartialEq, prost::Message)]
pub struct ExploreFrameMessage {
    #[prost(uint64, tag = "1")]
    tick: u64,
    #[prost(uint32, tag = "2")]
    rounds: u32,
    #[prost(bool, tag = "3")]
    decision: bool,
    #[prost(float, repeated, tag = "4")]
    x_m: Vec<f32>,
    #[prost(float, repeated, tag = "5")]
    y_m: Vec<f32>,
    #[prost(float, repeated, tag = "6")]
    z_m: Vec<f32>,
    #[prost(float, repeated, tag = "7")]
    heading_rad: Vec<f32>,
    #[prost(uint32, repeated, tag = "8")]
    level: Vec<u32>,
    #[prost(uint32, repeated, tag = "9")]
    purpose: Vec<u32>,
    #[prost(bool, repeated, tag = "10")]
    moves: Vec<bool>,
    #[prost(bool, repeated, tag = "11")]
    holds: Vec<bool>,
    #[prost(bool, repeated, tag = "12")]
    mfl: Vec<bool>,
    #[prost(uint32, repeated, tag = "13")]
    wall_contacts: Vec<u32>,
    #[prost(uint32, repeated, tag = "14")]
    robot_contacts: Vec<u32>,
    #[prost(uint32, repeated, tag = "15")]
    level_passes: Vec<u32>,
    #[prost(uint32, repeated, tag = "16")]
    node_robot: Vec<u32>,
    #[prost(uint32, repeated, tag = "17")]
    node_number: Vec<u32>,
    #[prost(float, repeated, tag = "18")]
    node_at_m: Vec<f32>,
    #[prost(float, repeated, tag = "19")]
    node_believed_m: Vec<f32>,
    #[prost(uint32, repeated, tag = "20")]
    sector_label: Vec<u32>,
    #[prost(float, repeated, tag = "21")]
    sector_r_m: Vec<f32>,
    #[prost(uint32, repeated, tag = "22")]
    label_robot: Vec<u32>,
    #[prost(uint32, repeated, tag = "23")]
    label_number: Vec<u32>,
    #[prost(uint32, repeated, tag = "24")]
    label_sector: Vec<u32>,
    #[prost(uint32, repeated, tag = "25")]
    label: Vec<u32>,
    #[prost(uint32, repeated, tag = "26")]
    edge_robot: Vec<u32>,
    #[prost(uint32, repeated, tag = "27")]
    edge_number: Vec<u32>,
    #[prost(uint32, tag = "28")]
    hubs: u32,
    #[prost(uint32, tag = "29")]
    stopped: u32,
}

/// `uchain.ExploreMetrics`.
#[derive(Clone, Copy, PartialEq, prost::Message)]
pub(super) struct ExploreMetricsMessage {
    #[prost(uint32, tag = "1")]
    rounds: u32,
    #[prost(uint32, tag = "2")]
    nodes: u32,
    #[prost(uint32, tag = "3")]
    edges: u32,
    #[prost(uint32, tag = "4")]
    hubs: u32,
    #[prost(uint32, tag = "5")]
    moving: u32,
    #[prost(double, tag = "6")]
    distance_m: f64,
    #[prost(uint32, tag = "7")]
    wall_contacts: u32,
    #[prost(uint32, tag = "8")]
    robot_contacts: u32,
}

impl From<Progress> for ExploreMetricsMessage {
    fn from(now: Progress) -> Self {
        let Progress { rounds, nodes, edges, hubs, moving, distance_m, .. } = now;
        let (wall_contacts, robot_contacts) = (now.wall_contacts, now.robot_contacts);
        Self { rounds, nodes, edges, hubs, moving, distance_m, wall_contacts, robot_contacts }
    }
}

impl ExploreFrameMessage {
    /// Takes a frame's values.
    fn fill(&mut self, frame: &ExploreFrame) {
        let ExploreFrame { tick, rounds, decision, robots, nodes, labels, edges, hubs, stopped } = frame;
        (self.tick, self.rounds, self.decision, self.hubs) = (*tick, *rounds, *decision, *hubs);
        self.stopped = stopped.map_or(0, |why| number(&STOPPED, why) + 1);
        set(&mut self.x_m, robots.iter().map(|robot| robot.x_m));
        set(&mut self.y_m, robots.iter().map(|robot| robot.y_m));
        set(&mut self.z_m, robots.iter().map(|robot| robot.z_m));
        set(&mut self.heading_rad, robots.iter().map(|robot| robot.heading_rad));
        set(&mut self.level, robots.iter().map(|robot| robot.level.into()));
        set(&mut self.purpose, robots.iter().map(|robot| number(&PURPOSES, robot.purpose)));
        set(&mut self.moves, robots.iter().map(|robot| robot.moves));
        set(&mut self.holds, robots.iter().map(|robot| robot.holds));
        set(&mut self.mfl, robots.iter().map(|robot| robot.mfl));
        set(&mut self.wall_contacts, robots.iter().map(|robot| robot.wall_contacts));
        set(&mut self.robot_contacts, robots.iter().map(|robot| robot.robot_contacts));
        set(&mut self.level_passes, robots.iter().map(|robot| robot.level_passes));
        set(&mut self.node_robot, nodes.iter().map(|node| node.id.robot.into()));
        set(&mut self.node_number, nodes.iter().map(|node| node.id.number));
        set(&mut self.node_at_m, nodes.iter().flat_map(|node| node.at_m));
        set(&mut self.node_believed_m, nodes.iter().flat_map(|node| node.believed_m));
        let sectors = || nodes.iter().flat_map(|node| &node.sectors);
        set(&mut self.sector_label, sectors().map(|sector| number(&LABELS, sector.label)));
        set(&mut self.sector_r_m, sectors().map(|sector| sector.r_m));
        set(&mut self.label_robot, labels.iter().map(|change| change.node.robot.into()));
        set(&mut self.label_number, labels.iter().map(|change| change.node.number));
        set(&mut self.label_sector, labels.iter().map(|change| change.sector.into()));
        set(&mut self.label, labels.iter().map(|change| number(&LABELS, change.label)));
        set(&mut self.edge_robot, edges.iter().flatten().map(|end| end.robot.into()));
        set(&mut self.edge_number, edges.iter().flatten().map(|end| end.number));
    }

    fn pour(&self, frame: &mut ExploreFrame) -> Result<(), String> {
        self.check()?;
        (frame.tick, frame.rounds, frame.decision) = (self.tick, self.rounds, self.decision);
        frame.hubs = self.hubs;
        frame.stopped = match self.stopped {
            0 => None,
            why => Some(word("stopped", &STOPPED, why - 1)?),
        };
        frame.robots.clear();
        for i in 0..self.x_m.len() {
            frame.robots.extend(self.robot(i)?);
        }
        frame.nodes.clear();
        let nodes = self.node_robot.len();
        let sectors = self.sector_label.len().checked_div(nodes).unwrap_or(0);
        for i in 0..nodes {
            frame.nodes.extend(self.node(i, sectors)?);
        }
        frame.labels.clear();
        for i in 0..self.label.len() {
            frame.labels.extend(self.change(i)?);
        }
        frame.edges.clear();
        for i in 0..self.edge_robot.len() / 2 {
            let ends = [self.end(2 * i)?, self.end(2 * i + 1)?];
            if let [Some(a), Some(b)] = ends {
                frame.edges.push([a, b]);
            }
        }
        Ok(())
    }

    // Lists are of like length: `None` comes from none of them.
    fn robot(&self, i: usize) -> Result<Option<RobotFrame>, String> {
        let (Some(&purpose), Some(&level)) = (self.purpose.get(i), self.level.get(i)) else {
            return Ok(None);
        };
        let (purpose, level) = (word("purpose", &PURPOSES, purpose)?, small("level", level)?);
        let robot = || {
            Some(RobotFrame {
                x_m: *self.x_m.get(i)?,
                y_m: *self.y_m.get(i)?,
                z_m: *self.z_m.get(i)?,
                heading_rad: *self.heading_rad.get(i)?,
                level,
                purpose,
                moves: *self.moves.get(i)?,
                holds: *self.holds.get(i)?,
                mfl: *self.mfl.get(i)?,
                wall_contacts: *self.wall_contacts.get(i)?,
                robot_contacts: *self.robot_contacts.get(i)?,
                level_passes: *self.level_passes.get(i)?,
            })
        };
        Ok(robot())
    }

    fn node(&self, i: usize, sectors: usize) -> Result<Option<NodeFrame>, String> {
        let (Some(&robot), Some(&number)) = (self.node_robot.get(i), self.node_number.get(i)) else {
            return Ok(None);
        };
        let id = NodeId { robot: small("node_robot", robot)?, number };
        let pair = |list: &[f32]| Some([*list.get(2 * i)?, *list.get(2 * i + 1)?]);
        let (Some(at_m), Some(believed_m)) = (pair(&self.node_at_m), pair(&self.node_believed_m)) else {
            return Ok(None);
        };
        let its = i * sectors..(i + 1) * sectors;
        let (labels, radii) = (self.sector_label.get(its.clone()), self.sector_r_m.get(its));
        let pairs = labels.unwrap_or_default().iter().zip(radii.unwrap_or_default());
        let sector = |(&label, &r_m)| Ok(Sector { label: word("sector_label", &LABELS, label)?, r_m });
        Ok(Some(NodeFrame {
            id,
            at_m,
            believed_m,
            sectors: pairs.map(sector).collect::<Result<_, String>>()?,
        }))
    }

    fn change(&self, i: usize) -> Result<Option<LabelFrame>, String> {
        let change = (self.label_robot.get(i), self.label_number.get(i), self.label_sector.get(i));
        let ((Some(&robot), Some(&number), Some(&sector)), Some(&label)) = (change, self.label.get(i)) else {
            return Ok(None);
        };
        let node = NodeId { robot: small("label_robot", robot)?, number };
        let label = word("label", &LABELS, label)?;
        Ok(Some(LabelFrame { node, sector: small("label_sector", sector)?, label }))
    }

    fn end(&self, i: usize) -> Result<Option<NodeId>, String> {
        let (Some(&robot), Some(&number)) = (self.edge_robot.get(i), self.edge_number.get(i)) else {
            return Ok(None);
        };
        Ok(Some(NodeId { robot: small("edge_robot", robot)?, number }))
    }

    fn check(&self) -> Result<(), String> {
        let robots = self.x_m.len();
        if robots > usize::from(u16::MAX) {
            return Err(format!("{robots} robots: expected at most {}", u16::MAX));
        }
        let lengths = [
            ("y_m", self.y_m.len()),
            ("z_m", self.z_m.len()),
            ("heading_rad", self.heading_rad.len()),
            ("level", self.level.len()),
            ("purpose", self.purpose.len()),
            ("moves", self.moves.len()),
            ("holds", self.holds.len()),
            ("mfl", self.mfl.len()),
            ("wall_contacts", self.wall_contacts.len()),
            ("robot_contacts", self.robot_contacts.len()),
            ("level_passes", self.level_passes.len()),
        ];
        alike(robots, "x_m", &lengths)?;
        let nodes = self.node_robot.len();
        alike(nodes, "node_robot", &[("node_number", self.node_number.len())])?;
        let pairs = [("node_at_m", self.node_at_m.len()), ("node_believed_m", self.node_believed_m.len())];
        alike(2 * nodes, "node_robot, times two", &pairs)?;
        let sectors = self.sector_label.len();
        alike(sectors, "sector_label", &[("sector_r_m", self.sector_r_m.len())])?;
        if sectors.checked_rem(nodes).unwrap_or(sectors) != 0 {
            return Err(format!("{sectors} sectors of {nodes} nodes: expected as many of each"));
        }
        let changes = [
            ("label_number", self.label_number.len()),
            ("label_sector", self.label_sector.len()),
            ("label", self.label.len()),
        ];
        alike(self.label_robot.len(), "label_robot", &changes)?;
        alike(self.edge_robot.len(), "edge_robot", &[("edge_number", self.edge_number.len())])?;
        if !self.edge_robot.len().is_multiple_of(2) {
            return Err(format!("edge_robot has {} entries: expected two per edge", self.edge_robot.len()));
        }
        bounded(&[
            ("x_m", &self.x_m),
            ("y_m", &self.y_m),
            ("z_m", &self.z_m),
            ("heading_rad", &self.heading_rad),
            ("node_at_m", &self.node_at_m),
            ("node_believed_m", &self.node_believed_m),
            ("sector_r_m", &self.sector_r_m),
        ])?;
        few(&[
            ("wall_contacts", &self.wall_contacts),
            ("robot_contacts", &self.robot_contacts),
            ("level_passes", &self.level_passes),
        ])
    }
}

impl Recordable for ExploreFrame {
    type Message = ExploreFrameMessage;
    const PROTO: &'static str = crate::mission::PROTO;
    const MESSAGE: &'static str = "ExploreFrame";

    fn take(&mut self, message: &ExploreFrameMessage) -> Result<(), String> {
        message.pour(self)
    }

    fn fill(&self, message: &mut ExploreFrameMessage) {
        message.fill(self);
    }
}
