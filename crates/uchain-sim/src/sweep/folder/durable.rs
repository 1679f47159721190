//! A file is there whole or not at all, whenever the power goes.

use std::{
    fs::{self, File},
    io::{BufWriter, Write as _},
    path::Path,
};

use super::FolderError;

/// How names of files end that are not finished yet.
pub(super) const PART: &str = ".part";

/// Writes a file under a temporary name, brings it to the disk, gives it its name, and brings that to the disk.
pub(in crate::sweep) fn write<T>(
    path: &Path,
    fill: impl FnOnce(&mut BufWriter<File>) -> Result<T, FolderError>,
) -> Result<T, FolderError> {
    written(path, true, fill)
}

/// Writes a file that can be made again: whole or not at all, unless the power goes.
pub(in crate::sweep) fn replace<T>(
    path: &Path,
    fill: impl FnOnce(&mut BufWriter<File>) -> Result<T, FolderError>,
) -> Result<T, FolderError> {
    written(path, false, fill)
}

fn written<T>(
    path: &Path,
    is_settled: bool,
    fill: impl FnOnce(&mut BufWriter<File>) -> Result<T, FolderError>,
) -> Result<T, FolderError> {
    let part = part_of(path);
    let written = write_part(path, &part, is_settled, fill);
    if written.is_err() {
        // What is left of it is of no use to anyone.
        let _ = fs::remove_file(&part);
    }
    written
}

fn write_part<T>(
    path: &Path,
    part: &Path,
    is_settled: bool,
    fill: impl FnOnce(&mut BufWriter<File>) -> Result<T, FolderError>,
) -> Result<T, FolderError> {
    let failed = |cause| FolderError::io(path, "write")(cause);
    let mut out = BufWriter::new(File::create(part).map_err(failed)?);
    let filled = fill(&mut out)?;
    out.flush().map_err(failed)?;
    if is_settled {
        out.get_ref().sync_all().map_err(failed)?;
    }
    drop(out);
    fs::rename(part, path).map_err(failed)?;
    if is_settled {
        settle(path.parent().unwrap_or(Path::new(".")))?;
    }
    Ok(filled)
}

/// Brings the names in a folder to the disk.
pub(super) fn settle(folder: &Path) -> Result<(), FolderError> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    // Elsewhere a folder cannot be opened; there the file system orders names by itself.
    if cfg!(unix) {
        File::open(folder).and_then(|folder| folder.sync_all()).map_err(FolderError::io(folder, "write"))?;
    }
    Ok(())
}

fn part_of(path: &Path) -> std::path::PathBuf {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(PART);
    path.with_file_name(name)
}
