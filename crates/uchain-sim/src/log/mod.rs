//! A log of a real flight, decided again: the node that flies sees what a drone saw, and says what it would have asked for.
//!
//! A log is a table in CSV, a row for every moment at which something was measured. Of each row the node sees what the
//! drone's own loop would have handed it: distances as they come, and at every decision the packets heard since the last
//! one. Decisions are due by the log's own time, from its first row on, whether or not there is a row.
//!
//! ```
//! use uchain_sim::log::{Replay, Settings, template};
//! let settings = Settings::read(&["equalize.v_max_mps=0.2".to_owned()]).unwrap();
//! let replay = Replay::of(&template(), "log.csv", &settings).unwrap();
//! assert_eq!(replay.summary().decisions, 1);
//! assert!(replay.csv().starts_with("line,time_s,decision,asked_forward_mps,"));
//!
//! let error = Replay::of("time_s,front_rssi\n0,-57\n", "log.csv", &settings).unwrap_err();
//! assert!(error.to_string().contains("did you mean 'front_rssi_dbm'?"));
//! ```

mod cells;
mod clock;
mod columns;
mod commands;
mod notes;
#[cfg(feature = "draw")]
mod picture;
mod replay;
mod rows;
mod settings;
mod summary;

use std::io;

pub use columns::{about_columns, template};
pub use replay::{Replay, STEPS_MAX, Step};
pub use rows::LOG_MAX_BYTES;
pub use settings::{NO_VALUE, Settings};
pub use summary::{Compared, Neighbour, Overridden, Summary};

/// Why a log cannot be replayed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LogError {
    /// The file cannot be read.
    #[error("{label}: cannot read the log: {cause}")]
    Read {
        /// The file.
        label: String,
        /// What the system said.
        cause: io::Error,
    },
    /// The file as a whole is none.
    #[error("{label}: {why}")]
    Whole {
        /// The file.
        label: String,
        /// What was expected.
        why: String,
    },
    /// A line.
    #[error("{label}:{line}: {why}")]
    Line {
        /// The file.
        label: String,
        /// The line, from 1.
        line: u64,
        /// What was found, and expected.
        why: String,
    },
    /// A cell.
    #[error("{label}:{line}: {column} = {got}: {expected}")]
    Cell {
        /// The file.
        label: String,
        /// The line, from 1.
        line: u64,
        /// The column.
        column: &'static str,
        /// What stands there.
        got: String,
        /// What was expected.
        expected: String,
    },
}
