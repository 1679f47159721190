//! Flying into memory.

use std::{ops::Range, path::Path};

use super::{Block, Table};
use crate::sweep::{
    Sweep,
    folder::{FolderError, Manifest, Shard, Watch, absolute, each_chunk, unrecorded},
    row::has_failed,
};

impl Table {
    /// Checks a sweep and flies a shard of it, on the threads of [`on_threads`](crate::sweep::on_threads). `scenes` is
    /// where relative paths in the scenario start. `watch` hears of every run.
    ///
    /// # Errors
    /// A variant that is no scenario; the caller asked to stop.
    pub fn fly(asked: &Sweep, scenes: &Path, shard: Shard, watch: &dyn Watch) -> Result<Self, FolderError> {
        let walls = asked.check_until(&|| watch.stop())?.ok_or(FolderError::Interrupted)?;
        // As a folder would have it: a row says nothing of where the files lie that were read.
        let table = Self::empty(asked.registry(), Manifest::of(asked, walls), absolute(scenes)?)?;
        let chunks = shard.chunks(table.manifest.chunks()).collect();
        let blocks =
            each_chunk(chunks, watch, |chunk, watch| table.block(table.manifest.runs_of(chunk), watch))?;
        table.with(blocks)
    }

    fn block(&self, runs: Range<u64>, watch: &dyn Watch) -> Result<Block, FolderError> {
        let mut block = Block::of(&self.columns, runs.start);
        for run in runs.map(|index| self.sweep.run(index)) {
            if watch.stop() {
                return Err(FolderError::Interrupted);
            }
            // Nothing is written: what ends a run from outside is that somebody stops it.
            let flown = unrecorded(&self.sweep, run, watch).map_err(|_| FolderError::Interrupted)?;
            block.push(self.sweep.row(run, &flown).iter());
            watch.done(1, u64::from(has_failed(&flown)), true);
        }
        Ok(block)
    }
}
