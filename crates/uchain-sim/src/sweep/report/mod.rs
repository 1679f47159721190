//! What a sweep came to, cell by cell: statistics of every number of the summary in every variant.

mod markdown;
#[cfg(feature = "draw")]
mod pictures;
mod rows;
#[cfg(feature = "draw")]
mod save;
#[cfg(feature = "draw")]
mod words;

use super::{
    Sweep,
    folder::FolderError,
    row::{FAILED, VERDICT},
};
use crate::analyse::Estimate;
use crate::analyse::{Cell, Column, Kind};

pub use markdown::markdown;
#[cfg(feature = "draw")]
pub use pictures::picture;
pub use rows::{Groups, Rows};
#[cfg(feature = "draw")]
pub use save::{CSV, MARKDOWN, PLOTS, save};
#[cfg(feature = "draw")]
pub use words::key_in_words;

/// Why there is no report.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReportError {
    /// Rows cannot be read, or a file cannot be written.
    #[error(transparent)]
    Folder(#[from] FolderError),
    /// No picture.
    #[cfg(feature = "draw")]
    #[error(transparent)]
    Draw(#[from] crate::draw::DrawError),
}

/// Most variants that are kept for tables and pictures.
pub const CELLS_MAX: usize = 1000;
/// Most different reasons of failures that are kept.
const REASONS_MAX: usize = 20;

/// One number of the summary, in the first [`CELLS_MAX`] variants.
#[derive(Debug, Clone, PartialEq)]
pub struct Metric {
    /// Its name.
    pub name: String,
    /// Its statistics, by variant; `None` where no run has the number.
    pub cells: Vec<Option<Estimate>>,
    /// The one value it has in all runs, if it is the same in all.
    pub constant: Option<f64>,
}

/// A reason for which runs failed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Reason {
    /// The outcome's word; of a run that was not flown, why not.
    pub words: String,
    /// The words with the numbers of the first of them, if it was flown.
    pub verdict: Option<String>,
    /// How many runs.
    pub runs: u64,
    /// The first of them.
    pub first: u64,
}

/// A sweep's failures.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Failures {
    /// Runs that failed, by variant, of the first [`CELLS_MAX`].
    pub cells: Vec<u64>,
    /// The first different reasons, as they came.
    pub reasons: Vec<Reason>,
    /// Runs that failed for other reasons still.
    pub others: u64,
}

/// Columns a report is about: every number of the summary, whatever is varied.
pub fn metrics(sweep: &Sweep) -> Vec<Column> {
    let mut columns = sweep.columns();
    let is_number = |column: &Column| matches!(column.kind, Kind::Count | Kind::Number | Kind::Single);
    columns.retain(|column| column.is_result && is_number(column));
    columns
}

/// Calls back with every variant's cells of a column, in order. Memory: the replicates of a variant.
///
/// # Errors
/// The table cannot be read, or the callback fails.
pub fn each_variant<E: From<FolderError>>(
    rows: &dyn Rows,
    column: &Column,
    mut told: impl FnMut(u64, &[Cell]) -> Result<(), E>,
) -> Result<(), E> {
    let replicates = usize::try_from(rows.manifest().replicates).unwrap_or(usize::MAX);
    let (mut cells, mut variant) = (Vec::new(), 0);
    for group in rows.cells(column)? {
        for cell in group? {
            cells.push(cell);
            if cells.len() == replicates {
                told(variant, &cells)?;
                cells.clear();
                variant += 1;
            }
        }
    }
    Ok(())
}

/// Statistics of a number in every variant; `told` hears of all of them, the result keeps the first ones.
///
/// # Errors
/// The table cannot be read, or the callback fails.
pub fn metric<E: From<FolderError>>(
    rows: &dyn Rows,
    column: &Column,
    mut told: impl FnMut(u64, &Estimate) -> Result<(), E>,
) -> Result<Metric, E> {
    let (mut kept, mut first, mut is_constant) = (Vec::new(), None, true);
    each_variant(rows, column, |variant, cells| {
        let sample: Vec<f64> = cells.iter().filter_map(Cell::number).collect();
        for number in &sample {
            is_constant &= *first.get_or_insert(*number) == *number;
        }
        is_constant &= sample.len() == cells.len();
        let estimate = match column.kind {
            Kind::Count => Estimate::of_never_negative(&sample),
            _ => Estimate::of(&sample),
        };
        if let Some(estimate) = &estimate {
            told(variant, estimate)?;
        }
        if kept.len() < CELLS_MAX {
            kept.push(estimate);
        }
        Ok::<(), E>(())
    })?;
    Ok(Metric { name: column.name.clone(), cells: kept, constant: first.filter(|_| is_constant) })
}

/// What a number is in every run.
///
/// # Errors
/// The table cannot be read.
pub fn values(rows: &dyn Rows, sweep: &Sweep, name: &str) -> Result<Vec<f64>, FolderError> {
    let mut values = Vec::new();
    for column in metrics(sweep).iter().filter(|column| column.name == name) {
        for group in rows.cells(column)? {
            values.extend(group?.iter().filter_map(Cell::number));
        }
    }
    Ok(values)
}

/// Which runs failed, and why.
///
/// # Errors
/// The table cannot be read.
pub fn failures(rows: &dyn Rows, sweep: &Sweep) -> Result<Failures, FolderError> {
    let mut failures = Failures::default();
    let Some(column) = sweep.columns().into_iter().find(|column| column.name == FAILED) else {
        return Ok(failures);
    };
    let replicates = sweep.replicates();
    each_variant(rows, &column, |variant, cells| {
        let mut failed = 0;
        for (replicate, cell) in cells.iter().enumerate() {
            let Some(words) = cell.text() else { continue };
            failed += 1;
            if let Some(reason) = failures.reasons.iter_mut().find(|reason| reason.words == words) {
                reason.runs += 1;
            } else if failures.reasons.len() < REASONS_MAX {
                let first = variant * replicates + replicate as u64;
                failures.reasons.push(Reason { words: words.to_owned(), verdict: None, runs: 1, first });
            } else {
                failures.others += 1;
            }
        }
        if failures.cells.len() < CELLS_MAX {
            failures.cells.push(failed);
        }
        Ok::<(), FolderError>(())
    })?;
    let Some(column) = sweep.columns().into_iter().find(|column| column.name == VERDICT) else {
        return Ok(failures);
    };
    each_variant(rows, &column, |variant, cells| {
        for reason in failures.reasons.iter_mut().filter(|reason| reason.first / replicates == variant) {
            let first = cells.get((reason.first % replicates) as usize);
            reason.verdict = first.and_then(Cell::text).map(str::to_owned);
        }
        Ok::<(), FolderError>(())
    })?;
    Ok(failures)
}
