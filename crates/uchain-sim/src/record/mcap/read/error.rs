//! Why a recording cannot be read.

use std::io;

/// Why a recording cannot be read. Every message names the place in the file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadError {
    /// The system said no.
    #[error("cannot read: {0}")]
    Io(#[from] io::Error),
    /// No MCAP file.
    #[error("not an MCAP file")]
    NotMcap,
    /// The file ends before a run has begun in it.
    #[error("the file ends after {bytes} bytes, before anything was recorded")]
    Empty {
        /// Length of the file (bytes).
        bytes: u64,
    },
    /// There is nothing to fly again.
    #[error("no tick was recorded")]
    NoFrames,
    /// An MCAP file of somebody else, or of another layout.
    #[error("not a recording of uchain: {why}")]
    NotOurs {
        /// What is missing or different.
        why: String,
    },
    /// A record that is not what it should be.
    #[error("damaged at byte {byte}: {why}")]
    Damaged {
        /// Where the record begins, counted from 0.
        byte: u64,
        /// What was found and expected.
        why: String,
    },
    /// A chunk that somebody compressed.
    #[error(
        "the chunk at byte {byte} is compressed ({compression}): recordings of uchain are not; `mcap` tools can \
         unpack it"
    )]
    Compressed {
        /// Where the chunk begins, counted from 0.
        byte: u64,
        /// The method.
        compression: String,
    },
    /// A record larger than any recording has.
    #[error("the record at byte {byte} has {bytes} bytes: expected at most {most}")]
    TooLarge {
        /// Where the record begins, counted from 0.
        byte: u64,
        /// Its length (bytes).
        bytes: u64,
        /// Longest record that is read (bytes).
        most: u64,
    },
    /// A frame that no run can come to, or that is not the next one.
    #[error("damaged: the frame after tick {tick}: {why}")]
    Frame {
        /// Tick of the last good frame; 0 = none.
        tick: u64,
        /// What was found and expected.
        why: String,
    },
    /// The scenario in the recording cannot be flown by this version.
    #[error(transparent)]
    Scenario(#[from] Box<crate::config::ConfigError>),
}
