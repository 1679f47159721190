//! One run, whole: a function of (scenario, seed).

use crate::{
    analyse::{Digest, Metrics, Summary},
    config::Course,
    record::{RecordError, Recorder, TICKS_PER_S},
    sim::Sim,
};

/// Why a run ended before its time.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The recorder asked for it.
    #[error(transparent)]
    Record(#[from] RecordError),
}

/// Flies a mission from its first tick to its last and says what it came to. The recorder is shown every
/// frame and changes none.
///
/// # Errors
/// Only what the recorder returns.
///
/// ```
/// use uchain_sim::{config::{Course, Scenario, builtin}, run::run};
/// let source = builtin("straight").unwrap();
/// let scenario = Scenario::parse(&source, &["duration_s=5".into()]).unwrap();
/// let course = Course::lay(scenario, &source).unwrap();
/// let (once, again) = (run(&course, 1, &mut ()).unwrap(), run(&course, 1, &mut ()).unwrap());
/// assert_eq!(once.digest, again.digest);
/// assert_ne!(once.digest, run(&course, 2, &mut ()).unwrap().digest);
/// ```
pub fn run(course: &Course, seed: u64, recorder: &mut impl Recorder) -> Result<Summary, RunError> {
    let mut sim = Sim::new(course, seed);
    let mut metrics = Metrics::new(course);
    let mut digest = Digest::default();
    for _ in 0..total_ticks(course.scenario.duration_s) {
        sim.step(&mut ((&mut metrics, &mut digest), &mut *recorder))?;
    }
    Ok(metrics.summary(seed, digest.hex()))
}

/// Ticks of a run of this length.
pub fn total_ticks(duration_s: f64) -> u64 {
    (duration_s * TICKS_PER_S).round() as u64
}
