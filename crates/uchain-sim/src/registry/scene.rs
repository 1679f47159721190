//! Scenes of whatever mission, and runs in them.

use std::{any::Any, fmt::Debug, sync::Arc};

use super::{
    Flown, Whole,
    watch::{Watch, Watched},
};
#[cfg(all(feature = "record", feature = "draw"))]
use crate::mission::Keep;
use crate::{
    map::Map,
    mission::{Scene, Shown},
    record::RecordError,
    run::run,
};
#[cfg(feature = "record")]
use crate::{mission::Recorded, record::mcap::McapRecorder};

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
    /// The whole scenario in TOML, every value written out: see [`Scene::to_toml`].
    ///
    /// # Errors
    /// None that a scenario that was read could cause.
    fn to_toml(&self) -> Result<String, toml::ser::Error>;
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
    fn record<'a>(&self, seed: u64, to: Output<'a>) -> Result<Box<dyn RecordedRun + 'a>, RecordError>;
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
        recording: Option<Output<'static>>,
    ) -> Result<Box<dyn super::Flight>, RecordError>;
    /// Flies and keeps all that a program may ask for, the frames that are asked for among it. A recording is ended with its
    /// index; one that could not be ended is no whole file.
    ///
    /// # Errors
    /// [`RecordError::Interrupted`] if `watch` says so; the recording cannot be written; the frames would take too much
    /// memory, which is said before the first tick.
    #[cfg(all(feature = "record", feature = "draw"))]
    fn keep(
        &self,
        seed: u64,
        frames: Option<Keep>,
        recording: Option<Output<'_>>,
        watch: &mut dyn Watch,
    ) -> Result<Box<dyn super::Kept>, RecordError>;
    /// The scene itself, an `Arc<S>`.
    fn as_any(&self) -> &(dyn Any + Send + Sync);
}

impl dyn AnyScene {
    /// A scene of a known mission as one of whatever mission, such as a course with a law of one's own.
    pub fn of<S: Whole>(scene: Arc<S>) -> Arc<Self> {
        Arc::new(Laid(scene))
    }
}

impl dyn AnyScene + '_ {
    /// The scene itself, if it is of this kind.
    pub fn get<S: Scene>(&self) -> Option<&Arc<S>> {
        self.as_any().downcast_ref()
    }
}

/// Where the bytes of a recording go.
#[cfg(feature = "record")]
pub type Output<'a> = Box<dyn std::io::Write + 'a>;

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
    recorder: McapRecorder<Output<'a>, <S::Mission as Recorded>::Topics>,
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
pub(super) struct Laid<S>(pub(super) Arc<S>);

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

    fn to_toml(&self) -> Result<String, toml::ser::Error> {
        self.0.to_toml()
    }

    fn fly(&self, seed: u64, watch: &mut dyn Watch) -> Result<Flown, RecordError> {
        run(&self.0, seed, &mut Watched(watch)).map(Flown::of::<S>)
    }

    #[cfg(feature = "record")]
    fn record<'a>(&self, seed: u64, to: Output<'a>) -> Result<Box<dyn RecordedRun + 'a>, RecordError> {
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
        recording: Option<Output<'static>>,
    ) -> Result<Box<dyn super::Flight>, RecordError> {
        super::flight::prepare(self.0.clone(), seed, recording)
    }

    #[cfg(all(feature = "record", feature = "draw"))]
    fn keep(
        &self,
        seed: u64,
        frames: Option<Keep>,
        recording: Option<Output<'_>>,
        watch: &mut dyn Watch,
    ) -> Result<Box<dyn super::Kept>, RecordError> {
        super::kept::keep(&self.0, seed, frames, recording, watch)
    }

    fn as_any(&self) -> &(dyn Any + Send + Sync) {
        &self.0
    }
}
