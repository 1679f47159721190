//! One run, whole: a function of scene, seed and what the pilot asks for.

use std::sync::Arc;

use uchain_core::params::OutOfRange;

use crate::{
    clock::time_s,
    mission::{Mission, Scene, UnderWay},
    pilot::{Asked, INPUTS_MAX, Pilot},
    record::{RecordError, Recorder},
};

/// The frames of the mission that is flown in a scene.
pub type FrameOf<S> = <<S as Scene>::Mission as Mission>::Frame;
/// What sums a run in a scene up.
pub type MetricsOf<S> = <<S as Scene>::Mission as Mission>::Metrics;
/// What a run in a scene comes to.
pub type SummaryOf<S> = <<S as Scene>::Mission as Mission>::Summary;

/// What a pilot may ask for in a scene.
pub type InputOf<S> = <<S as Scene>::Mission as Mission>::Input;

/// Flies a mission from its first tick until it is over, by the scenario's own script, and says what it came to. The
/// recorder is shown every frame and changes none.
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
    let mut under_way = UnderWay::<S::Mission>::start(scene, seed);
    while under_way.tick(recorder)?.is_none() {}
    Ok(under_way.sum_up())
}

/// What a flight by hand came to.
#[derive(Debug)]
pub struct Piloted<S: Scene> {
    /// In numbers.
    pub summary: SummaryOf<S>,
    /// What summed it up: it may know more than the summary, for pictures.
    pub metrics: MetricsOf<S>,
    /// What the pilot asked for, in order: changes only. Of a chain,
    /// [`Scenario::by_hand`](crate::mission::chain::Scenario::by_hand) makes a scenario of it.
    pub inputs: Vec<Asked<InputOf<S>>>,
}

/// Why a flight by hand ended before its time.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The recorder's doing.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// The pilot asked for what no scenario may ask for.
    #[error("the pilot's input at {at_s:.2} s of simulated time: {why}")]
    Input {
        /// When it was asked for (s).
        at_s: f64,
        /// What is wrong with it.
        why: OutOfRange,
    },
    /// The pilot asked for something new too often.
    #[error(
        "the pilot's input at {at_s:.2} s of simulated time is one more than {INPUTS_MAX}: expected at most these"
    )]
    TooManyInputs {
        /// When it was asked for (s).
        at_s: f64,
    },
}

/// Like [`run`], with a pilot who is asked before every tick: the script is flown until he asks for something. The inputs
/// are kept, at most [`INPUTS_MAX`]; one that equals the one before is none.
///
/// ```
/// use uchain_libm as _; // the same bits on every system
/// use uchain_sim::{config::builtin, mission::chain::Course, pilot::{Nobody, Scripted}, run::{run, run_with}};
/// let course = Course::read(&builtin("straight").unwrap(), &["duration_s=60".into()]).unwrap();
/// let scripted = run_with(&course, 1, &mut Scripted, &mut ()).unwrap();
/// assert_eq!(scripted.summary, run(&course, 1, &mut ()).unwrap());
/// let hovering = run_with(&course, 1, &mut Nobody, &mut ()).unwrap();
/// assert!(hovering.summary.head_reach_m < 0.5 * scripted.summary.head_reach_m);
/// ```
///
/// # Errors
/// [`RunError`]: those of [`run`]; an input out of its range, or one too many.
pub fn run_with<S: Scene>(
    scene: &Arc<S>,
    seed: u64,
    pilot: &mut impl Pilot<FrameOf<S>, InputOf<S>>,
    recorder: &mut impl Recorder<FrameOf<S>>,
) -> Result<Piloted<S>, RunError> {
    let mut under_way = UnderWay::<S::Mission>::start(scene, seed);
    let mut inputs: Vec<Asked<InputOf<S>>> = Vec::new();
    let mut tick = 0;
    loop {
        if let Some(input) = pilot.ask(tick, under_way.mission().frame())
            && inputs.last().is_none_or(|last| last.input != input)
        {
            let at_s = time_s(tick);
            if inputs.len() == INPUTS_MAX {
                return Err(RunError::TooManyInputs { at_s });
            }
            under_way.mission_mut().steer(input.clone()).map_err(|why| RunError::Input { at_s, why })?;
            inputs.push(Asked { tick, input });
        }
        if under_way.tick(recorder)?.is_some() {
            break;
        }
        tick += 1;
    }
    let (summary, metrics) = under_way.sum_up();
    Ok(Piloted { summary, metrics, inputs })
}
