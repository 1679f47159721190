//! What is varied, as Python writes it, in the words of the command line: `vary` as `key=1,2,3`, a design as CSV. What they
//! mean is the engine's business alone.

use std::path::PathBuf;

use pyo3::{
    exceptions::{PyTypeError, PyValueError},
    prelude::*,
    types::{PyDict, PyString},
};
use uchain_sim::sweep::{DesignText, TABLE_MAX_BYTES};

use super::arrow;
use crate::{errors, run::shown, value::toml_text};

/// What messages call a table that is in no file.
const LABEL: &str = "design";

/// A design and what messages call its table.
pub(super) fn read(
    vary: Option<&Bound<'_, PyAny>>,
    design: Option<&Bound<'_, PyAny>>,
) -> PyResult<(DesignText, String)> {
    let vary = vary.map(varied).transpose()?.unwrap_or_default();
    let Some(design) = design else { return Ok((DesignText { vary, table: None }, String::new())) };
    if design.is_instance_of::<PyString>() || design.hasattr("__fspath__")? {
        let path: PathBuf = design.extract()?;
        let text = DesignText::read(vary, Some(&path)).map_err(|error| errors::sweep(error.into()))?;
        return Ok((text, path.display().to_string()));
    }
    let table = table(design)?.csv()?;
    Ok((DesignText { vary, table: Some(table) }, LABEL.to_owned()))
}

/// `key=1,2,3` for every key.
fn varied(vary: &Bound<'_, PyAny>) -> PyResult<Vec<String>> {
    let Ok(vary) = vary.cast::<PyDict>() else {
        let got = shown(vary);
        let expected = "expected a dict of keys and their values, such as {\"radio.sigma_db\": [1, 3, 5]}";
        return Err(PyTypeError::new_err(format!("vary = {got}: {expected}")));
    };
    let mut all = Vec::new();
    for (key, values) in vary {
        let key = name(&key, "vary")?;
        // The command line's own words: a range with both ends, or a list.
        if let Ok(text) = values.cast::<PyString>() {
            all.push(format!("{key}={}", text.to_cow()?));
            continue;
        }
        let mut list = format!("{key}=");
        let before = list.len();
        for value in column(&key, &values, "vary")? {
            if list.len() > before {
                list.push(',');
            }
            list.push_str(&plain(&toml_text(&key, &value?)?));
            bounded(&list, "vary")?;
        }
        if list.len() == before {
            return Err(PyValueError::new_err(format!("vary: {key} has no values; expected at least one")));
        }
        all.push(list);
    }
    Ok(all)
}

/// A key, as far as that can be told without the scenario.
fn name(key: &Bound<'_, PyAny>, of: &str) -> PyResult<String> {
    let text: Option<String> = key.extract().ok();
    text.filter(|text| !text.trim().is_empty() && !text.contains(['=', '\n', '\r'])).ok_or_else(|| {
        let got = shown(key);
        PyTypeError::new_err(format!("{of}: {got} is no key; expected a str such as \"radio.sigma_db\""))
    })
}

/// The values under a key, one by one.
fn column<'py>(
    key: &str,
    values: &Bound<'py, PyAny>,
    of: &str,
) -> PyResult<Bound<'py, pyo3::types::PyIterator>> {
    let is_text = values.is_instance_of::<PyString>();
    let items = if is_text { None } else { values.try_iter().ok() };
    items.ok_or_else(|| {
        let got = shown(values);
        PyTypeError::new_err(format!("{of}: {key} = {got}: expected a list of values, such as [{got}]"))
    })
}

/// Texts that grow are bounded as the engine bounds a file.
fn bounded(text: &str, of: &str) -> PyResult<()> {
    if text.len() as u64 > TABLE_MAX_BYTES {
        return Err(PyValueError::new_err(format!("{of}: longer than {TABLE_MAX_BYTES} bytes of text")));
    }
    Ok(())
}

/// A value without quotes where the command line needs none: what is typed there most often is the same text then, and
/// the sweeps are the same. Words that mean something else without quotes keep them.
pub(super) fn plain(value: &str) -> String {
    const MEANING: [&str; 8] = ["true", "false", "inf", "nan", "null", "none", "na", "nat"];
    let inner = value.strip_prefix('"').and_then(|rest| rest.strip_suffix('"')).unwrap_or("");
    let is_word = inner.starts_with(|c: char| c.is_ascii_alphabetic())
        && inner.chars().all(|c| c.is_ascii_alphanumeric() || matches!(c, '_' | '-'))
        && !MEANING.contains(&inner.to_ascii_lowercase().as_str());
    if is_word { inner.to_owned() } else { value.to_owned() }
}

/// Columns of texts, each a key; an empty text leaves the scenario's own value.
#[derive(Default)]
pub(super) struct Texts {
    pub(super) keys: Vec<String>,
    pub(super) columns: Vec<Vec<String>>,
    bytes: u64,
}

impl Texts {
    pub(super) fn push(&mut self, column: usize, text: String) -> PyResult<()> {
        self.bytes += text.len() as u64 + 1;
        if self.bytes > TABLE_MAX_BYTES {
            let most = TABLE_MAX_BYTES;
            return Err(PyValueError::new_err(format!("{LABEL}: longer than {most} bytes of text")));
        }
        if let Some(column) = self.columns.get_mut(column) {
            column.push(text);
        }
        Ok(())
    }

    fn csv(&self) -> PyResult<String> {
        let rows = self.columns.first().map_or(0, Vec::len);
        for (key, column) in self.keys.iter().zip(&self.columns) {
            if column.len() != rows {
                let first = self.keys.first().map_or("", String::as_str);
                return Err(PyValueError::new_err(format!(
                    "{LABEL}: {key} has {} values, {first} has {rows}; expected as many in every column",
                    column.len()
                )));
            }
        }
        let is_single = self.keys.len() == 1;
        let cell = |text: &str| {
            // An empty line would be no row.
            if text.contains([',', '"', '\n', '\r']) || (is_single && text.is_empty()) {
                format!("\"{}\"", text.replace('"', "\"\""))
            } else {
                text.to_owned()
            }
        };
        let line = |cells: Vec<String>| cells.join(",") + "\n";
        let mut text = line(self.keys.iter().map(|key| cell(key)).collect());
        for row in 0..rows {
            let cells = self.columns.iter().map(|column| cell(column.get(row).map_or("", String::as_str)));
            text.push_str(&line(cells.collect()));
        }
        Ok(text)
    }
}

/// A cell of a design: `None` leaves the scenario's own value.
fn text(key: &str, value: &Bound<'_, PyAny>) -> PyResult<String> {
    if value.is_none() { Ok(String::new()) } else { Ok(plain(&toml_text(key, value)?)) }
}

/// A table of Python's, whatever kind it is of.
fn table(design: &Bound<'_, PyAny>) -> PyResult<Texts> {
    if design.hasattr("keys")? && design.hasattr("__getitem__")? {
        return columns(design);
    }
    if design.hasattr("__arrow_c_stream__")? {
        return arrow::texts(design);
    }
    rows(design)
}

/// Columns by their names: a dict, a data frame of pandas.
fn columns(design: &Bound<'_, PyAny>) -> PyResult<Texts> {
    let mut texts = Texts::default();
    for key in design.call_method0("keys")?.try_iter()? {
        let key = key?;
        let values = design.get_item(&key)?;
        let key = name(&key, LABEL)?;
        texts.columns.push(Vec::new());
        let place = texts.columns.len() - 1;
        for value in column(&key, &values, LABEL)? {
            texts.push(place, text(&key, &value?)?)?;
        }
        texts.keys.push(key);
    }
    Ok(texts)
}

/// Rows, each a dict; one that lacks a key leaves the scenario's own value.
fn rows(design: &Bound<'_, PyAny>) -> PyResult<Texts> {
    let wrong = |got: &Bound<'_, PyAny>| {
        let got = shown(got);
        PyTypeError::new_err(format!(
            "{LABEL}: {got}: expected the path of a CSV file, a dict of columns, a list of dicts, or a data frame"
        ))
    };
    let mut texts = Texts::default();
    for (count, row) in design.try_iter().map_err(|_| wrong(design))?.enumerate() {
        let row = row?;
        let row = row.cast::<PyDict>().map_err(|_| wrong(&row))?;
        for (key, value) in row {
            let key = name(&key, LABEL)?;
            let known = texts.keys.iter().position(|known| *known == key);
            let place = known.unwrap_or(texts.keys.len());
            if known.is_none() {
                // Rows before it had nothing there.
                texts.keys.push(key.clone());
                texts.columns.push(Vec::new());
                for _ in 0..count {
                    texts.push(place, String::new())?;
                }
            }
            texts.push(place, text(&key, &value)?)?;
        }
        for place in 0..texts.keys.len() {
            if texts.columns.get(place).is_some_and(|column| column.len() <= count) {
                texts.push(place, String::new())?;
            }
        }
    }
    Ok(texts)
}
