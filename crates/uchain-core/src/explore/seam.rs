//! What an explorer may know, say and ask: estimated poses, its scans, and what the others say.

use alloc::vec::Vec;

use super::Sector;

/// A place in the plane, in the team's inertial frame.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Point {
    /// Along the inertial x axis (m).
    pub x_m: f32,
    /// Along the inertial y axis (m).
    pub y_m: f32,
}

impl Point {
    /// Places lie within this distance of the origin along each axis (m): beyond, `f32` cannot tell a robot's
    /// length, and a robot that says it is there is not believed.
    pub const LIMIT_M: f32 = 1.0e5;

    /// Straight distance (m).
    pub fn distance_m(self, other: Self) -> f32 {
        libm::sqrtf(self.distance2_m2(other))
    }

    /// Its square (m²).
    pub(crate) fn distance2_m2(self, other: Self) -> f32 {
        let (dx, dy) = (other.x_m - self.x_m, other.y_m - self.y_m);
        dx * dx + dy * dy
    }

    /// Whether both numbers are within [`Self::LIMIT_M`], which no NaN is.
    pub fn is_sound(self) -> bool {
        self.x_m.abs() <= Self::LIMIT_M && self.y_m.abs() <= Self::LIMIT_M
    }
}

/// Where a robot believes it is.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Pose {
    /// Its place.
    pub at: Point,
    /// Its heading from the inertial x axis, counter-clockwise (rad).
    pub heading_rad: f32,
}

/// The name of a node: the j-th of robot i, `q_ij` in Kim 2021, both counted from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct NodeId {
    /// Robot that scanned there.
    pub robot: u16,
    /// How many nodes it had before.
    pub number: u32,
}

/// All a robot may know by itself at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Observation<'a> {
    /// Its pose as its localisation has it.
    pub pose: Pose,
    /// Its body is where the last command asked for; true before the first.
    pub arrived: bool,
    /// A scan made here, if the last command asked for one, and before the first: per sector the distance
    /// to the nearest point, within the closed cone of that sector, of the obstacles grown by `r_body_m` (m), or
    /// `None` if no such point is within `r_s_m`. A distance that is not finite counts as 0.
    pub scan: Option<&'a [Option<f32>]>,
}

/// Why a robot flies, or does not.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Purpose {
    /// To a new node, along a frontier.
    Explore,
    /// Along the graph to a node with frontiers, one edge at a time.
    Backtrack,
    /// Along the graph to its first node.
    Home,
    /// It stays: it is home and knows of no frontier it can reach.
    Park,
    /// It stays: it has not scanned yet, or knows no way.
    Wait,
}

impl Purpose {
    /// In a word, for programs.
    pub fn word(self) -> &'static str {
        match self {
            Self::Explore => "explore",
            Self::Backtrack => "backtrack",
            Self::Home => "home",
            Self::Park => "park",
            Self::Wait => "wait",
        }
    }
}

/// What a robot is about to fly, in the same instant as all others.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Target {
    /// Who.
    pub robot: u16,
    /// Why.
    pub purpose: Purpose,
    /// The hub at the end of the way, if it is backtracking.
    pub hub: Option<NodeId>,
    /// Start of the move, where it believes it is.
    pub from: Point,
    /// End of the move; the start, for a stay.
    pub to: Point,
    /// Level it has flown on so far.
    pub level: u16,
}

/// A node as its robot has scanned it, with what is known of it by now.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct NodeReport {
    /// Its name.
    pub id: NodeId,
    /// Where the robot believed it scanned.
    pub at: Point,
    /// The node it was reached from; `None` for a robot's first.
    pub flown_from: Option<NodeId>,
    /// Label and radius of every sector (Kim 2021, Eq. 1).
    pub sectors: Vec<Sector>,
}

/// Arcs that are no frontiers any more, whatever their mid-points say: flown along, or leading nowhere new.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SpentReport {
    /// The node.
    pub node: NodeId,
    /// Its one or two sectors; twice the same for one.
    pub sectors: [u16; 2],
}

/// What one robot says to all that hear it.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Message {
    /// Where it believes it is.
    Pose {
        /// Who.
        robot: u16,
        /// Where.
        at: Point,
    },
    /// A node it knows.
    Node(NodeReport),
    /// Arcs that are spent.
    Spent(SpentReport),
    /// What it is about to fly.
    Target(Target),
}

/// All an explorer may ask of its body for one move.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Command {
    /// Where to fly, straight; the place it is at, to stay.
    pub to: Point,
    /// Heading to have there (rad): that of the move.
    pub heading_rad: f32,
    /// Level to be on there; the height changes along the move.
    pub level: u16,
    /// Height of that level (m).
    pub z_m: f32,
    /// Whether a scan is wanted there.
    pub scan: bool,
    /// It flies on another level than the usual one for Kim 2021, §6.2, which counts as time by MFL.
    pub mfl: bool,
    /// It stays this round to let another one pass ("srg" only).
    pub hold: bool,
}
