//! A third mission, written as anybody could write one outside of the library: robots fly round a ring, one after the
//! other. The seed says where on the ring they start.

mod frame;
mod metrics;
mod scene;
mod shown;
mod topics;

use std::{convert::Infallible, f32::consts::TAU, sync::Arc};

use glam::Vec2;
use uchain_core::params::OutOfRange;
use uchain_sim::{
    clock::total_ticks,
    config::Source,
    mission::{Mission, Stopped},
    seed::{Seed, Source as Noise},
    world::{MotionParams, PointMass, Vehicle, Waypoint, World},
};

pub(crate) use frame::RingFrame;
pub(crate) use metrics::RingSummary;
pub(crate) use scene::RingScene;
pub(crate) use topics::RingTopics;

use metrics::RingMetrics;

/// Height of all (m).
const Z_M: f32 = 1.0;
/// Waypoints of one round.
const HOPS: f32 = 12.0;

/// The scenario that comes along.
pub(crate) fn source() -> Source {
    Source { label: "ring.toml".to_owned(), text: include_str!("ring.toml").to_owned(), folder: "".into() }
}

/// What one robot may know at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Seen {
    /// Where it is.
    pub(crate) at: Vec2,
    /// Whether all are where they were told to be; only then there is anything to decide.
    pub(crate) arrived: bool,
}

/// Robots in a ring.
#[derive(Debug)]
pub(crate) struct Ring {
    scene: Arc<RingScene>,
    world: World,
    seen: Vec<Seen>,
    commands: Vec<Waypoint>,
    tick: u64,
    frame: RingFrame,
}

/// Where the seed puts the robots: side by side on the ring.
fn starts(scene: &RingScene, seed: u64) -> Vec<Waypoint> {
    let first_rad = TAU * Seed(seed).stream(0, Noise::Start).uniform();
    let robots = scene.ring.robots;
    (0..robots).map(|i| scene.on_ring(first_rad - TAU * f32::from(i) / f32::from(robots))).collect()
}

impl Mission for Ring {
    type Scene = RingScene;
    type Observation = Seen;
    type Command = Waypoint;
    type Input = Infallible;
    type Frame = RingFrame;
    type Metrics = RingMetrics;
    type Summary = RingSummary;

    fn start(scene: Arc<RingScene>, seed: u64) -> Self {
        let body = |at| -> Box<dyn Vehicle> { Box::new(PointMass::new(at, scene.ring.speed_mps, 1.0)) };
        let starts = starts(&scene, seed).into_iter().map(body);
        let world = World::new(scene.map.clone(), MotionParams::default(), starts);
        let (seen, commands) = (Vec::new(), Vec::new());
        Self { scene, world, seen, commands, tick: 0, frame: RingFrame::default() }
    }

    fn reset(&mut self, seed: u64) {
        // One start per body.
        self.world.reset(starts(&self.scene, seed)).unwrap();
        (self.tick, self.frame) = (0, RingFrame::default());
    }

    fn scene(&self) -> &Arc<RingScene> {
        &self.scene
    }

    fn steer(&mut self, input: Infallible) -> Result<(), OutOfRange> {
        match input {}
    }

    fn input_of(_: &RingFrame) -> Option<Infallible> {
        None
    }

    fn sense(&mut self) -> &[Seen] {
        let arrived = self.world.has_arrived();
        self.seen.clear();
        self.seen.extend(self.world.bodies().iter().map(|body| Seen { at: body.at, arrived }));
        &self.seen
    }

    fn decide(&mut self, commands: &mut Vec<Waypoint>) {
        commands.clear();
        let due = self.seen.iter().filter(|seen| seen.arrived);
        commands.extend(due.map(|seen| self.scene.on_ring(self.scene.angle_rad(seen.at) + TAU / HOPS)));
    }

    fn act(&mut self, commands: &[Waypoint]) -> Option<Stopped> {
        let decision = self.world.has_arrived();
        for (i, to) in commands.iter().enumerate() {
            // Every robot takes waypoints.
            self.world.command(i, (*to).into()).unwrap();
        }
        self.world.advance();
        self.tick += 1;
        self.frame.fill(self.tick, decision, self.world.bodies());
        (self.tick >= total_ticks(self.scene.duration_s)).then_some(Stopped::Time)
    }

    fn frame(&self) -> &RingFrame {
        &self.frame
    }

    fn commands(&mut self) -> &mut Vec<Waypoint> {
        &mut self.commands
    }
}
