//! One tick: sense, decide, act, advance, record. Read this first.

use glam::Vec2;
use uchain_core::chain::{Command, Observation};

use crate::{
    config::Course,
    map::{Geodesic, Trail},
    mission::ChainMission,
    record::{Frame, RecordError, Recorder, TICK_S, TICKS_PER_S, UavFrame},
    seed::{Seed, Source},
    sense::{FlowNoise, GridRays, Rays, TofBeams, TofNoise, read_tof},
    world::World,
};

/// A chain mission under way.
#[derive(Debug)]
pub struct Sim<'a, R = GridRays> {
    world: World<'a>,
    mission: ChainMission<'a>,
    senses: Senses<'a, R>,
    from_base: &'a Geodesic,
    trail: Trail,
    decision_ticks: u64,
    tick: u64,
    seen: Vec<Observation>,
    asked: Vec<Command>,
    frame: Frame,
}

/// The sensors of all UAVs.
#[derive(Debug)]
struct Senses<'a, R> {
    rays: &'a R,
    beams: TofBeams,
    tof_ticks: u64,
    tof_noise: Vec<TofNoise>,
    flow: Vec<FlowNoise>,
}

/// A period as a whole number of ticks, at least one.
fn ticks(period_s: f32) -> u64 {
    ((period_s / TICK_S).round() as u64).max(1)
}

/// Places and headings in which the UAVs wait.
fn spawns(course: &Course) -> impl Iterator<Item = (Vec2, f32)> {
    course.spawns.iter().map(|spawn| (spawn.at, spawn.heading_rad))
}

impl<'a> Sim<'a> {
    /// A mission at its first tick.
    pub fn new(course: &'a Course, seed: u64) -> Self {
        let world = World::new(&course.map, course.scenario.motion.clone(), spawns(course));
        Self::start(course, seed, &course.rays, world)
    }
}

impl<'a, R: Rays> Sim<'a, R> {
    /// The same mission with these rays and every UAV in rapier at every tick: the slow way, and the measure of
    /// [`Sim::new`] in tests and benchmarks. With [`Course::rays`] it has the same bits until something touches; with
    /// [`ParryRays`](crate::sense::ParryRays) it is what the libraries do by themselves.
    pub fn plain(course: &'a Course, seed: u64, rays: &'a R) -> Self {
        let world = World::ungated(&course.map, course.scenario.motion.clone(), spawns(course));
        Self::start(course, seed, rays, world)
    }

    fn start(course: &'a Course, seed: u64, rays: &'a R, world: World<'a>) -> Self {
        let (scenario, seed) = (&course.scenario, Seed(seed));
        let robots = 0..course.spawns.len() as u32;
        let tof = |i| TofNoise::new(seed.stream(i, Source::Tof), scenario.tof.clone());
        let flow = |i| FlowNoise::new(seed.stream(i, Source::Flow), scenario.flow.clone());
        let senses = Senses {
            rays,
            beams: TofBeams::new(&scenario.tof),
            tof_ticks: ticks(scenario.tof.period_s),
            tof_noise: robots.clone().map(tof).collect(),
            flow: robots.clone().map(flow).collect(),
        };
        Self {
            world,
            mission: ChainMission::new(course, seed),
            senses,
            from_base: &course.from_base,
            trail: Trail::default(),
            decision_ticks: ticks(scenario.equalize.decision_s),
            tick: 0,
            seen: vec![Observation::default(); robots.len()],
            asked: vec![Command::default(); robots.len()],
            frame: Frame {
                uavs: Vec::with_capacity(robots.len()),
                links: Vec::with_capacity(robots.len()),
                ..Frame::default()
            },
        }
    }

    /// All UAVs and the walls around them.
    pub fn world(&self) -> &World<'a> {
        &self.world
    }

    /// One tick.
    ///
    /// # Errors
    /// Only the recorder's own.
    pub fn step(&mut self, out: &mut impl Recorder) -> Result<(), RecordError> {
        let decision = self.tick.is_multiple_of(self.decision_ticks);
        self.sense(decision);
        self.mission.decide(self.tick, &self.seen, &mut self.asked);
        self.world.act(&self.asked);
        self.world.advance();
        self.tick += 1;
        self.fill_frame(decision);
        out.frame(&self.frame)
    }

    /// What every UAV may know at this instant.
    fn sense(&mut self, decision: bool) {
        let pilot = self.mission.pilot_at(self.tick as f64 / TICKS_PER_S);
        let ranging = self.tick.is_multiple_of(self.senses.tof_ticks);
        for (i, body) in self.world.bodies().iter().enumerate() {
            let seen = &mut self.seen[i];
            *seen = Observation { pilot: (i == 0).then_some(pilot), ..Observation::default() };
            if ranging && body.airborne {
                let exact = read_tof(self.senses.rays, &self.world, i, &self.senses.beams);
                seen.tof = Some(self.senses.tof_noise[i].apply(exact));
            }
            if decision {
                seen.ground_speed_mps = self.senses.flow[i].read(body);
            }
        }
        if decision {
            self.mission.exchange(self.tick, &self.world, &mut self.seen);
        }
    }

    fn fill_frame(&mut self, decision: bool) {
        let frame = &mut self.frame;
        frame.tick = self.tick;
        frame.decision = decision;
        frame.uavs.clear();
        frame.uavs.extend(self.world.bodies().iter().zip(&self.seen).map(|(body, seen)| UavFrame {
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
        }));
        if decision {
            frame.links.clear();
            frame.links.extend(self.mission.links());
            let head = self.world.bodies()[0].at;
            // A head pressed against a wall can stand a hair inside it; the last reach holds.
            if let Some(reach_m) = self.from_base.follow_m(self.world.map(), &mut self.trail, head) {
                frame.head_reach_m = reach_m;
            }
        }
    }
}
