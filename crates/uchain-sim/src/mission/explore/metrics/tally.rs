//! The summary of an exploration, from its frames.

use std::sync::Arc;

use glam::{DVec3, Vec2};

use super::gaps::Gaps;
use crate::mission::explore::{Coverage, ExploreSummary, Unseen, Width, width_but_for_m};
use crate::{
    analyse::{Outcome, Verdict},
    clock::time_s,
    mission::{
        self, Stopped,
        explore::{Exploration, ExploreFrame, RobotFrame, Site, Way},
    },
    record::{RecordError, Recorder},
};

/// Share of the ground that may be left unseen when it is said what to set (1).
const LEFT: f64 = 0.005;

/// Watches an exploration and sums it up. Memory: one entry per cell of the ground, and one per round with new nodes.
#[derive(Debug)]
pub struct ExploreMetrics {
    site: Arc<Site>,
    coverage: Coverage,
    /// Times (s) and coverage (1), from each round with new nodes on.
    curve: Vec<(f64, f64)>,
    robots: Vec<Tally>,
    gaps: Gaps,
    nodes: Vec<u32>,
    edges: u32,
    hubs: u32,
    rounds: u32,
    mfl_ticks: u64,
    time_s: f64,
    stopped: Option<Stopped>,
}

/// What one robot has flown.
#[derive(Debug, Clone, Copy)]
struct Tally {
    way: Way,
    moves: u32,
    holds: u32,
    wall_contacts: u32,
    robot_contacts: u32,
    level_passes: u32,
}

/// What was seen, and when.
#[derive(Debug, Clone)]
pub struct Survey {
    /// Times (s) and the share of the reachable ground seen by then (1), in order.
    pub curve: Vec<(f64, f64)>,
    /// Which cells of the ground have been seen.
    pub coverage: Coverage,
}

fn place(robot: &RobotFrame) -> DVec3 {
    DVec3::new(robot.x_m.into(), robot.y_m.into(), robot.z_m.into())
}

impl ExploreMetrics {
    /// For a run on this site.
    pub fn new(site: Arc<Site>) -> Self {
        let (team, params) = (&site.scenario.team, &site.scenario.params);
        Self {
            coverage: Coverage::new(site.ground(), params.r_s_m),
            curve: Vec::new(),
            robots: Vec::new(),
            gaps: Gaps::new(team.robots, params.r_body_m, team.downwash_radius_m),
            nodes: vec![0; usize::from(team.robots)],
            edges: 0,
            hubs: 0,
            rounds: 0,
            mfl_ticks: 0,
            time_s: 0.0,
            stopped: None,
            site,
        }
    }

    /// Share of the reachable ground that has been seen so far (1).
    pub fn coverage(&self) -> f64 {
        self.coverage.share(self.site.ground())
    }

    /// What was seen so far.
    pub fn survey(&self) -> Survey {
        Survey { curve: self.curve.clone(), coverage: self.coverage.clone() }
    }

    /// What it has come to so far.
    pub fn summary(&self, seed: u64, digest: String) -> ExploreSummary {
        let ground = self.site.ground();
        let mut unseen = self.coverage.unseen(&self.site.map, ground);
        let unseen_m2 = unseen.iter().map(|piece| piece.area_m2).sum();
        let unseen_behind_m2 = unseen.iter().map(|piece| piece.behind_m2).sum();
        let verdict = self.verdict(self.coverage.share(ground), &unseen);
        unseen.truncate(ExploreSummary::UNSEEN_MAX);
        let distance_m: Vec<f64> = self.robots.iter().map(|robot| robot.way.over_ground_m()).collect();
        let longest_m = distance_m.iter().copied().fold(0.0, f64::max);
        let shortest_m = distance_m.iter().copied().fold(f64::INFINITY, f64::min);
        let coverage = self.coverage.share(ground);
        let when = |share: f64| {
            let reached = self.curve.iter().find(|(_, seen)| *seen >= share);
            reached.map(|(time_s, _)| *time_s)
        };
        let mut gaps = self.gaps.gaps();
        gaps.truncate(ExploreSummary::GAPS_MAX);
        let scenario = &self.site.scenario;
        ExploreSummary {
            scenario: scenario.name.clone(),
            seed,
            strategy: scenario.params.strategy,
            robots: scenario.team.robots,
            vehicle: scenario.team.vehicle,
            stopped: self.stopped,
            verdict,
            sim_s: self.time_s,
            iterations: self.rounds,
            moves: self.robots.iter().map(|robot| robot.moves).collect(),
            holds: self.robots.iter().map(|robot| robot.holds).collect(),
            balance: (longest_m > 0.0 && distance_m.len() > 1).then(|| shortest_m / longest_m),
            distance_m,
            distance_3d_m: self.robots.iter().map(|robot| robot.way.length_m()).collect(),
            mfl_s: time_s(self.mfl_ticks),
            coverage,
            coverage_t50_s: when(0.5),
            coverage_t90_s: when(0.9),
            coverage_t100_s: when(1.0),
            overlap: self.coverage.overlap(),
            nodes: self.nodes.clone(),
            edges: self.edges,
            hubs_left: self.hubs,
            unseen_m2,
            unseen_behind_m2,
            unseen,
            shut_off_m2: ground.shut_off_m2(),
            wall_contacts: self.robots.iter().map(|robot| robot.wall_contacts).sum(),
            robot_contacts: self.robots.iter().map(|robot| robot.robot_contacts).sum::<u32>() / 2,
            level_passes: self.robots.iter().map(|robot| robot.level_passes).sum::<u32>() / 2,
            downwash_s: self.gaps.downwash_s(),
            gaps,
            digest,
        }
    }

    /// What came, of all that could be reached.
    fn verdict(&self, seen: f64, unseen: &[Unseen]) -> Verdict {
        let (hubs, at_s, after_s) = (self.hubs, self.time_s, self.site.scenario.duration_s);
        let found = match self.stopped {
            None => Some(Outcome::Interrupted { at_s, of_s: None }),
            Some(Stopped::Explored) => self.unseen(seen, unseen),
            Some(Stopped::Unreachable) => Some(Outcome::Unreachable { seen, hubs }),
            Some(Stopped::Full) => Some(Outcome::Full { seen, hubs }),
            Some(Stopped::Stuck) => Some(Outcome::Stuck { seen, at_s }),
            Some(Stopped::Time) => Some(Outcome::TimeUp { seen, after_s }),
        };
        Verdict::new(Outcome::Explored { seen }, found.into_iter().collect(), Vec::new())
    }

    /// What no frontier leads to; `None` if it is next to nothing.
    fn unseen(&self, seen: f64, unseen: &[Unseen]) -> Option<Outcome> {
        let largest = unseen.first().filter(|_| seen < ExploreSummary::EXPLORED)?;
        let ground = self.site.ground();
        let width = Width::seen(&self.site.scenario.params);
        let parts = unseen.iter().filter_map(|piece| Some((piece.passage_m? as f32, piece.behind_m2)));
        let parts: Vec<(f32, f64)> = parts.collect();
        let behind_m2: f64 = parts.iter().map(|(_, behind_m2)| behind_m2).sum();
        let remedy = match width_but_for_m(parts, LEFT * ground.area_m2()) {
            Some(width_m) => width.remedy(width_m, ground.area_m2()),
            None => width.finer(),
        };
        Some(Outcome::Unseen {
            seen,
            behind: behind_m2 / ground.area_m2(),
            narrow_m: width.least_m.into(),
            piece_m: [largest.x_m, largest.y_m],
            piece_m2: largest.area_m2,
            remedy,
        })
    }

    fn decision(&mut self, frame: &ExploreFrame) {
        for node in &frame.nodes {
            self.coverage.look(&self.site.map, self.site.ground(), node);
            if let Some(count) = self.nodes.get_mut(usize::from(node.id.robot)) {
                *count += 1;
            }
        }
        if !frame.nodes.is_empty() {
            self.curve.push((frame.decided_s(), self.coverage.share(self.site.ground())));
        }
        self.edges += frame.edges.len() as u32;
        self.hubs = frame.hubs;
        for (tally, robot) in self.robots.iter_mut().zip(&frame.robots) {
            tally.moves += u32::from(robot.moves);
            tally.holds += u32::from(robot.holds);
        }
    }
}

impl Recorder<ExploreFrame> for ExploreMetrics {
    fn frame(&mut self, frame: &ExploreFrame) -> Result<(), RecordError> {
        let at_rest = |robot: &RobotFrame| Tally {
            way: Way::from(place(robot)),
            moves: 0,
            holds: 0,
            wall_contacts: 0,
            robot_contacts: 0,
            level_passes: 0,
        };
        if self.robots.is_empty() {
            self.robots = frame.robots.iter().map(at_rest).collect();
            for ((tally, node), robot) in self.robots.iter_mut().zip(&frame.nodes).zip(&frame.robots) {
                tally.way = Way::from(Vec2::from(node.at_m).as_dvec2().extend(robot.z_m.into()));
            }
        }
        if frame.decision {
            self.decision(frame);
        }
        for (tally, robot) in self.robots.iter_mut().zip(&frame.robots) {
            tally.way.go(place(robot), frame.decision);
            (tally.wall_contacts, tally.robot_contacts) = (robot.wall_contacts, robot.robot_contacts);
            tally.level_passes = robot.level_passes;
        }
        self.gaps.look(&frame.robots);
        self.rounds = frame.rounds;
        self.mfl_ticks += u64::from(frame.robots.iter().any(|robot| robot.mfl));
        // The last tick of an exploration that is over belongs to nobody.
        self.time_s = if frame.stopped.is_some_and(|why| why != Stopped::Time) {
            frame.decided_s()
        } else {
            frame.time_s()
        };
        self.stopped = frame.stopped;
        Ok(())
    }
}

impl mission::Metrics for ExploreMetrics {
    type Mission = Exploration;

    fn of(site: Arc<Site>) -> Self {
        Self::new(site)
    }

    fn sum_up(&self, seed: u64, digest: String) -> ExploreSummary {
        self.summary(seed, digest)
    }
}
