//! A recording flown again, and two recordings side by side.

use std::io::Read;

use crate::{
    analyse::{Comparison, Difference, differences},
    record::{
        Frame, RecordError, Recorder,
        mcap::{End, Frames, ReadError, Recording},
    },
    run::total_ticks,
    sim::Sim,
};

/// What became of a recording that was flown again.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Verdict {
    /// Ticks that were compared; all of them are the same, bit for bit, but perhaps the last.
    pub ticks: u64,
    /// Ticks of the whole run.
    pub of: u64,
    /// Whether the recording ends as a run does, or in the middle; `None` if a difference came first.
    pub end: Option<End>,
    /// The first field that differs.
    pub first: Option<Difference>,
}

impl Verdict {
    /// What was recorded is what this version flies, up to the last tick that was recorded. A run that was stopped is
    /// shorter than its scenario.
    pub fn agrees(&self) -> bool {
        self.first.is_none()
    }
}

/// Keeps the last frame.
struct Last(Frame);

impl Recorder for Last {
    fn frame(&mut self, frame: &Frame) -> Result<(), RecordError> {
        self.0.clone_from(frame);
        Ok(())
    }
}

/// Flies a recording again, up to the first tick that differs in a bit.
///
/// # Errors
/// [`ReadError`]: the recording is empty or damaged, goes on after its run is over, or is of a scenario that this version
/// cannot fly.
///
/// ```
/// use uchain_sim::{config::{Course, builtin}, record::mcap::{McapRecorder, Recording}, replay, run::run};
/// let course = Course::read(&builtin("corner").unwrap(), &["duration_s=2".to_owned()]).unwrap();
/// let mut recorder = McapRecorder::start(Vec::new(), &course, 1).unwrap();
/// run(&course, 1, &mut recorder).unwrap();
/// let file = recorder.finish().unwrap();
///
/// let verdict = replay::verify(&mut Recording::read(file.as_slice(), "memory").unwrap()).unwrap();
/// assert!(verdict.agrees());
/// assert_eq!(verdict.ticks, 40);
/// ```
pub fn verify<R: Read>(recording: &mut Recording<R>) -> Result<Verdict, ReadError> {
    let course = recording.course()?;
    let of = total_ticks(course.scenario.duration_s);
    let mut sim = Sim::new(&course, recording.about.seed);
    let (mut recorded, mut flown) = (Frame::default(), Last(Frame::default()));
    let (mut ticks, mut first) = (0, None);
    while first.is_none() && recording.frames.read(&mut recorded)? {
        if ticks == of {
            let why = format!("it goes on after the {of} ticks of its scenario");
            return Err(ReadError::Frame { tick: ticks, why });
        }
        // `Last` never says no.
        let _ = sim.step(&mut flown);
        differences(&recorded, &flown.0, |found| _ = first.get_or_insert(found));
        ticks += 1;
    }
    if ticks == 0 {
        return Err(ReadError::NoFrames);
    }
    Ok(Verdict { ticks, of, end: recording.frames.end(), first })
}

/// Which of two recordings cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum DiffError {
    /// The first.
    #[error("{0}")]
    Here(ReadError),
    /// The second.
    #[error("{0}")]
    There(ReadError),
}

/// Compares what is left of two recordings tick by tick, and reads both to their ends.
///
/// # Errors
/// [`DiffError`].
pub fn diff(here: &mut Frames<impl Read>, there: &mut Frames<impl Read>) -> Result<Comparison, DiffError> {
    let (mut a, mut b) = (Frame::default(), Frame::default());
    let mut comparison = Comparison::default();
    loop {
        let more =
            (here.read(&mut a).map_err(DiffError::Here)?, there.read(&mut b).map_err(DiffError::There)?);
        match more {
            (true, true) => comparison.tick(&a, &b),
            (false, false) => return Ok(comparison),
            _ => {}
        }
    }
}
