//! A chunk: a fixed number of rows, whoever flies them. One file each, a line of JSON a row, the last line a checksum.

use std::{fs, io::Write as _, ops::Range, path::Path};

use serde::{Deserialize, Serialize};
use twox_hash::XxHash64;
use uchain_core::bounded;

use super::{FolderError, durable};
use crate::analyse::Cell;

/// Most chunks of a sweep of few runs: each is saved early, and there is work for many threads.
const CHUNKS: u64 = 256;
/// Most rows of a chunk: bounds the memory.
const ROWS_MAX: u64 = 1000;
/// Longest file (bytes); a chain of 1000 UAVs leaves about 30 kB a row.
const BYTES_MAX: u64 = 256 << 20;

const REMEDY: &str = "--resume flies its runs again";

/// Rows of a chunk: a function of the number of runs alone.
pub(super) fn rows(runs: u64) -> u64 {
    bounded(runs.div_ceil(CHUNKS), 1, ROWS_MAX)
}

/// The first line.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
struct Head {
    /// Hash of the sweep it belongs to.
    sweep: String,
    /// First run.
    first: u64,
    /// Number of rows.
    rows: u64,
}

/// The last line.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
struct Tail {
    /// `XxHash64` of all bytes before this line.
    xxh64: String,
}

fn hash(bytes: &[u8]) -> String {
    format!("{:016x}", XxHash64::oneshot(0, bytes))
}

/// Leaves a chunk on the disk.
pub(super) fn write(
    path: &Path,
    sweep: &str,
    runs: &Range<u64>,
    rows: &[Vec<Cell>],
) -> Result<(), FolderError> {
    let head = Head { sweep: sweep.to_owned(), first: runs.start, rows: runs.end - runs.start };
    durable::write(path, |out| {
        let text = || -> serde_json::Result<Vec<u8>> {
            let mut bytes = serde_json::to_vec(&head)?;
            for row in rows {
                bytes.push(b'\n');
                serde_json::to_writer(&mut bytes, row)?;
            }
            bytes.push(b'\n');
            let tail = serde_json::to_vec(&Tail { xxh64: hash(&bytes) })?;
            bytes.extend(tail);
            bytes.push(b'\n');
            Ok(bytes)
        };
        let bytes = text().map_err(|error| FolderError::io(path, "write")(error.into()))?;
        out.write_all(&bytes).map_err(FolderError::io(path, "write"))
    })
}

/// Reads a chunk, every bit of it checked.
pub(super) fn read(
    path: &Path,
    sweep: &str,
    runs: &Range<u64>,
    columns: usize,
) -> Result<Vec<Vec<Cell>>, FolderError> {
    let damaged =
        |why: &str| FolderError::Damaged { file: path.to_owned(), why: why.to_owned(), remedy: REMEDY };
    let length = fs::metadata(path).map_err(FolderError::io(path, "read"))?.len();
    if length > BYTES_MAX {
        return Err(damaged("it is longer than any chunk"));
    }
    let bytes = fs::read(path).map_err(FolderError::io(path, "read"))?;
    let body = bytes.strip_suffix(b"\n").ok_or_else(|| damaged("it is cut short"))?;
    let end = body.iter().rposition(|byte| *byte == b'\n').ok_or_else(|| damaged("it is cut short"))?;
    let (content, tail) = body.split_at_checked(end + 1).unwrap_or((body, &[]));
    let tail: Tail = serde_json::from_slice(tail).map_err(|_| damaged("it is cut short"))?;
    if tail.xxh64 != hash(content) {
        return Err(damaged("its checksum is wrong"));
    }
    // From here on it is as it was written; but perhaps for somewhere else.
    let mut lines = content.split(|byte| *byte == b'\n').filter(|line| !line.is_empty());
    let head = Head { sweep: sweep.to_owned(), first: runs.start, rows: runs.end - runs.start };
    let is_ours = lines.next().and_then(|line| serde_json::from_slice::<Head>(line).ok()) == Some(head);
    if !is_ours {
        return Err(damaged("it belongs to another sweep"));
    }
    let rows: Vec<Vec<Cell>> = lines
        .map(serde_json::from_slice)
        .collect::<Result<_, _>>()
        .map_err(|error| damaged(&format!("a row cannot be read ({error})")))?;
    let are_all_there = rows.len() as u64 == runs.end - runs.start
        && rows
            .iter()
            .zip(runs.clone())
            .all(|(row, run)| row.len() == columns && row.first() == Some(&Cell::from(run)));
    if !are_all_there {
        return Err(damaged("its rows are not those of its runs"));
    }
    Ok(rows)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::seed::{Seed, Source};

    /// Finite floats of all sizes.
    fn floats(count: usize) -> impl Iterator<Item = f64> {
        let mut stream = Seed(1).stream(0, Source::Choice);
        let mut bits = move || f64::from_bits(u64::from(stream.bits()) << 32 | u64::from(stream.bits()));
        std::iter::from_fn(move || Some(bits())).filter(|number| number.is_finite()).take(count)
    }

    #[test]
    fn every_bit_of_a_number_comes_back_from_the_disk() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("0.jsonl");
        let rows: Vec<Vec<Cell>> = floats(20_000)
            .enumerate()
            .map(|(run, number)| {
                // Such as a run comes to, and any other.
                let usual = (number.to_bits() >> 12) as f64 * 1e-13;
                let list = Cell::Numbers(vec![Some(usual), None, Some(number)]);
                vec![run.into(), number.into(), usual.into(), (usual as f32).into(), list]
            })
            .collect();
        let runs = 0..rows.len() as u64;
        write(&path, "it", &runs, &rows).unwrap();
        let bits = |rows: &[Vec<Cell>]| -> Vec<u64> {
            let numbers = |cell: &Cell| match cell {
                Cell::Numbers(list) => list.iter().flatten().map(|number| number.to_bits()).collect(),
                cell => cell.number().map(f64::to_bits).into_iter().collect::<Vec<_>>(),
            };
            rows.iter().flatten().flat_map(numbers).collect()
        };
        let back = read(&path, "it", &runs, 5).unwrap();
        let (wanted, got) = (bits(&rows), bits(&back));
        assert_eq!(wanted.len(), 6 * rows.len());
        let differ = wanted.iter().zip(&got).filter(|(a, b)| a != b).count();
        assert!(back == rows && differ == 0, "{differ} of {} numbers differ", wanted.len());

        // A digit less is another number for most of them: the comparison sees the last bit.
        let short = floats(20_000).filter(|number| format!("{number:.15e}").parse() != Ok(*number)).count();
        assert!(short > 5_000, "{short}");
    }
}
