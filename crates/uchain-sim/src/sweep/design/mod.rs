//! Which variants are flown: every combination of what is varied.

mod axis;
mod overlap;
mod table;

use std::{borrow::Cow, fs::File, io::Read as _, path::Path};

use serde::{Deserialize, Serialize};

use crate::config::{ConfigError, Origin, shorten};
use axis::Axis;

pub use overlap::Written;
pub(super) use overlap::refuse as refuse_overlaps;
pub use table::TABLE_MAX_BYTES;

/// Most runs of a sweep.
pub const RUNS_MAX: u64 = 10_000_000;
/// Longest text of all values of a variant (bytes): a chunk of rows has to fit into a file.
const VARIANT_MAX_BYTES: usize = 64 << 10;

/// Why there is no such sweep. Nothing has been flown.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DesignError {
    /// What stands behind `--vary` is no list and no range.
    #[error("--vary {typed}: {why}")]
    Vary {
        /// As it was typed.
        typed: String,
        /// What was expected.
        why: String,
    },
    /// A line of a table.
    #[error("{at}: {why}")]
    Table {
        /// Where.
        at: Origin,
        /// What was expected.
        why: String,
    },
    /// The table cannot be read.
    #[error("{label}: cannot read the design: {cause}")]
    Read {
        /// The file.
        label: String,
        /// What the system said.
        cause: std::io::Error,
    },
    /// Two places that give one key its values.
    #[error("{}{key} is written twice: by {}, and by {}; expected one of them", overlap::line(places), places[0], places[1])]
    Twice {
        /// The key.
        key: String,
        /// The two.
        places: Box<[Written; 2]>,
    },
    /// A key of a table, and that table as a whole.
    #[error(
        "{}{} lies within {}: one would undo the other; write the keys of the outer one singly",
        overlap::line(places), places[0], places[1]
    )]
    Within {
        /// The place of the key, and that of what holds it.
        places: Box<[Written; 2]>,
    },
    /// Values that fill a book.
    #[error("the values of a variant have {bytes} bytes: expected at most {VARIANT_MAX_BYTES}")]
    TooLong {
        /// How many at most.
        bytes: usize,
    },
    /// More runs than anyone waits for.
    #[error("{runs} runs ({product}): expected at most {RUNS_MAX}")]
    TooMany {
        /// How many.
        runs: u128,
        /// How they come about.
        product: String,
    },
    /// Not even one.
    #[error("0 replicates: expected at least 1")]
    None,
    /// A variant that is no scenario.
    #[error(transparent)]
    Config(#[from] ConfigError),
}

/// What is varied, as it was written.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct DesignText {
    /// One key each: `radio.sigma_db=1,3,5` or `equalize.tolerance_db=0..5/6`.
    pub vary: Vec<String>,
    /// A table in CSV, keys in its first line, a variant in every other one.
    pub table: Option<String>,
}

impl DesignText {
    /// With the table in a file.
    ///
    /// # Errors
    /// [`DesignError::Read`]; a file that is too long or not text.
    pub fn read(vary: Vec<String>, table: Option<&Path>) -> Result<Self, DesignError> {
        let Some(path) = table else { return Ok(Self { vary, table: None }) };
        let label = path.display().to_string();
        let mut bytes = Vec::new();
        let read = File::open(path).and_then(|file| file.take(TABLE_MAX_BYTES + 1).read_to_end(&mut bytes));
        if let Err(cause) = read {
            return Err(DesignError::Read { label, cause });
        }
        let wrong = |why: String| DesignError::Table { at: Origin::Whole { label: label.clone() }, why };
        if bytes.len() as u64 > TABLE_MAX_BYTES {
            return Err(wrong(format!("longer than {TABLE_MAX_BYTES} bytes")));
        }
        let table = String::from_utf8(bytes).map_err(|error| {
            wrong(format!("not UTF-8 text from byte {} on", error.utf8_error().valid_up_to()))
        })?;
        Ok(Self { vary, table: Some(table) })
    }
}

impl DesignText {
    /// The command line, but for the table's name.
    pub(super) fn says(&self) -> String {
        let table = self.table.as_ref().map(|table| {
            let rows = table.lines().filter(|line| !line.trim().is_empty()).count().saturating_sub(1);
            format!("--design with {rows} rows")
        });
        let words: Vec<String> =
            table.into_iter().chain(self.vary.iter().map(|typed| format!("--vary {typed}"))).collect();
        if words.is_empty() { "nothing varied".to_owned() } else { shorten(&words.join(" ")) }
    }
}

/// Every combination of what is varied. The table comes first; what is varied last changes fastest.
#[derive(Debug, Clone, Default)]
pub struct Design {
    text: DesignText,
    axes: Vec<Axis>,
}

impl Design {
    /// Reads what was written. `label` is what messages call the table.
    ///
    /// # Errors
    /// No list, no range, no table; values that are too long.
    pub fn parse(text: &DesignText, label: &str) -> Result<Self, DesignError> {
        let table = text.table.iter().map(|table| Axis::table(table, label));
        let vary = text.vary.iter().map(|typed| Axis::vary(typed));
        let axes: Vec<Axis> = table.chain(vary).collect::<Result<_, _>>()?;
        let bytes = axes.iter().map(Axis::longest).sum();
        if bytes > VARIANT_MAX_BYTES {
            return Err(DesignError::TooLong { bytes });
        }
        Ok(Self { text: text.clone(), axes })
    }

    /// As it was written.
    pub fn text(&self) -> &DesignText {
        &self.text
    }

    /// Names of what is varied.
    pub fn keys(&self) -> impl Iterator<Item = &str> {
        self.axes.iter().flat_map(|axis| &axis.keys).map(|key| key.name.as_str())
    }

    /// Number of variants; more than can be counted is the most that can.
    pub fn variants(&self) -> u128 {
        self.axes.iter().fold(1, |all: u128, axis| all.saturating_mul(u128::from(axis.len())))
    }

    /// How many of each: `1000 × 20`.
    pub(super) fn product(&self) -> String {
        let counts: Vec<String> = self.axes.iter().map(|axis| axis.len().to_string()).collect();
        if counts.is_empty() { "1".to_owned() } else { counts.join(" × ") }
    }

    /// The values of a variant, in the order of [`Design::keys`]; `None` leaves the scenario's own.
    pub fn values(&self, variant: u64) -> Vec<Option<Cow<'_, str>>> {
        self.places(variant)
            .flat_map(|(axis, index)| (0..axis.keys.len()).map(move |key| axis.value(index, key)))
            .collect()
    }

    /// `key=value` for everything a variant writes over its scenario.
    pub fn assignments(&self, variant: u64) -> Vec<String> {
        let pairs = self.keys().zip(self.values(variant));
        pairs.filter_map(|(key, value)| Some(format!("{key}={}", value?))).collect()
    }

    /// Says where a value of a variant was written, if that is what an error is about.
    pub(super) fn place(&self, variant: u64, mut error: ConfigError) -> ConfigError {
        for (axis, index) in self.places(variant) {
            for (key, name) in axis.keys.iter().enumerate() {
                let Some(value) = axis.value(index, key) else { continue };
                let assignment = format!("{}={value}", name.name);
                // A key that nobody knows is wrong where it is written, not where its values are.
                let is_key = match &error {
                    ConfigError::UnknownKey { key, .. } => *key == name.name,
                    ConfigError::Set { .. } => true,
                    _ => false,
                };
                let head = axis.head().filter(|_| is_key);
                error =
                    error.written_at(&assignment, head.unwrap_or_else(|| axis.origin(index, &assignment)));
            }
        }
        error
    }

    /// Every axis, and the place of a variant on it.
    fn places(&self, variant: u64) -> impl Iterator<Item = (&Axis, u64)> {
        let mut rest = variant;
        let mut places: Vec<(&Axis, u64)> = Vec::with_capacity(self.axes.len());
        for axis in self.axes.iter().rev() {
            places.push((axis, rest % axis.len()));
            rest /= axis.len();
        }
        places.into_iter().rev()
    }
}

/// The scenario with a variant's values.
pub(super) fn combined(design: &Design, sets: &[String], variant: u64) -> Vec<String> {
    sets.iter().cloned().chain(design.assignments(variant)).collect()
}

#[cfg(test)]
mod tests;
