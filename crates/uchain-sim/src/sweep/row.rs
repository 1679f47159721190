//! One run as a row: the run, its variant, and what it came to under the names of `summary.json`. Lists that differ in
//! length from run to run stay lists; what a report needs of them stands beside them.

use super::{Flown, Run, Sweep};
use crate::analyse::{Cell, Column, Kind};
use crate::registry::ValueKind;

/// Columns before those of the design.
const RUN: [(&str, Kind); 4] =
    [("run", Kind::Count), ("variant", Kind::Count), ("replicate", Kind::Count), ("seed", Kind::Count)];
/// Why a run failed: its outcome's word, or why it was not flown; absent if it did not fail.
pub(super) const FAILED: &str = "failed";
/// What a run came to, in words with numbers.
pub(super) const VERDICT: &str = "verdict";

/// How a run that came to an end still failed its mission: its outcome's word.
fn failure(flown: &Flown) -> Option<&str> {
    let outcome = flown.verdict().outcome();
    (!outcome.is_success()).then(|| outcome.word())
}

/// Whether what became of a run is a failure: it was not flown to its end, or its mission failed.
pub(super) fn has_failed(flown: &Result<Flown, String>) -> bool {
    flown.as_ref().map_or(true, |flown| failure(flown).is_some())
}

impl Sweep {
    /// All columns of its table.
    pub fn columns(&self) -> Vec<Column> {
        let column = |name: &str, kind, is_result| Column { name: name.to_owned(), kind, is_result };
        let mut columns: Vec<Column> = RUN.iter().map(|(name, kind)| column(name, *kind, false)).collect();
        for (key, kind) in self.design.keys().zip(&self.kinds) {
            let kind = match kind {
                ValueKind::Whole => Kind::Count,
                ValueKind::Number => Kind::Number,
                ValueKind::Other => Kind::Text,
            };
            columns.push(column(key, kind, false));
        }
        columns.push(column(FAILED, Kind::Text, false));
        columns.extend(self.about.mission.columns());
        columns
    }

    /// The row of a run, in the order of [`Sweep::columns`].
    pub fn row(&self, run: Run, flown: &Result<Flown, String>) -> Vec<Cell> {
        let mut row: Vec<Cell> =
            [run.index, run.variant, run.replicate, run.seed].into_iter().map(Cell::from).collect();
        for (value, kind) in self.design.values(run.variant).into_iter().zip(&self.kinds) {
            row.push(value.map_or(Cell::Absent, |text| cell(&text, *kind)));
        }
        row.push(match flown {
            Ok(flown) => failure(flown).into(),
            Err(reason) => reason.as_str().into(),
        });
        match flown {
            Ok(flown) => row.extend_from_slice(flown.cells()),
            Err(_) => row.extend(self.about.mission.columns().iter().map(|_| Cell::Absent)),
        }
        row
    }
}

/// A varied value, in a column whose type is its key's, whatever the value.
fn cell(text: &str, kind: ValueKind) -> Cell {
    match (kind, text.parse()) {
        (ValueKind::Whole, Ok(toml::Value::Integer(number))) => Cell::Count(number),
        (ValueKind::Number, Ok(toml::Value::Integer(number))) => Cell::Number(number as f64),
        (ValueKind::Number, Ok(toml::Value::Float(number))) => number.into(),
        // A word is the same with quotes and without.
        (ValueKind::Other, Ok(toml::Value::String(word))) => Cell::Text(word),
        (ValueKind::Other, _) => text.into(),
        // A variant with such a value is no scenario.
        _ => Cell::Absent,
    }
}
