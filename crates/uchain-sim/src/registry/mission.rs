//! Missions and their scenes behind one face each.

use std::{any::Any, fmt::Debug, marker::PhantomData, ops::ControlFlow, sync::Arc};

#[cfg(feature = "sweep")]
use crate::analyse::{Cell, Column};
#[cfg(all(feature = "record", feature = "draw"))]
use crate::record::mcap::Opened;
use crate::{
    analyse::Verdict,
    clock::time_s,
    config::{ConfigError, Document, Keys},
    map::Map,
    mission::{Scene, Shown, Summary as _},
    record::{RecordError, Recorder, Snapshot},
    run::{SummaryOf, run},
};
#[cfg(feature = "record")]
use crate::{mission::Recorded, record::mcap::McapRecorder};

/// A mission of whatever kind.
pub trait AnyMission: Debug + Sync {
    /// The mission in a word, with its article: "a chain".
    fn kind(&self) -> &'static str;

    /// The keys that its scenarios may have.
    fn keys(&self) -> &'static Keys;

    /// A scenario of it as JSON Schema.
    #[cfg(feature = "schema")]
    fn schema(&self) -> serde_json::Value;

    /// Name and description of a scenario, its values checked one by one.
    ///
    /// # Errors
    /// What is wrong with it, and where that was written.
    fn describe(&self, document: &Document<'_>) -> Result<[String; 2], ConfigError>;

    /// Lays a scenario out; a `map` that was built before stands where it names one.
    ///
    /// # Errors
    /// What is wrong with it, and where that was written.
    fn lay(
        &self,
        document: &Document<'_>,
        map: Option<Map>,
        shared: Option<&(dyn Any + Send + Sync)>,
    ) -> Result<Arc<dyn AnyScene>, ConfigError>;

    /// Whether all values of a scenario are of the right types, whatever they are.
    fn takes(&self, document: &Document<'_>) -> bool;

    /// A recording of this mission.
    #[cfg(all(feature = "record", feature = "draw"))]
    fn recording(&self, opened: Opened<super::recording::Input>) -> Box<dyn super::AnyRecording>;

    /// What scenes of one sweep may share.
    fn shared(&self) -> Box<dyn Any + Send + Sync>;

    /// Columns of the numbers that a run comes to.
    #[cfg(feature = "sweep")]
    fn columns(&self) -> Vec<Column>;
}

/// The mission that is flown in scenes of a kind.
pub struct Of<S>(PhantomData<fn() -> S>);

impl<S> Of<S> {
    /// There is but one.
    pub const NEW: Self = Self(PhantomData);
}

impl<S: Scene> Debug for Of<S> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(S::KIND)
    }
}

/// What a scene's mission can do for the doors: it can be looked at, and recorded if recordings are compiled in.
#[cfg(feature = "record")]
pub trait Whole: Scene<Mission: Shown + Recorded> {}
#[cfg(feature = "record")]
impl<S: Scene<Mission: Shown + Recorded>> Whole for S {}
/// What a scene's mission can do for the doors: it can be looked at.
#[cfg(not(feature = "record"))]
pub trait Whole: Scene<Mission: Shown> {}
#[cfg(not(feature = "record"))]
impl<S: Scene<Mission: Shown>> Whole for S {}

impl<S: Whole> AnyMission for Of<S> {
    fn kind(&self) -> &'static str {
        S::KIND
    }

    fn keys(&self) -> &'static Keys {
        S::KEYS
    }

    #[cfg(feature = "schema")]
    fn schema(&self) -> serde_json::Value {
        S::schema()
    }

    fn describe(&self, document: &Document<'_>) -> Result<[String; 2], ConfigError> {
        S::describe(document)
    }

    fn lay(
        &self,
        document: &Document<'_>,
        map: Option<Map>,
        shared: Option<&(dyn Any + Send + Sync)>,
    ) -> Result<Arc<dyn AnyScene>, ConfigError> {
        let shared =
            shared.and_then(|shared| shared.downcast_ref::<S::Shared>()).cloned().unwrap_or_default();
        S::lay(document, map, &shared).map(|scene| -> Arc<dyn AnyScene> { Arc::new(Laid(scene)) })
    }

    fn takes(&self, document: &Document<'_>) -> bool {
        S::takes(document)
    }

    #[cfg(all(feature = "record", feature = "draw"))]
    fn recording(&self, opened: Opened<super::recording::Input>) -> Box<dyn super::AnyRecording> {
        Box::new(crate::replay::Recording::<_, S>::from(opened))
    }

    fn shared(&self) -> Box<dyn Any + Send + Sync> {
        Box::new(S::Shared::default())
    }

    #[cfg(feature = "sweep")]
    fn columns(&self) -> Vec<Column> {
        let column = |(name, kind, _): &(&str, _, _)| Column {
            name: (*name).to_owned(),
            kind: *kind,
            is_result: true,
        };
        S::Mission::columns().iter().map(column).collect()
    }
}

/// What a run came to, of whatever mission.
#[derive(Debug)]
pub struct Flown {
    verdict: Verdict,
    digest: String,
    #[cfg(feature = "sweep")]
    cells: Vec<Cell>,
    summary: Box<dyn Any + Send + Sync>,
}

impl Flown {
    fn of<S: Whole>(summary: SummaryOf<S>) -> Self {
        Self {
            verdict: summary.verdict().clone(),
            digest: summary.digest().to_owned(),
            #[cfg(feature = "sweep")]
            cells: S::Mission::columns().iter().map(|(_, _, of)| of(&summary)).collect(),
            summary: Box::new(summary),
        }
    }

    /// What was found out about how it went.
    pub fn verdict(&self) -> &Verdict {
        &self.verdict
    }

    /// The run's digest.
    pub fn digest(&self) -> &str {
        &self.digest
    }

    /// The numbers it came to, under [`AnyMission::columns`].
    #[cfg(feature = "sweep")]
    pub fn cells(&self) -> &[Cell] {
        &self.cells
    }

    /// Its summary; `None` if it is of another type.
    pub fn summary<T: 'static>(&self) -> Option<&T> {
        self.summary.downcast_ref()
    }
}

/// How far a run has come.
pub struct Now<'a> {
    /// Ticks since the start.
    pub tick: u64,
    /// Whether somebody decided at the start of this tick.
    pub is_decision: bool,
    /// Says it in words.
    pub words: &'a dyn Fn() -> String,
}

impl Now<'_> {
    /// Simulated time at the end of the tick (s).
    pub fn time_s(&self) -> f64 {
        time_s(self.tick)
    }
}

/// Someone who is told at every tick how far a run has come, and can stop it.
pub trait Watch {
    /// One tick has passed; to break off is to be interrupted.
    fn tick(&mut self, now: &Now<'_>) -> ControlFlow<()>;
}

impl Watch for () {
    fn tick(&mut self, _: &Now<'_>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

/// Shows somebody who watches the frames of whatever mission.
pub(super) struct Watched<'a>(pub(super) &'a mut dyn Watch);

impl<F: Snapshot> Recorder<F> for Watched<'_> {
    fn frame(&mut self, frame: &F) -> Result<(), RecordError> {
        tell(self.0, frame, &String::new)
    }
}

/// Tells somebody who watches of a frame.
pub(super) fn tell<F: Snapshot>(
    watch: &mut dyn Watch,
    frame: &F,
    words: &dyn Fn() -> String,
) -> Result<(), RecordError> {
    let now = Now { tick: frame.tick(), is_decision: frame.is_decision(), words };
    match watch.tick(&now) {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(RecordError::Interrupted { time_s: now.time_s() }),
    }
}

/// A scene of whatever mission.
pub trait AnyScene: Debug + Send + Sync {
    /// The mission in a word, with its article: "a chain".
    fn kind(&self) -> &'static str;
    /// The scenario's name.
    fn name(&self) -> &str;
    /// Its name, and what else tells at a glance which values it has.
    fn title(&self) -> String;
    /// One that flies: "UAV".
    fn robot(&self) -> &'static str;
    /// How many fly.
    fn crew(&self) -> usize;
    /// The longest it may take (s).
    fn duration_s(&self) -> f64;
    /// Whether a run takes as long as its scenario says; else nobody knows before.
    fn runs_to_the_end(&self) -> bool;
    /// What it is flown in.
    fn map(&self) -> &Arc<Map>;
    /// What one should know before the start.
    fn notes(&self) -> Vec<String>;
    /// Flies from the first tick to the last.
    ///
    /// # Errors
    /// [`RecordError::Interrupted`] if `watch` says so.
    fn fly(&self, seed: u64, watch: &mut dyn Watch) -> Result<Flown, RecordError>;
    /// Begins a recording, for a run to fly.
    ///
    /// # Errors
    /// The recording cannot be written.
    #[cfg(feature = "record")]
    fn record<'a>(&self, seed: u64, to: Sink<'a>) -> Result<Box<dyn RecordedRun + 'a>, RecordError>;
    /// Names of the files that a run leaves beside its numbers, its picture and its recording.
    fn files(&self) -> &'static [&'static str];
    /// Gets ready for a run whose results are kept; a recording, if it is to leave one, begins at once.
    ///
    /// # Errors
    /// The recording cannot be written.
    #[cfg(all(feature = "record", feature = "draw"))]
    fn prepare(
        &self,
        seed: u64,
        recording: Option<Sink<'static>>,
    ) -> Result<Box<dyn super::Flight>, RecordError>;
    /// The scene itself, an `Arc<S>`.
    fn as_any(&self) -> &(dyn Any + Send + Sync);
}

impl dyn AnyScene + '_ {
    /// The scene itself, if it is of this kind.
    pub fn get<S: Scene>(&self) -> Option<&Arc<S>> {
        self.as_any().downcast_ref()
    }
}

/// Where the bytes of a recording go.
#[cfg(feature = "record")]
pub type Sink<'a> = Box<dyn std::io::Write + 'a>;

/// A run that leaves a recording, which has begun.
#[cfg(feature = "record")]
pub trait RecordedRun {
    /// Flies from the first tick to the last.
    ///
    /// # Errors
    /// [`RecordError::Interrupted`] if `watch` says so; the recording cannot be written.
    fn fly(&mut self, watch: &mut dyn Watch) -> Result<Flown, RecordError>;

    /// Ends the recording with its index, wherever the run has ended.
    ///
    /// # Errors
    /// The recording cannot be written.
    fn finish(self: Box<Self>) -> Result<(), RecordError>;
}

#[cfg(feature = "record")]
struct Recording<'a, S: Whole> {
    scene: Arc<S>,
    seed: u64,
    recorder: McapRecorder<Sink<'a>, <S::Mission as Recorded>::Topics>,
}

#[cfg(feature = "record")]
impl<S: Whole> RecordedRun for Recording<'_, S> {
    fn fly(&mut self, watch: &mut dyn Watch) -> Result<Flown, RecordError> {
        run(&self.scene, self.seed, &mut (Watched(watch), &mut self.recorder)).map(Flown::of::<S>)
    }

    fn finish(self: Box<Self>) -> Result<(), RecordError> {
        self.recorder.finish().map(drop)
    }
}

/// A scene of a known mission.
#[derive(Debug)]
struct Laid<S>(Arc<S>);

impl<S: Whole> AnyScene for Laid<S> {
    fn kind(&self) -> &'static str {
        S::KIND
    }

    fn name(&self) -> &str {
        self.0.name()
    }

    fn title(&self) -> String {
        self.0.title()
    }

    fn robot(&self) -> &'static str {
        S::ROBOT
    }

    fn crew(&self) -> usize {
        self.0.crew()
    }

    fn duration_s(&self) -> f64 {
        self.0.duration_s()
    }

    fn runs_to_the_end(&self) -> bool {
        S::Mission::RUNS_TO_THE_END
    }

    fn map(&self) -> &Arc<Map> {
        self.0.map()
    }

    fn notes(&self) -> Vec<String> {
        self.0.notes()
    }

    fn fly(&self, seed: u64, watch: &mut dyn Watch) -> Result<Flown, RecordError> {
        run(&self.0, seed, &mut Watched(watch)).map(Flown::of::<S>)
    }

    #[cfg(feature = "record")]
    fn record<'a>(&self, seed: u64, to: Sink<'a>) -> Result<Box<dyn RecordedRun + 'a>, RecordError> {
        let recorder = McapRecorder::start(to, &*self.0, seed)?;
        Ok(Box::new(Recording::<'a, S> { scene: self.0.clone(), seed, recorder }))
    }

    fn files(&self) -> &'static [&'static str] {
        S::Mission::FILES
    }

    #[cfg(all(feature = "record", feature = "draw"))]
    fn prepare(
        &self,
        seed: u64,
        recording: Option<Sink<'static>>,
    ) -> Result<Box<dyn super::Flight>, RecordError> {
        super::flight::prepare(self.0.clone(), seed, recording)
    }

    fn as_any(&self) -> &(dyn Any + Send + Sync) {
        &self.0
    }
}
