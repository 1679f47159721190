//! Runs on all processors: across runs, never inside one.

use std::{
    any::Any,
    panic::{AssertUnwindSafe, catch_unwind},
    sync::Arc,
};

use rayon::prelude::*;

use super::{Run, Sweep};
use crate::{config::ConfigError, registry::AnyScene};

/// The system gives no threads.
#[derive(Debug, thiserror::Error)]
#[error("cannot start {threads} threads: {cause}")]
pub struct PoolError {
    threads: usize,
    cause: rayon::ThreadPoolBuildError,
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
    pub fn each<T: Send>(&self, work: impl Fn(&dyn AnyScene, Run) -> T + Sync) -> Vec<Result<T, String>> {
        // Chunks would be right for the folder as well; in memory a run is the smallest and best one.
        let runs = usize::try_from(self.runs()).unwrap_or(usize::MAX);
        (0..runs).into_par_iter().map(|index| self.one(self.run(index as u64), &work)).collect()
    }

    /// Does something with one run, or says why it cannot be flown, in the words that stand in its row.
    ///
    /// # Errors
    /// It cannot be laid out, or panicked.
    pub fn one<T>(&self, run: Run, work: impl FnOnce(&dyn AnyScene, Run) -> T) -> Result<T, String> {
        let scene = self.scene(run)?;
        caught(|| work(&*scene, run))
    }

    /// Why a variant cannot be flown, wherever on this computer its files lie.
    fn reason(&self, error: &ConfigError) -> String {
        let folder = self.source.folder.join("").display().to_string();
        let error = error.to_string();
        format!("not flown: {}", if folder.is_empty() { error } else { error.replace(&folder, "") })
    }

    /// The scene of a run, laid out once for all that share it.
    pub(super) fn scene(&self, run: Run) -> Result<Arc<dyn AnyScene>, String> {
        let lay = || self.lay(run.variant).map_err(|error| self.reason(&error));
        caught(|| self.scenes.get(run.variant, lay))?
    }
}

/// A panic as words: one run that goes wrong takes no other with it. What was being made is given up.
///
/// # Errors
/// The words of a row that says so.
pub fn caught<T>(work: impl FnOnce() -> T) -> Result<T, String> {
    // What is borrowed is immutable, or a lock that holds nothing half done, or given up with the run.
    catch_unwind(AssertUnwindSafe(work)).map_err(|panic| format!("panicked: {}", words(&*panic)))
}

/// What a panic said.
fn words(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_else(|| "no reason given".to_owned())
}
