//! A team of robots that explores an unknown building (Kim 2021). One tick: sense, decide, act, advance, record.
//!
//! Robots sense and decide in rounds that all begin together: when the last one has arrived, and has looked around for
//! [`TeamConfig::scan_s`]. In between they fly.

mod config;
mod events;
mod extensions;
mod frame;
mod ground;
mod logbook;
#[cfg(feature = "record")]
mod mcap;
mod metrics;
#[cfg(feature = "draw")]
mod picture;
mod scene;
mod shown;
mod start;
mod team;

use std::{convert::Infallible, sync::Arc};

use glam::Vec2;
use uchain_core::{
    explore::{Command, Point, Pose},
    params::OutOfRange,
};

use super::{Mission, Stopped};

use crate::{
    clock::{total_ticks, whole_ticks},
    radio::Antenna,
    seed::{Seed, Source, Stream},
    sense::Scanner,
    world::{Waypoint, World},
};

pub use config::{ExploreScenario, TeamConfig, VehicleKind};
pub use extensions::SiteExtensions;
pub use frame::{ExploreFrame, LabelFrame, NodeFrame, Progress, RobotFrame};
pub(crate) use frame::{Odometer, Way};
pub(crate) use ground::width_but_for_m;
pub use ground::{Coverage, Ground, Passage, Passages, RosMap, Unseen, Width};
#[cfg(feature = "record")]
pub use mcap::{ExploreRecorder, ExploreTopics};
pub use metrics::{
    ExploreHistory, ExploreMetrics, ExploreSummary, ExploreTimeline, Gap, Moment, States, Survey,
};
#[cfg(feature = "draw")]
pub use picture::{explore_picture, explore_png, states_png};
pub use scene::Site;
pub use shown::Rounds;
pub use team::Team;

use start::{at_rest, starts, world};

/// What one robot may know at one instant.
#[derive(Debug, Clone, PartialEq)]
pub struct Observation {
    /// Where it believes it is, as of the begin of the round.
    pub pose: Pose,
    /// Whether a round begins at this instant: all robots have arrived and looked around. Only then there is anything to
    /// decide.
    pub arrived: bool,
    /// Returns of the scan it asked for, one per sector (m; `None` without one); `None` if it asked for none. Empty until a
    /// round begins.
    pub scan: Option<Vec<Option<f32>>>,
}

/// An exploration under way.
#[derive(Debug)]
pub struct Exploration {
    site: Arc<Site>,
    team: Team,
    world: World,
    scanner: Scanner,
    /// Noise of where robots believe they are.
    noise: Vec<Stream>,
    seen: Vec<Observation>,
    /// Where robots stood when the round began.
    stood: Vec<Vec2>,
    /// Room for what the team decides.
    commands: Vec<Command>,
    tick: u64,
    rounds: u32,
    /// Whether what was sensed is of this very tick.
    has_sensed: bool,
    /// Whether a round begins at this tick.
    decision: bool,
    /// Why nobody has anything left to do.
    over: Option<Stopped>,
    /// Whether robots look around where they come to.
    scanning: bool,
    /// Tick at which all have looked around; `None` while somebody flies.
    ready: Option<u64>,
    last_tick: u64,
    frame: ExploreFrame,
}

impl Mission for Exploration {
    type Scene = Site;
    type Observation = Observation;
    type Command = Command;
    type Input = Infallible;
    type Frame = ExploreFrame;
    type Metrics = ExploreMetrics;
    type Summary = ExploreSummary;

    fn start(site: Arc<Site>, seed: u64) -> Self {
        let robots = usize::from(site.scenario.team.robots);
        let mut exploration = Self {
            team: Team::new(&site, Seed(seed)),
            world: world(&site, Seed(seed)),
            scanner: Scanner::new(&site.scenario.params),
            noise: Vec::with_capacity(robots),
            seen: Vec::with_capacity(robots),
            stood: Vec::with_capacity(robots),
            commands: Vec::with_capacity(robots),
            tick: 0,
            rounds: 0,
            has_sensed: false,
            decision: false,
            over: None,
            scanning: true,
            ready: None,
            last_tick: total_ticks(site.scenario.duration_s),
            frame: ExploreFrame::default(),
            site,
        };
        exploration.restart(Seed(seed));
        exploration
    }

    fn reset(&mut self, seed: u64) {
        self.team = Team::new(&self.site, Seed(seed));
        if self.world.reset(starts(&self.site, Seed(seed))).is_err() {
            self.world = world(&self.site, Seed(seed));
        }
        self.restart(Seed(seed));
    }

    fn scene(&self) -> &Arc<Site> {
        &self.site
    }

    fn steer(&mut self, input: Infallible) -> Result<(), OutOfRange> {
        match input {}
    }

    fn input_of(_: &ExploreFrame) -> Option<Infallible> {
        None
    }

    fn sense(&mut self) -> &[Observation] {
        self.look();
        &self.seen
    }

    fn decide(&mut self, commands: &mut Vec<Command>) {
        commands.clear();
        if !self.decision {
            return;
        }
        let antennas = self.stood.iter().zip(&self.seen);
        let antennas = antennas
            .zip(0_u16..)
            .map(|((&at, seen), i)| Antenna::flying(at, seen.pose.heading_rad).carried_by(i))
            .collect::<Vec<_>>();
        self.over = self.team.round(self.tick, &self.seen, &antennas);
        commands.extend_from_slice(self.team.commands());
    }

    fn act(&mut self, commands: &[Command]) -> Option<Stopped> {
        self.look();
        let decision = self.decision;
        if decision {
            // A round in which nobody has anything left to do is none.
            self.rounds += u32::from(self.over.is_none());
            self.fly(commands);
        }
        self.world.advance();
        self.tick += 1;
        self.has_sensed = false;
        let stopped = self.over.or((self.tick >= self.last_tick).then_some(Stopped::Time));
        self.fill_frame(commands, decision, stopped);
        stopped
    }

    fn frame(&self) -> &ExploreFrame {
        &self.frame
    }

    fn commands(&mut self) -> &mut Vec<Command> {
        &mut self.commands
    }
}

impl Exploration {
    /// Everything but team and bodies as it was before the first tick.
    fn restart(&mut self, seed: Seed) {
        let robots = 0..u32::from(self.site.scenario.team.robots);
        self.noise.clear();
        self.noise.extend(robots.map(|i| seed.stream(i, Source::Position)));
        self.seen.clear();
        let unseen = || Observation { pose: Pose::default(), arrived: false, scan: Some(Vec::new()) };
        self.seen.extend(self.world.bodies().iter().map(|_| unseen()));
        self.stood.clear();
        (self.tick, self.rounds, self.has_sensed, self.decision) = (0, 0, false, false);
        (self.over, self.scanning, self.ready) = (None, true, None);
        let mut robots = std::mem::take(&mut self.frame.robots);
        robots.clear();
        robots.extend(self.world.bodies().iter().map(|body| at_rest(body.pose())));
        self.frame = ExploreFrame { robots, ..ExploreFrame::default() };
    }

    /// The team, for whoever checks on what it knows.
    pub fn team(&self) -> &Team {
        &self.team
    }

    /// Whether a round begins: all are there, and have looked around.
    fn is_ready(&mut self) -> bool {
        if !self.world.has_arrived() {
            return false;
        }
        let scan_ticks = if self.scanning { whole_ticks(self.site.scenario.team.scan_s) } else { 0 };
        let ready = *self.ready.get_or_insert(self.tick + scan_ticks);
        self.tick >= ready
    }

    /// What every robot may know at this instant.
    fn look(&mut self) {
        if std::mem::replace(&mut self.has_sensed, true) {
            return;
        }
        self.decision = self.is_ready();
        self.seen.iter_mut().for_each(|seen| seen.arrived = self.decision);
        if !self.decision {
            return;
        }
        let sigma_m = self.site.scenario.team.position_sigma_m;
        self.stood.clear();
        for ((body, seen), noise) in self.world.stand().zip(&mut self.seen).zip(&mut self.noise) {
            self.stood.push(body.at);
            let off =
                if sigma_m > 0.0 { sigma_m * Vec2::new(noise.normal(), noise.normal()) } else { Vec2::ZERO };
            seen.pose = Pose { at: point(body.at + off), heading_rad: body.heading_rad };
            if let Some(returns_m) = &mut seen.scan {
                self.scanner.scan(&self.site.map, body.at, returns_m);
            }
        }
    }

    /// A robot flies as far and in the direction it has asked for, from where it stands.
    fn fly(&mut self, commands: &[Command]) {
        self.ready = None;
        self.scanning = false;
        for ((i, command), &from) in commands.iter().enumerate().zip(&self.stood) {
            let Some(Observation { pose, scan, .. }) = self.seen.get_mut(i) else { continue };
            let asked = Vec2::new(command.to.x_m - pose.at.x_m, command.to.y_m - pose.at.y_m);
            let at = if point(from) == pose.at { place(command.to) } else { from + asked };
            let to = Waypoint { at, z_m: command.z_m, heading_rad: command.heading_rad };
            let told = self.world.command(i, to.into());
            debug_assert_eq!(told, Ok(()), "one body flies to waypoints for every robot of the team");
            *scan = command.scan.then(Vec::new);
            self.scanning |= command.scan;
        }
    }

    fn fill_frame(&mut self, commands: &[Command], decision: bool, stopped: Option<Stopped>) {
        let frame = &mut self.frame;
        (frame.tick, frame.rounds, frame.decision, frame.stopped) =
            (self.tick, self.rounds, decision, stopped);
        frame.nodes.clear();
        frame.labels.clear();
        frame.edges.clear();
        if decision {
            for (i, (robot, command)) in frame.robots.iter_mut().zip(commands).enumerate() {
                let Command { level, hold, mfl, to, .. } = *command;
                (robot.level, robot.holds, robot.mfl) = (level, hold, mfl);
                if let Some(target) = self.team.targets().get(i) {
                    (robot.purpose, robot.moves) = (target.purpose, to != target.from);
                }
            }
            let (whole, diff) = (self.team.whole(), self.team.diff());
            let count = whole.cones().count();
            for (slot, sectors) in diff.nodes.clone().zip(diff.sectors.chunks(count)) {
                let (Some(id), Some(at)) = (whole.id(slot), whole.at(slot)) else { continue };
                let believed_m = [at.x_m, at.y_m];
                let at_m = self.stood.get(usize::from(id.robot)).map_or(believed_m, Vec2::to_array);
                frame.nodes.push(NodeFrame { id, at_m, believed_m, sectors: sectors.to_vec() });
            }
            frame.labels.extend_from_slice(&diff.labels);
            frame.edges.extend_from_slice(&diff.edges);
            frame.hubs = whole.hub_count() as u32;
        }
        for (robot, body) in frame.robots.iter_mut().zip(self.world.bodies()) {
            (robot.x_m, robot.y_m, robot.z_m) = (body.at.x, body.at.y, body.z_m);
            robot.heading_rad = body.heading_rad();
            (robot.wall_contacts, robot.robot_contacts) = (body.wall_contacts, body.uav_contacts);
            robot.level_passes = body.level_passes;
        }
    }
}

fn point(at: Vec2) -> Point {
    Point { x_m: at.x, y_m: at.y }
}

fn place(at: Point) -> Vec2 {
    Vec2::new(at.x_m, at.y_m)
}
