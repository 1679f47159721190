//! A recording flown again, and two recordings side by side.

use std::io::Read;

use crate::{
    clock::total_ticks,
    mission::{
        chain::Sim,
        explore::{Exploration, ExploreFrame},
    },
    record::{Comparison, Difference},
    record::{
        RecordError, Recorder,
        mcap::{End, Frames, ReadError, Recordable, Recording},
    },
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
#[derive(Default)]
struct Last<F>(F);

impl<F: Clone> Recorder<F> for Last<F> {
    fn frame(&mut self, frame: &F) -> Result<(), RecordError> {
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
/// use uchain_libm as _; // the same bits on every system
/// use uchain_sim::{mission::chain::{Course, McapRecorder}, config::builtin, record::mcap::Recording, replay, run::run};
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
    let mut ticks = 0;
    compare(&mut recording.frames, |flown| {
        if ticks == of {
            return false;
        }
        ticks += 1;
        // `Last` never says no.
        let _ = sim.step(flown);
        true
    })
    .map(|found| Verdict { of, ..found })
}

/// Like [`verify`], for an exploration. What was not recorded is flown all the same, to say how many ticks there are.
///
/// # Errors
/// Those of [`verify`].
///
/// ```
/// use uchain_libm as _; // the same bits on every system
/// use uchain_sim::{mission::explore::{Site, ExploreRecorder}, config::builtin, record::mcap::Recording, replay, run::explore};
/// let site = Site::read(&builtin("apartment").unwrap(), &["duration_s=20".to_owned()]).unwrap();
/// let mut recorder = ExploreRecorder::start(Vec::new(), &site, 1).unwrap();
/// explore(&site, 1, &mut recorder).unwrap();
/// let file = recorder.finish().unwrap();
///
/// let mut recording = Recording::read_exploration(file.as_slice(), "memory").unwrap();
/// let verdict = replay::verify_exploration(&mut recording).unwrap();
/// assert!(verdict.agrees());
/// assert_eq!((verdict.ticks, verdict.of), (400, 400));
/// ```
pub fn verify_exploration<R: Read>(recording: &mut Recording<R, ExploreFrame>) -> Result<Verdict, ReadError> {
    let site = recording.site()?;
    let Some(mut exploration) = Exploration::new(&site, recording.about.seed) else {
        return Err(ReadError::NotOurs { why: "its parameters are out of range".to_owned() });
    };
    let (mut over, mut of) = (false, 0);
    let mut step = |flown: &mut Last<ExploreFrame>| {
        if over {
            return false;
        }
        // `Last` never says no.
        over = !matches!(exploration.step(flown), Ok(None));
        of += 1;
        true
    };
    let verdict = compare(&mut recording.frames, &mut step)?;
    let mut rest = Last::default();
    while verdict.first.is_none() && step(&mut rest) {}
    Ok(Verdict { of, ..verdict })
}

/// Flies tick by tick beside a recording; `step` says whether there was one more.
fn compare<R: Read, F: Recordable>(
    frames: &mut Frames<R, F>,
    mut step: impl FnMut(&mut Last<F>) -> bool,
) -> Result<Verdict, ReadError> {
    let (mut recorded, mut flown) = (F::default(), Last(F::default()));
    let (mut ticks, mut first) = (0, None);
    while first.is_none() && frames.read(&mut recorded)? {
        if !step(&mut flown) {
            let why = format!("it goes on after the {ticks} ticks of its scenario");
            return Err(ReadError::Frame { tick: ticks, why });
        }
        recorded.differences(&flown.0, &mut |found| _ = first.get_or_insert(found));
        ticks += 1;
    }
    if ticks == 0 {
        return Err(ReadError::NoFrames);
    }
    Ok(Verdict { ticks, of: ticks, end: frames.end(), first })
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
pub fn diff<F: Recordable>(
    here: &mut Frames<impl Read, F>,
    there: &mut Frames<impl Read, F>,
) -> Result<Comparison, DiffError> {
    let (mut a, mut b) = (F::default(), F::default());
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
