//! Who is shown the frames of a run, and what may stop it; and where what a recording says of them goes.

mod compare;
mod event;
#[cfg(feature = "record")]
pub mod mcap;
#[cfg(feature = "record")]
mod sink;
pub mod table;

use std::fmt::Debug;

pub use compare::{Comparison, Difference, FieldDiff, Value, Whose};
pub use event::{Event, Gravity};
#[cfg(feature = "record")]
pub use sink::{Channel, Messages, Said, Schema, Sink};

/// One instant of a run, whatever the mission: what recorders are shown at the end of every tick.
pub trait Snapshot: Debug + Clone + PartialEq + Default + Send {
    /// What moves in it, in the plural: "UAVs".
    const CREW: &'static str;

    /// Ticks since the start; the first frame is that of tick 1.
    fn tick(&self) -> u64;

    /// How many move in it.
    fn crew(&self) -> usize;

    /// Whether somebody decided at the start of the tick: often enough for a picture, far rarer than ticks.
    fn is_decision(&self) -> bool;

    /// Appends the bits of every field that makes two runs differ, in a fixed order: what the run's digest is of.
    fn hash(&self, bytes: &mut Vec<u8>);

    /// Every field in which two frames differ, in a fixed order: the frame's own, those that move one by one, the rest.
    fn differences(&self, there: &Self, found: &mut dyn FnMut(Difference));
}

/// Someone who is shown every frame of a run, in order. It can stop the run, it cannot change it.
pub trait Recorder<F> {
    /// One frame.
    ///
    /// # Errors
    /// [`RecordError`] ends the run.
    fn frame(&mut self, frame: &F) -> Result<(), RecordError>;
}

/// Why a recorder ended a run.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RecordError {
    /// The caller asked to stop (Ctrl-C).
    #[error("interrupted at {time_s:.1} s of simulated time")]
    Interrupted {
        /// Simulated time (s).
        time_s: f64,
    },
    /// The recording cannot be written.
    #[error("cannot write the recording: {0}")]
    Io(#[from] std::io::Error),
    /// A table would take too much memory.
    #[error("the run's {name} would take {gib:.1} GiB of memory, more than {most_gib:.0}")]
    TooMuch {
        /// The table's name.
        name: &'static str,
        /// What it would take (GiB).
        gib: f64,
        /// Most that it may take (GiB).
        most_gib: f64,
    },
}

/// Nobody listens.
impl<F> Recorder<F> for () {
    fn frame(&mut self, _: &F) -> Result<(), RecordError> {
        Ok(())
    }
}

/// Perhaps somebody listens.
impl<F, R: Recorder<F>> Recorder<F> for Option<R> {
    fn frame(&mut self, frame: &F) -> Result<(), RecordError> {
        self.as_mut().map_or(Ok(()), |recorder| recorder.frame(frame))
    }
}

/// Both listen, the first one first.
impl<F, A: Recorder<F>, B: Recorder<F>> Recorder<F> for (A, B) {
    fn frame(&mut self, frame: &F) -> Result<(), RecordError> {
        self.0.frame(frame)?;
        self.1.frame(frame)
    }
}

impl<F, R: Recorder<F> + ?Sized> Recorder<F> for &mut R {
    fn frame(&mut self, frame: &F) -> Result<(), RecordError> {
        (**self).frame(frame)
    }
}
