//! What is varied: one key over values of its own, or several keys together, row by row of a table.

use std::borrow::Cow;

use super::DesignError;
use crate::config::{Origin, shorten};

/// Longest table (bytes).
pub const TABLE_MAX_BYTES: u64 = 16 << 20;
/// Most columns of a table.
const COLUMNS_MAX: usize = 64;

/// Keys that change together.
#[derive(Debug, Clone)]
pub(super) struct Axis {
    pub(super) keys: Vec<String>,
    values: Values,
}

#[derive(Debug, Clone)]
enum Values {
    List(Vec<String>),
    /// Evenly spaced, both ends included; never written out.
    Steps {
        low: f64,
        high: f64,
        count: u64,
    },
    Table {
        label: String,
        /// Each with its line.
        rows: Vec<(u64, csv::StringRecord)>,
    },
}

/// What all values of a key are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ValueKind {
    Whole,
    Number,
    Text,
}

impl Axis {
    /// `key=1,3,5` or `key=0..5/6`, as it stands behind `--vary`.
    pub(super) fn vary(typed: &str) -> Result<Self, DesignError> {
        let wrong = |why: &str| DesignError::Vary { typed: shorten(typed), why: why.to_owned() };
        let Some((key, text)) = typed.split_once('=').filter(|(key, _)| !key.trim().is_empty()) else {
            return Err(wrong("expected key=values, such as radio.sigma_db=1,3,5"));
        };
        let values = if let Some(steps) = steps(text) {
            steps.map_err(|why| wrong(&why))?
        } else {
            let list = split(text);
            if list.iter().any(String::is_empty) {
                return Err(wrong("a value is empty; expected key=values, such as radio.sigma_db=1,3,5"));
            }
            Values::List(list)
        };
        Ok(Self { keys: vec![key.trim().to_owned()], values })
    }

    /// A table in CSV: the first line holds keys, every other one the values of a variant. An empty cell leaves the
    /// scenario's own value.
    pub(super) fn table(text: &str, label: &str) -> Result<Self, DesignError> {
        let at = |line: u64| Origin::Line { label: label.to_owned(), line: line as usize };
        let wrong = |line: u64, why: String| DesignError::Table { at: at(line), why };
        let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text.as_bytes());
        // The reader's own count stands before the empty lines that it skips.
        let line_of = |place: Option<&csv::Position>| {
            let Some(place) = place else { return 1 };
            let rest = usize::try_from(place.byte()).ok().and_then(|byte| text.get(byte..)).unwrap_or("");
            let empty = rest.bytes().take_while(|byte| matches!(byte, b'\n' | b'\r'));
            place.line() + empty.filter(|byte| *byte == b'\n').count() as u64
        };
        let refuse = |error: &csv::Error| {
            let line = line_of(error.position());
            let why = match error.kind() {
                csv::ErrorKind::UnequalLengths { expected_len, len, .. } => {
                    format!("{len} cells, expected {expected_len} as in the first line")
                }
                _ => "not a line of CSV".to_owned(),
            };
            wrong(line, why)
        };
        let keys: Vec<String> =
            reader.headers().map_err(|error| refuse(&error))?.iter().map(str::to_owned).collect();
        if keys.is_empty() || keys.len() > COLUMNS_MAX || keys.iter().any(String::is_empty) {
            let why = format!("expected 1 to {COLUMNS_MAX} keys, such as radio.sigma_db,chain.uavs");
            return Err(wrong(1, why));
        }
        let numbered = |row: csv::StringRecord| (line_of(row.position()), row);
        let rows: Result<Vec<_>, _> = reader.into_records().map(|row| row.map(numbered)).collect();
        let rows = rows.map_err(|error| refuse(&error))?;
        if rows.is_empty() {
            return Err(wrong(1, "no rows below the keys; expected one for every variant".to_owned()));
        }
        Ok(Self { keys, values: Values::Table { label: label.to_owned(), rows } })
    }

    /// How many values.
    pub(super) fn len(&self) -> u64 {
        match &self.values {
            Values::List(list) => list.len() as u64,
            Values::Steps { count, .. } => *count,
            Values::Table { rows, .. } => rows.len() as u64,
        }
    }

    /// The value of a key at a place of the axis; `None` where a table leaves the scenario's own.
    pub(super) fn value(&self, index: u64, key: usize) -> Option<Cow<'_, str>> {
        let row = usize::try_from(index).ok()?;
        match &self.values {
            Values::List(list) => list.get(row).map(|text| text.as_str().into()),
            Values::Steps { low, high, count } => {
                let last = count - 1;
                let value =
                    if index == last { *high } else { low + (high - low) * index as f64 / last as f64 };
                Some(value.to_string().into())
            }
            Values::Table { rows, .. } => {
                rows.get(row)?.1.get(key).filter(|text| !text.is_empty()).map(Into::into)
            }
        }
    }

    /// Where a value was written.
    pub(super) fn origin(&self, index: u64, assignment: &str) -> Origin {
        match &self.values {
            Values::Table { label, rows } => {
                let row = usize::try_from(index).ok().and_then(|row| rows.get(row));
                Origin::Line { label: label.clone(), line: row.map_or(1, |(line, _)| *line as usize) }
            }
            _ => Origin::Argument { typed: format!("--vary {}", shorten(assignment)) },
        }
    }

    /// What all values of a key are.
    pub(super) fn kind(&self, key: usize) -> ValueKind {
        let kind = |text: &str| match text.parse() {
            Ok(toml::Value::Integer(_)) => ValueKind::Whole,
            Ok(toml::Value::Float(number)) if number.is_finite() => ValueKind::Number,
            _ => ValueKind::Text,
        };
        let wider = |a, b| match (a, b) {
            (ValueKind::Text, _) | (_, ValueKind::Text) => ValueKind::Text,
            (ValueKind::Number, _) | (_, ValueKind::Number) => ValueKind::Number,
            _ => ValueKind::Whole,
        };
        match &self.values {
            Values::List(list) => list.iter().map(|text| kind(text)).fold(ValueKind::Whole, wider),
            // Every step of whole numbers between whole ends is one.
            Values::Steps { low, high, count } => {
                let step = (high - low) / (count - 1) as f64;
                let is_whole = low.fract() == 0.0 && step.fract() == 0.0;
                if is_whole && low.abs().max(high.abs()) < 1e15 {
                    ValueKind::Whole
                } else {
                    ValueKind::Number
                }
            }
            Values::Table { rows, .. } => {
                let cells = rows.iter().filter_map(|(_, row)| row.get(key)).filter(|text| !text.is_empty());
                cells.map(kind).fold(ValueKind::Whole, wider)
            }
        }
    }
}

/// `0..5/6`: six values from 0 to 5; `None` if it is no range at all.
fn steps(text: &str) -> Option<Result<Values, String>> {
    let (low, rest) = text.split_once("..")?;
    let low: f64 = low.trim().parse().ok()?;
    let read = || {
        let (high, count) = rest.split_once('/')?;
        let high: f64 = high.trim().parse().ok()?;
        let count: u64 = count.trim().parse().ok()?;
        let is_range = (high - low).is_finite() && high != low && count >= 2;
        is_range.then_some(Values::Steps { low, high, count })
    };
    let expected = "expected low..high/count, such as 0..5/6 for the six values 0, 1, 2, 3, 4, 5";
    Some(read().ok_or_else(|| expected.to_owned()))
}

/// Splits at the commas outside of brackets and quotes.
fn split(text: &str) -> Vec<String> {
    let mut parts = vec![String::new()];
    let (mut depth, mut quote) = (0_usize, None);
    for c in text.chars() {
        match (quote, c) {
            (Some(open), _) if c == open => quote = None,
            (None, '"' | '\'') => quote = Some(c),
            (None, '[' | '{') => depth += 1,
            (None, ']' | '}') => depth = depth.saturating_sub(1),
            _ => {}
        }
        match parts.last_mut() {
            Some(part) if !(c == ',' && depth == 0 && quote.is_none()) => part.push(c),
            _ => parts.push(String::new()),
        }
    }
    parts.iter().map(|part| part.trim().to_owned()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(typed: &str) -> Vec<String> {
        let axis = Axis::vary(typed).unwrap();
        (0..axis.len()).map(|i| axis.value(i, 0).unwrap().into_owned()).collect()
    }

    #[test]
    fn a_list_splits_at_commas_outside_of_brackets_and_quotes() {
        assert_eq!(values("radio.sigma_db=1, 3,5"), ["1", "3", "5"]);
        assert_eq!(values("chain.base_m=[0,0],[1,0]"), ["[0,0]", "[1,0]"]);
        assert_eq!(values("map.ros.file='../a,b.yaml',../c.yaml"), ["'../a,b.yaml'", "../c.yaml"]);
    }

    #[test]
    fn a_range_holds_both_of_its_ends_and_whole_numbers_stay_whole() {
        assert_eq!(values("chain.tolerance_db=0..5/6"), ["0", "1", "2", "3", "4", "5"]);
        assert_eq!(values("radio.sigma_db=0.1..0.7/4")[3], "0.7");
        assert_eq!(Axis::vary("a=0..5/6").unwrap().kind(0), ValueKind::Whole);
        assert_eq!(Axis::vary("a=0..5/5").unwrap().kind(0), ValueKind::Number);
        assert_eq!(Axis::vary("a=1,2.5").unwrap().kind(0), ValueKind::Number);
        assert_eq!(Axis::vary("a=1,left").unwrap().kind(0), ValueKind::Text);
    }

    #[test]
    fn what_is_neither_list_nor_range_is_refused_with_an_example() {
        for typed in ["a", "=1", "a=", "a=1,,2", "a=0..5", "a=0..5/1", "a=0..0/3", "a=0..inf/3", "a=0..5/-1"]
        {
            let message = Axis::vary(typed).unwrap_err().to_string();
            assert!(message.contains("expected") && message.contains(typed), "{message}");
        }
    }

    #[test]
    fn a_table_gives_a_row_per_variant_and_says_which_line_is_wrong() {
        let axis = Axis::table("chain.uavs, pilot.0.follow\n3,left\n\n4,\n", "d.csv").unwrap();
        assert_eq!((axis.len(), axis.value(0, 1).as_deref(), axis.value(1, 1)), (2, Some("left"), None));
        assert_eq!(axis.origin(1, "").to_string(), "d.csv:4");
        for (text, place) in
            [("", "d.csv:1"), ("a,b\n", "d.csv:1"), ("a,,b\n1,2,3", "d.csv:1"), ("a,b\n1,2\n3\n", "d.csv:3")]
        {
            let message = Axis::table(text, "d.csv").unwrap_err().to_string();
            assert!(message.starts_with(place) && message.contains("expected"), "{message}");
        }
    }
}
