//! `runs.parquet`: the only place that knows Parquet. The table is flat and written row by row, so the crate's arrow half
//! would only copy what is in rows already; it stays out.

mod pages;
mod read;
mod seal;
mod write;

use std::path::Path;

use parquet::errors::ParquetError;

use super::FolderError;

pub(in crate::sweep) use read::Table;
pub(super) use seal::{Seal, Sealing, seal_of};
pub(in crate::sweep) use write::Writer;

/// Rows of a row group, and entries of lists in it: they bound the memory of writers and readers.
const GROUP_ROWS: usize = 16_384;
const GROUP_ENTRIES: usize = 1 << 20;
/// What helps where a table is not as it was written.
pub(super) const REMEDY: &str = "remove it and fly the sweep again";

type Result<T> = std::result::Result<T, ParquetError>;

/// For `map_err`.
pub(in crate::sweep) fn damaged(path: &Path, error: &ParquetError) -> FolderError {
    FolderError::Damaged { file: path.to_owned(), why: error.to_string(), remedy: REMEDY }
}

/// For `map_err`: the system's own words, if it was the system.
pub(in crate::sweep) fn cannot_write(path: &Path, error: ParquetError) -> FolderError {
    let cause = match error {
        ParquetError::External(cause) => match cause.downcast::<std::io::Error>() {
            Ok(cause) => *cause,
            Err(cause) => std::io::Error::other(cause),
        },
        other => std::io::Error::other(other),
    };
    FolderError::io(path, "write")(cause)
}

#[cfg(test)]
mod tests;
