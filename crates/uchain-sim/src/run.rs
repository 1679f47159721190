//! One run, whole: a function of scene and seed.

use std::sync::Arc;

use crate::{
    analyse::Digest,
    mission::{Metrics, Mission, Scene},
    record::{RecordError, Recorder},
};

/// The frames of the mission that is flown in a scene.
pub type FrameOf<S> = <<S as Scene>::Mission as Mission>::Frame;
/// What sums a run in a scene up.
pub type MetricsOf<S> = <<S as Scene>::Mission as Mission>::Metrics;
/// What a run in a scene comes to.
pub type SummaryOf<S> = <<S as Scene>::Mission as Mission>::Summary;

/// Flies a mission from its first tick until it is over and says what it came to. The recorder is shown every frame and
/// changes none.
///
/// # Errors
/// Only what the recorder returns.
///
/// ```
/// use uchain_libm as _; // the same bits on every system
/// use uchain_sim::{config::builtin, mission::{chain::Course, explore::Site}, run::run};
/// let course = Course::read(&builtin("straight").unwrap(), &["duration_s=5".into()]).unwrap();
/// let (once, again) = (run(&course, 1, &mut ()).unwrap(), run(&course, 1, &mut ()).unwrap());
/// assert_eq!(once.digest, again.digest);
/// assert_ne!(once.digest, run(&course, 2, &mut ()).unwrap().digest);
///
/// let site = Site::read(&builtin("apartment").unwrap(), &["duration_s=20".into()]).unwrap();
/// let (once, again) = (run(&site, 1, &mut ()).unwrap(), run(&site, 1, &mut ()).unwrap());
/// assert_eq!(once, again);
/// ```
pub fn run<S: Scene>(
    scene: &Arc<S>,
    seed: u64,
    recorder: &mut impl Recorder<FrameOf<S>>,
) -> Result<SummaryOf<S>, RecordError> {
    fly(scene, seed, recorder).map(|(summary, _)| summary)
}

/// Like [`run`], and gives what summed it up: it may know more than the summary, for pictures.
///
/// # Errors
/// Those of [`run`].
pub fn fly<S: Scene>(
    scene: &Arc<S>,
    seed: u64,
    recorder: &mut impl Recorder<FrameOf<S>>,
) -> Result<(SummaryOf<S>, MetricsOf<S>), RecordError> {
    let mut mission = S::Mission::start(scene.clone(), seed);
    let (mut metrics, mut digest) = (MetricsOf::<S>::of(scene.clone()), Digest::default());
    while mission.step(&mut ((&mut metrics, &mut digest), &mut *recorder))?.is_none() {}
    Ok((metrics.sum_up(seed, digest.hex()), metrics))
}
