//! Recordings of whatever mission: summed up, flown again, side by side.

use std::{
    any::Any,
    fs::File,
    io::{BufReader, Read},
    path::Path,
    sync::Arc,
};

use serde::Serialize;

use super::{
    AnyScene, FlightError, Kept, Registry, Watch, flight::Report, kept::keep_recorded, mission::Whole,
    scene::Laid,
};
use crate::{
    clock::total_ticks,
    config::Document,
    mission::{History as _, Keep, Shown, Timeline},
    record::{
        Comparison,
        mcap::{About, End, Opened, PlayError, ReadError},
    },
    replay::{DiffError, Recording, Verdict, diff, verify_while},
    run::{MetricsOf, SummaryOf},
};

/// Moments in JSON, at most twice as many.
const MOMENTS: usize = 500;
/// Rows of the table, at most twice as many.
const ROWS: usize = 12;

/// A recording of whatever mission.
pub trait AnyRecording {
    /// The mission in a word, with its article: "a chain".
    fn kind(&self) -> &'static str;

    /// What it is of.
    fn about(&self) -> &About;

    /// Ticks that have been read so far.
    fn ticks(&self) -> u64;

    /// Plays it to its end and sums it up.
    ///
    /// # Errors
    /// [`PlayError`].
    fn inspect(&mut self) -> Result<Box<dyn Inspection>, PlayError>;

    /// Plays it to its end and keeps all that a program may ask for, the frames that are asked for among it.
    ///
    /// # Errors
    /// [`PlayError`], that of an interruption if `watch` says so.
    fn keep(&mut self, frames: Option<Keep>, watch: &mut dyn Watch) -> Result<Box<dyn Kept>, PlayError>;

    /// The scene it was flown in, in the walls that were recorded.
    ///
    /// # Errors
    /// [`ReadError::Scenario`]: this version cannot fly it.
    fn any_scene(&mut self) -> Result<Arc<dyn AnyScene>, ReadError>;

    /// Flies it again: see [`verify`](crate::replay::verify).
    ///
    /// # Errors
    /// [`ReadError`].
    fn verify(&mut self) -> Result<Verdict, ReadError> {
        self.verify_while(&mut || true)
    }

    /// Flies it again as long as somebody wants to go on: see [`verify_while`](crate::replay::verify_while).
    ///
    /// # Errors
    /// [`ReadError`].
    fn verify_while(&mut self, go_on: &mut dyn FnMut() -> bool) -> Result<Verdict, ReadError>;

    /// Compares what is left of it with another one of the same mission, and reads both to their ends; `None` for one of
    /// another mission.
    ///
    /// # Errors
    /// [`DiffError`].
    fn diff(&mut self, there: &mut dyn AnyRecording) -> Result<Option<Comparison>, DiffError>;

    /// Itself.
    fn as_any(&mut self) -> &mut dyn Any;
}

/// What a recording comes to.
pub trait Inspection {
    /// Whether the file ends as a recording does.
    fn is_whole(&self) -> bool;

    /// Numbers, and numbers over time, with a newline at its end.
    ///
    /// # Errors
    /// [`FlightError::Json`].
    fn json(&self) -> Result<String, FlightError>;

    /// The same for people.
    fn text(&self, files: &str) -> String;

    /// The run on one page, as a PNG.
    ///
    /// # Errors
    /// [`FlightError::Draw`].
    fn picture(&mut self) -> Result<Vec<u8>, FlightError>;
}

/// Bytes of a recording.
pub(super) type Input = Box<dyn Read>;

impl Registry {
    /// The recording in a file, of whatever mission; messages call it by its path.
    ///
    /// # Errors
    /// [`ReadError`].
    pub fn open(self, path: &Path) -> Result<Box<dyn AnyRecording>, ReadError> {
        self.open_bytes(Box::new(BufReader::new(File::open(path)?)), &path.display().to_string())
    }

    /// A recording of whatever mission; `label` names it in messages.
    ///
    /// # Errors
    /// [`ReadError`].
    pub fn open_bytes(self, input: Box<dyn Read>, label: &str) -> Result<Box<dyn AnyRecording>, ReadError> {
        let opened = Opened::read(input, label)?;
        let source = opened.source();
        let known = self.known();
        let mission = Document::parse(&source, &[], &known).map(|document| self.mission_of(&document));
        Ok(mission.map_err(Box::new)?.recording(opened))
    }
}

impl<S: Whole> AnyRecording for Recording<Input, S> {
    fn kind(&self) -> &'static str {
        S::KIND
    }

    fn about(&self) -> &About {
        &self.about
    }

    fn ticks(&self) -> u64 {
        self.frames.tick()
    }

    fn inspect(&mut self) -> Result<Box<dyn Inspection>, PlayError> {
        let scene = self.scene()?;
        let mut history = <S::Mission as Shown>::History::of(&scene);
        let mut timeline = <S::Mission as Shown>::Timeline::of(&scene, MOMENTS);
        let (summary, metrics) = self.play(&scene, &mut (&mut history, &mut timeline))?;
        Ok(Box::new(Inspected::<S> {
            summary,
            metrics,
            history,
            kept: timeline.kept(),
            ticks: self.frames.tick(),
            is_whole: self.frames.end() == Some(End::Whole),
            version: self.about.version.clone(),
            scene,
        }))
    }

    fn keep(&mut self, frames: Option<Keep>, watch: &mut dyn Watch) -> Result<Box<dyn Kept>, PlayError> {
        keep_recorded(self, frames, watch)
    }

    fn any_scene(&mut self) -> Result<Arc<dyn AnyScene>, ReadError> {
        Ok(Arc::new(Laid(self.scene()?)))
    }

    fn verify_while(&mut self, go_on: &mut dyn FnMut() -> bool) -> Result<Verdict, ReadError> {
        verify_while(self, go_on)
    }

    fn diff(&mut self, there: &mut dyn AnyRecording) -> Result<Option<Comparison>, DiffError> {
        let Some(there) = there.as_any().downcast_mut::<Self>() else { return Ok(None) };
        diff(&mut self.frames, &mut there.frames).map(Some)
    }

    fn as_any(&mut self) -> &mut dyn Any {
        self
    }
}

struct Inspected<S: Whole> {
    scene: Arc<S>,
    summary: SummaryOf<S>,
    metrics: MetricsOf<S>,
    history: <S::Mission as Shown>::History,
    kept: <<S::Mission as Shown>::Timeline as Timeline>::Kept,
    ticks: u64,
    is_whole: bool,
    version: String,
}

/// `inspect.json`.
#[derive(Serialize)]
struct Numbers<'a, T, K> {
    #[serde(flatten)]
    report: Report<'a, T>,
    /// Ticks that were recorded.
    ticks: u64,
    /// Those of a whole run, where somebody knows.
    #[serde(skip_serializing_if = "Option::is_none")]
    of_ticks: Option<u64>,
    /// Whether the file ends as a recording does.
    whole: bool,
    #[serde(flatten)]
    kept: &'a K,
}

impl<S: Whole> Inspection for Inspected<S> {
    fn is_whole(&self) -> bool {
        self.is_whole
    }

    fn json(&self) -> Result<String, FlightError> {
        let numbers = Numbers {
            report: Report { summary: &self.summary, wall_s: None, version: &self.version },
            ticks: self.ticks,
            of_ticks: S::Mission::RUNS_TO_THE_END.then(|| total_ticks(self.scene.duration_s())),
            whole: self.is_whole,
            kept: &self.kept,
        };
        Ok(serde_json::to_string_pretty(&numbers)? + "\n")
    }

    fn text(&self, files: &str) -> String {
        let table = <S::Mission as Shown>::Timeline::table(&self.kept, ROWS);
        S::Mission::text(&self.summary, None, files) + &table
    }

    fn picture(&mut self) -> Result<Vec<u8>, FlightError> {
        Ok(S::Mission::picture(&self.scene, &mut self.history, &self.metrics, &self.summary)?)
    }
}
