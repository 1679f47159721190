//! Missions: who flies, who waits, what they tell each other, and what comes of it. One folder each.
//!
//! [`Mission`] ties one tick: sense, decide, act, advance, record. [`run`](crate::run::run), replay, sweeps, recordings
//! and the command line know this trait and no mission; [`chain`] and [`explore`] implement it.
//!
//! A mission of one's own is written in the same way, outside of this crate: a folder that implements [`Mission`],
//! [`Scene`], [`Metrics`], [`Summary`], [`Shown`] and `Recorded`, and a line in a
//! [`Registry`](crate::registry::Registry). The project's `tests/ring` is one. Its keys are declared with
//! [`uchain_core::params!`], in a crate that has the feature `schema` and schemars; its messages derive prost's; what it
//! finds at the end is an [`Outcome::Own`](crate::analyse::Outcome::Own).
//!
//! Smaller answers of one's own, such as a strategy for explorers, need no mission: they get their words in scenarios as
//! [`Scene::Extensions`] of a mission that is there.

pub mod chain;
pub mod explore;
mod logbook;
mod shown;
mod under_way;

#[cfg(feature = "record")]
use std::io::Write;
use std::{fmt::Debug, sync::Arc};

use serde::Serialize;
use uchain_core::params::OutOfRange;

use crate::{
    analyse::Verdict,
    config::{ConfigError, Document, Keys, KnownKeys, Source},
    map::Map,
    record::{RecordError, Recorder, Snapshot},
};

pub use logbook::{EVENTS_MAX, Graph, Keep, Log, Logbook};
pub use shown::{History, Shown, Timeline, thinned};
pub use under_way::UnderWay;

#[cfg(feature = "record")]
use crate::record::{
    Sink,
    mcap::{About, McapRecorder, McapWriter, MessageRecorder, Recordable, Topics},
};

/// What describes the messages of our missions.
#[cfg(feature = "record")]
pub(crate) const PROTO: &str = include_str!("uchain.proto");

/// A mission under way: a function of its scene and a seed.
///
/// One tick is [`Mission::step`]. Whoever decides for the robots himself calls its halves instead: [`Mission::sense`],
/// which says what every robot may know at this instant, and [`Mission::act`], which takes what every robot is to do.
///
/// ```
/// use uchain_libm as _; // the same bits on every system
/// use uchain_sim::{config::builtin, mission::{Mission, chain::{Chain, Course}}};
/// let course = Course::read(&builtin("corner").unwrap(), &[]).unwrap();
/// let (mut whole, mut halves) = (Chain::start(course.clone(), 1), Chain::start(course, 1));
/// let mut commands = Vec::new();
/// for _ in 0..40 {
///     whole.step(&mut ()).unwrap();
///     halves.sense();
///     halves.decide(&mut commands);
///     halves.act(&commands);
///     assert_eq!(whole.frame(), halves.frame());
/// }
/// ```
pub trait Mission: Sized + Debug + Send + 'static {
    /// What it is flown in: a scenario laid out and checked, shared by many runs.
    type Scene: Scene;
    /// What a robot may know at one instant.
    type Observation: Debug;
    /// What a robot is to do.
    type Command: Debug + Clone;
    /// What a pilot may ask for; [`Infallible`](std::convert::Infallible) where there is none.
    type Input: Debug + Clone + PartialEq + Send;
    /// What an instant leaves behind.
    type Frame: Snapshot;
    /// Sums a run up.
    type Metrics: Metrics<Mission: Mission<Scene = Self::Scene, Frame = Self::Frame, Summary = Self::Summary>>;
    /// What a run came to.
    type Summary: Summary;

    /// Before its first tick.
    fn start(scene: Arc<Self::Scene>, seed: u64) -> Self;

    /// As [`Mission::start`] would make it of the same scene, in the memory it has.
    fn reset(&mut self, seed: u64);

    /// What it is flown in.
    fn scene(&self) -> &Arc<Self::Scene>;

    /// What its pilot asks for from the next tick on that has not been sensed yet, until he asks for something else: see
    /// [`pilot`](crate::pilot). The scenario's own script is over with the first input.
    ///
    /// # Errors
    /// An input that no script may ask for is refused, and all stays as it was.
    fn steer(&mut self, input: Self::Input) -> Result<(), OutOfRange>;

    /// What the pilot asked for anew at the start of a frame's tick, by [`Mission::steer`]; what a script asks for is nothing
    /// new. Who flies a recording again steers by it.
    fn input_of(frame: &Self::Frame) -> Option<Self::Input>;

    /// The first half of a tick: what every robot may know at this instant, in their order.
    fn sense(&mut self) -> &[Self::Observation];

    /// What the robots themselves decide, given what they sensed last; replaces what `commands` holds.
    fn decide(&mut self, commands: &mut Vec<Self::Command>);

    /// The second half of a tick: the robots do as they are told, one command each in their order, and time passes. Says
    /// why, once the mission is over; then nothing moves any more. Robots that are told nothing do nothing new.
    fn act(&mut self, commands: &[Self::Command]) -> Option<Stopped>;

    /// What the last tick left behind.
    fn frame(&self) -> &Self::Frame;

    /// Room for the commands of a tick.
    fn commands(&mut self) -> &mut Vec<Self::Command>;

    /// One tick. Says why, once the mission is over.
    ///
    /// # Errors
    /// Only the recorder's own.
    fn step(&mut self, out: &mut impl Recorder<Self::Frame>) -> Result<Option<Stopped>, RecordError> {
        let mut commands = std::mem::take(self.commands());
        self.sense();
        self.decide(&mut commands);
        let stopped = self.act(&commands);
        *self.commands() = commands;
        out.frame(self.frame())?;
        Ok(stopped)
    }
}

/// A scenario laid out in its map, checked. Nothing in it changes any more.
pub trait Scene: Sized + Debug + Send + Sync + 'static {
    /// What is flown in it.
    type Mission: Mission<Scene = Self>;
    /// What scenes that differ in other things may share, such as a table that takes long to make.
    type Shared: Default + Clone + Debug + Send + Sync + 'static;
    /// What a program adds to the words that scenarios of this mission may use, such as a strategy of its own; `()` where
    /// nothing can be added. [`Of::with`](crate::registry::Of::with) hands it to everything that reads scenarios.
    type Extensions: Copy + Debug + Send + Sync + 'static;

    /// Nothing added: scenarios use the words that are built in.
    const BUILTIN: Self::Extensions;
    /// The mission in a word, with its article: "a chain".
    const KIND: &'static str;
    /// One that flies: "UAV".
    const ROBOT: &'static str;

    /// The keys that its scenarios may have.
    const KEYS: &'static Keys;

    /// A scenario of it as JSON Schema, words that were added included; [`config::help`](crate::config::help) has what
    /// helps to make one.
    #[cfg(feature = "schema")]
    fn schema(extensions: Self::Extensions) -> serde_json::Value;

    /// Name and description of a scenario, its values checked one by one; nothing is laid out.
    ///
    /// # Errors
    /// What is wrong with the scenario, and where that was written.
    fn describe(document: &Document<'_>, extensions: Self::Extensions) -> Result<[String; 2], ConfigError>;

    /// Whether all values of a scenario are of the right types, whatever they are.
    fn takes(document: &Document<'_>, extensions: Self::Extensions) -> bool;

    /// Lays a scenario out. A `map` that was built before stands where the scenario names one.
    ///
    /// # Errors
    /// What is wrong with the scenario, and where that was written.
    fn lay(
        document: &Document<'_>,
        map: Option<Map>,
        shared: &Self::Shared,
        extensions: Self::Extensions,
    ) -> Result<Arc<Self>, ConfigError>;

    /// Reads, checks and lays out a scenario, with `sets` (`key=value`) written over it.
    ///
    /// # Errors
    /// What is wrong, and where that was written, `--set` included.
    fn read(source: &Source, sets: &[String]) -> Result<Arc<Self>, ConfigError> {
        Self::read_with(source, sets, Self::BUILTIN)
    }

    /// Like [`Scene::read`], of a scenario that may use added words.
    ///
    /// # Errors
    /// Those of [`Scene::read`].
    fn read_with(
        source: &Source,
        sets: &[String],
        extensions: Self::Extensions,
    ) -> Result<Arc<Self>, ConfigError> {
        let known = KnownKeys::of(&[Self::KEYS]);
        Self::lay(&Document::parse(source, sets, &known)?, None, &Self::Shared::default(), extensions)
    }

    /// Like [`Scene::read_with`], in a map that was built before: it stands where the scenario names one, which is not
    /// read.
    ///
    /// # Errors
    /// Those of [`Scene::read`].
    fn read_in(source: &Source, map: Map, extensions: Self::Extensions) -> Result<Arc<Self>, ConfigError> {
        let known = KnownKeys::of(&[Self::KEYS]);
        Self::lay(&Document::parse(source, &[], &known)?, Some(map), &Self::Shared::default(), extensions)
    }

    /// Like [`Scene::read_in`], of what was recorded: a scenario that names an answer which this program does not have, such as
    /// a law of somebody's own, can be looked at; a run of it ends as soon as that is asked.
    ///
    /// # Errors
    /// Those of [`Scene::read`].
    fn read_recorded(
        source: &Source,
        map: Map,
        extensions: Self::Extensions,
    ) -> Result<Arc<Self>, ConfigError> {
        Self::read_in(source, map, extensions)
    }

    /// The scenario's name.
    fn name(&self) -> &str;

    /// Its name, and what else tells at a glance which values it has.
    fn title(&self) -> String {
        self.name().to_owned()
    }

    /// The longest it may take (s).
    fn duration_s(&self) -> f64;

    /// How many fly.
    fn crew(&self) -> usize;

    /// What it is flown in.
    fn map(&self) -> &Arc<Map>;

    /// The scene of one run: as this one is, but for what the run's seed adds to it, such as shadows that stay in place.
    fn seeded(self: &Arc<Self>, _seed: u64) -> Arc<Self> {
        self.clone()
    }

    /// What one should know before the start.
    fn notes(&self) -> Vec<String>;

    /// The whole scenario in TOML: every value it has, whether written, set or by default. Read again it is the same
    /// scenario.
    ///
    /// # Errors
    /// None that a scenario that was read could cause.
    fn to_toml(&self) -> Result<String, toml::ser::Error>;
}

/// Watches a run and sums it up.
pub trait Metrics: Recorder<<Self::Mission as Mission>::Frame> + Debug + Send {
    /// Of what.
    type Mission: Mission;

    /// For a run of this scene.
    fn of(scene: Arc<<Self::Mission as Mission>::Scene>) -> Self;

    /// What the run has come to so far.
    fn sum_up(&self, seed: u64, digest: String) -> <Self::Mission as Mission>::Summary;
}

/// What a run came to.
pub trait Summary: Debug + Clone + PartialEq + Serialize + Send + Sync + 'static {
    /// What was found out about how it went.
    fn verdict(&self) -> &Verdict;

    /// The run's digest.
    fn digest(&self) -> &str;
}

/// A mission whose runs can be recorded.
#[cfg(feature = "record")]
pub trait Recorded: Mission<Frame: Recordable> {
    /// What its recordings show beside the frames.
    type Topics: Topics<Scene = Self::Scene, Frame = Self::Frame>;
}

#[cfg(feature = "record")]
impl<W: Write, T: Topics<Scene: Scene>> McapRecorder<W, T> {
    /// Begins a recording of a run: see [`McapRecorder::begin`].
    ///
    /// # Errors
    /// [`RecordError::Io`].
    pub fn start(to: W, scene: &T::Scene, seed: u64) -> Result<Self, RecordError> {
        Self::start_in(McapWriter::begin(to)?, scene, seed)
    }
}

#[cfg(feature = "record")]
impl<S: Sink, T: Topics<Scene: Scene>> MessageRecorder<S, T> {
    /// Begins a recording of a run, into a sink: see [`MessageRecorder::begin_in`].
    ///
    /// # Errors
    /// [`RecordError::Io`].
    pub fn start_in(sink: S, scene: &T::Scene, seed: u64) -> Result<Self, RecordError> {
        let scenario = scene.to_toml().map_err(std::io::Error::other)?;
        Self::begin_in(sink, &About::of(scenario, scene.map(), seed), scene.map(), scene)
    }
}

/// Why a mission is over.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Stopped {
    /// No frontier is left, and all are home.
    Explored,
    /// All are home, and frontiers are left that nobody knows of or finds a way to.
    Unreachable,
    /// All are home because there is room for no more nodes (`nodes_max`).
    Full,
    /// Nobody moves, and not all are home.
    Stuck,
    /// The longest time is up (`duration_s`).
    Time,
}

impl Stopped {
    /// The reason in words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Explored => "no frontier left, all home",
            Self::Unreachable => "all home, frontiers left that nobody finds a way to",
            Self::Full => "all home, no room for more nodes (nodes_max)",
            Self::Stuck => "nobody moves, and not all are home",
            Self::Time => "the time is up (duration_s)",
        }
    }
}
