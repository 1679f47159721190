//! Reads logs: a table in CSV, a row for every packet, or for every moment with a column for every link.

mod anchors;
mod columns;
mod header;
mod mapping;
mod notes;
mod rows;
mod table;
#[cfg(test)]
mod tests;

use std::{fs::File, io::Read as _, path::Path};

use super::FitError;
use anchors::Anchors;

pub use columns::{about_columns, template};
pub use mapping::Mapping;

/// Longest log (bytes).
pub const LOG_MAX_BYTES: u64 = 64 << 20;
/// Most samples, packets that were not heard among them.
pub const SAMPLES_MAX: usize = 500_000;
/// Most links.
pub(super) const LINKS_MAX: usize = 1_000;

/// How a log is read.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ReadOptions {
    /// What its columns are called.
    pub mapping: Mapping,
    /// Power that packets are sent with (dBm), which turns a received power into a loss; 0 if nobody says.
    pub tx_dbm: Option<f64>,
    /// What stands in the log, as its column has it, for a packet that was not heard, beside an empty cell.
    pub lost: Option<f64>,
    /// The only link that is read.
    pub link: Option<String>,
}

/// A packet.
#[derive(Debug, Clone, PartialEq)]
pub struct Sample {
    /// The line that it stands in, from 1; that of the next heard one for a packet that a gap in `seq` tells of.
    pub line: usize,
    /// Which of [`Log::links`].
    pub link: usize,
    /// Loss (dB); `None` if it was not heard.
    pub loss_db: Option<f64>,
    /// Distance between the two ends (m).
    pub distance_m: f64,
    /// The two ends, x, y and z of each (m); the distance alone in the first number where nobody knows the places.
    pub ends_m: [f64; 6],
}

/// A log that was read.
#[derive(Debug, Clone, PartialEq)]
pub struct Log {
    /// What it is called in messages.
    pub label: String,
    /// Names of its links; one without a name if no column tells links apart.
    pub links: Vec<String>,
    /// In the order of the file.
    pub samples: Vec<Sample>,
    /// Whether places are known, not only distances.
    pub has_places: bool,
    /// What one should know of how it was read.
    pub notes: Vec<String>,
}

impl Log {
    /// Reads a file, and another one that says where anchors stand.
    ///
    /// # Errors
    /// [`FitError`], with file, line and column.
    pub fn read(path: &Path, anchors: Option<&Path>, options: &ReadOptions) -> Result<Self, FitError> {
        let anchors = match anchors {
            Some(path) => Some((text(path)?, path.display().to_string())),
            None => None,
        };
        let anchors = anchors.as_ref().map(|(text, label)| (text.as_str(), label.as_str()));
        Self::of(&text(path)?, &path.display().to_string(), anchors, options)
    }

    /// The same of texts, each with its label.
    ///
    /// # Errors
    /// Those of [`Self::read`].
    pub fn of(
        text: &str,
        label: &str,
        anchors: Option<(&str, &str)>,
        options: &ReadOptions,
    ) -> Result<Self, FitError> {
        let anchors = anchors.map(|(text, label)| Anchors::of(text, label)).transpose()?;
        rows::read(text, label, anchors.as_ref(), options)
    }

    /// How many packets were heard.
    pub fn heard(&self) -> usize {
        self.samples.iter().filter(|sample| sample.loss_db.is_some()).count()
    }
}

fn text(path: &Path) -> Result<String, FitError> {
    let label = path.display().to_string();
    let mut bytes = Vec::new();
    let read = File::open(path).and_then(|file| file.take(LOG_MAX_BYTES + 1).read_to_end(&mut bytes));
    if let Err(cause) = read {
        return Err(FitError::Read { label, cause });
    }
    if bytes.len() as u64 > LOG_MAX_BYTES {
        let why = format!("longer than {LOG_MAX_BYTES} bytes: cut it into parts");
        return Err(FitError::Whole { label, why });
    }
    String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        let why = format!(
            "not UTF-8 text from byte {at} on: expected a table in CSV (uchain radio fit --template prints one)"
        );
        FitError::Whole { label, why }
    })
}
