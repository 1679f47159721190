//! A sweep's rows in memory, column by column: flown without a folder, or read from one. What is written of them are the
//! bytes that [`folder`](super::folder) writes.

mod block;
mod fly;
mod stored;
mod values;

use std::{path::PathBuf, sync::Arc};

use super::{
    Sweep,
    folder::{FolderError, Manifest, Sum, Totals, summed},
    report::{Groups, Rows},
};
use crate::{
    analyse::{Cell, Column},
    registry::Registry,
};
use block::joined;

pub use block::{BLOCK_ROWS, Block};
pub use fly::Flyer;
pub use values::{Lists, Texts, Values};

/// Rows of a sweep: all of them, or those of shards.
#[derive(Debug)]
pub struct Table {
    manifest: Manifest,
    /// Where relative paths in the scenario start.
    scenes: PathBuf,
    sweep: Arc<Sweep>,
    columns: Vec<Column>,
    blocks: Vec<Block>,
}

impl Table {
    /// Without rows yet.
    fn empty(registry: Registry, manifest: Manifest, scenes: PathBuf) -> Result<Self, FolderError> {
        let sweep = manifest.sweep(registry, &scenes)?;
        let columns = sweep.columns();
        Ok(Self { manifest, scenes, sweep: Arc::new(sweep), columns, blocks: Vec::new() })
    }

    fn with(mut self, blocks: Vec<Block>) -> Result<Self, FolderError> {
        self.blocks = joined(&self.columns, blocks).map_err(|run| FolderError::RunTwice { run })?;
        Ok(self)
    }

    /// One table of many, such as of all shards of a sweep.
    ///
    /// # Errors
    /// No tables, tables of different sweeps, a run that is in two of them.
    pub fn concat(tables: &[&Self]) -> Result<Self, FolderError> {
        let Some(first) = tables.first() else { return Err(FolderError::NoTables) };
        for (place, table) in tables.iter().enumerate() {
            if let Some(what) = first.manifest.differs(&table.manifest) {
                return Err(FolderError::OtherSweep { place, what });
            }
        }
        let blocks = tables.iter().flat_map(|table| &table.blocks).cloned().collect();
        let (manifest, scenes) = (first.manifest.clone(), first.scenes.clone());
        let columns = first.columns.clone();
        Self { manifest, scenes, sweep: first.sweep.clone(), columns, blocks: Vec::new() }.with(blocks)
    }

    /// What is flown.
    pub fn manifest(&self) -> &Manifest {
        &self.manifest
    }

    /// The sweep whose rows these are.
    pub fn sweep(&self) -> &Arc<Sweep> {
        &self.sweep
    }

    /// Names and kinds of its columns.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// Its rows, block by block, in the order of the runs. How they are cut follows from which runs are there.
    pub fn blocks(&self) -> &[Block] {
        &self.blocks
    }

    /// Number of rows.
    pub fn rows(&self) -> u64 {
        self.blocks.iter().map(|block| block.rows() as u64).sum()
    }

    /// An error unless all runs are there.
    ///
    /// # Errors
    /// [`FolderError::Missing`].
    pub fn whole(&self) -> Result<(), FolderError> {
        let (runs, rows) = (self.manifest.runs, self.rows());
        if rows == runs {
            return Ok(());
        }
        let mut first = 0;
        for block in &self.blocks {
            if block.runs().start == first {
                first = block.runs().end;
            }
        }
        Err(FolderError::Missing { missing: runs.saturating_sub(rows), runs, first })
    }

    /// What the runs that are there came to.
    pub fn totals(&self) -> Totals {
        let places = summed(&self.columns);
        let mut sum = Sum::new();
        for block in &self.blocks {
            let cell =
                |place: usize, row| block.values().get(place).map_or(Cell::Absent, |values| values.cell(row));
            for row in 0..block.rows() {
                let [failed, sim_s, digest] = places.map(|place| cell(place, row));
                sum.add([&failed, &sim_s, &digest]);
            }
        }
        sum.totals()
    }
}

/// The same sweep, wherever its files lie, and the same rows, bit for bit.
impl PartialEq for Table {
    fn eq(&self, other: &Self) -> bool {
        self.manifest == other.manifest && self.blocks == other.blocks
    }
}

impl Rows for Table {
    fn manifest(&self) -> &Manifest {
        &self.manifest
    }

    fn cells<'a>(&'a self, column: &Column) -> Result<Groups<'a>, FolderError> {
        self.whole()?;
        let place = self.columns.iter().position(|known| known.name == column.name);
        let values =
            self.blocks.iter().filter_map(move |block| Some((block.rows(), block.values().get(place?)?)));
        Ok(Box::new(values.map(|(rows, values)| Ok((0..rows).map(|row| values.cell(row)).collect()))))
    }

    fn totals(&self, _: &Sweep) -> Result<Totals, FolderError> {
        Ok(Self::totals(self))
    }
}

#[cfg(test)]
mod tests;
