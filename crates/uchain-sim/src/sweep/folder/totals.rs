//! What a sweep came to, in four numbers; and its table, made of its chunks.

use std::hash::Hasher as _;

use twox_hash::XxHash64;

use super::{
    Folder, FolderError, MANIFEST, durable,
    manifest::OnDisk,
    table::{REMEDY, Seal, Sealing, Writer, cannot_write, damaged},
};
use crate::{
    analyse::{Cell, Column},
    sweep::{Sweep, row::FAILED},
};

/// What many runs came to.
#[derive(Debug, Clone, PartialEq)]
pub struct Totals {
    /// Runs.
    pub runs: u64,
    /// Runs that failed.
    pub failed: u64,
    /// Simulated time of all runs (s).
    pub sim_s: f64,
    /// `XxHash64` over the digests of all runs in order, a line each, `-` for a run without one; 16 hex digits.
    pub digest: String,
}

/// Totals while they are summed up.
#[derive(Debug)]
pub(in crate::sweep) struct Sum {
    runs: u64,
    failed: u64,
    sim_s: f64,
    hash: XxHash64,
}

impl Sum {
    pub(in crate::sweep) fn new() -> Self {
        Self { runs: 0, failed: 0, sim_s: 0.0, hash: XxHash64::with_seed(0) }
    }

    pub(in crate::sweep) fn add(&mut self, [failed, sim_s, digest]: [&Cell; 3]) {
        self.runs += 1;
        self.failed += u64::from(*failed != Cell::Absent);
        self.sim_s += sim_s.number().unwrap_or(0.0);
        self.hash.write(digest.text().unwrap_or("-").as_bytes());
        self.hash.write(b"\n");
    }

    pub(in crate::sweep) fn totals(&self) -> Totals {
        let digest = format!("{:016x}", self.hash.finish());
        Totals { runs: self.runs, failed: self.failed, sim_s: self.sim_s, digest }
    }
}

/// The columns that are summed up.
pub(in crate::sweep) fn summed(columns: &[Column]) -> [usize; 3] {
    let place = |name| columns.iter().position(|column| column.name == name).unwrap_or(usize::MAX);
    [place(FAILED), place("sim_s"), place("digest")]
}

fn cells<'r>(row: &'r [Cell], places: &[usize; 3]) -> [&'r Cell; 3] {
    places.map(|place| row.get(place).unwrap_or(&Cell::Absent))
}

impl Folder {
    /// Totals of the runs that are there.
    ///
    /// # Errors
    /// What is there cannot be read.
    pub fn totals(&self, sweep: &Sweep) -> Result<Totals, FolderError> {
        let columns = sweep.columns();
        let places = summed(&columns);
        let mut sum = Sum::new();
        if !self.is_complete() {
            for chunk in self.finished_chunks() {
                self.read_chunk(chunk, &columns)?.iter().for_each(|row| sum.add(cells(row, &places)));
            }
            return Ok(sum.totals());
        }
        let path = self.table_path();
        let table = self.table()?;
        for group in 0..table.groups() {
            let read =
                |place: usize| columns.get(place).map_or(Ok(Vec::new()), |column| table.cells(column, group));
            let read = |place| read(place).map_err(|error| damaged(&path, &error));
            let [failed, sim_s, digest] = places;
            let (failed, sim_s, digest) = (read(failed)?, read(sim_s)?, read(digest)?);
            for ((failed, sim_s), digest) in failed.iter().zip(&sim_s).zip(&digest) {
                sum.add([failed, sim_s, digest]);
            }
        }
        if sum.runs != self.manifest().runs {
            let why = format!("it has {} rows, not {}", sum.runs, self.manifest().runs);
            return Err(FolderError::Damaged { file: path, why, remedy: REMEDY });
        }
        Ok(sum.totals())
    }

    /// Makes the table of a sweep whose chunks are all there; `None` if some are not.
    ///
    /// # Errors
    /// A chunk is damaged, or the table cannot be written.
    pub fn finish(&self, sweep: &Sweep) -> Result<Option<Totals>, FolderError> {
        if self.is_complete() {
            return self.totals(sweep).map(Some);
        }
        if (0..self.chunks()).any(|chunk| !self.chunk_path(chunk).exists()) {
            return Ok(None);
        }
        let columns = sweep.columns();
        self.tabulate(&columns, |chunk| self.read_chunk(chunk, &columns)).map(Some)
    }

    /// Writes the table from chunks, wherever they are.
    pub(super) fn tabulate(
        &self,
        columns: &[Column],
        read: impl Fn(u64) -> Result<Vec<Vec<Cell>>, FolderError>,
    ) -> Result<Totals, FolderError> {
        let (path, places) = (self.table_path(), summed(columns));
        let failed = |error| cannot_write(&path, error);
        let totals = durable::write(&path, |out| {
            let mut sum = Sum::new();
            let mut out = Sealing::new(out);
            let metadata = self.manifest().metadata(&self.path.join(MANIFEST))?;
            let mut writer = Writer::start(&mut out, columns.to_vec(), metadata).map_err(failed)?;
            for chunk in 0..self.chunks() {
                for row in read(chunk)? {
                    sum.add(cells(&row, &places));
                    writer.row(row).map_err(failed)?;
                }
            }
            writer.finish().map_err(failed)?;
            self.seal(out.seal())?;
            Ok(sum.totals())
        })?;
        self.tidy()?;
        Ok(totals)
    }

    /// Writes down what the bytes of the table are. It is done before the table has its name: there is none without.
    pub(super) fn seal(&self, seal: Seal) -> Result<(), FolderError> {
        OnDisk { table: Some(seal), ..OnDisk::read(&self.path)? }.write(&self.path)
    }
}
