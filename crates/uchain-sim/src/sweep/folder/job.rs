//! Flying what is missing.

use std::{
    fs,
    ops::ControlFlow,
    path::PathBuf,
    sync::atomic::{AtomicBool, Ordering},
};

use rayon::prelude::*;

use super::{Folder, FolderError, RECORDINGS, chunk, durable};
use crate::{
    analyse::Column,
    record::RecordError,
    registry::{self, Flown, Now},
    sweep::{Run, Sweep, fly::caught, row::has_failed},
};

/// Which chunks: every `of`-th, from number `number`, counted from 1. The sum of all shards is the sweep.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    /// Which one, from 1.
    pub number: u64,
    /// Of how many, at least 1.
    pub of: u64,
}

impl Shard {
    /// How many runs of a sweep it has.
    pub fn runs(self, sweep: &Sweep) -> u64 {
        let (runs, rows) = (sweep.runs(), chunk::rows(sweep.runs()));
        self.chunks(runs.div_ceil(rows)).map(|chunk| rows.min(runs - chunk * rows)).sum()
    }

    /// Its chunks, of so many.
    pub(in crate::sweep) fn chunks(self, all: u64) -> impl Iterator<Item = u64> {
        let (first, step) = (self.number.saturating_sub(1), usize::try_from(self.of).unwrap_or(usize::MAX));
        (first..all).step_by(step.max(1))
    }
}

/// Which runs leave a recording.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Record {
    /// None.
    None,
    /// Those that failed; each is flown a second time.
    Failed,
    /// All.
    All,
}

/// Someone who is told how far the work has come, and can stop it.
pub trait Watch: Sync {
    /// Whether to stop; asked at every tick.
    fn stop(&self) -> bool;
    /// So many more runs are on the disk, so many of them failed; `now` if they were flown just now.
    fn done(&self, runs: u64, failed: u64, now: bool);
    /// Runs that were on the disk cannot be read, and are flown again; `why` names the file.
    fn again(&self, why: &FolderError);
}

/// What to fly, and for whom.
#[derive(Clone, Copy)]
pub struct Job<'a> {
    /// Which chunks.
    pub shard: Shard,
    /// Which recordings.
    pub record: Record,
    /// Who looks on.
    pub watch: &'a dyn Watch,
}

/// Stops a run.
struct Stop<'a>(&'a dyn Watch);

impl registry::Watch for Stop<'_> {
    fn tick(&mut self, _: &Now<'_>) -> ControlFlow<()> {
        if self.0.stop() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

impl Folder {
    /// Flies what is missing of a shard, on the threads of [`on_threads`](crate::sweep::on_threads). What is there is
    /// read first; a chunk that is damaged is flown again.
    ///
    /// # Errors
    /// A chunk cannot be read or written, or is gone in the end; the caller asked to stop. Chunks that were finished stay.
    pub fn fly(&self, sweep: &Sweep, job: Job<'_>) -> Result<(), FolderError> {
        if self.is_complete() {
            return Ok(());
        }
        let columns = sweep.columns();
        let mut missing = Vec::new();
        for chunk in self.chunks_of(job.shard) {
            if self.chunk_path(chunk).exists() {
                let rows = match self.read_chunk(chunk, &columns) {
                    Err(why @ FolderError::Damaged { .. }) => {
                        job.watch.again(&why);
                        missing.push(chunk);
                        continue;
                    }
                    rows => rows?,
                };
                let place = columns.iter().position(|column| column.name == crate::sweep::row::FAILED);
                let has_failed =
                    |row: &&Vec<_>| place.and_then(|place| row.get(place)) != Some(&super::Cell::Absent);
                job.watch.done(rows.len() as u64, rows.iter().filter(has_failed).count() as u64, false);
            } else {
                missing.push(chunk);
            }
        }
        each_chunk(missing, job.watch, |chunk, watch| {
            self.fly_chunk(sweep, chunk, &columns, Job { watch, ..job })
        })?;
        self.lacks(job.shard)
    }

    /// An error if runs of a shard are not there, whoever took them away.
    fn lacks(&self, shard: Shard) -> Result<(), FolderError> {
        let chunks = self.chunks_of(shard).filter(|chunk| !self.chunk_path(*chunk).exists());
        let missing: Vec<_> = chunks.map(|chunk| self.runs_of(chunk)).collect();
        match missing.first() {
            Some(first) if !self.is_complete() => Err(FolderError::Missing {
                missing: missing.iter().map(|runs| runs.end - runs.start).sum(),
                runs: self.manifest().runs,
                first: first.start,
            }),
            _ => Ok(()),
        }
    }

    fn chunks_of(&self, shard: Shard) -> impl Iterator<Item = u64> {
        shard.chunks(self.chunks())
    }

    fn fly_chunk(
        &self,
        sweep: &Sweep,
        chunk: u64,
        columns: &[Column],
        job: Job<'_>,
    ) -> Result<(), FolderError> {
        let runs = self.runs_of(chunk);
        let mut rows = Vec::with_capacity((runs.end - runs.start) as usize);
        let mut failed = 0;
        for run in runs.clone().map(|index| sweep.run(index)) {
            if job.watch.stop() {
                return Err(FolderError::Interrupted);
            }
            let mut flown = match job.record {
                Record::All => self.recorded(sweep, run, job.watch)?,
                _ => unrecorded(sweep, run, job.watch).map_err(|error| self.broken(run, error))?,
            };
            if job.record == Record::Failed && has_failed(&flown) {
                flown = self.recorded(sweep, run, job.watch)?;
            }
            failed += u64::from(has_failed(&flown));
            let row = sweep.row(run, &flown);
            debug_assert_eq!(row.len(), columns.len());
            rows.push(row);
        }
        chunk::write(&self.chunk_path(chunk), &self.hash, &runs, &rows)?;
        job.watch.done(rows.len() as u64, failed, true);
        Ok(())
    }

    /// Flies a run and records it, up to where it panics if it does.
    fn recorded(
        &self,
        sweep: &Sweep,
        run: Run,
        watch: &dyn Watch,
    ) -> Result<Result<Flown, String>, FolderError> {
        let scene = match sweep.scene(run) {
            Ok(scene) => scene,
            Err(reason) => return Ok(Err(reason)),
        };
        let path = self.recording(run);
        let folder = self.path.join(RECORDINGS);
        fs::create_dir_all(&folder).map_err(FolderError::io(&folder, "make the folder"))?;
        durable::write(&path, |out| {
            let broken = |error: RecordError| self.broken(run, error);
            let mut recorded = scene.record(run.seed, Box::new(out)).map_err(broken)?;
            let flown = whole(caught(|| recorded.fly(&mut Stop(watch)))).map_err(broken)?;
            recorded.finish().map_err(broken)?;
            Ok(flown)
        })
    }

    fn recording(&self, run: Run) -> PathBuf {
        self.path.join(RECORDINGS).join(format!("run-{:08}.mcap", run.index))
    }

    /// Why a run has no end: someone stopped it, or its recording cannot be written.
    fn broken(&self, run: Run, error: RecordError) -> FolderError {
        match error {
            RecordError::Interrupted { .. } => FolderError::Interrupted,
            RecordError::Io(cause) => FolderError::io(&self.recording(run), "write")(cause),
            // Runs of a sweep keep no tables; were it to come, it would be about the recording.
            error @ RecordError::TooMuch { .. } => {
                FolderError::io(&self.recording(run), "write")(std::io::Error::other(error))
            }
        }
    }
}

/// Flies chunks on all threads; the first error stops the others at their next tick.
pub(in crate::sweep) fn each_chunk<T: Send>(
    chunks: Vec<u64>,
    watch: &dyn Watch,
    fly: impl Fn(u64, &dyn Watch) -> Result<T, FolderError> + Sync,
) -> Result<Vec<T>, FolderError> {
    let is_over = AtomicBool::new(false);
    let watch = Until { watch, is_over: &is_over };
    let done: Vec<Result<T, FolderError>> = chunks
        .into_par_iter()
        .with_max_len(1)
        .map(|chunk| {
            let done = fly(chunk, &watch);
            is_over.fetch_or(done.is_err(), Ordering::Relaxed);
            done
        })
        .collect();
    let (mut flown, mut stopped) = (Vec::new(), None);
    for done in done {
        match done {
            Ok(chunk) => flown.push(chunk),
            // What stopped the others says more than that they were stopped.
            Err(FolderError::Interrupted) => stopped = stopped.or(Some(FolderError::Interrupted)),
            Err(error) => return Err(error),
        }
    }
    stopped.map_or(Ok(flown), Err)
}

/// Flies a run that leaves no recording.
pub(in crate::sweep) fn unrecorded(
    sweep: &Sweep,
    run: Run,
    watch: &dyn Watch,
) -> Result<Result<Flown, String>, RecordError> {
    whole(sweep.one(run, |scene, run| scene.fly(run.seed, &mut Stop(watch))))
}

/// A run that was stopped is no row; one that failed by itself is.
fn whole(flown: Result<Result<Flown, RecordError>, String>) -> Result<Result<Flown, String>, RecordError> {
    flown.map_or_else(|reason| Ok(Err(reason)), |flown| flown.map(Ok))
}

/// Stops when the caller says so, or when another thread cannot go on.
struct Until<'a> {
    watch: &'a dyn Watch,
    is_over: &'a AtomicBool,
}

impl Watch for Until<'_> {
    fn stop(&self) -> bool {
        self.is_over.load(Ordering::Relaxed) || self.watch.stop()
    }

    fn done(&self, runs: u64, failed: u64, now: bool) {
        self.watch.done(runs, failed, now);
    }

    fn again(&self, why: &FolderError) {
        self.watch.again(why);
    }
}
