//! What people see of a mission: words, tables and pictures.

use std::sync::Arc;

use serde::Serialize;

use super::{Graph, Keep, Logbook, Mission};
#[cfg(feature = "sweep")]
use crate::analyse::Field;
#[cfg(feature = "draw")]
use crate::draw::DrawError;
use crate::record::{RecordError, Recorder};

/// A mission that people can look at: what the command line and reports need of it.
pub trait Shown: Mission {
    /// Keeps what pictures and progress need of a run, in bounded memory.
    type History: History<Mission = Self>;
    /// Keeps numbers over time of a bounded number of moments.
    type Timeline: Timeline<Mission = Self>;

    /// Whether a run takes as long as its scenario says; else nobody knows before.
    const RUNS_TO_THE_END: bool;

    /// A few aligned lines that say what a run came to; `wall_s` is how long the computer flew (s), `files` where results
    /// are.
    fn text(summary: &Self::Summary, wall_s: Option<f64>, files: &str) -> String;

    /// The numbers of a summary that stand in the table of a sweep, under the names of `summary.json`.
    #[cfg(feature = "sweep")]
    fn columns() -> &'static [Field<Self::Summary>];

    /// Keeps the numbers of a run in this scene over time, and what happens in it, for programs; `None` of a mission that
    /// keeps nothing. The frames are those that are asked for, if any.
    ///
    /// # Errors
    /// [`RecordError::TooMuch`]: they would take too much memory.
    fn logbook(
        _scene: &Arc<Self::Scene>,
        _frames: Option<Keep>,
    ) -> Result<Option<Box<dyn Logbook<Self>>>, RecordError> {
        Ok(None)
    }

    /// The graph that was made of what was found; `None` of a mission that makes none.
    fn graph(_history: &Self::History) -> Option<Graph> {
        None
    }

    /// One run on one page, as a PNG.
    ///
    /// # Errors
    /// [`DrawError`].
    #[cfg(feature = "draw")]
    fn picture(
        scene: &Arc<Self::Scene>,
        history: &mut Self::History,
        metrics: &Self::Metrics,
        summary: &Self::Summary,
    ) -> Result<Vec<u8>, DrawError>;

    /// Names of the files that a run leaves beside its numbers, its picture and its recording.
    const FILES: &'static [&'static str] = &[];

    /// Those files, in the order of [`Shown::FILES`].
    ///
    /// # Errors
    /// [`DrawError`].
    #[cfg(feature = "draw")]
    fn files(
        _scene: &Arc<Self::Scene>,
        _history: &mut Self::History,
        _summary: &Self::Summary,
    ) -> Result<Vec<Vec<u8>>, DrawError> {
        Ok(Vec::new())
    }
}

/// Keeps what pictures and progress need of a run, in bounded memory.
pub trait History: Recorder<<Self::Mission as Mission>::Frame> + Send {
    /// Of what.
    type Mission: Mission;

    /// For a run in this scene.
    fn of(scene: &<Self::Mission as Mission>::Scene) -> Self;

    /// How far a run has come, in words.
    fn progress(&self, frame: &<Self::Mission as Mission>::Frame) -> String;
}

/// Keeps numbers over time of a bounded number of moments.
pub trait Timeline: Recorder<<Self::Mission as Mission>::Frame> + Send {
    /// Of what.
    type Mission: Mission;
    /// A table with one column, its name the one in JSON.
    type Kept: Serialize;

    /// Keeps about so many moments of a run in this scene, at most twice as many.
    fn of(scene: &<Self::Mission as Mission>::Scene, wanted: usize) -> Self;

    /// The moments that were kept.
    fn kept(self) -> Self::Kept;

    /// Some of them as a table for people, of about so many rows.
    fn table(kept: &Self::Kept, rows: usize) -> String;
}

/// Some of many, evenly spaced, the last one included.
pub fn thinned<M>(moments: &[M], rows: usize) -> Vec<&M> {
    let step = moments.len().div_ceil(rows.max(1)).max(1);
    let mut kept: Vec<&M> = moments.iter().rev().step_by(step).collect();
    kept.reverse();
    kept
}
