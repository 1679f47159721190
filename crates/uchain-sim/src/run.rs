//! One run, whole: a function of scene, seed and what the pilot asks for.

use std::sync::Arc;

use uchain_core::params::OutOfRange;

use crate::{
    analyse::Digest,
    clock::time_s,
    mission::{Metrics, Mission, Scene, Stopped},
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
        if let Some(input) = pilot.ask(tick, under_way.mission.frame())
            && inputs.last().is_none_or(|last| last.input != input)
        {
            let at_s = time_s(tick);
            if inputs.len() == INPUTS_MAX {
                return Err(RunError::TooManyInputs { at_s });
            }
            under_way.mission.steer(input.clone()).map_err(|why| RunError::Input { at_s, why })?;
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

/// A mission under way and those who always watch it: what sums it up, and its digest. Whoever flies tick by tick holds it.
///
/// ```
/// use uchain_libm as _; // the same bits on every system
/// use uchain_sim::{config::builtin, mission::chain::{Chain, Course}, run::{UnderWay, run}};
/// let course = Course::read(&builtin("straight").unwrap(), &["duration_s=5".into()]).unwrap();
/// let mut under_way = UnderWay::<Chain>::start(&course, 1);
/// while under_way.tick(&mut ()).unwrap().is_none() {}
/// assert_eq!(under_way.summary(), run(&course, 1, &mut ()).unwrap());
/// ```
#[derive(Debug)]
pub struct UnderWay<M: Mission> {
    mission: M,
    metrics: M::Metrics,
    digest: Digest,
    seed: u64,
}

impl<M: Mission> UnderWay<M> {
    /// Before its first tick.
    pub fn start(scene: &Arc<M::Scene>, seed: u64) -> Self {
        let mission = M::start(scene.clone(), seed);
        Self { mission, metrics: M::Metrics::of(scene.clone()), digest: Digest::default(), seed }
    }

    /// As [`UnderWay::start`] would make it of the same scene, in the memory it has.
    pub fn reset(&mut self, seed: u64) {
        self.mission.reset(seed);
        let scene = self.mission.scene().clone();
        (self.metrics, self.digest, self.seed) = (M::Metrics::of(scene), Digest::default(), seed);
    }

    /// One tick. Says why, once the mission is over.
    ///
    /// # Errors
    /// Those of [`Mission::step`].
    pub fn tick(&mut self, recorder: &mut impl Recorder<M::Frame>) -> Result<Option<Stopped>, RecordError> {
        self.mission.step(&mut ((&mut self.metrics, &mut self.digest), recorder))
    }

    /// The second half of a tick, for whoever decides for the robots himself: [`Mission::act`].
    ///
    /// # Errors
    /// Only the recorder's own.
    pub fn act(
        &mut self,
        commands: &[M::Command],
        recorder: &mut impl Recorder<M::Frame>,
    ) -> Result<Option<Stopped>, RecordError> {
        let stopped = self.mission.act(commands);
        ((&mut self.metrics, &mut self.digest), recorder).frame(self.mission.frame())?;
        Ok(stopped)
    }

    /// The mission.
    pub fn mission(&self) -> &M {
        &self.mission
    }

    /// The mission, to look or to steer: a tick that passes by other ways than [`UnderWay::tick`] and [`UnderWay::act`] is seen
    /// by nobody.
    pub fn mission_mut(&mut self) -> &mut M {
        &mut self.mission
    }

    /// Its seed.
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// What it has come to so far.
    pub fn summary(&self) -> M::Summary {
        self.metrics.sum_up(self.seed, self.digest.hex())
    }

    fn sum_up(self) -> (M::Summary, M::Metrics) {
        (self.summary(), self.metrics)
    }
}
