//! What is varied: one key over values of its own, or several keys together, row by row of a table.

use std::borrow::Cow;

use super::{DesignError, table::Table};
use crate::config::{Origin, plain_key, shorten};

/// Keys that change together.
#[derive(Debug, Clone)]
pub(super) struct Axis {
    pub(super) keys: Vec<Key>,
    values: Values,
}

/// A key that is varied.
#[derive(Debug, Clone)]
pub(super) struct Key {
    /// In the spelling that all others are measured by.
    pub(super) name: String,
    /// As it was typed.
    pub(super) typed: String,
}

impl Key {
    fn new(typed: &str) -> Self {
        Self { name: plain_key(typed), typed: typed.to_owned() }
    }
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
    Table(Table),
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
        Ok(Self { keys: vec![Key::new(key.trim())], values })
    }

    /// A table in CSV: the first line holds keys, every other one the values of a variant. An empty cell leaves the
    /// scenario's own value.
    pub(super) fn table(text: &str, label: &str) -> Result<Self, DesignError> {
        let table = Table::read(text, label)?;
        Ok(Self { keys: table.keys.iter().map(|key| Key::new(key)).collect(), values: Values::Table(table) })
    }

    /// How many values.
    pub(super) fn len(&self) -> u64 {
        match &self.values {
            Values::List(list) => list.len() as u64,
            Values::Steps { count, .. } => *count,
            Values::Table(table) => table.rows.len() as u64,
        }
    }

    /// The value of a key at a place of the axis; `None` where a table leaves the scenario's own.
    pub(super) fn value(&self, index: u64, key: usize) -> Option<Cow<'_, str>> {
        let row = usize::try_from(index).ok()?;
        match &self.values {
            Values::List(list) => list.get(row).map(|text| plain(text)),
            Values::Steps { low, high, count } => {
                let last = count - 1;
                let value =
                    if index == last { *high } else { low + (high - low) * index as f64 / last as f64 };
                Some(value.to_string().into())
            }
            Values::Table(table) => {
                table.rows.get(row)?.1.get(key).filter(|text| !text.is_empty()).map(plain)
            }
        }
    }

    /// Where a value was written.
    pub(super) fn origin(&self, index: u64, assignment: &str) -> Origin {
        match &self.values {
            Values::Table(Table { label, rows, .. }) => {
                let row = usize::try_from(index).ok().and_then(|row| rows.get(row));
                Origin::Line { label: label.clone(), line: row.map_or(1, |(line, _)| *line as usize) }
            }
            _ => Origin::Argument { typed: format!("--vary {}", shorten(assignment)) },
        }
    }

    /// Where the keys were written; `None` if each stands with its values.
    pub(super) fn head(&self) -> Option<Origin> {
        let Values::Table(Table { label, head, .. }) = &self.values else { return None };
        Some(Origin::Line { label: label.clone(), line: *head as usize })
    }

    /// Length of the longest place on the axis (bytes), keys left out.
    pub(super) fn longest(&self) -> usize {
        /// Digits of a number.
        const NUMBER: usize = 400;
        match &self.values {
            Values::List(list) => list.iter().map(String::len).max().unwrap_or(0),
            Values::Steps { .. } => NUMBER,
            Values::Table(table) => table.rows.iter().map(|(_, row)| row.as_slice().len()).max().unwrap_or(0),
        }
    }
}

/// A value as a scenario writes it. Programs that know one kind of number write whole ones as `2.0`, all of them with
/// twenty digits, and Python writes `True`. The number is the same, for keys of either kind.
fn plain(text: &str) -> Cow<'_, str> {
    /// Up to here every whole number is a float of its own.
    const EXACT: f64 = 9_007_199_254_740_992.0;
    match text {
        "True" | "TRUE" => "true".into(),
        "False" | "FALSE" => "false".into(),
        _ => match text.parse() {
            Ok(toml::Value::Float(number))
                if number.fract() == 0.0
                    && number.abs() < EXACT
                    && (number != 0.0 || number.is_sign_positive()) =>
            {
                (number as i64).to_string().into()
            }
            Ok(toml::Value::Float(number)) if number.is_finite() => format!("{number:?}").into(),
            _ => text.into(),
        },
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
        assert_eq!(values("equalize.tolerance_db=0..5/6"), ["0", "1", "2", "3", "4", "5"]);
        assert_eq!(values("radio.sigma_db=0.1..0.7/4")[3], "0.7");
    }

    #[test]
    fn whole_numbers_and_truths_are_read_as_python_writes_them() {
        assert_eq!(values("a=2.0,3.000000000000000000e+00,1e3,-4.,-0.0"), ["2", "3", "1000", "-4.", "-0.0"]);
        assert_eq!(values("a=True,False,TRUE,true"), ["true", "false", "true", "true"]);
        // What is no whole number, or more than a float can count, stays as it is.
        assert_eq!(values("a=2.5,1e16,\"2.0\",[2.0],inf"), ["2.5", "1e16", "\"2.0\"", "[2.0]", "inf"]);
    }

    #[test]
    fn what_is_neither_list_nor_range_is_refused_with_an_example() {
        for typed in ["a", "=1", "a=", "a=1,,2", "a=0..5", "a=0..5/1", "a=0..0/3", "a=0..inf/3", "a=0..5/-1"]
        {
            let message = Axis::vary(typed).unwrap_err().to_string();
            assert!(message.contains("expected") && message.contains(typed), "{message}");
        }
    }
}
