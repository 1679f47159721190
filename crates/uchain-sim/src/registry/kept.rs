//! A run, flown or recorded, of which all is kept that a program may ask for: numbers, numbers over time, events, graph,
//! picture.

use std::sync::Arc;

use super::{FlightError, Output, Watch, Whole, flight::Report, watch::tell};
use crate::{
    analyse::Verdict,
    mission::{Graph, History as _, Keep, Log, Logbook, Shown, Summary as _},
    record::{
        RecordError, Recorder, Snapshot as _,
        mcap::{End, McapRecorder, PlayError},
    },
    replay::Recording,
    run::{FrameOf, MetricsOf, SummaryOf, fly},
};

/// A run, flown or recorded, of which all is kept.
pub trait Kept: Send {
    /// What was found out about how it went.
    fn verdict(&self) -> &Verdict;

    /// Its digest.
    fn digest(&self) -> &str;

    /// `summary.json`; `wall_s` is how long the computer flew (s), which a recording does not say.
    ///
    /// # Errors
    /// [`FlightError::Json`].
    fn json(&self, wall_s: Option<f64>, version: &str) -> Result<String, FlightError>;

    /// Numbers over time, and what happened. They are handed over: a second time there is nothing.
    fn take_log(&mut self) -> Log;

    /// The graph it made; `None` of a mission that makes none.
    fn graph(&self) -> Option<Graph>;

    /// The run on one page, as a PNG.
    ///
    /// # Errors
    /// [`FlightError::Draw`].
    fn picture(&mut self) -> Result<Vec<u8>, FlightError>;

    /// Ticks of it.
    fn ticks(&self) -> u64;

    /// Whether it is there up to its end.
    fn is_whole(&self) -> bool;
}

struct Results<S: Whole> {
    scene: Arc<S>,
    history: <S::Mission as Shown>::History,
    summary: SummaryOf<S>,
    metrics: MetricsOf<S>,
    log: Log,
    ticks: u64,
    is_whole: bool,
}

/// Keeps all that results are made of, and tells whoever watches.
struct Keeper<'a, S: Whole> {
    history: <S::Mission as Shown>::History,
    logbook: Option<Box<dyn Logbook<S::Mission>>>,
    ticks: u64,
    watch: &'a mut dyn Watch,
}

impl<'a, S: Whole> Keeper<'a, S> {
    fn new(scene: &Arc<S>, frames: Option<Keep>, watch: &'a mut dyn Watch) -> Result<Self, RecordError> {
        let logbook = S::Mission::logbook(scene, frames)?;
        Ok(Self { history: <S::Mission as Shown>::History::of(scene), logbook, ticks: 0, watch })
    }

    fn results(
        self,
        scene: Arc<S>,
        (summary, metrics): (SummaryOf<S>, MetricsOf<S>),
        is_whole: bool,
    ) -> Box<dyn Kept> {
        let log = self.logbook.map(|logbook| logbook.close(&metrics)).unwrap_or_default();
        let (history, ticks) = (self.history, self.ticks);
        Box::new(Results { scene, history, summary, metrics, log, ticks, is_whole })
    }
}

impl<S: Whole> Recorder<FrameOf<S>> for Keeper<'_, S> {
    fn frame(&mut self, frame: &FrameOf<S>) -> Result<(), RecordError> {
        let history = &self.history;
        tell(self.watch, frame, &|| history.progress(frame))?;
        self.ticks = frame.tick();
        self.history.frame(frame)?;
        self.logbook.as_mut().map_or(Ok(()), |logbook| logbook.frame(frame))
    }
}

/// Flies a run and keeps all of it; writes a recording if there is somewhere to.
pub(super) fn keep<S: Whole>(
    scene: &Arc<S>,
    seed: u64,
    frames: Option<Keep>,
    recording: Option<Output<'_>>,
    watch: &mut dyn Watch,
) -> Result<Box<dyn Kept>, RecordError> {
    let mut keeper = Keeper::new(scene, frames, watch)?;
    let recorder = recording.map(|sink| {
        McapRecorder::<_, <S::Mission as crate::mission::Recorded>::Topics>::start(sink, &**scene, seed)
    });
    let mut recorder = recorder.transpose()?;
    let flown = fly(scene, seed, &mut (&mut keeper, &mut recorder))?;
    recorder.map(McapRecorder::finish).transpose()?;
    Ok(keeper.results(scene.clone(), flown, true))
}

/// Plays what is left of a recording and keeps all of it.
pub(super) fn keep_recorded<R: std::io::Read, S: Whole>(
    recording: &mut Recording<R, S>,
    frames: Option<Keep>,
    watch: &mut dyn Watch,
) -> Result<Box<dyn Kept>, PlayError> {
    let scene = recording.scene()?;
    let mut keeper = Keeper::new(&scene, frames, watch)?;
    let played = recording.play(&scene, &mut keeper)?;
    let is_whole = recording.frames.end() == Some(End::Whole);
    Ok(keeper.results(scene, played, is_whole))
}

impl<S: Whole> Kept for Results<S> {
    fn verdict(&self) -> &Verdict {
        self.summary.verdict()
    }

    fn digest(&self) -> &str {
        self.summary.digest()
    }

    fn json(&self, wall_s: Option<f64>, version: &str) -> Result<String, FlightError> {
        let report = Report { summary: &self.summary, wall_s, version };
        Ok(serde_json::to_string_pretty(&report)? + "\n")
    }

    fn take_log(&mut self) -> Log {
        std::mem::take(&mut self.log)
    }

    fn graph(&self) -> Option<Graph> {
        S::Mission::graph(&self.history)
    }

    fn picture(&mut self) -> Result<Vec<u8>, FlightError> {
        Ok(S::Mission::picture(&self.scene, &mut self.history, &self.metrics, &self.summary)?)
    }

    fn ticks(&self) -> u64 {
        self.ticks
    }

    fn is_whole(&self) -> bool {
        self.is_whole
    }
}
