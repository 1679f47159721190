//! A run whose results are kept: numbers, words, picture, recording.

use std::sync::Arc;

use serde::Serialize;

use super::{Output, Watch, Whole, watch::tell};
use crate::{
    draw::DrawError,
    mission::{History, Mission, Recorded, Shown, Summary as _},
    record::{RecordError, Recorder, mcap::McapRecorder},
    run::{MetricsOf, SummaryOf, fly},
};

/// Why a run has no results.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FlightError {
    /// It has not been flown.
    #[error("it has not been flown to its end")]
    NotFlown,
    /// No picture.
    #[error(transparent)]
    Draw(#[from] DrawError),
    /// No numbers.
    #[error("cannot write JSON: {0}")]
    Json(#[from] serde_json::Error),
}

/// A run whose results are kept: first it is flown, then it has results.
pub trait Flight {
    /// Flies from the first tick to the last.
    ///
    /// # Errors
    /// [`RecordError::Interrupted`] if `watch` says so; the recording cannot be written.
    fn fly(&mut self, watch: &mut dyn Watch) -> Result<(), RecordError>;

    /// Ends the recording with its index; `false` if there is none.
    ///
    /// # Errors
    /// The recording cannot be written.
    fn end_recording(&mut self) -> Result<bool, RecordError>;

    /// The run's digest; empty before it was flown.
    fn digest(&self) -> &str;

    /// `summary.json`, with a newline at its end: `wall_s` is how long the computer flew (s), the only number that differs
    /// from run to run.
    ///
    /// # Errors
    /// [`FlightError`].
    fn json(&self, wall_s: f64, version: &str) -> Result<String, FlightError>;

    /// The summary for people.
    fn text(&self, wall_s: f64, files: &str) -> String;

    /// The run on one page, as a PNG.
    ///
    /// # Errors
    /// [`FlightError`].
    fn picture(&mut self) -> Result<Vec<u8>, FlightError>;

    /// What [`AnyScene::files`](super::AnyScene::files) names.
    ///
    /// # Errors
    /// [`FlightError`].
    fn files(&mut self) -> Result<Vec<Vec<u8>>, FlightError>;
}

/// The numbers of a run, and whose they are.
#[derive(Debug, Serialize)]
pub(super) struct Report<'a, T> {
    #[serde(flatten)]
    pub(super) summary: &'a T,
    /// How long the computer flew (s). A recording does not say.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) wall_s: Option<f64>,
    /// Version of uchain that flew.
    pub(super) version: &'a str,
}

struct Prepared<S: Whole> {
    scene: Arc<S>,
    seed: u64,
    recorder: Option<McapRecorder<Output<'static>, <S::Mission as Recorded>::Topics>>,
    history: <S::Mission as Shown>::History,
    flown: Option<(SummaryOf<S>, MetricsOf<S>)>,
}

pub(super) fn prepare<S: Whole>(
    scene: Arc<S>,
    seed: u64,
    recording: Option<Output<'static>>,
) -> Result<Box<dyn Flight>, RecordError> {
    let recorder = recording.map(|sink| McapRecorder::start(sink, &*scene, seed)).transpose()?;
    let history = <S::Mission as Shown>::History::of(&scene);
    Ok(Box::new(Prepared { scene, seed, recorder, history, flown: None }))
}

/// Keeps what pictures need, and tells whoever watches.
struct Watched<'a, H> {
    history: &'a mut H,
    watch: &'a mut dyn Watch,
}

impl<H: History> Recorder<<H::Mission as Mission>::Frame> for Watched<'_, H> {
    fn frame(&mut self, frame: &<H::Mission as Mission>::Frame) -> Result<(), RecordError> {
        let history = &*self.history;
        tell(self.watch, frame, &|| history.progress(frame))?;
        self.history.frame(frame)
    }
}

impl<S: Whole> Flight for Prepared<S> {
    fn fly(&mut self, watch: &mut dyn Watch) -> Result<(), RecordError> {
        let mut watched = Watched { history: &mut self.history, watch };
        self.flown = Some(fly(&self.scene, self.seed, &mut (&mut watched, &mut self.recorder))?);
        Ok(())
    }

    fn end_recording(&mut self) -> Result<bool, RecordError> {
        match self.recorder.take() {
            Some(recorder) => recorder.finish().map(|_| true),
            None => Ok(false),
        }
    }

    fn digest(&self) -> &str {
        self.flown.as_ref().map_or("", |(summary, _)| summary.digest())
    }

    fn json(&self, wall_s: f64, version: &str) -> Result<String, FlightError> {
        let (summary, _) = self.flown.as_ref().ok_or(FlightError::NotFlown)?;
        let report = Report { summary, wall_s: Some(wall_s), version };
        Ok(serde_json::to_string_pretty(&report)? + "\n")
    }

    fn text(&self, wall_s: f64, files: &str) -> String {
        let flown = self.flown.as_ref();
        flown.map(|(summary, _)| S::Mission::text(summary, Some(wall_s), files)).unwrap_or_default()
    }

    fn picture(&mut self) -> Result<Vec<u8>, FlightError> {
        let (summary, metrics) = self.flown.as_ref().ok_or(FlightError::NotFlown)?;
        Ok(S::Mission::picture(&self.scene, &mut self.history, metrics, summary)?)
    }

    fn files(&mut self) -> Result<Vec<Vec<u8>>, FlightError> {
        let (summary, _) = self.flown.as_ref().ok_or(FlightError::NotFlown)?;
        Ok(S::Mission::files(&self.scene, &mut self.history, summary)?)
    }
}
