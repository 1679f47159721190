//! Flying into memory.

use std::path::Path;

use super::{Block, Table};
use crate::{
    registry::Flown,
    sweep::{
        Run, Sweep,
        folder::{FolderError, Manifest, Shard, Watch, absolute, each_chunk, unrecorded},
        row::has_failed,
    },
};

/// Flies runs of a sweep in a way of its own, such as by a law of one's own, or side by side.
pub trait Flyer: Sync {
    /// Most runs that it takes at one time; 0 counts as 1.
    fn at_a_time(&self) -> usize;

    /// Flies these runs: what each came to, in their order, or why it could not be flown. It looks often whether to stop.
    ///
    /// # Errors
    /// [`FolderError::Interrupted`]: it has stopped.
    fn fly(
        &self,
        sweep: &Sweep,
        runs: &[Run],
        watch: &dyn Watch,
    ) -> Result<Vec<Result<Flown, String>>, FolderError>;
}

/// Runs as they are.
struct Alone;

impl Flyer for Alone {
    fn at_a_time(&self) -> usize {
        1
    }

    fn fly(
        &self,
        sweep: &Sweep,
        runs: &[Run],
        watch: &dyn Watch,
    ) -> Result<Vec<Result<Flown, String>>, FolderError> {
        // Nothing is written: what ends a run from outside is that somebody stops it.
        let fly = |run: &Run| unrecorded(sweep, *run, watch).map_err(|_| FolderError::Interrupted);
        runs.iter().map(fly).collect()
    }
}

impl Table {
    /// Checks a sweep and flies a shard of it, on the threads of [`on_threads`](crate::sweep::on_threads). `scenes` is
    /// where relative paths in the scenario start. `watch` hears of every run.
    ///
    /// # Errors
    /// A variant that is no scenario; the caller asked to stop.
    pub fn fly(asked: &Sweep, scenes: &Path, shard: Shard, watch: &dyn Watch) -> Result<Self, FolderError> {
        Self::fly_by(asked, scenes, shard, watch, &Alone)
    }

    /// Like [`Table::fly`], with runs flown by somebody else.
    ///
    /// # Errors
    /// Those of [`Table::fly`].
    pub fn fly_by(
        asked: &Sweep,
        scenes: &Path,
        shard: Shard,
        watch: &dyn Watch,
        flyer: &dyn Flyer,
    ) -> Result<Self, FolderError> {
        let walls = asked.check_until(&|| watch.stop())?.ok_or(FolderError::Interrupted)?;
        // As a folder would have it: a row says nothing of where the files lie that were read.
        let table = Self::empty(asked.registry(), Manifest::of(asked, walls), absolute(scenes)?)?;
        let chunks: Vec<u64> = shard.chunks(table.manifest.chunks()).collect();
        let longest = chunks.first().map_or(1, |chunk| table.rows_of(*chunk));
        let groups: Vec<&[u64]> = chunks.chunks((flyer.at_a_time() / longest).max(1)).collect();
        let numbers = (0..groups.len() as u64).collect();
        let flown = each_chunk(numbers, watch, |group, watch| {
            let chunks = usize::try_from(group).ok().and_then(|group| groups.get(group));
            table.fly_chunks(chunks.copied().unwrap_or_default(), watch, flyer)
        })?;
        table.with(flown.into_iter().flatten().collect())
    }

    fn rows_of(&self, chunk: u64) -> usize {
        let runs = self.manifest.runs_of(chunk);
        usize::try_from(runs.end - runs.start).unwrap_or(usize::MAX).max(1)
    }

    fn fly_chunks(
        &self,
        chunks: &[u64],
        watch: &dyn Watch,
        flyer: &dyn Flyer,
    ) -> Result<Vec<Block>, FolderError> {
        let runs: Vec<Run> = chunks
            .iter()
            .flat_map(|chunk| self.manifest.runs_of(*chunk))
            .map(|index| self.sweep.run(index))
            .collect();
        let mut flown = Vec::new();
        let mut rows = runs.chunks(flyer.at_a_time().max(1));
        let mut blocks = Vec::with_capacity(chunks.len());
        for chunk in chunks {
            let runs = self.manifest.runs_of(*chunk);
            let mut block = Block::of(&self.columns, runs.start);
            for index in runs {
                if flown.is_empty() {
                    if watch.stop() {
                        return Err(FolderError::Interrupted);
                    }
                    let next = rows.next().unwrap_or_default();
                    flown = flyer.fly(&self.sweep, next, watch)?;
                    let failed = flown.iter().filter(|flown| has_failed(flown)).count();
                    watch.done(next.len() as u64, failed as u64, true);
                    flown.resize_with(next.len(), || Err("not flown".to_owned()));
                    flown.reverse();
                }
                let flown = flown.pop().unwrap_or_else(|| Err("not flown".to_owned()));
                block.push(self.sweep.row(self.sweep.run(index), &flown).iter());
            }
            blocks.push(block);
        }
        Ok(blocks)
    }
}
