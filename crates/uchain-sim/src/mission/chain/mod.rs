//! A chain of UAVs that relays radio into a tunnel (Laclau 2021). One tick: sense, decide, act, advance, record.

mod brains;
mod config;
mod events;
mod extensions;
mod flight;
mod frame;
mod law;
mod logbook;
#[cfg(feature = "record")]
mod mcap;
mod members;
mod metrics;
#[cfg(feature = "draw")]
mod picture;
mod pilot;
mod plan;
mod scene;
mod shown;

use std::sync::Arc;

use glam::Vec2;
use uchain_core::{
    chain::{Command, Explanation, Observation, Packet, PilotInput},
    params::OutOfRange,
};

use super::{Mission, Scene as _, Stopped};
use crate::{
    clock::{period_ticks, time_s, total_ticks},
    map::Trail,
    record::{RecordError, Recorder},
    seed::{Seed, Source},
    sense::{FlowNoise, GridRays, Rays, TofBeams, TofNoise, read_tof},
    world::{Waypoint, World},
};

use brains::Brains;
#[cfg(feature = "log")]
pub(crate) use config::agreed;
pub use config::{ChainConfig, PilotStep, Scenario, UAVS_MAX};
pub use extensions::{ChainExtensions, MakeBrain};
pub use flight::Flight;
pub(crate) use frame::spread_db;
pub use frame::{Frame, HeadFrame, History, LinkFrame, Moment, Silence, UavFrame};
pub use law::{AnyBrain, Asked, Law, Leveller, OwnLaw, OwnLeveller};
#[cfg(feature = "record")]
pub use mcap::{ChainTopics, McapRecorder};
pub use members::{Member, MemberError, Members};
pub use metrics::{LinkSummary, Metrics, Summary, Timeline};
#[cfg(feature = "draw")]
pub use picture::{everywhere_png, plan_png, run_picture, run_png};
use pilot::Steering;
pub use plan::{
    Assumptions, Batteries, Battery, BatteryAssumed, FlightEnd, Flown, FlownRun, HeadAssumed, Launch,
    MOST_LISTED, MOST_ROWS, MapAssumed, Place, Plan, PlanError, PlanOptions, PlanRow, RESERVE, RadioAssumed,
    Reach, Sensitivity, Variant, plan, plan_while,
};
pub use scene::{Course, CourseOptimum, Everywhere, Farthest, FromBase, ReachedCell, Spawn};
pub use shown::{Moments, PlanSteps, PlanTable, ThinnedHistory, everywhere_csv, places_csv, places_geojson};

/// A chain under way, of UAVs with the brains that its scenario asks for.
pub type Chain<R = GridRays> = ChainOf<AnyBrain, R>;

/// A chain under way, of UAVs with such brains.
#[derive(Debug)]
pub struct ChainOf<B, R = GridRays> {
    course: Arc<Course>,
    world: World,
    brains: Brains<B>,
    steering: Steering,
    senses: Senses<R>,
    trail: Trail,
    decision_ticks: u64,
    last_tick: u64,
    tick: u64,
    /// Whether what was sensed is of this very tick.
    has_sensed: bool,
    seen: Vec<Observation>,
    asked: Vec<Command>,
    /// Room for what the brains decide.
    commands: Vec<Command>,
    frame: Frame,
}

/// The sensors of all UAVs.
#[derive(Debug)]
struct Senses<R> {
    rays: Arc<R>,
    beams: TofBeams,
    tof_ticks: u64,
    tof_noise: Vec<TofNoise>,
    flow: Vec<FlowNoise>,
}

impl<R> Senses<R> {
    /// Sensors that have measured nothing yet.
    fn reset(&mut self, course: &Course, seed: Seed) {
        let (scenario, uavs) = (&course.scenario, 0..course.spawns.len() as u32);
        let tof = |i| TofNoise::new(seed.stream(i, Source::Tof), scenario.tof.clone());
        let flow = |i| FlowNoise::new(seed.stream(i, Source::Flow), scenario.flow.clone());
        self.tof_noise.clear();
        self.tof_noise.extend(uavs.clone().map(tof));
        self.flow.clear();
        self.flow.extend(uavs.map(flow));
    }
}

/// Places and headings in which the UAVs wait.
fn spawns(course: &Course) -> impl Iterator<Item = (Vec2, f32)> {
    course.spawns.iter().map(|spawn| (spawn.at, spawn.heading_rad))
}

impl<B: Law> Mission for ChainOf<B> {
    type Scene = Course;
    type Observation = Observation;
    type Command = Command;
    type Input = PilotInput;
    type Frame = Frame;
    type Metrics = Metrics;
    type Summary = Summary;

    fn start(course: Arc<Course>, seed: u64) -> Self {
        let course = course.seeded(seed);
        let world = World::new(course.map.clone(), course.scenario.motion.clone(), spawns(&course));
        let rays = course.rays.clone();
        Self::with(course, seed, rays, world)
    }

    fn reset(&mut self, seed: u64) {
        let start = |spawn: &Spawn| Waypoint { at: spawn.at, z_m: 0.0, heading_rad: spawn.heading_rad };
        if self.world.reset(self.course.spawns.iter().map(start)).is_err() {
            self.world = World::new(
                self.course.map.clone(),
                self.course.scenario.motion.clone(),
                spawns(&self.course),
            );
        }
        self.course = self.course.seeded(seed);
        self.restart(seed);
    }

    fn scene(&self) -> &Arc<Course> {
        &self.course
    }

    fn steer(&mut self, input: PilotInput) -> Result<(), OutOfRange> {
        self.steering.steer(input)
    }

    fn input_of(frame: &Frame) -> Option<PilotInput> {
        frame.input
    }

    fn sense(&mut self) -> &[Observation] {
        self.look();
        &self.seen
    }

    fn decide(&mut self, commands: &mut Vec<Command>) {
        self.brains.decide(self.tick, &self.seen, commands);
    }

    fn act(&mut self, commands: &[Command]) -> Option<Stopped> {
        self.fly(commands)
    }

    fn frame(&self) -> &Frame {
        &self.frame
    }

    fn commands(&mut self) -> &mut Vec<Command> {
        &mut self.commands
    }

    fn step(&mut self, out: &mut impl Recorder<Frame>) -> Result<Option<Stopped>, RecordError> {
        Self::step(self, out)
    }
}

#[cfg(feature = "oracles")]
impl<B: Law, R: Rays> ChainOf<B, R> {
    /// The same chain with these rays and every UAV in rapier at every tick: the slow way, and the measure of
    /// [`Chain::start`] in tests and benchmarks. With [`Course::rays`] it has the same bits until something touches; with
    /// [`ParryRays`](crate::sense::ParryRays) it is what the libraries do by themselves.
    pub fn plain(course: &Arc<Course>, seed: u64, rays: Arc<R>) -> Self {
        let course = course.seeded(seed);
        let world = World::ungated(course.map.clone(), course.scenario.motion.clone(), spawns(&course));
        Self::with(course, seed, rays, world)
    }
}

impl<B: Law, R: Rays> ChainOf<B, R> {
    fn with(course: Arc<Course>, seed: u64, rays: Arc<R>, world: World) -> Self {
        course.from_base.prepare(&course.map);
        let scenario = &course.scenario;
        let uavs = course.spawns.len();
        let senses = Senses {
            rays,
            beams: TofBeams::new(&scenario.tof),
            tof_ticks: period_ticks(scenario.tof.period_s),
            tof_noise: Vec::with_capacity(uavs),
            flow: Vec::with_capacity(uavs),
        };
        let mut chain = Self {
            world,
            brains: Brains::new(&course, Seed(seed)),
            steering: Steering::default(),
            senses,
            trail: Trail::default(),
            decision_ticks: period_ticks(scenario.equalize.decision_s),
            last_tick: total_ticks(scenario.duration_s),
            tick: 0,
            has_sensed: false,
            seen: vec![Observation::default(); uavs],
            asked: vec![Command::default(); uavs],
            commands: Vec::with_capacity(uavs),
            frame: Frame {
                uavs: Vec::with_capacity(uavs),
                links: Vec::with_capacity(uavs),
                ..Frame::default()
            },
            course,
        };
        chain.senses.reset(&chain.course, Seed(seed));
        chain
    }

    /// Everything but the world as it was before the first tick.
    fn restart(&mut self, seed: u64) {
        self.brains.reset(&self.course, Seed(seed));
        self.steering = Steering::default();
        self.senses.reset(&self.course, Seed(seed));
        self.trail = Trail::default();
        (self.tick, self.has_sensed) = (0, false);
        self.seen.fill(Observation::default());
        self.asked.fill(Command::default());
        self.frame.uavs.clear();
        self.frame.links.clear();
        let (uavs, links) = (std::mem::take(&mut self.frame.uavs), std::mem::take(&mut self.frame.links));
        self.frame = Frame { uavs, links, ..Frame::default() };
    }

    /// All UAVs and the walls around them.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// One tick, as [`Mission::step`] has it, with whatever rays.
    ///
    /// # Errors
    /// The recorder's own, and [`RecordError::Interrupted`] from a [`Leveller`] that breaks off.
    pub fn step(&mut self, out: &mut impl Recorder<Frame>) -> Result<Option<Stopped>, RecordError> {
        let mut commands = std::mem::take(&mut self.commands);
        self.look();
        self.brains.decide(self.tick, &self.seen, &mut commands);
        if self.brains.is_broken_off {
            return Err(RecordError::Interrupted { time_s: time_s(self.tick) });
        }
        let stopped = self.fly(&commands);
        self.commands = commands;
        out.frame(&self.frame)?;
        Ok(stopped)
    }

    /// Ticks since the start.
    pub fn tick(&self) -> u64 {
        self.tick
    }

    /// The first half of all decisions of this instant: the relays that ask for the speed that levels their links, by id.
    /// Brains that decide as a whole ask for nothing. However often it is called, an instant is prepared once; for
    /// [`ChainOf::conclude`], or [`Mission::decide`], which asks whoever levels.
    pub fn prepare(&mut self) -> &[Asked] {
        self.look();
        self.brains.prepare(self.tick, &self.seen)
    }

    /// The second half: commands for [`Mission::act`], with forward speeds for those that asked (m/s), in their order. Who
    /// gets none has 0.
    pub fn conclude(&mut self, level_mps: &[f32], commands: &mut Vec<Command>) {
        self.look();
        self.brains.conclude(self.tick, &self.seen, level_mps, commands);
    }

    /// Who is in the chain.
    pub fn members(&self) -> &Members {
        &self.brains.members
    }

    /// Gives a UAV that has none a place in the chain, 0 to lead it: all behind are one farther from the leader. On the
    /// ground it takes off when it is its turn, as all do; in the air it is a link at once.
    ///
    /// # Errors
    /// [`MemberError`]: no such UAV or place, it has a place already, or it has failed.
    pub fn join(&mut self, uav: usize, place: usize) -> Result<(), MemberError> {
        self.brains.members.join(uav, place)
    }

    /// Takes a UAV out of the chain, whose gap closes at the next decision. Nobody hears it any more, and it hears nobody:
    /// with the built-in law it flies back the way it came.
    ///
    /// # Errors
    /// [`MemberError`]: no such UAV, or it has no place.
    pub fn leave(&mut self, uav: usize) -> Result<(), MemberError> {
        self.brains.members.leave(uav)
    }

    /// What a UAV believes at this instant, and why it asks for what it asks: worked out now, for it is kept nowhere.
    /// `None` if there is none of this id, or its law does not explain itself.
    pub fn explain(&self, uav: usize) -> Option<Explanation> {
        self.brains.explain(uav, &self.seen)
    }

    /// What a UAV tells whoever hears it, given what it sees at this instant; `None` if there is none of this id.
    pub fn says(&self, uav: usize) -> Option<Packet> {
        self.brains.says(uav, &self.seen)
    }

    /// Tells a UAV how much of its battery's charge is left (0 to 1), which it senses from the next tick on.
    pub fn set_battery(&mut self, uav: usize, charge: Option<f32>) {
        self.world.set_battery(uav, charge);
    }

    /// Whether radio and laws run at this tick.
    pub(super) fn is_decision(&self) -> bool {
        self.tick.is_multiple_of(self.decision_ticks)
    }

    /// What every UAV may know at this instant.
    fn look(&mut self) {
        if std::mem::replace(&mut self.has_sensed, true) {
            return;
        }
        self.brains.forget();
        let decision = self.is_decision();
        self.brains.fail(self.tick, &mut self.world);
        let pilot = self.steering.look(&self.course.scenario.pilot, self.tick);
        let leader = self.brains.members.leader();
        let ranging = self.tick.is_multiple_of(self.senses.tof_ticks);
        for (i, body) in self.world.bodies().iter().enumerate() {
            let seen = &mut self.seen[i];
            (seen.tof, seen.radio, seen.place, seen.ground_speed_mps) = (None, None, None, None);
            seen.battery = body.battery;
            seen.pilot = (Some(i) == leader).then_some(pilot);
            if ranging && body.airborne {
                let exact = read_tof(&*self.senses.rays, &self.world, i, &self.senses.beams);
                seen.tof = Some(self.senses.tof_noise[i].apply(exact));
            }
            if decision {
                seen.ground_speed_mps = Some(self.senses.flow[i].read(body));
            }
        }
        if decision {
            self.brains.exchange(self.tick, &self.world, &mut self.seen);
        }
    }

    /// The UAVs do as they are told, and a tick passes.
    fn fly(&mut self, commands: &[Command]) -> Option<Stopped> {
        self.look();
        let decision = self.is_decision();
        for (asked, command) in self.asked.iter_mut().zip(commands) {
            *asked = *command;
        }
        self.brains.take_off_and_land(self.tick, &mut self.asked);
        self.world.act(&self.asked);
        self.world.advance();
        self.tick += 1;
        self.has_sensed = false;
        self.fill_frame(decision);
        (self.tick >= self.last_tick).then_some(Stopped::Time)
    }

    fn fill_frame(&mut self, decision: bool) {
        let frame = &mut self.frame;
        frame.tick = self.tick;
        frame.decision = decision;
        frame.input = self.steering.anew();
        frame.uavs.clear();
        let doing = |uav, seen| decision.then(|| self.brains.doing(uav, seen)).flatten();
        let bodies = self.world.bodies().iter().zip(&self.seen).enumerate();
        frame.uavs.extend(bodies.map(|(uav, (body, seen))| UavFrame {
            x_m: body.at.x,
            y_m: body.at.y,
            heading_rad: body.heading_rad(),
            forward_mps: body.forward_mps(),
            lateral_mps: body.lateral_mps(),
            yaw_rate_radps: body.yaw_rate_radps,
            airborne: body.airborne,
            wall_contacts: body.wall_contacts,
            uav_contacts: body.uav_contacts,
            tof: seen.tof,
            doing: doing(uav, seen),
        }));
        let head = self.brains.members.leader();
        frame.leader = head.unwrap_or(0);
        let allowed_mps = self.brains.head_allowed_mps();
        frame.head = head.zip(allowed_mps).filter(|&(head, _)| self.world.bodies()[head].airborne).map(
            |(head, allowed_mps)| HeadFrame {
                pilot_mps: self.seen[head].pilot.unwrap_or_default().speed_mps,
                allowed_mps,
                asked_mps: self.asked[head].forward_mps,
            },
        );
        if decision {
            frame.links.clear();
            frame.links.extend(self.brains.links());
            let head = head.map(|head| self.world.bodies()[head].at);
            let reach_m =
                head.and_then(|head| self.course.from_base.follow_m(self.world.map(), &mut self.trail, head));
            // A head pressed against a wall can stand a hair inside it; the last reach holds.
            if let Some(reach_m) = reach_m {
                frame.head_reach_m = reach_m;
            }
        }
    }
}

#[cfg(test)]
mod tests;
