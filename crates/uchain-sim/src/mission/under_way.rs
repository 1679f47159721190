//! A mission tick by tick, with those who watch every run.

use std::sync::Arc;

use super::{Metrics, Mission, Stopped};
use crate::{
    analyse::Digest,
    record::{RecordError, Recorder},
};

/// A mission under way and those who always watch it: what sums it up, and its digest. Whoever flies tick by tick holds it.
///
/// ```
/// use uchain_libm as _; // the same bits on every system
/// use uchain_sim::{config::builtin, mission::{UnderWay, chain::{Chain, Course}}, run::run};
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
        let scene = mission.scene().clone();
        Self { mission, metrics: M::Metrics::of(scene), digest: Digest::default(), seed }
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

    /// What it has come to, and what summed it up.
    pub fn sum_up(self) -> (M::Summary, M::Metrics) {
        (self.summary(), self.metrics)
    }
}
