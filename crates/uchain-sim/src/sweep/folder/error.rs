//! What can go wrong with a sweep's folder.

use std::{
    io,
    path::{Path, PathBuf},
};

use crate::sweep::{DesignError, PoolError};

/// Why a sweep's folder is not what it should be. What was finished before stays.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FolderError {
    /// The system said no.
    #[error("{}: cannot {doing}: {cause}", path.display())]
    Io {
        /// The file or folder.
        path: PathBuf,
        /// What was tried.
        doing: &'static str,
        /// What the system said.
        cause: io::Error,
    },
    /// The folder holds a sweep, and nobody asked to go on with it.
    #[error(
        "{} holds a sweep already: add --resume to go on with it, or name another folder", folder.display()
    )]
    Exists {
        /// The folder.
        folder: PathBuf,
    },
    /// The folder holds another sweep.
    #[error("{} holds another sweep: {what}; name another folder", folder.display())]
    Another {
        /// The folder.
        folder: PathBuf,
        /// What differs: what is there, and what was asked for.
        what: String,
    },
    /// The folder holds something else.
    #[error("{} holds something else ({found}); name another folder", folder.display())]
    Occupied {
        /// The folder.
        folder: PathBuf,
        /// A name in it.
        found: String,
    },
    /// The folder holds no sweep.
    #[error("{} holds no sweep: it has no sweep.json", folder.display())]
    NoSweep {
        /// The folder.
        folder: PathBuf,
    },
    /// Another process writes there.
    #[error("{}: another process works on this sweep", folder.display())]
    Busy {
        /// The folder.
        folder: PathBuf,
    },
    /// A file is not as it was written.
    #[error("{} is damaged: {why}; {remedy}", file.display())]
    Damaged {
        /// The file.
        file: PathBuf,
        /// What is wrong with it.
        why: String,
        /// What helps.
        remedy: &'static str,
    },
    /// Two folders say different things about the same runs.
    #[error("{} and {} hold different rows for the same runs", first.display(), second.display())]
    Contradiction {
        /// One file.
        first: PathBuf,
        /// The other one.
        second: PathBuf,
    },
    /// Not all runs have been flown.
    #[error("{missing} of {runs} runs are missing, the first is run {first}: fly them with --resume")]
    Missing {
        /// How many.
        missing: u64,
        /// Of how many.
        runs: u64,
        /// The first of them.
        first: u64,
    },
    /// A run that is in two tables which were to be one.
    #[error("run {run} is in two of the tables: expected every shard once")]
    RunTwice {
        /// The run.
        run: u64,
    },
    /// Tables of different sweeps.
    #[error("table {place} is of another sweep than table 0: {what}")]
    OtherSweep {
        /// Which one, from 0.
        place: usize,
        /// What differs: what is in the first, and what is in it.
        what: String,
    },
    /// One table of none.
    #[error("no tables: expected at least one")]
    NoTables,
    /// There is no table yet.
    #[error("{} is not complete: {there} of {runs} runs are there; go on with --resume, or merge its shards", folder.display())]
    NoTable {
        /// The folder.
        folder: PathBuf,
        /// Runs that are there.
        there: u64,
        /// Runs of the sweep.
        runs: u64,
    },
    /// There is no such run.
    #[error("no run {run}: the sweep has the runs 0 to {last}")]
    NoSuchRun {
        /// The one asked for.
        run: u64,
        /// The last one.
        last: u64,
    },
    /// The caller asked to stop.
    #[error("interrupted; --resume goes on where it stopped")]
    Interrupted,
    /// The scenario or the design is wrong.
    #[error(transparent)]
    Design(#[from] DesignError),
    /// The system gives no threads.
    #[error(transparent)]
    Pool(#[from] PoolError),
}

impl FolderError {
    /// For `map_err`.
    pub(in crate::sweep) fn io(path: &Path, doing: &'static str) -> impl FnOnce(io::Error) -> Self {
        let path = path.to_owned();
        move |cause| Self::Io { path, doing, cause }
    }
}
