//! Rows of a log, one after the other: each cell is a number of its column, or what is wrong is said at its place.

use std::{borrow::Cow, fs::File, io::Read as _, path::Path};

use uchain_core::chain::{Follow, Packet, Tof};

use super::{
    LogError,
    cells::Cells,
    columns::{Header, header},
};
use crate::config::shorten;

/// Longest log (bytes).
pub const LOG_MAX_BYTES: u64 = 64 << 20;
/// Longest time that a log covers (s).
const SPAN_MAX_S: f64 = 86_400.0;
/// Farthest that two rows lie apart (s).
const APART_MAX_S: f64 = 30.0;

/// What a drone saw at one moment.
#[derive(Debug, Clone, Default)]
pub(super) struct Row {
    pub(super) line: u64,
    pub(super) time_s: f64,
    pub(super) place: Option<u16>,
    pub(super) tof: Option<Tof>,
    pub(super) ground_speed_mps: Option<f32>,
    pub(super) battery: Option<f32>,
    pub(super) pilot_mps: Option<f32>,
    pub(super) pilot_follow: Option<Follow>,
    pub(super) back: Option<Word>,
    pub(super) front: Option<Word>,
    /// What the drone asked for itself: forward, lateral (m/s), yaw rate (rad/s).
    pub(super) asked: [Option<f32>; 3],
}

/// A packet from a neighbour.
#[derive(Debug, Clone, Copy)]
pub(super) struct Word {
    pub(super) loss_db: f32,
    pub(super) packet: Packet,
    /// It did not say for how long it has flown.
    pub(super) is_of_age: bool,
}

/// The text of a log.
///
/// # Errors
/// A file that cannot be read, is longer than [`LOG_MAX_BYTES`], or is not text.
pub(super) fn text(path: &Path) -> Result<String, LogError> {
    let label = path.display().to_string();
    let mut bytes = Vec::new();
    let read = File::open(path).and_then(|file| file.take(LOG_MAX_BYTES + 1).read_to_end(&mut bytes));
    if let Err(cause) = read {
        return Err(LogError::Read { label, cause });
    }
    if bytes.len() as u64 > LOG_MAX_BYTES {
        let why = format!("longer than {LOG_MAX_BYTES} bytes: cut the log into parts");
        return Err(LogError::Whole { label, why });
    }
    String::from_utf8(bytes).map_err(|error| LogError::Whole {
        label,
        why: format!(
            "not UTF-8 text from byte {} on: expected a table in CSV (uchain node --template prints one)",
            error.utf8_error().valid_up_to()
        ),
    })
}

/// A log whose lines end in one way, however they did, and which begins with its first column.
pub(super) fn plain(text: &str) -> Cow<'_, str> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    if text.contains('\r') { text.replace("\r\n", "\n").replace('\r', "\n").into() } else { text.into() }
}

/// Reads rows.
pub(super) struct Rows<'t> {
    label: &'t str,
    text: &'t str,
    reader: csv::Reader<&'t [u8]>,
    record: csv::StringRecord,
    /// The line that it stands in.
    line: u64,
    pub(super) header: Header,
    /// Line and time of the first row, and of the one before.
    first_s: Option<f64>,
    before: Option<(u64, f64)>,
    /// Cells with no number in them: column, line of the first, how many.
    pub(super) no_numbers: Vec<(&'static str, u64, u64)>,
}

impl<'t> Rows<'t> {
    /// Reads the names of the columns.
    pub(super) fn start(text: &'t str, label: &'t str) -> Result<Self, LogError> {
        let reader =
            csv::ReaderBuilder::new().trim(csv::Trim::All).has_headers(false).from_reader(text.as_bytes());
        let mut rows = Self {
            label,
            text,
            reader,
            record: csv::StringRecord::new(),
            line: 1,
            header: Header::new(),
            first_s: None,
            before: None,
            no_numbers: Vec::new(),
        };
        if !rows.advance()? {
            let why = "empty: expected a table in CSV (uchain node --template prints one)".to_owned();
            return Err(LogError::Whole { label: label.to_owned(), why });
        }
        rows.header = header(&rows.record).map_err(|why| rows.line_error(why))?;
        Ok(rows)
    }

    fn advance(&mut self) -> Result<bool, LogError> {
        // The reader passes over empty lines and does not tell.
        let place = self.reader.position();
        let rest = usize::try_from(place.byte()).ok().and_then(|byte| self.text.get(byte..)).unwrap_or("");
        self.line = place.line() + rest.bytes().take_while(|byte| *byte == b'\n').count() as u64;
        match self.reader.read_record(&mut self.record) {
            Ok(is_there) => Ok(is_there),
            Err(error) => Err(self.line_error(match error.kind() {
                csv::ErrorKind::UnequalLengths { expected_len, len, .. } => {
                    format!("{len} cells: expected {expected_len}, as many as there are columns")
                }
                _ => "not a line of CSV".to_owned(),
            })),
        }
    }

    fn line_error(&self, why: String) -> LogError {
        LogError::Line { label: self.label.to_owned(), line: self.line, why }
    }

    /// The next row.
    pub(super) fn next(&mut self) -> Result<Option<Row>, LogError> {
        if !self.advance()? {
            return Ok(None);
        }
        let mut cells = Cells::default();
        let mut row = Row { line: self.line, ..Row::default() };
        for place in 0..self.header.len() {
            let Some(column) = self.header[place] else { continue };
            let Some(cell) = self.record.get(place).filter(|cell| !cell.is_empty()) else { continue };
            let read = cells.take(&mut row, column, cell).map_err(|expected| LogError::Cell {
                label: self.label.to_owned(),
                line: row.line,
                column: column.name,
                got: shorten(cell),
                expected,
            })?;
            if !read {
                match self.no_numbers.iter_mut().find(|(name, ..)| *name == column.name) {
                    Some((.., count)) => *count += 1,
                    None => self.no_numbers.push((column.name, row.line, 1)),
                }
            }
        }
        if !cells.has_time {
            return Err(self.line_error("no time_s: expected one in every row".to_owned()));
        }
        self.in_order(&row)?;
        cells.end(&mut row);
        Ok(Some(row))
    }

    /// Checks a row's time by that of the row before, and of the first.
    fn in_order(&mut self, row: &Row) -> Result<(), LogError> {
        let first_s = *self.first_s.get_or_insert(row.time_s);
        let wrong = |expected: String| LogError::Cell {
            label: self.label.to_owned(),
            line: row.line,
            column: "time_s",
            got: row.time_s.to_string(),
            expected,
        };
        if let Some((line, before_s)) = self.before {
            if row.time_s <= before_s {
                return Err(wrong(format!(
                    "not later than {before_s} in line {line}: sort the rows by time"
                )));
            }
            let apart_s = row.time_s - before_s;
            if apart_s > APART_MAX_S {
                return Err(wrong(format!(
                    "{apart_s:.1} s after line {line}, expected at most {APART_MAX_S} s: is it in milliseconds? or cut the \
                     log there, and replay its parts (--airborne)"
                )));
            }
        }
        if row.time_s - first_s > SPAN_MAX_S {
            return Err(wrong(format!(
                "more than {SPAN_MAX_S} s after the first row: cut the log into parts"
            )));
        }
        self.before = Some((row.line, row.time_s));
        Ok(())
    }
}
