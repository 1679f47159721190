//! A team of robots that explores an unknown building (Kim 2021). One tick: sense, decide, act, advance, record.
//!
//! Robots sense and decide in rounds that all begin together: when the last one has arrived, and has looked around for
//! [`TeamConfig::scan_s`]. In between they fly.

mod config;
mod frame;
mod ground;
#[cfg(feature = "record")]
mod mcap;
mod metrics;
#[cfg(feature = "draw")]
mod picture;
mod scene;
mod team;

use glam::Vec2;
use uchain_core::explore::{Command, Point, Pose, Purpose};

use crate::{
    clock::{total_ticks, whole_ticks},
    record::{RecordError, Recorder},
    seed::{Seed, Source, Stream},
    sense::Scanner,
    world::{MotionParams, PointMass, Quadrotor, Vehicle, Waypoint, World},
};

pub(crate) use config::KEYS;
#[cfg(feature = "schema")]
pub(crate) use config::schema;
pub use config::{ExploreScenario, TeamConfig, VehicleKind};
pub use frame::{ExploreFrame, LabelFrame, NodeFrame, Progress, RobotFrame, Stopped};
pub(crate) use frame::{Odometer, Way};
pub(crate) use ground::width_but_for_m;
pub use ground::{Coverage, Ground, Passage, Passages, RosMap, Unseen, Width};
#[cfg(feature = "record")]
pub use mcap::ExploreRecorder;
pub use metrics::{
    ExploreHistory, ExploreMetrics, ExploreSummary, ExploreTimeline, Gap, Moment, States, Survey,
};
#[cfg(feature = "draw")]
pub use picture::{explore_picture, explore_png, states_png};
pub use scene::Site;
pub use team::Team;

/// What one robot sees at the start of a round: where it believes it is, and a scan if it asked for one.
type Seen = (Pose, Option<Vec<Option<f32>>>);

/// An exploration under way.
#[derive(Debug)]
pub struct Exploration<'a> {
    site: &'a Site,
    team: Team,
    world: World,
    scanner: Scanner,
    /// Noise of where robots believe they are.
    noise: Vec<Stream>,
    seen: Vec<Seen>,
    /// Where robots stood when the round began.
    stood: Vec<Vec2>,
    tick: u64,
    rounds: u32,
    /// Whether robots look around where they come to.
    scanning: bool,
    /// Tick at which all have looked around; `None` while somebody flies.
    ready: Option<u64>,
    last_tick: u64,
    frame: ExploreFrame,
}

impl<'a> Exploration<'a> {
    /// A team at its starts, before its first tick. `None` for parameters that no checked site has.
    pub fn new(site: &'a Site, seed: u64) -> Option<Self> {
        let (team, params, seed) = (&site.scenario.team, &site.scenario.params, Seed(seed));
        let z_m = params.height_m(uchain_core::explore::ExploreParams::USUAL_LEVEL);
        let start = |(i, &at): (u32, &Vec2)| {
            let mut stream = seed.stream(i, Source::Start);
            let mut aside = || team.scatter_m * (2.0 * stream.uniform() - 1.0);
            let at = at + Vec2::new(aside(), aside());
            Waypoint { at, z_m, heading_rad: team.heading_deg.to_radians() }
        };
        let body = |at| -> Box<dyn Vehicle> {
            match team.vehicle {
                VehicleKind::PointMass => Box::new(PointMass::new(at, team.v_mps, team.climb_mps)),
                VehicleKind::Quadrotor => {
                    Box::new(Quadrotor::new(at, &team.quadrotor, team.v_mps, team.climb_mps))
                }
            }
        };
        let robots = 0..u32::from(team.robots);
        let vehicles: Vec<Box<dyn Vehicle>> = robots.clone().zip(&site.spawns).map(start).map(body).collect();
        let pending = |body: Waypoint| RobotFrame {
            x_m: body.at.x,
            y_m: body.at.y,
            z_m: body.z_m,
            heading_rad: body.heading_rad,
            level: uchain_core::explore::ExploreParams::USUAL_LEVEL,
            purpose: Purpose::Wait,
            moves: false,
            holds: false,
            mfl: false,
            wall_contacts: 0,
            robot_contacts: 0,
            level_passes: 0,
        };
        Some(Self {
            team: Team::new(&site.scenario, seed)?,
            scanner: Scanner::new(params),
            noise: robots.map(|i| seed.stream(i, Source::Position)).collect(),
            seen: vec![(Pose::default(), Some(Vec::new())); vehicles.len()],
            stood: Vec::with_capacity(vehicles.len()),
            tick: 0,
            rounds: 0,
            scanning: true,
            ready: None,
            last_tick: total_ticks(site.scenario.duration_s),
            frame: ExploreFrame {
                robots: vehicles.iter().map(|body| pending(body.now())).collect(),
                ..ExploreFrame::default()
            },
            world: World::new(
                site.map.clone(),
                MotionParams { radius_m: params.r_body_m, ..MotionParams::default() },
                vehicles,
            ),
            site,
        })
    }

    /// One tick. Says why, once it is over; then nothing moves any more.
    ///
    /// # Errors
    /// Only the recorder's own.
    pub fn step(&mut self, out: &mut impl Recorder<ExploreFrame>) -> Result<Option<Stopped>, RecordError> {
        let decision = self.is_ready();
        let mut stopped = None;
        if decision {
            self.sense();
            stopped = self.decide();
            self.act();
        }
        self.world.advance();
        self.tick += 1;
        stopped = stopped.or((self.tick >= self.last_tick).then_some(Stopped::Time));
        self.fill_frame(decision, stopped);
        out.frame(&self.frame)?;
        Ok(stopped)
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

    fn sense(&mut self) {
        let sigma_m = self.site.scenario.team.position_sigma_m;
        self.stood.clear();
        for ((body, seen), noise) in self.world.stand().zip(&mut self.seen).zip(&mut self.noise) {
            self.stood.push(body.at);
            let (pose, scan) = seen;
            let off =
                if sigma_m > 0.0 { sigma_m * Vec2::new(noise.normal(), noise.normal()) } else { Vec2::ZERO };
            *pose = Pose { at: point(body.at + off), heading_rad: body.heading_rad };
            if let Some(returns_m) = scan {
                self.scanner.scan(&self.site.map, body.at, returns_m);
            }
        }
    }

    fn decide(&mut self) -> Option<Stopped> {
        let places: Vec<Point> = self.stood.iter().copied().map(point).collect();
        self.rounds += 1;
        let over = self.team.round(&self.seen, &places);
        // A round in which nobody has anything left to do is none.
        self.rounds -= u32::from(over.is_some());
        over
    }

    /// A robot flies as far and in the direction it has asked for, from where it stands.
    fn act(&mut self) {
        self.ready = None;
        self.scanning = false;
        for ((i, command), &from) in self.team.commands().iter().enumerate().zip(&self.stood) {
            let (pose, scan) = &mut self.seen[i];
            let asked = Vec2::new(command.to.x_m - pose.at.x_m, command.to.y_m - pose.at.y_m);
            let at = if point(from) == pose.at { place(command.to) } else { from + asked };
            let to = Waypoint { at, z_m: command.z_m, heading_rad: command.heading_rad };
            let told = self.world.command(i, to.into());
            debug_assert_eq!(told, Ok(()), "one body flies to waypoints for every robot of the team");
            *scan = command.scan.then(Vec::new);
            self.scanning |= command.scan;
        }
    }

    fn fill_frame(&mut self, decision: bool, stopped: Option<Stopped>) {
        let frame = &mut self.frame;
        (frame.tick, frame.rounds, frame.decision, frame.stopped) =
            (self.tick, self.rounds, decision, stopped);
        frame.nodes.clear();
        frame.labels.clear();
        frame.edges.clear();
        if decision {
            let asked = self.team.commands().iter().zip(self.team.targets());
            for (robot, (command, target)) in frame.robots.iter_mut().zip(asked) {
                let Command { level, hold, mfl, to, .. } = *command;
                (robot.level, robot.holds, robot.mfl) = (level, hold, mfl);
                (robot.purpose, robot.moves) = (target.purpose, to != target.from);
            }
            let (whole, news) = (self.team.whole(), self.team.news());
            let count = whole.cones().count();
            for (slot, sectors) in news.nodes.clone().zip(news.sectors.chunks(count)) {
                let (Some(id), Some(at)) = (whole.id(slot), whole.at(slot)) else { continue };
                let believed_m = [at.x_m, at.y_m];
                let at_m = self.stood.get(usize::from(id.robot)).map_or(believed_m, Vec2::to_array);
                frame.nodes.push(NodeFrame { id, at_m, believed_m, sectors: sectors.to_vec() });
            }
            frame.labels.extend_from_slice(&news.labels);
            frame.edges.extend_from_slice(&news.edges);
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
