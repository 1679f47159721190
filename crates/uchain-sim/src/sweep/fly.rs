//! Runs on all processors: across runs, never inside one.

use std::{
    any::Any,
    panic::{AssertUnwindSafe, catch_unwind},
    sync::Arc,
};

use rayon::prelude::*;

use super::{Run, Sweep};
use crate::{
    analyse::Verdict,
    config::ConfigError,
    mission::{
        Mission,
        chain::{Frame, Summary},
        explore::{ExploreFrame, ExploreSummary},
    },
    record::Recorder,
    run::{RunError, explore, run},
};

/// The system gives no threads.
#[derive(Debug, thiserror::Error)]
#[error("cannot start {threads} threads: {cause}")]
pub struct PoolError {
    threads: usize,
    cause: rayon::ThreadPoolBuildError,
}

/// What a run came to.
#[derive(Debug, Clone, PartialEq)]
pub enum Flown {
    /// A chain.
    Chain(Summary),
    /// An exploration.
    Explore(ExploreSummary),
}

impl Flown {
    /// What was found out about how it went.
    pub fn verdict(&self) -> &Verdict {
        match self {
            Self::Chain(summary) => &summary.verdict,
            Self::Explore(summary) => &summary.verdict,
        }
    }

    /// The run's digest.
    pub fn digest(&self) -> &str {
        match self {
            Self::Chain(summary) => &summary.digest,
            Self::Explore(summary) => &summary.digest,
        }
    }
}

/// Someone who can look on at either kind of mission, or stop it.
pub trait Onlooker: Recorder<Frame> + Recorder<ExploreFrame> {}

impl<T: Recorder<Frame> + Recorder<ExploreFrame>> Onlooker for T {}

/// Flies a mission of either kind.
///
/// # Errors
/// Only what the recorder returns, for a mission that was read.
pub fn fly(mission: &Mission, seed: u64, onlooker: &mut impl Onlooker) -> Result<Flown, RunError> {
    match mission {
        Mission::Chain(course) => run(course, seed, onlooker).map(Flown::Chain),
        Mission::Explore(site) => explore(site, seed, onlooker).map(|(summary, _)| Flown::Explore(summary)),
    }
}

/// Does something on so many threads; `None` = one for every processor.
///
/// # Errors
/// The system gives no threads.
pub fn on_threads<T: Send>(threads: Option<usize>, work: impl FnOnce() -> T + Send) -> Result<T, PoolError> {
    let threads = threads.unwrap_or(0);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    pool.map(|pool| pool.install(work)).map_err(|cause| PoolError { threads, cause })
}

/// Does something with every number from 0 to `count` - 1, on the threads of [`on_threads`] or else on all there are;
/// results in the order of the numbers, whoever did them: a parallel map, for many trials that are no runs of a scenario.
///
/// A panic in `work` goes on in the caller.
///
/// ```
/// use uchain_sim::{seed::{Seed, Source}, sweep::parallel_map};
/// // Each trial draws from a stream of its own, so that no number depends on the number of threads.
/// let trial = |index| Seed(1).replicate(index).stream(0, Source::Start).uniform();
/// assert_eq!(parallel_map(3, trial), (0..3).map(trial).collect::<Vec<_>>());
/// ```
pub fn parallel_map<T: Send>(count: u64, work: impl Fn(u64) -> T + Sync + Send) -> Vec<T> {
    let count = usize::try_from(count).unwrap_or(usize::MAX);
    (0..count).into_par_iter().map(|index| work(index as u64)).collect()
}

/// The error of the first variant that has one.
pub(super) fn first_error<E: Send>(
    variants: u64,
    error: impl Fn(u64) -> Option<E> + Sync + Send,
) -> Result<(), E> {
    (0..variants).into_par_iter().find_map_first(error).map_or(Ok(()), Err)
}

impl Sweep {
    /// Does something with every run, on the threads of [`on_threads`] or else on all there are; results in the order
    /// of the runs, whoever did them. A run that cannot be laid out or that panics gives the reason instead.
    pub fn each<T: Send>(&self, work: impl Fn(&Mission, Run) -> T + Sync) -> Vec<Result<T, String>> {
        // Chunks would be right for the folder as well; in memory a run is the smallest and best one.
        let runs = usize::try_from(self.runs()).unwrap_or(usize::MAX);
        (0..runs).into_par_iter().map(|index| self.one(self.run(index as u64), &work)).collect()
    }

    /// Does something with one run, or says why it cannot be flown.
    pub(super) fn one<T>(&self, run: Run, work: impl FnOnce(&Mission, Run) -> T) -> Result<T, String> {
        let mission = self.mission(run)?;
        caught(|| work(&mission, run))
    }

    /// Why a variant cannot be flown, wherever on this computer its files lie.
    fn reason(&self, error: &ConfigError) -> String {
        let folder = self.source.folder.join("").display().to_string();
        let error = error.to_string();
        format!("not flown: {}", if folder.is_empty() { error } else { error.replace(&folder, "") })
    }

    /// The mission of a run, laid out once for all that share it.
    pub(super) fn mission(&self, run: Run) -> Result<Arc<Mission>, String> {
        let lay = || self.lay(run.variant).map(Arc::new).map_err(|error| self.reason(&error));
        caught(|| self.shelf.get(run.variant, lay))?
    }
}

/// A panic as words: one run that goes wrong takes no other with it.
pub(super) fn caught<T>(work: impl FnOnce() -> T) -> Result<T, String> {
    // What is borrowed is immutable, or a lock that holds nothing half done, or given up with the run.
    catch_unwind(AssertUnwindSafe(work)).map_err(|panic| format!("panicked: {}", words(&*panic)))
}

/// What a panic said.
fn words(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_else(|| "no reason given".to_owned())
}
