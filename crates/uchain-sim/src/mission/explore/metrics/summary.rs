//! The numbers an exploration is judged by.

use serde::Serialize;
use uchain_core::explore::StrategyKind;

use crate::mission::explore::{Gap, Unseen};
use crate::{
    analyse::Verdict,
    mission::{self, Stopped, explore::VehicleKind},
};

/// What one exploration came to. A function of (scenario, seed): nothing here is measured by a clock.
///
/// *Coverage* is the share of the reachable ground ([`Ground`](crate::mission::explore::Ground)) within `r_s_m` and in line of sight of
/// a node. Its times are those at which a share of that ground had been seen.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ExploreSummary {
    /// The scenario's name.
    pub scenario: String,
    /// The seed.
    pub seed: u64,
    /// Who chose where to fly.
    pub strategy: StrategyKind,
    /// Robots.
    pub robots: u16,
    /// What flew.
    pub vehicle: VehicleKind,
    /// Why it ended, which in files the outcome says; `None` of one that is known up to somewhere in the middle.
    #[serde(skip)]
    pub stopped: Option<Stopped>,
    /// What was asked and what came; in files the two fields `outcome`, a word, and `verdict`, words with numbers.
    #[serde(flatten)]
    pub verdict: Verdict,
    /// Simulated time until all were home, or it ended otherwise (s).
    pub sim_s: f64,
    /// Rounds, homing included (Kim 2021, §7.2).
    pub iterations: u32,
    /// Rounds in which a robot flew to another place, by robot.
    pub moves: Vec<u32>,
    /// Rounds in which a robot held for another one, by robot.
    pub holds: Vec<u32>,
    /// Way over ground, by robot (m).
    pub distance_m: Vec<f64>,
    /// Way through the air, climbs included, by robot (m).
    pub distance_3d_m: Vec<f64>,
    /// Time in which any robot flew on another level than the usual one to keep clear of others (s).
    pub mfl_s: f64,
    /// Share of the reachable ground that was seen (1).
    pub coverage: f64,
    /// When half of the reachable ground had been seen (s); `None` if that never was.
    pub coverage_t50_s: Option<f64>,
    /// When nine tenths of it had been seen (s); `None` if that never was.
    pub coverage_t90_s: Option<f64>,
    /// When all of it, every cell, had been seen (s); `None` if that never was, as is common: stars end short of corners.
    pub coverage_t100_s: Option<f64>,
    /// Share of the seen ground that nodes of more than one robot saw (1).
    pub overlap: f64,
    /// Shortest over longest way over ground of any robot (1); `None` if nobody moved, or there is only one.
    pub balance: Option<f64>,
    /// Nodes, by robot.
    pub nodes: Vec<u32>,
    /// Edges of the roadmap.
    pub edges: u32,
    /// Nodes with a frontier that were left.
    pub hubs_left: u32,
    /// Area of the reachable ground that nobody saw (m²).
    pub unseen_m2: f64,
    /// Of that, what lies in or behind passages narrower than stars surely look through (m²); see
    /// [`Width`](crate::mission::explore::Width).
    pub unseen_behind_m2: f64,
    /// Its pieces, the largest first; at most [`ExploreSummary::UNSEEN_MAX`].
    pub unseen: Vec<Unseen>,
    /// Free ground that robots of this radius cannot get to, for the ways there are too narrow; it does not count for
    /// coverage (m²).
    pub shut_off_m2: f64,
    /// Wall contacts begun.
    pub wall_contacts: u32,
    /// Contacts between robots on one level begun: nearer over ground than two radii.
    pub robot_contacts: u32,
    /// Times that two robots, one of which changed its level, came nearer through the air than two radii. Kim 2021
    /// chooses levels for the end of a move, not for the way there.
    pub level_passes: u32,
    /// Time in the downwash of any other robot, by robot (s); see [`Gap`].
    pub downwash_s: Vec<f64>,
    /// How near robots came to each other, pair by pair, the nearest first; at most [`ExploreSummary::GAPS_MAX`].
    pub gaps: Vec<Gap>,
    /// Hash over every bit of every frame, 16 hex digits.
    pub digest: String,
}

impl ExploreSummary {
    /// Share of the reachable ground that has to be seen to call it explored (1).
    pub const EXPLORED: f64 = 0.99;

    /// Most unseen pieces that are listed.
    pub const UNSEEN_MAX: usize = 20;

    /// Most pairs of robots that are listed.
    pub const GAPS_MAX: usize = 200;

    /// Mean way over ground of a robot (m).
    pub fn distance_mean_m(&self) -> f64 {
        self.distance_m.iter().sum::<f64>() / self.distance_m.len().max(1) as f64
    }
}

impl mission::Summary for ExploreSummary {
    fn verdict(&self) -> &Verdict {
        &self.verdict
    }

    fn digest(&self) -> &str {
        &self.digest
    }
}
