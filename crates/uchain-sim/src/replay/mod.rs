//! Recordings read back, summed up and flown again; two of them side by side.

mod recording;
#[cfg(test)]
mod tests;

use std::io::{self, Read};

use uchain_core::params::OutOfRange;

use crate::{
    mission::{Mission, Recorded, Scene},
    record::{
        Comparison, Difference, Snapshot as _,
        mcap::{End, Frames, ReadError, Recordable},
    },
    run::FrameOf,
};

pub use recording::Recording;

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

/// Flies a recording again, by the inputs of its pilot if it was flown by hand, up to the first tick that differs in a bit. What was not recorded is flown all the same, to
/// say how many ticks there are.
///
/// # Errors
/// [`ReadError`]: the recording is empty or damaged, goes on after its run is over, or is of a scenario that this version
/// cannot fly.
///
/// ```
/// use uchain_libm as _; // the same bits on every system
/// use uchain_sim::{config::builtin, mission::chain::{Course, McapRecorder}, replay::{self, Recording}, run::run};
/// let course = Course::read(&builtin("corner").unwrap(), &["duration_s=2".to_owned()]).unwrap();
/// let mut recorder = McapRecorder::start(Vec::new(), &course, 1).unwrap();
/// run(&course, 1, &mut recorder).unwrap();
/// let file = recorder.finish().unwrap();
///
/// let mut recording = Recording::<_, Course>::read(file.as_slice(), "memory").unwrap();
/// let verdict = replay::verify(&mut recording).unwrap();
/// assert!(verdict.agrees());
/// assert_eq!((verdict.ticks, verdict.of), (40, 40));
/// ```
pub fn verify<R: Read, S: Scene<Mission: Recorded>>(
    recording: &mut Recording<R, S>,
) -> Result<Verdict, ReadError> {
    verify_while(recording, &mut || true)
}

/// Like [`verify`], as long as whoever asked for it wants to go on, which is asked at every tick.
///
/// # Errors
/// Those of [`verify`]; [`ReadError::Io`] of an interruption.
pub fn verify_while<R: Read, S: Scene<Mission: Recorded>>(
    recording: &mut Recording<R, S>,
    go_on: &mut dyn FnMut() -> bool,
) -> Result<Verdict, ReadError> {
    let mut wanted = || if go_on() { Ok(()) } else { Err(io::Error::from(io::ErrorKind::Interrupted)) };
    let mut mission = S::Mission::start(recording.scene_to_fly()?, recording.about.seed);
    let (mut recorded, mut first) = (FrameOf::<S>::default(), None);
    let (mut ticks, mut of, mut over) = (0, 0, false);
    while first.is_none() && recording.frames.read(&mut recorded)? {
        wanted()?;
        if over {
            let why = format!("it goes on after the {ticks} ticks of its scenario");
            return Err(ReadError::Frame { tick: ticks, why });
        }
        if let Some(input) = S::Mission::input_of(&recorded) {
            let refused = |why: OutOfRange| ReadError::Frame { tick: ticks, why: why.to_string() };
            mission.steer(input).map_err(refused)?;
        }
        // Nobody is there to say no.
        over = !matches!(mission.step(&mut ()), Ok(None));
        (ticks, of) = (ticks + 1, of + 1);
        recorded.differences(mission.frame(), &mut |found| _ = first.get_or_insert(found));
    }
    if ticks == 0 {
        return Err(ReadError::NoFrames);
    }
    while first.is_none() && !over {
        wanted()?;
        over = !matches!(mission.step(&mut ()), Ok(None));
        of += 1;
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
