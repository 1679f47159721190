//! Files whose names the user chose, each whole or not at all.

use std::{
    fs,
    io::{self, Write as _},
    path::{Path, PathBuf},
};

use super::unfinished_file;
use crate::exit::Failure;

/// Writes files, in this order, once all are complete under other names. Neither takes the place of an input, and only with
/// `force` that of something else.
pub(crate) fn write(files: &[(PathBuf, Vec<u8>)], inputs: &[PathBuf], force: bool) -> Result<(), Failure> {
    let inputs: Vec<PathBuf> = inputs.iter().filter_map(|input| fs::canonicalize(input).ok()).collect();
    for (file, _) in files {
        if fs::canonicalize(file).is_ok_and(|file| inputs.contains(&file)) {
            return Err(Failure::OwnMap { file: file.clone() });
        }
        if !force && file.symlink_metadata().is_ok() {
            return Err(Failure::Exists { file: file.clone() });
        }
    }
    let mut ready = Vec::new();
    for (file, bytes) in files {
        let failed = |cause: io::Error| Failure::Write { file: file.clone(), cause };
        let folder = folder_of(file);
        fs::create_dir_all(folder).map_err(failed)?;
        let mut unfinished = unfinished_file(folder).map_err(failed)?;
        unfinished.write_all(bytes).map_err(failed)?;
        ready.push((file, unfinished));
    }
    for (file, unfinished) in ready {
        unfinished
            .persist(file)
            .map_err(|error| Failure::Write { file: file.clone(), cause: error.error })?;
    }
    Ok(())
}

fn folder_of(file: &Path) -> &Path {
    match file.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}
