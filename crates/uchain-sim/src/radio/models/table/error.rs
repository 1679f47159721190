//! What can be wrong with a table of losses, with the place in its file.

use super::{BYTES_MAX, PLACES_MAX};

/// Why a file is no table of losses.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TableError {
    /// The system does not give it.
    #[error(
        "cannot be read: {why}; a path starts at the folder of the scenario, and that of a recording, which does not hold \
         the table, at the working folder"
    )]
    Read {
        /// What the system said.
        why: String,
    },
    /// Longer than any table.
    #[error("longer than {BYTES_MAX} bytes")]
    TooLong,
    /// No text.
    #[error("not text from byte {byte} on: expected CSV, or NPZ as numpy.savez writes it")]
    NotText {
        /// The first byte that is none.
        byte: usize,
    },
    /// A first line that does not name the columns.
    #[error("line 1: \"{got}\": expected x1_m,y1_m,x2_m,y2_m,loss_db")]
    Header {
        /// What it is.
        got: String,
    },
    /// A line with more cells or fewer than there are columns.
    #[error("line {line}: {got} cells: expected 5, as many as there are columns")]
    Cells {
        /// Which, from 1.
        line: usize,
        /// How many cells it has.
        got: usize,
    },
    /// A cell that holds the wrong thing.
    #[error("line {line}, {column} = \"{got}\": expected {expected}")]
    Cell {
        /// Which line, from 1.
        line: usize,
        /// Which column.
        column: &'static str,
        /// What it holds.
        got: String,
        /// What it should hold.
        expected: &'static str,
    },
    /// A pair of places with two losses.
    #[error(
        "line {line}, loss_db = {got}: the same two places have {other} in another line; expected the same both ways, \
         within 0.001 dB"
    )]
    TwoLosses {
        /// Which line, from 1.
        line: usize,
        /// Its loss (dB).
        got: f32,
        /// The one before it (dB).
        other: f32,
    },
    /// Places that are not evenly spaced.
    #[error("{axis} = {got_m} m lies on no grid that begins at {first_m} m with steps of {step_m} m")]
    Uneven {
        /// `x` or `y`.
        axis: &'static str,
        /// Which (m).
        got_m: f64,
        /// The least (m).
        first_m: f64,
        /// The least step (m).
        step_m: f64,
    },
    /// A grid with too many lines.
    #[error("{axis}: a grid of {got} lines, expected at most {most}: are its places evenly spaced?")]
    TooManyLines {
        /// `x` or `y`.
        axis: &'static str,
        /// How many.
        got: f64,
        /// How many there may be.
        most: usize,
    },
    /// Too many places.
    #[error(
        "more than {PLACES_MAX} places, whose pairs are {pairs}: take a coarser grid, or a smaller part",
        pairs = PLACES_MAX * PLACES_MAX
    )]
    TooManyPlaces,
    /// No two places.
    #[error("{got} places: expected two or more")]
    TooFewPlaces {
        /// How many there are.
        got: usize,
    },
    /// No loss at all.
    #[error("no pair of places has a loss")]
    Empty,
    /// The archive around the arrays.
    #[error("no NPZ file: {why}")]
    Archive {
        /// What is wrong.
        why: &'static str,
    },
    /// One of the arrays.
    #[error("array {name}: {why}")]
    Array {
        /// Which.
        name: &'static str,
        /// What is wrong.
        why: String,
    },
    /// This build was made without the feature `maps`.
    #[error("this build reads no NPZ files; build with the feature `maps`, or save the table as CSV")]
    NoNpz,
}
