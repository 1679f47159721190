//! What may be wrong with a trace.

use core::fmt;

use crate::{FRAME_MAX, UAVS_MAX, VERSION};

/// What cannot be read, and where.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Fault {
    /// Records before it.
    pub place: u32,
    /// What is wrong there.
    pub cause: Cause,
}

/// What is wrong.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Cause {
    /// It ends in the middle.
    Short,
    /// It goes on behind its end.
    Trailing,
    /// It does not begin like such a file.
    Magic,
    /// Another version wrote it.
    Version {
        /// Which one.
        got: u8,
    },
    /// A record that no reader has room for, or one without a byte.
    Length {
        /// Its bytes.
        bytes: u16,
    },
    /// Bytes that are no record.
    Malformed,
    /// A record that no record before it announces: a UAV or a robot that the mission does not have, or none yet.
    Order,
    /// More UAVs or robots than there is room for, or none.
    Crew {
        /// How many.
        got: u16,
    },
    /// Parameters of an exploration outside their range.
    Params,
    /// An explorer draws more bits than were recorded.
    Draws,
    /// Records are missing, or there are too many.
    Count {
        /// As many were written.
        written: u32,
    },
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "after {} records: ", self.place)?;
        match self.cause {
            Cause::Short => write!(f, "it ends in the middle")?,
            Cause::Trailing => write!(f, "it goes on behind its end")?,
            Cause::Magic => write!(f, "it is no such file")?,
            Cause::Version { got } => write!(f, "version {got}, where {VERSION} is expected")?,
            Cause::Length { bytes } => write!(f, "a record of {bytes} bytes, where 1 to {FRAME_MAX} fit")?,
            Cause::Malformed => write!(f, "bytes that are no record")?,
            Cause::Order => write!(f, "a UAV or a robot that the mission does not have")?,
            Cause::Crew { got } => write!(f, "a crew of {got}, where 1 to {UAVS_MAX} fit")?,
            Cause::Params => write!(f, "parameters outside their range")?,
            Cause::Draws => write!(f, "more random bits are drawn than were recorded")?,
            Cause::Count { written } => write!(f, "{written} records were written")?,
        }
        write!(f, "; write it again with `cargo run --release --example observed -- FOLDER`")
    }
}

impl core::error::Error for Fault {}
