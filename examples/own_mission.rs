//! A mission of one's own: robots fly round a ring, one after the other. The library knows nothing of it, and gives it
//! scenarios with checked keys, a world with walls and contacts, seeds, runs, digests and verdicts.
//!
//! `tests/ring` of the project is the same mission with all that it takes to be drawn, recorded, swept and flown from the
//! command line (`Shown`, `Recorded` and a line in a `Registry`); this is what it takes to fly.
//!
//! `cargo run --release --example own_mission`. A package of one's own has the crates that are named here as dependencies,
//! besides schemars, and a feature `schema` that is on: the keys' JSON Schema is made under that name.
//!
//! ```text
//! 0.5 m/s: round: 2.63 rounds of the slowest robot in 40 s
//! 0.1 m/s: not-round: 0.53 rounds of the slowest robot in 40 s
//! --set ring.radios_m=1: unknown key 'ring.radios_m'; did you mean 'radius_m'? (known: robots, radius_m, speed_mps)
//! ```

use std::{convert::Infallible, error::Error, f32::consts::TAU, sync::Arc};

use glam::Vec2;
use serde::{Deserialize, Serialize};
use uchain_core::params::{Key, OutOfRange};
use uchain_libm as _; // the same bits on every system
use uchain_sim::{
    analyse::{Outcome, Verdict},
    clock::{time_s, total_ticks},
    config::{
        Check, ConfigError, Document, Heading, Keys, MapConfig, Source,
        help::{schema_of, schema_with_table},
    },
    map::Map,
    mission::{Metrics, Mission, Scene, Stopped, Summary},
    record::{Difference, FieldDiff, RecordError, Recorder, Snapshot, Value, Whose},
    run::run,
    scene::lay_map,
    seed::{Seed, Source as Noise},
    world::{MotionParams, PointMass, Vehicle, Waypoint, World},
};

// 1. A scenario: its keys, with default, range and meaning. Mistakes are answered with file, line and the nearest key.

uchain_core::params! {
    /// Robots that fly round a ring.
    #[derive(Serialize, Deserialize)]
    #[serde(default, deny_unknown_fields)]
    pub struct RingConfig {
        /// Robots.
        /// - Source: ours
        pub robots: u16 = 3, in 2..=100;
        /// Radius of the ring (m).
        /// - Source: ours
        pub radius_m: f32 = 1.0, in 0.2..=100.0;
        /// Speed over ground (m/s).
        /// - Source: ours
        pub speed_mps: f32 = 0.5, in 0.01..=20.0;
    }
}

const SCENARIO: &str = r#"
name = "ring"
duration_s = 40.0

[map.walls]
outer_m = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]]

[ring]
radius_m = 1.2
"#;

/// The table that makes a scenario one of a ring.
const RING: Key = Key { name: "ring", range: None, doc: "Robots that fly round a ring." };

/// The file.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    name: String,
    #[serde(default)]
    description: String,
    duration_s: f64,
    map: MapConfig,
    ring: RingConfig,
}

// 2. A scene: a scenario checked and laid out in its map. Many runs share it, and nothing in it changes.

#[derive(Debug)]
struct RingScene {
    heading: Heading,
    ring: RingConfig,
    map: Arc<Map>,
    middle: Vec2,
}

impl RingScene {
    fn checked(document: &Document<'_>) -> Result<(Heading, RingConfig), ConfigError> {
        let File { name, description, duration_s, map, ring } = document.values()?;
        let heading = Heading { name, description, duration_s, map };
        let check = Check { document };
        check.heading(&heading)?;
        check.ranged(RING.name, ring.check())?;
        Ok((heading, ring))
    }

    /// The place in this direction, along the ring.
    fn on_ring(&self, angle_rad: f32) -> Waypoint {
        // `libm` gives the same bits on every system.
        let (sin, cos) = libm::sincosf(angle_rad);
        let at = self.middle + self.ring.radius_m * Vec2::new(cos, sin);
        Waypoint { at, z_m: 1.0, heading_rad: angle_rad + TAU / 4.0 }
    }
}

impl Scene for RingScene {
    type Mission = Ring;
    type Shared = ();
    type Extensions = ();
    const BUILTIN: () = ();
    const KIND: &'static str = "a ring";
    const ROBOT: &'static str = "robot";
    const KEYS: &'static Keys = &Keys {
        marker: Some(RING.name),
        tables: &[("", &[RING]), (RING.name, RingConfig::KEYS)],
        renamed: &[],
    };

    fn schema((): ()) -> serde_json::Value {
        schema_with_table(&RING, [schema_of::<RingConfig>()])
    }

    fn describe(document: &Document<'_>, (): ()) -> Result<[String; 2], ConfigError> {
        Self::checked(document).map(|(heading, _)| [heading.name, heading.description])
    }

    fn takes(document: &Document<'_>, (): ()) -> bool {
        document.values::<File>().is_ok()
    }

    fn lay(document: &Document<'_>, map: Option<Map>, (): &(), (): ()) -> Result<Arc<Self>, ConfigError> {
        let (heading, ring) = Self::checked(document)?;
        let map = match map {
            Some(map) => map,
            None => lay_map(&heading.map, [0.0; 2], document)?.0,
        };
        let (low, high) = map.bounds();
        let middle = low.midpoint(high);
        let room_m = map.clearance_m(middle);
        if room_m < ring.radius_m + 0.1 {
            let expected = format!("must leave 0.1 m to walls: the middle is {room_m:.3} m from the nearest");
            return Err(document.invalid("ring.radius_m", &ring.radius_m.to_string(), expected));
        }
        Ok(Arc::new(Self { heading, ring, map: Arc::new(map), middle }))
    }

    fn name(&self) -> &str {
        &self.heading.name
    }

    fn duration_s(&self) -> f64 {
        self.heading.duration_s
    }

    fn crew(&self) -> usize {
        self.ring.robots.into()
    }

    fn map(&self) -> &Arc<Map> {
        &self.map
    }

    fn notes(&self) -> Vec<String> {
        Vec::new()
    }

    fn to_toml(&self) -> Result<String, toml::ser::Error> {
        let Heading { name, description, duration_s, map } = self.heading.clone();
        toml::to_string(&File { name, description, duration_s, map, ring: self.ring.clone() })
    }
}

// 3. The mission: sense, decide, act, advance, one tick after the other.

/// What one robot may know at one instant.
#[derive(Debug, Clone, Copy)]
struct Seen {
    at: Vec2,
    /// Whether all are where they were told to be; only then there is anything to decide.
    arrived: bool,
}

#[derive(Debug)]
struct Ring {
    scene: Arc<RingScene>,
    world: World,
    seen: Vec<Seen>,
    commands: Vec<Waypoint>,
    tick: u64,
    frame: RingFrame,
}

/// Where the seed puts the robots: side by side on the ring. Every use of chance has a stream of its own.
fn starts(scene: &RingScene, seed: u64) -> Vec<Waypoint> {
    let first_rad = TAU * Seed(seed).stream(0, Noise::Start).uniform();
    let robots = scene.ring.robots;
    (0..robots).map(|i| scene.on_ring(first_rad - TAU * f32::from(i) / f32::from(robots))).collect()
}

impl Mission for Ring {
    type Scene = RingScene;
    type Observation = Seen;
    type Command = Waypoint;
    /// Nobody steers.
    type Input = Infallible;
    type Frame = RingFrame;
    type Metrics = RingMetrics;
    type Summary = RingSummary;

    fn start(scene: Arc<RingScene>, seed: u64) -> Self {
        let body = |at| -> Box<dyn Vehicle> { Box::new(PointMass::new(at, scene.ring.speed_mps, 1.0)) };
        let starts = starts(&scene, seed).into_iter().map(body);
        let world = World::new(scene.map.clone(), MotionParams::default(), starts);
        Self { scene, world, seen: Vec::new(), commands: Vec::new(), tick: 0, frame: RingFrame::default() }
    }

    fn reset(&mut self, seed: u64) {
        // As many starts as bodies, which is all that could be wrong.
        self.world.reset(starts(&self.scene, seed)).expect("one start per body");
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
        commands.extend(due.map(|seen| {
            let from_middle = seen.at - self.scene.middle;
            self.scene.on_ring(libm::atan2f(from_middle.y, from_middle.x) + TAU / 12.0)
        }));
    }

    fn act(&mut self, commands: &[Waypoint]) -> Option<Stopped> {
        let decision = self.world.has_arrived();
        for (i, to) in commands.iter().enumerate() {
            self.world.command(i, (*to).into()).expect("every robot takes waypoints");
        }
        self.world.advance();
        self.tick += 1;
        let robots = self.world.bodies().iter();
        let robots =
            robots.map(|body| RobotFrame { x_m: body.at.x, y_m: body.at.y, contacts: body.uav_contacts });
        self.frame = RingFrame { tick: self.tick, decision, robots: robots.collect() };
        (self.tick >= total_ticks(self.scene.heading.duration_s)).then_some(Stopped::Time)
    }

    fn frame(&self) -> &RingFrame {
        &self.frame
    }

    fn commands(&mut self) -> &mut Vec<Waypoint> {
        &mut self.commands
    }
}

// 4. A frame: all that can be seen of a run after a tick. The digest is of its bits.

#[derive(Debug, Clone, PartialEq, Default)]
struct RingFrame {
    tick: u64,
    decision: bool,
    robots: Vec<RobotFrame>,
}

#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct RobotFrame {
    x_m: f32,
    y_m: f32,
    contacts: u32,
}

impl Snapshot for RingFrame {
    const CREW: &'static str = "robots";

    fn tick(&self) -> u64 {
        self.tick
    }

    fn crew(&self) -> usize {
        self.robots.len()
    }

    fn is_decision(&self) -> bool {
        self.decision
    }

    fn hash(&self, bytes: &mut Vec<u8>) {
        bytes.extend_from_slice(&self.tick.to_le_bytes());
        for robot in &self.robots {
            bytes.extend_from_slice(&robot.x_m.to_bits().to_le_bytes());
            bytes.extend_from_slice(&robot.y_m.to_bits().to_le_bytes());
            bytes.extend_from_slice(&robot.contacts.to_le_bytes());
        }
    }

    fn differences(&self, there: &Self, found: &mut dyn FnMut(Difference)) {
        let mut look = FieldDiff { tick: self.tick, found };
        for (i, (here, there)) in self.robots.iter().zip(&there.robots).enumerate() {
            let fields = |robot: &RobotFrame| {
                [
                    ("x_m", Value::Number(robot.x_m)),
                    ("y_m", Value::Number(robot.y_m)),
                    ("contacts", Value::Count(robot.contacts.into())),
                ]
            };
            look.at(Whose::One("robot", i as u64), fields(here), fields(there));
        }
    }
}

// 5. What it comes to: numbers, and a verdict in a word and in words.

#[derive(Debug, Clone, PartialEq, Serialize)]
struct RingSummary {
    #[serde(flatten)]
    verdict: Verdict,
    rounds: f64,
    digest: String,
}

impl Summary for RingSummary {
    fn verdict(&self) -> &Verdict {
        &self.verdict
    }

    fn digest(&self) -> &str {
        &self.digest
    }
}

/// Watches a run: how far every robot has come.
#[derive(Debug)]
struct RingMetrics {
    scene: Arc<RingScene>,
    last: RingFrame,
    distance_m: Vec<f64>,
}

impl Recorder<RingFrame> for RingMetrics {
    fn frame(&mut self, frame: &RingFrame) -> Result<(), RecordError> {
        self.distance_m.resize(frame.robots.len(), 0.0);
        for ((way_m, here), before) in self.distance_m.iter_mut().zip(&frame.robots).zip(&self.last.robots) {
            let step = Vec2::new(here.x_m - before.x_m, here.y_m - before.y_m);
            *way_m += f64::from(step.length());
        }
        self.last.clone_from(frame);
        Ok(())
    }
}

impl Metrics for RingMetrics {
    type Mission = Ring;

    fn of(scene: Arc<RingScene>) -> Self {
        Self { scene, last: RingFrame::default(), distance_m: Vec::new() }
    }

    fn sum_up(&self, _: u64, digest: String) -> RingSummary {
        let least_m = self.distance_m.iter().copied().fold(f64::INFINITY, f64::min);
        let rounds = least_m / f64::from(TAU * self.scene.ring.radius_m);
        let words = format!("{rounds:.2} rounds of the slowest robot in {:.0} s", time_s(self.last.tick));
        let good = Outcome::Own { word: "round", words: words.clone(), is_success: true };
        let late = Outcome::Own { word: "not-round", words, is_success: false };
        let found = if rounds >= 1.0 { Vec::new() } else { vec![late] };
        RingSummary { verdict: Verdict::new(good, found, Vec::new()), rounds, digest }
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let source = Source { label: "ring.toml".to_owned(), text: SCENARIO.to_owned(), folder: "".into() };
    for speed_mps in [0.5, 0.1] {
        let scene = RingScene::read(&source, &[format!("ring.speed_mps={speed_mps}")])?;
        let (once, again) = (run(&scene, 1, &mut ())?, run(&scene, 1, &mut ())?);
        println!("{speed_mps} m/s: {}: {}", once.verdict.outcome().word(), once.verdict);
        assert_eq!(once.digest, again.digest, "a run is a function of scene and seed");
    }
    let mistake = RingScene::read(&source, &["ring.radios_m=1".to_owned()]);
    println!("{}", mistake.err().ok_or("there is no such key")?);
    Ok(())
}
