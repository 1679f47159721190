//! Which variants are flown: every combination of what is varied.

use std::{borrow::Cow, fs::File, io::Read as _, path::Path};

use serde::{Deserialize, Serialize};

use super::axis::{Axis, TABLE_MAX_BYTES, ValueKind};
use crate::config::{ConfigError, Origin, shorten};

/// Most runs of a sweep.
pub const RUNS_MAX: u64 = 10_000_000;

/// Why there is no such sweep. Nothing has been flown.
#[derive(Debug, thiserror::Error)]
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
    #[error("{key} is written twice: by {first} and by {second}; expected one of them")]
    Twice {
        /// The key.
        key: String,
        /// One place.
        first: &'static str,
        /// The other one.
        second: &'static str,
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
    /// One key each: `radio.sigma_db=1,3,5` or `chain.tolerance_db=0..5/6`.
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
    /// No list, no range, no table; a key that is written twice.
    pub fn parse(text: &DesignText, label: &str) -> Result<Self, DesignError> {
        let table = text.table.iter().map(|table| Axis::table(table, label));
        let vary = text.vary.iter().map(|typed| Axis::vary(typed));
        let axes: Vec<Axis> = table.chain(vary).collect::<Result<_, _>>()?;
        let mut known: Vec<(&String, &'static str)> = Vec::new();
        for (i, axis) in axes.iter().enumerate() {
            let place = if i == 0 && text.table.is_some() { "--design" } else { "--vary" };
            for key in &axis.keys {
                if let Some((_, first)) = known.iter().find(|(other, _)| *other == key) {
                    return Err(DesignError::Twice { key: key.clone(), first, second: place });
                }
                known.push((key, place));
            }
        }
        Ok(Self { text: text.clone(), axes })
    }

    /// As it was written.
    pub fn text(&self) -> &DesignText {
        &self.text
    }

    /// Names of what is varied.
    pub fn keys(&self) -> impl Iterator<Item = &str> {
        self.axes.iter().flat_map(|axis| &axis.keys).map(String::as_str)
    }

    /// What the values of every key are, in the same order.
    pub(super) fn kinds(&self) -> Vec<ValueKind> {
        let kinds = |axis: &Axis| (0..axis.keys.len()).map(|key| axis.kind(key)).collect::<Vec<_>>();
        self.axes.iter().flat_map(kinds).collect()
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
                let assignment = format!("{name}={value}");
                error = error.written_at(&assignment, axis.origin(index, &assignment));
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

/// A key that is both set and varied has two values.
pub(super) fn set_and_varied(design: &Design, sets: &[String]) -> Result<(), DesignError> {
    let set = |key: &str| sets.iter().any(|set| set.split('=').next().is_some_and(|name| name.trim() == key));
    match design.keys().find(|key| set(key)) {
        Some(key) => Err(DesignError::Twice { key: key.to_owned(), first: "--set", second: "the design" }),
        None => Ok(()),
    }
}

/// The scenario with a variant's values.
pub(super) fn combined(design: &Design, sets: &[String], variant: u64) -> Vec<String> {
    sets.iter().cloned().chain(design.assignments(variant)).collect()
}
