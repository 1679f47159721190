//! Shards that were flown apart, put together.

use std::{fs, path::Path};

use super::{Folder, FolderError, RECORDINGS, Totals, durable};

/// Makes one table of shards that were flown into folders of their own. The shards stay as they are.
///
/// # Errors
/// The folders hold different sweeps or different rows for the same runs, runs are missing, or the table cannot be
/// written. Nothing is written unless all runs are there.
pub fn merge(folders: &[impl AsRef<Path>], out: &Path) -> Result<Totals, FolderError> {
    let shards = folders.iter().map(|path| Folder::open(path.as_ref())).collect::<Result<Vec<_>, _>>()?;
    let Some(first) = shards.first() else { return Err(FolderError::NoSweep { folder: out.to_owned() }) };
    for shard in &shards {
        if shard.is_complete() {
            return Err(FolderError::Complete { folder: shard.path.clone() });
        }
        if let Some(what) = shard.manifest().differs(first.manifest()) {
            return Err(FolderError::Another { folder: shard.path.clone(), what });
        }
    }
    let sweep = first.sweep()?;
    let columns = sweep.columns();
    let mut holders = Vec::new();
    let (mut missing, mut first_missing) = (0, None);
    for chunk in 0..first.chunks() {
        let mut holding = shards.iter().filter(|shard| shard.chunk_path(chunk).exists());
        let Some(holder) = holding.next() else {
            let runs = first.runs_of(chunk);
            missing += runs.end - runs.start;
            first_missing = first_missing.or(Some(runs.start));
            continue;
        };
        for other in holding {
            if holder.read_chunk(chunk, &columns)? != other.read_chunk(chunk, &columns)? {
                let (first, second) = (holder.chunk_path(chunk), other.chunk_path(chunk));
                return Err(FolderError::Contradiction { first, second });
            }
        }
        holders.push(holder);
    }
    if let Some(first_run) = first_missing {
        return Err(FolderError::Missing { missing, runs: first.manifest().runs, first: first_run });
    }
    let merged = Folder::begin(out, first.manifest().clone(), &first.on_disk.folder, true)?;
    for shard in &shards {
        copy_recordings(shard, &merged)?;
    }
    merged.tabulate(&columns, |chunk| match holders.get(chunk as usize) {
        Some(holder) => holder.read_chunk(chunk, &columns),
        None => merged.read_chunk(chunk, &columns),
    })
}

fn copy_recordings(from: &Folder, to: &Folder) -> Result<(), FolderError> {
    let (source, target) = (from.path.join(RECORDINGS), to.path.join(RECORDINGS));
    if !source.exists() || from.path == to.path {
        return Ok(());
    }
    fs::create_dir_all(&target).map_err(FolderError::io(&target, "make the folder"))?;
    for entry in fs::read_dir(&source).map_err(FolderError::io(&source, "read"))? {
        let file = entry.map_err(FolderError::io(&source, "read"))?.path();
        let name = file.file_name().unwrap_or_default();
        if name.to_string_lossy().ends_with(durable::PART) {
            continue;
        }
        let mut recording = fs::File::open(&file).map_err(FolderError::io(&file, "read"))?;
        let copy = target.join(name);
        durable::write(&copy, |out| {
            std::io::copy(&mut recording, out).map_err(FolderError::io(&copy, "write"))
        })?;
    }
    Ok(())
}
