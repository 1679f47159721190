//! A flight: flown here, or read from a recording; looked at, steered, flown again.

mod again;
mod film;
mod flight;
mod rows;
mod tape;
#[cfg(test)]
mod tests;

use std::{io::Cursor, sync::Arc};

use serde::Serialize;
use serde_json::Value;
use uchain_sim::{
    analyse::Digest,
    mission::{Logbook, Metrics as _, Mission, Shown},
    pilot::{Asked, INPUTS_MAX},
    record::mcap::Opened,
    replay::Recording,
    run::{FrameOf, InputOf, MetricsOf},
};

use crate::{
    problem::Problem,
    seen::Viewed,
    told::{FlightFile, Input, Since, TimedInput},
};
use again::Again;
use film::Film;
use rows::Rows;
pub(crate) use rows::Series;
use tape::Tape;

/// Where a flight has come to.
#[derive(Debug, Serialize)]
pub(crate) struct Advanced {
    tick: u64,
    stopped: Option<End>,
    kept_every: u64,
    events: Vec<Value>,
    rows: usize,
    generation: u32,
}

/// Why it is over.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct End {
    why: String,
    words: String,
}

/// A flight that becomes a recording.
#[derive(Debug)]
pub(crate) struct Taped {
    pub(crate) tick: u64,
    pub(crate) file: Option<Vec<u8>>,
}

/// A flight of whatever mission.
pub(crate) trait Flight: std::fmt::Debug {
    fn scene(&self) -> Result<Value, Problem>;
    fn advance(&mut self, ticks: u64) -> Result<Advanced, Problem>;
    fn steer(&mut self, input: Input) -> Result<(), Problem>;
    fn cut(&mut self, tick: u64) -> Result<(), Problem>;
    fn frame(&mut self, tick: u64) -> Result<String, Problem>;
    fn why(&mut self, tick: u64, uav: usize) -> Result<Value, Problem>;
    fn series(&self, from: usize) -> Series;
    fn events(&self) -> Vec<Value>;
    fn graph(&self, from: Since) -> Value;
    fn inputs(&self) -> Vec<TimedInput>;
    fn summary(&self) -> Result<Value, Problem>;
    fn to_file(&self) -> FlightFile;
    fn toml(&self, by_hand: bool) -> Result<String, Problem>;
    fn record(&mut self, ticks: u64) -> Result<Taped, Problem>;
}

/// Bytes of a recording.
type Bytes = Cursor<Vec<u8>>;

/// Where frames come from.
#[derive(Debug)]
enum Origin<S: Viewed> {
    /// They are flown.
    Live(S::Mission),
    /// They were.
    File(Box<Recording<Bytes, S>>),
}

/// A flight in scenes of a kind.
#[derive(Debug)]
pub(crate) struct Flown<S: Viewed> {
    scene: Arc<S>,
    file: FlightFile,
    origin: Origin<S>,
    /// Of a recording: whether this program has all that it takes to fly it again.
    flies_again: bool,
    /// What the pilot asks for, in order, as far as is known.
    inputs: Vec<Asked<InputOf<S>>>,
    tick: u64,
    end: Option<End>,
    watched: Watched<S>,
    again: Again<S>,
    tape: Option<Tape<S>>,
}

/// Those who are shown every frame.
struct Watched<S: Viewed> {
    metrics: MetricsOf<S>,
    digest: Digest,
    log: Option<Box<dyn Logbook<S::Mission>>>,
    /// Events that the page has been told of.
    told: usize,
    read: S::Read,
    film: Film<FrameOf<S>>,
    rows: Rows,
    extra: S::Extra,
}

impl<S: Viewed> std::fmt::Debug for Watched<S> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Watched").finish_non_exhaustive()
    }
}

impl<S: Viewed> Watched<S> {
    fn new(scene: &Arc<S>) -> Result<Self, Problem> {
        Ok(Self {
            metrics: MetricsOf::<S>::of(scene.clone()),
            digest: Digest::default(),
            log: S::Mission::logbook(scene, None).map_err(Problem::new)?,
            told: 0,
            read: S::Read::default(),
            film: Film::default(),
            rows: Rows::new(scene.columns()),
            extra: S::Extra::default(),
        })
    }
}

impl<S: Viewed> Flown<S> {
    /// One that is flown here.
    pub(crate) fn live(scene: Arc<S>, file: FlightFile, inputs: Vec<TimedInput>) -> Result<Self, Problem> {
        let inputs = checked::<S>(inputs)?;
        let mission = S::Mission::start(scene.clone(), file.seed);
        Self::new(scene, file, Origin::Live(mission), true, inputs)
    }

    /// One that was recorded.
    pub(crate) fn recorded(opened: Opened<Bytes>, file: FlightFile) -> Result<Self, Problem> {
        let mut recording = Recording::<_, S>::from(opened);
        let (scene, flies_again) = match recording.scene_to_fly() {
            Ok(scene) => (scene, true),
            Err(_) => (recording.scene().map_err(Problem::new)?, false),
        };
        Self::new(scene, file, Origin::File(Box::new(recording)), flies_again, Vec::new())
    }

    fn new(
        scene: Arc<S>,
        file: FlightFile,
        origin: Origin<S>,
        flies_again: bool,
        inputs: Vec<Asked<InputOf<S>>>,
    ) -> Result<Self, Problem> {
        let watched = Watched::new(&scene.seeded(file.seed))?;
        let again = Again::default();
        Ok(Self { scene, file, origin, flies_again, inputs, tick: 0, end: None, watched, again, tape: None })
    }
}

/// Inputs as a scene's mission takes them, in order of time.
fn checked<S: Viewed>(inputs: Vec<TimedInput>) -> Result<Vec<Asked<InputOf<S>>>, Problem> {
    if inputs.len() > INPUTS_MAX {
        return Err(Problem::new(format!(
            "{} inputs of the pilot: expected at most {INPUTS_MAX}",
            inputs.len()
        )));
    }
    let mut asked: Vec<Asked<InputOf<S>>> = Vec::with_capacity(inputs.len());
    for timed in inputs {
        let input = S::input(timed.into())?;
        if asked.last().is_some_and(|last| last.tick >= timed.tick) {
            return Err(Problem::new(format!(
                "the pilot's input at tick {}: expected inputs in order",
                timed.tick
            )));
        }
        asked.push(Asked { tick: timed.tick, input });
    }
    Ok(asked)
}
