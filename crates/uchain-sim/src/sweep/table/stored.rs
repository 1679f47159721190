//! Tables from files, and files from tables.

use std::{io::Write, path::Path};

use bytes::Bytes;
use parquet::file::reader::ChunkReader;

use super::{Block, Table};
use crate::{
    registry::Registry,
    sweep::folder::{Folder, FolderError, OnDisk, Stored, Writer, cannot_write, damaged, durable},
};

/// What messages call bytes that are in no file.
const PICKLED: &str = "<table>";

impl Table {
    /// The rows in a folder: all of a sweep that is complete, else those that were flown so far.
    ///
    /// # Errors
    /// What is there cannot be read, or is damaged.
    pub fn read(folder: &Folder) -> Result<Self, FolderError> {
        let (manifest, scenes) = (folder.manifest().clone(), folder.scenes().to_owned());
        let table = Self::empty(folder.registry(), manifest, scenes)?;
        if folder.is_complete() {
            let rows = folder.table()?;
            let table = table.filled(&rows, &folder.table_path())?;
            return table.whole().map(|()| table);
        }
        let mut blocks = Vec::new();
        for chunk in folder.finished_chunks() {
            let mut block = Block::of(&table.columns, table.manifest.runs_of(chunk).start);
            folder.read_chunk(chunk, &table.columns)?.iter().for_each(|row| block.push(row.iter()));
            blocks.push(block);
        }
        table.with(blocks)
    }

    /// With the rows of a table that was written; `path` is what messages call it.
    fn filled<R: ChunkReader + 'static>(self, stored: &Stored<R>, path: &Path) -> Result<Self, FolderError> {
        let wrong =
            |why: String| FolderError::Damaged { file: path.to_owned(), why, remedy: "fly the sweep again" };
        let mut blocks: Vec<Block> = Vec::new();
        for group in 0..stored.groups() {
            let cells = self.columns.iter().map(|column| stored.cells(column, group));
            let cells: Vec<_> = cells.collect::<Result<_, _>>().map_err(|error| damaged(path, &error))?;
            let runs = cells.first().map(Vec::as_slice).unwrap_or_default();
            for (row, run) in runs.iter().enumerate() {
                let run = run.number().map(|run| run as u64).filter(|run| *run < self.manifest.runs);
                let run = run.ok_or_else(|| wrong("it has a row of no run".to_owned()))?;
                let is_next = blocks.last().is_some_and(|last| last.runs().end == run);
                if !is_next || row == 0 {
                    blocks.push(Block::of(&self.columns, run));
                }
                if let Some(last) = blocks.last_mut() {
                    last.push(cells.iter().filter_map(|cells| cells.get(row)));
                }
            }
        }
        self.with(blocks)
    }

    /// Writes its rows as a folder's table is written, whole or not at all: of a complete sweep the same bytes.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), FolderError> {
        durable::write(path, |out| self.write_to(out, path))
    }

    fn write_to(&self, out: impl Write + Send, path: &Path) -> Result<(), FolderError> {
        let failed = |error| cannot_write(path, error);
        let mut writer =
            Writer::start(out, self.columns.clone(), self.manifest.metadata(path)?).map_err(failed)?;
        for block in &self.blocks {
            for row in 0..block.rows() {
                writer.row(block.row(row)).map_err(failed)?;
            }
        }
        writer.finish().map_err(failed)
    }

    /// All of it, for another process: what is flown, and the rows as they are written.
    ///
    /// # Errors
    /// Memory is short.
    pub fn to_bytes(&self) -> Result<(String, Vec<u8>), FolderError> {
        let path = Path::new(PICKLED);
        let about = OnDisk::new(self.manifest.clone(), self.scenes.clone());
        let about =
            serde_json::to_string(&about).map_err(|error| FolderError::io(path, "write")(error.into()))?;
        let mut rows = Vec::new();
        self.write_to(&mut rows, path)?;
        Ok((about, rows))
    }

    /// What [`Table::to_bytes`] gave.
    ///
    /// # Errors
    /// It is something else.
    pub fn from_bytes(registry: Registry, about: &str, rows: Vec<u8>) -> Result<Self, FolderError> {
        let path = Path::new(PICKLED);
        let wrong =
            |why: String| FolderError::Damaged { file: path.to_owned(), why, remedy: "fly the sweep again" };
        let about: OnDisk = serde_json::from_str(about).map_err(|error| wrong(error.to_string()))?;
        let (manifest, scenes) = about.into_parts();
        let table = Self::empty(registry, manifest, scenes)?;
        if table.manifest.runs != table.sweep.runs() {
            return Err(wrong(format!(
                "it says {} runs, and has {}",
                table.manifest.runs,
                table.sweep.runs()
            )));
        }
        let stored = Stored::of(Bytes::from(rows)).map_err(|error| damaged(path, &error))?;
        table.filled(&stored, path)
    }
}
