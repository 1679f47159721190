//! Shards that were flown apart, put together.

use std::{fs, io, path::Path};

use super::{
    Folder, FolderError, RECORDINGS, Totals, durable,
    table::{REMEDY, Sealing, damaged, seal_of},
};
use crate::analyse::{Cell, Column, Kind};
use crate::registry::Registry;

/// Makes one table of shards that were flown into folders of their own. The shards stay as they are. One that has every
/// run has its table already, and gives that.
///
/// # Errors
/// The folders hold different sweeps or different rows for the same runs, runs are missing, or the table cannot be
/// written. Nothing is written unless all runs are there.
pub fn merge(registry: Registry, folders: &[impl AsRef<Path>], out: &Path) -> Result<Totals, FolderError> {
    let open = |path: &Path| Folder::open(path).map(|folder| folder.with_missions(registry));
    let shards = folders.iter().map(|path| open(path.as_ref())).collect::<Result<Vec<_>, _>>()?;
    let Some(first) = shards.first() else { return Err(FolderError::NoSweep { folder: out.to_owned() }) };
    for shard in &shards {
        if let Some(what) = shard.manifest().differs(first.manifest()) {
            return Err(FolderError::Another { folder: shard.path.clone(), what });
        }
    }
    let columns = first.sweep()?.columns();
    let whole = shards.iter().find(|shard| shard.is_complete());
    if let Some(whole) = whole {
        for other in &shards {
            agree(whole, other, &columns)?;
        }
    }
    let holders = if whole.is_some() { Vec::new() } else { holders(&shards, first, &columns)? };
    let merged =
        Folder::begin(out, first.manifest().clone(), &first.on_disk.folder, true)?.with_missions(registry);
    for shard in &shards {
        copy_recordings(shard, &merged)?;
    }
    if let Some(whole) = whole {
        return merged.take_table(whole);
    }
    merged.tabulate(&columns, |chunk| match holders.get(chunk as usize) {
        Some(holder) => holder.read_chunk(chunk, &columns),
        None => merged.read_chunk(chunk, &columns),
    })
}

/// Which shard holds a chunk, for all of them.
fn holders<'s>(
    shards: &'s [Folder],
    first: &Folder,
    columns: &[Column],
) -> Result<Vec<&'s Folder>, FolderError> {
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
            if holder.read_chunk(chunk, columns)? != other.read_chunk(chunk, columns)? {
                let (first, second) = (holder.chunk_path(chunk), other.chunk_path(chunk));
                return Err(FolderError::Contradiction { first, second });
            }
        }
        holders.push(holder);
    }
    match first_missing {
        Some(first_run) => {
            Err(FolderError::Missing { missing, runs: first.manifest().runs, first: first_run })
        }
        None => Ok(holders),
    }
}

/// An error if a shard says something else than a table does; lists are left to the digests.
fn agree(whole: &Folder, shard: &Folder, columns: &[Column]) -> Result<(), FolderError> {
    let (table, path) = (whole.table()?, whole.table_path());
    let differs = |second| Err(FolderError::Contradiction { first: path.clone(), second });
    if shard.is_complete() {
        shard.table()?;
        let is_same = seal_of(&path)? == seal_of(&shard.table_path())?;
        return if is_same { Ok(()) } else { differs(shard.table_path()) };
    }
    let is_scalar = |(_, column): &(usize, &Column)| !matches!(column.kind, Kind::Numbers | Kind::Singles);
    let scalars: Vec<(usize, &Column)> = columns.iter().enumerate().filter(is_scalar).collect();
    let mut run = 0;
    let mut held: (Option<u64>, Vec<Vec<Cell>>) = (None, Vec::new());
    for group in 0..table.groups() {
        let read = |(place, column): &(usize, &Column)| Ok((*place, table.cells(column, group)?));
        let cells: Result<Vec<_>, _> = scalars.iter().map(read).collect();
        let cells = cells.map_err(|error| damaged(&path, &error))?;
        for row in 0..cells.first().map_or(0, |(_, cells)| cells.len()) {
            let chunk = run / shard.manifest().chunk_rows.max(1);
            if held.0 != Some(chunk) {
                let is_there = shard.chunk_path(chunk).exists();
                held = (Some(chunk), if is_there { shard.read_chunk(chunk, columns)? } else { Vec::new() });
            }
            let there = held.1.get((run - shard.runs_of(chunk).start) as usize);
            let is_same =
                |there: &Vec<Cell>| cells.iter().all(|(place, cells)| there.get(*place) == cells.get(row));
            if !there.is_none_or(is_same) {
                return differs(shard.chunk_path(chunk));
            }
            run += 1;
        }
    }
    Ok(())
}

impl Folder {
    /// Copies the table of a folder that has every run, unless it is this one.
    fn take_table(&self, whole: &Self) -> Result<Totals, FolderError> {
        let (from, to) = (whole.table_path(), self.table_path());
        let place = |path: &Path| fs::canonicalize(path).map_err(FolderError::io(path, "read"));
        if place(&whole.path)? != place(&self.path)? {
            let (mut file, seal) =
                (fs::File::open(&from).map_err(FolderError::io(&from, "read"))?, seal_of(&from)?);
            durable::write(&to, |out| {
                let mut out = Sealing::new(out);
                io::copy(&mut file, &mut out).map_err(FolderError::io(&to, "write"))?;
                if out.seal() != seal {
                    let why = "it changed while it was read".to_owned();
                    return Err(FolderError::Damaged { file: from.clone(), why, remedy: REMEDY });
                }
                self.seal(seal)
            })?;
            self.tidy()?;
        }
        self.totals(&self.sweep()?)
    }
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
        durable::write(&copy, |out| io::copy(&mut recording, out).map_err(FolderError::io(&copy, "write")))?;
    }
    Ok(())
}
