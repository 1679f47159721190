//! One run, whole: a function of (scenario, seed).

use crate::{
    analyse::Digest,
    clock::total_ticks,
    mission::{
        chain::{Course, Metrics, Sim, Summary},
        explore::{Exploration, ExploreFrame, ExploreMetrics, ExploreSummary, Site, Survey},
    },
    record::{RecordError, Recorder},
};

/// Why a run ended before its time.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The recorder asked for it.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// Parameters outside their ranges; a site that was read has none.
    #[error("the site's parameters are out of range")]
    Params,
}

/// Flies a mission from its first tick to its last and says what it came to. The recorder is shown every
/// frame and changes none.
///
/// # Errors
/// Only what the recorder returns.
///
/// ```
/// use uchain_libm as _; // the same bits on every system
/// use uchain_sim::{mission::chain::{Course, Scenario}, config::builtin, run::run};
/// let source = builtin("straight").unwrap();
/// let scenario = Scenario::parse(&source, &["duration_s=5".into()]).unwrap();
/// let course = Course::lay(scenario, &source).unwrap();
/// let (once, again) = (run(&course, 1, &mut ()).unwrap(), run(&course, 1, &mut ()).unwrap());
/// assert_eq!(once.digest, again.digest);
/// assert_ne!(once.digest, run(&course, 2, &mut ()).unwrap().digest);
/// ```
pub fn run(
    course: &Course,
    seed: u64,
    recorder: &mut impl Recorder<crate::mission::chain::Frame>,
) -> Result<Summary, RunError> {
    let mut sim = Sim::new(course, seed);
    let mut metrics = Metrics::new(course);
    let mut digest = Digest::default();
    for _ in 0..total_ticks(course.scenario.duration_s) {
        sim.step(&mut ((&mut metrics, &mut digest), &mut *recorder))?;
    }
    Ok(metrics.summary(seed, digest.hex()))
}

/// Explores from the first tick until all are home, and says what it came to. The recorder is shown every frame and
/// changes none.
///
/// # Errors
/// Only what the recorder returns, for a site that was read.
///
/// ```
/// use uchain_libm as _; // the same bits on every system
/// use uchain_sim::{mission::explore::Site, config::builtin, run::explore};
/// let site = Site::read(&builtin("apartment").unwrap(), &["duration_s=20".into()]).unwrap();
/// let (once, again) = (explore(&site, 1, &mut ()).unwrap().0, explore(&site, 1, &mut ()).unwrap().0);
/// assert_eq!(once, again);
/// assert_ne!(once.digest, explore(&site, 2, &mut ()).unwrap().0.digest);
/// ```
pub fn explore(
    site: &Site,
    seed: u64,
    recorder: &mut impl Recorder<ExploreFrame>,
) -> Result<(ExploreSummary, Survey), RunError> {
    let mut exploration = Exploration::new(site, seed).ok_or(RunError::Params)?;
    let mut metrics = ExploreMetrics::new(site);
    let mut digest = Digest::default();
    while exploration.step(&mut ((&mut metrics, &mut digest), &mut *recorder))?.is_none() {}
    Ok(metrics.finish(seed, digest.hex()))
}
