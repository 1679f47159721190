//! A table of variants in CSV, as numpy, pandas, polars, R and spreadsheets write it: keys in the first line, a variant in
//! every other one. What is clear is read; what is not is refused at its line for what it is.

use std::ops::ControlFlow;

use super::DesignError;
use crate::config::{Origin, plain_key, shorten};

/// Longest table (bytes).
pub const TABLE_MAX_BYTES: u64 = 16 << 20;
/// Most columns.
const COLUMNS_MAX: usize = 64;
/// How programs write that a value is missing.
const MISSING: [&str; 11] = ["nan", "NaN", "NAN", "NA", "N/A", "#N/A", "<NA>", "NaT", "None", "null", "NULL"];

/// A table that was read.
#[derive(Debug, Clone)]
pub(super) struct Table {
    pub(super) label: String,
    /// The line of the keys, from 1.
    pub(super) head: u64,
    /// Keys as they are spelled there.
    pub(super) keys: Vec<String>,
    /// A variant each, with its line. An empty cell leaves the scenario's own value.
    pub(super) rows: Vec<(u64, csv::StringRecord)>,
}

/// Reads lines of CSV, and knows which they are.
struct Lines<'t> {
    text: &'t str,
    reader: csv::Reader<&'t [u8]>,
}

impl Table {
    pub(super) fn read(text: &str, label: &str) -> Result<Self, DesignError> {
        // However lines end, here they end in one way.
        let text = text.strip_prefix('\u{feff}').unwrap_or(text).replace("\r\n", "\n").replace('\r', "\n");
        let wrong = |line: u64, why: String| {
            let at = Origin::Line { label: label.to_owned(), line: line as usize };
            DesignError::Table { at, why }
        };
        let mut lines = Lines::of(&text);
        let (_, head, first) = lines.next().map_err(|(line, why)| wrong(line, why))?;
        let keys = keys(&first.unwrap_or_default()).map_err(|why| wrong(head, why))?;
        // The reader passes over empty lines: in a table of one column each is a row whose cell is empty.
        let is_single = keys.len() == 1;
        let mut rows = Vec::new();
        loop {
            let (passed, line, row) = lines.next().map_err(|(line, why)| wrong(line, why))?;
            let empty = (line - passed..line).filter(|_| is_single);
            rows.extend(empty.map(|line| (line, csv::StringRecord::from(vec![""]))));
            let Some(row) = row else { break };
            for (key, cell) in keys.iter().zip(&row) {
                if MISSING.contains(&cell) {
                    let why = format!(
                        "{key} = {cell}: no value; expected one, or an empty cell, which leaves the scenario's own"
                    );
                    return Err(wrong(line, why));
                }
            }
            rows.push((line, row));
        }
        if rows.is_empty() {
            return Err(wrong(head, "no rows below the keys; expected one for every variant".to_owned()));
        }
        Ok(Self { label: label.to_owned(), head, keys, rows })
    }
}

impl<'t> Lines<'t> {
    fn of(text: &'t str) -> Self {
        let reader =
            csv::ReaderBuilder::new().trim(csv::Trim::All).has_headers(false).from_reader(text.as_bytes());
        Self { text, reader }
    }

    /// The next line that is not empty: how many empty ones the reader passed over, its number, its cells if there is one.
    /// Or what is wrong with it, and where.
    fn next(&mut self) -> Result<(u64, u64, Option<csv::StringRecord>), (u64, String)> {
        let place = self.reader.position();
        let rest = usize::try_from(place.byte()).ok().and_then(|byte| self.text.get(byte..)).unwrap_or("");
        let passed = rest.bytes().take_while(|byte| *byte == b'\n').count() as u64;
        let line = place.line() + passed;
        let mut row = csv::StringRecord::new();
        match self.reader.read_record(&mut row) {
            Ok(is_there) => Ok((passed, line, is_there.then_some(row))),
            Err(error) => match error.kind() {
                csv::ErrorKind::UnequalLengths { expected_len, len, .. } => {
                    Err((line, format!("{len} cells, expected {expected_len} as in the line of the keys")))
                }
                _ => Err((line, "not a line of CSV".to_owned())),
            },
        }
    }
}

/// The keys in the first line, or what it is instead.
fn keys(line: &csv::StringRecord) -> Result<Vec<String>, String> {
    const EXPECTED: &str = "expected keys such as radio.sigma_db,chain.uavs in the first line";
    let mut cells: Vec<&str> = line.iter().collect();
    // numpy.savetxt writes a comment's sign before its header.
    let first = cells.first().copied().unwrap_or_default();
    let is_comment = first.starts_with('#');
    if let (true, Some(cell)) = (is_comment, cells.first_mut()) {
        *cell = first.trim_start_matches('#').trim();
    }
    if let ControlFlow::Break(what) = other_separator(&cells, is_comment) {
        return Err(format!("columns are separated by {what}, expected commas: {EXPECTED}"));
    }
    if is_comment && !cells.iter().all(|cell| is_key(cell)) {
        return Err(format!("a comment; {EXPECTED}"));
    }
    if cells.is_empty() || cells.len() > COLUMNS_MAX {
        return Err(format!(
            "{} columns: expected 1 to {COLUMNS_MAX} keys, such as radio.sigma_db,chain.uavs",
            cells.len()
        ));
    }
    if cells.iter().all(|cell| cell.parse::<f64>().is_ok()) {
        return Err(format!("values without keys above them; {EXPECTED}"));
    }
    for (place, cell) in cells.iter().enumerate() {
        let number = place + 1;
        let is_unnamed = cell.is_empty() || cell.starts_with("Unnamed: ");
        if is_unnamed && place == 0 {
            return Err(format!(
                "column 1 has no name, as the index of a data frame: leave it out (pandas: to_csv(…, index=False)); {EXPECTED}"
            ));
        }
        if is_unnamed && number == cells.len() {
            return Err(format!(
                "column {number} has no name: is there a comma too many at the end of the line? {EXPECTED}"
            ));
        }
        if is_unnamed || !is_key(cell) {
            return Err(format!("column {number} is called '{}'; {EXPECTED}", shorten(cell)));
        }
    }
    Ok(cells.into_iter().map(str::to_owned).collect())
}

/// Whether words may be a key.
fn is_key(words: &str) -> bool {
    let may_be =
        |step: &str| !step.is_empty() && step.chars().all(|c| c.is_alphanumeric() || matches!(c, '_' | '-'));
    plain_key(words).split('.').all(may_be)
}

/// What stands between keys instead of commas, if it is that.
fn other_separator(cells: &[&str], is_comment: bool) -> ControlFlow<&'static str> {
    let [only] = cells else { return ControlFlow::Continue(()) };
    for (separator, name) in [('\t', "tabs"), (';', "semicolons"), ('|', "bars"), (' ', "spaces")] {
        let parts: Vec<&str> = only.split(separator).map(str::trim).filter(|part| !part.is_empty()).collect();
        // Words of a comment are no keys of tables.
        let are_words = is_comment && separator == ' ' && !parts.iter().any(|part| part.contains('.'));
        if parts.len() > 1 && !is_key(only) && !are_words && parts.iter().all(|part| is_key(part)) {
            return ControlFlow::Break(name);
        }
    }
    ControlFlow::Continue(())
}
