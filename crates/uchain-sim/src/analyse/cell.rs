//! What a table is made of: columns and cells.

use serde::{Deserialize, Serialize};

/// What the cells of a column are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A whole number.
    Count,
    /// A number, 64 bits.
    Number,
    /// A number, 32 bits.
    Single,
    /// Words.
    Text,
    /// A list of numbers, 64 bits.
    Numbers,
    /// A list of numbers, 32 bits.
    Singles,
}

/// A column of the table.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Column {
    /// Its name: a key of the scenario, or a number of the summary.
    pub name: String,
    /// What its cells are.
    pub kind: Kind,
    /// Whether it is something a run came to.
    pub is_result: bool,
}

/// A number of a summary that stands in the table: its name, what it is, and where it is found.
pub type Field<S> = (&'static str, Kind, fn(&S) -> Cell);

/// One cell. Numbers are finite; what is not is absent.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
#[non_exhaustive]
pub enum Cell {
    /// Nothing.
    Absent,
    /// A whole number.
    Count(i64),
    /// A number; one of 32 bits as its exact value in 64.
    Number(f64),
    /// Words.
    Text(String),
    /// A list of numbers; one that is not finite is absent.
    Numbers(Vec<Option<f64>>),
}

impl Cell {
    /// A list of numbers.
    pub fn list<T: Into<Self>>(numbers: impl IntoIterator<Item = T>) -> Self {
        Self::Numbers(numbers.into_iter().map(|number| number.into().number()).collect())
    }

    /// A choice by the name it has in files.
    #[cfg(feature = "sweep")]
    pub fn word(choice: &impl Serialize) -> Self {
        match serde_json::to_value(choice) {
            Ok(serde_json::Value::String(word)) => Self::Text(word),
            _ => Self::Absent,
        }
    }

    /// The number in it, if there is one.
    pub fn number(&self) -> Option<f64> {
        match self {
            Self::Count(count) => Some(*count as f64),
            Self::Number(number) => Some(*number),
            _ => None,
        }
    }

    /// The words in it, if there are any.
    pub fn text(&self) -> Option<&str> {
        if let Self::Text(text) = self { Some(text) } else { None }
    }
}

impl From<f64> for Cell {
    fn from(number: f64) -> Self {
        if number.is_finite() { Self::Number(number) } else { Self::Absent }
    }
}

impl From<f32> for Cell {
    fn from(number: f32) -> Self {
        f64::from(number).into()
    }
}

impl From<u32> for Cell {
    fn from(count: u32) -> Self {
        Self::Count(count.into())
    }
}

impl From<u64> for Cell {
    fn from(count: u64) -> Self {
        // Nothing here counts that far.
        Self::Count(i64::try_from(count).unwrap_or(i64::MAX))
    }
}

impl From<usize> for Cell {
    fn from(count: usize) -> Self {
        (count as u64).into()
    }
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl<T: Into<Self>> From<Option<T>> for Cell {
    fn from(value: Option<T>) -> Self {
        value.map_or(Self::Absent, Into::into)
    }
}
