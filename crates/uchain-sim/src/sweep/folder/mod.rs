//! A sweep on disk: nothing that was finished is lost, whatever happens to the process, and the same bytes come out of
//! it however the work was cut up.
//!
//! `sweep.json` says what is flown. Runs are flown in chunks of a fixed number of rows, a file each in `chunks`, written
//! whole or not at all. When all are there, `runs.parquet` is made of them, and they go.

mod chunk;
pub(super) mod durable;
mod error;
mod job;
mod lock;
mod manifest;
mod merge;
mod table;
mod totals;

use std::{
    fs, io,
    ops::Range,
    path::{Path, PathBuf},
    sync::OnceLock,
};

pub use error::FolderError;
pub use job::{Job, Record, Shard, Watch};
pub(super) use job::{each_chunk, unrecorded};
pub use lock::{LOCK, Lock, LockError};
pub use manifest::Manifest;
pub(super) use manifest::OnDisk;
pub use merge::merge;
pub(super) use table::{Table as Stored, Writer, cannot_write, damaged};
pub use totals::Totals;
pub(super) use totals::{Sum, summed};

use super::{Sweep, row::FAILED};
use crate::analyse::{Cell, Column};
use crate::registry::Registry;
use table::{REMEDY, Table, seal_of};

/// What is flown.
pub(super) const MANIFEST: &str = "sweep.json";
/// The table.
pub const TABLE: &str = "runs.parquet";
/// Chunks that wait for the others.
const CHUNKS: &str = "chunks";
/// Recordings, if any are asked for.
const RECORDINGS: &str = "recordings";

/// A sweep's folder.
#[derive(Debug)]
pub struct Folder {
    path: PathBuf,
    /// Missions that its scenario may be of.
    registry: Registry,
    on_disk: OnDisk,
    hash: String,
    /// Whether the bytes of the table were found to be those that were written.
    is_checked: OnceLock<()>,
    /// Held as long as someone may write.
    _lock: Option<Lock>,
}

/// What is known of one run of a sweep.
#[derive(Debug, Clone, PartialEq)]
pub struct Known {
    /// Its digest, if it was flown to its end.
    pub digest: Option<String>,
    /// Why it failed, if it did.
    pub failed: Option<String>,
}

impl Folder {
    /// A folder to write to: a new one, an empty one, or with `resume` one that holds the same sweep. `scenes` is where
    /// relative paths in the scenario start.
    ///
    /// # Errors
    /// The folder holds something else or another sweep, another process writes there, or it cannot be written to.
    pub fn begin(path: &Path, manifest: Manifest, scenes: &Path, resume: bool) -> Result<Self, FolderError> {
        let folder = || path.to_owned();
        if path.join(MANIFEST).exists() {
            if !resume {
                return Err(FolderError::Exists { folder: folder() });
            }
            let there = Self::open(path)?;
            if let Some(what) = there.on_disk.manifest.differs(&manifest) {
                return Err(FolderError::Another { folder: folder(), what });
            }
            let mut this = Self { _lock: Some(lock(path)?), ..there };
            // The sweep may have been carried elsewhere, and the files that it reads as well.
            let scenes = absolute(scenes)?;
            if this.on_disk.folder != scenes {
                this.on_disk.folder = scenes;
                this.on_disk.write(path)?;
            }
            this.prepare()?;
            return Ok(this);
        }
        let is_new = !path.exists();
        if let Some(found) = stranger(path)? {
            return Err(FolderError::Occupied { folder: folder(), found });
        }
        let made = Self::make(path, manifest, scenes);
        if made.is_err() && is_new {
            // Goes only if it is empty, and then it is ours.
            let _ = fs::remove_dir(path);
        }
        made
    }

    fn make(path: &Path, manifest: Manifest, scenes: &Path) -> Result<Self, FolderError> {
        fs::create_dir_all(path).map_err(FolderError::io(path, "make the folder"))?;
        durable::settle(path.parent().unwrap_or(path))?;
        let lock = lock(path)?;
        let on_disk = OnDisk::new(manifest, absolute(scenes)?);
        on_disk.write(path)?;
        let this = Self::of(path, on_disk, Some(lock));
        this.prepare()?;
        Ok(this)
    }

    fn of(path: &Path, on_disk: OnDisk, lock: Option<Lock>) -> Self {
        let hash = on_disk.manifest.hash();
        Self {
            path: path.to_owned(),
            registry: Registry::default(),
            on_disk,
            hash,
            is_checked: OnceLock::new(),
            _lock: lock,
        }
    }

    /// What a killed process may not have come to: a folder for chunks, and none once there is a table.
    fn prepare(&self) -> Result<(), FolderError> {
        if self.is_complete() {
            // Chunks go for a table that is whole.
            return self.table().and_then(|_| self.tidy());
        }
        let chunks = self.path.join(CHUNKS);
        fs::create_dir_all(&chunks).map_err(FolderError::io(&chunks, "make the folder"))?;
        durable::settle(&self.path)
    }

    /// A folder to read from.
    ///
    /// # Errors
    /// It holds no sweep, or cannot be read.
    pub fn open(path: &Path) -> Result<Self, FolderError> {
        Ok(Self::of(path, OnDisk::read(path)?, None))
    }

    /// Takes the folder for oneself, to write beside the sweep, as long as what this gives lives.
    ///
    /// # Errors
    /// Another process writes there.
    pub fn lock(&self) -> Result<Lock, FolderError> {
        lock(&self.path)
    }

    /// What is flown.
    pub fn manifest(&self) -> &Manifest {
        &self.on_disk.manifest
    }

    /// The missions that its scenario may be of.
    pub fn registry(&self) -> Registry {
        self.registry
    }

    /// Where relative paths in the scenario start.
    pub(super) fn scenes(&self) -> &Path {
        &self.on_disk.folder
    }

    /// From here on its scenario may be of these missions, and of no others.
    #[must_use]
    pub fn with_missions(self, registry: Registry) -> Self {
        Self { registry, ..self }
    }

    /// The sweep, ready to be flown by this version.
    ///
    /// # Errors
    /// This version does not know the scenario any more.
    pub fn sweep(&self) -> Result<Sweep, FolderError> {
        Ok(self.on_disk.manifest.sweep(self.registry, &self.on_disk.folder)?)
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Whether the table is there, and with it every run.
    pub fn is_complete(&self) -> bool {
        self.table_path().exists()
    }

    /// The table, whose bytes are those that were written.
    pub(super) fn table(&self) -> Result<Table, FolderError> {
        let path = self.table_path();
        if self.is_checked.get().is_none() {
            // Read anew: this process may have written the table since it began.
            let seal = OnDisk::read(&self.path)?.table;
            let now = if seal.is_some() { Some(seal_of(&path)?) } else { None };
            if now != seal {
                let why = "its checksum is not that in sweep.json".to_owned();
                return Err(FolderError::Damaged { file: path, why, remedy: REMEDY });
            }
            // Another thread may have been faster.
            let _ = self.is_checked.set(());
        }
        Table::open(&path)
    }

    pub(super) fn table_path(&self) -> PathBuf {
        self.path.join(TABLE)
    }

    /// Number of chunks.
    fn chunks(&self) -> u64 {
        self.manifest().chunks()
    }

    /// Runs of a chunk.
    fn runs_of(&self, chunk: u64) -> Range<u64> {
        self.manifest().runs_of(chunk)
    }

    /// Chunks that wait for the others.
    pub(super) fn finished_chunks(&self) -> impl Iterator<Item = u64> {
        (0..self.chunks()).filter(|chunk| self.chunk_path(*chunk).exists())
    }

    fn chunk_path(&self, chunk: u64) -> PathBuf {
        self.path.join(CHUNKS).join(format!("{chunk:08}.jsonl"))
    }

    pub(super) fn read_chunk(&self, chunk: u64, columns: &[Column]) -> Result<Vec<Vec<Cell>>, FolderError> {
        chunk::read(&self.chunk_path(chunk), &self.hash, &self.runs_of(chunk), columns.len())
    }

    /// Removes the chunks of a complete sweep: the table holds them all.
    fn tidy(&self) -> Result<(), FolderError> {
        let chunks = self.path.join(CHUNKS);
        match fs::remove_dir_all(&chunks) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => {
                Err(FolderError::io(&chunks, "remove")(error))
            }
            _ => Ok(()),
        }
    }

    /// What is known of a run.
    ///
    /// # Errors
    /// There is no such run, it was not flown yet, or what holds it is damaged.
    pub fn known(&self, sweep: &Sweep, run: u64) -> Result<Known, FolderError> {
        let (runs, columns) = (self.manifest().runs, sweep.columns());
        if run >= runs {
            return Err(FolderError::NoSuchRun { run, last: runs - 1 });
        }
        let words = |name: &str| -> Result<Option<String>, FolderError> {
            let place = columns.iter().position(|column| column.name == name).unwrap_or(usize::MAX);
            let cell = if let (true, Some(column)) = (self.is_complete(), columns.get(place)) {
                self.table()?.cell(column, run).map_err(|e| damaged(&self.table_path(), &e))?
            } else {
                let chunk = run / self.manifest().chunk_rows.max(1);
                if !self.chunk_path(chunk).exists() {
                    return Err(FolderError::Missing { missing: 1, runs, first: run });
                }
                let mut rows = self.read_chunk(chunk, &columns)?;
                let row = (run - self.runs_of(chunk).start) as usize;
                if row < rows.len() && place < columns.len() {
                    rows.swap_remove(row).swap_remove(place)
                } else {
                    Cell::Absent
                }
            };
            Ok(cell.text().map(str::to_owned))
        };
        Ok(Known { digest: words("digest")?, failed: words(FAILED)? })
    }

    /// All cells of a column of scalars of a complete sweep, in order, some thousands at a time.
    ///
    /// # Errors
    /// The table cannot be read, now or later.
    pub fn column(
        &self,
        column: &Column,
    ) -> Result<impl Iterator<Item = Result<Vec<Cell>, FolderError>> + use<>, FolderError> {
        let path = self.table_path();
        let table = self.table()?;
        let cells: Vec<_> = (0..table.groups()).collect();
        let column = column.clone();
        Ok(cells
            .into_iter()
            .map(move |group| table.cells(&column, group).map_err(|error| damaged(&path, &error))))
    }
}

/// A name in a folder that is none of what a killed process may have left there before `sweep.json`.
fn stranger(path: &Path) -> Result<Option<String>, FolderError> {
    let entries = match fs::read_dir(path) {
        Ok(entries) => entries,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(FolderError::io(path, "write")(error)),
    };
    for entry in entries {
        let name = entry.map_err(FolderError::io(path, "read"))?.file_name();
        let name = name.to_string_lossy();
        if !name.ends_with(durable::PART) && name != LOCK {
            return Ok(Some(name.into_owned()));
        }
    }
    Ok(None)
}

/// Where relative paths start, wherever a process stands.
pub(super) fn absolute(scenes: &Path) -> Result<PathBuf, FolderError> {
    let scenes = if scenes.as_os_str().is_empty() { Path::new(".") } else { scenes };
    std::path::absolute(scenes).map_err(FolderError::io(scenes, "find the folder"))
}

/// One process at a time.
fn lock(path: &Path) -> Result<Lock, FolderError> {
    Lock::take(path).map_err(|error| match error {
        LockError::Busy => FolderError::Busy { folder: path.to_owned() },
        LockError::Io(cause) => FolderError::io(path, "lock")(cause),
    })
}
