//! Why a store does not take in what a robot says.

use super::Point;

/// Why a message was not taken in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Refusal {
    /// There are as many nodes or connections as there may be.
    Full {
        /// How many nodes there are.
        nodes: usize,
    },
    /// A robot that the team does not have.
    Stranger {
        /// Its index.
        robot: u16,
        /// How many robots the team has.
        robots: usize,
    },
    /// A node with another number of sectors than all others.
    Sectors {
        /// How many it has.
        got: usize,
        /// How many it should have.
        want: usize,
    },
    /// A place farther away than [`Point::LIMIT_M`], or none.
    Place,
}

impl core::fmt::Display for Refusal {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Full { nodes } => write!(f, "the map is full at {nodes} nodes"),
            Self::Stranger { robot, robots } => write!(f, "robot {robot} speaks in a team of {robots}"),
            Self::Sectors { got, want } => write!(f, "a star of {got} sectors, where all others have {want}"),
            Self::Place => write!(f, "a place beyond {} m", Point::LIMIT_M),
        }
    }
}

impl core::error::Error for Refusal {}
