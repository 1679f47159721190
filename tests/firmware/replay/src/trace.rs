//! What a trace holds: missions one after the other, and in each of them what its robots could know, instant by instant.

#[cfg(feature = "explore")]
use arrayvec::ArrayVec;
use serde::{Deserialize, Serialize};
use uchain_core::chain::{NodeParams, Observation, Role};
#[cfg(feature = "explore")]
use uchain_core::explore::{ExploreParams, Message, Pose};

use crate::{
    FRAME_MAX, Output,
    frames::{begin, write},
};

/// How a trace begins, before its version.
pub const TRACE_MAGIC: [u8; 7] = *b"UCTRACE";

/// Most sectors of a recorded scan.
#[cfg(feature = "explore")]
pub const SECTORS_MAX: usize = 64;

/// Most random numbers that one decision draws.
#[cfg(feature = "explore")]
pub const DRAWS_MAX: usize = 64;

/// One record. New ones come last: postcard numbers them in this order.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[allow(clippy::large_enum_variant, reason = "one is alive at a time, and there is no heap to box it on")]
pub enum Record<'a> {
    /// A chain begins.
    Chain {
        /// What it is called.
        name: &'a str,
        /// How many fly.
        uavs: u8,
    },
    /// One of its UAVs, before it has seen anything.
    Uav {
        /// Its id, from 0.
        uav: u8,
        /// What it is in the chain until it is told its place.
        role: Role,
        /// What it flies by.
        params: NodeParams,
    },
    /// What a UAV may know at one instant.
    Seen {
        /// Ticks since the start.
        tick: u32,
        /// Whose.
        uav: u8,
        /// All it may know.
        seen: Observation,
    },
    /// The trace is over.
    End {
        /// How many records were before this one.
        records: u32,
    },
    /// An exploration begins.
    #[cfg(feature = "explore")]
    Team {
        /// What it is called.
        name: &'a str,
        /// How many robots there are.
        robots: u16,
        /// The one robot whose brain this is about, which has a store of its own and hears the others; `None`: the whole
        /// team, on one store.
        alone: Option<u16>,
        /// What they explore by.
        params: ExploreParams,
    },
    /// A robot looks around at the begin of a round.
    #[cfg(feature = "explore")]
    Scanned {
        /// Who.
        robot: u16,
        /// Where it believes it is.
        pose: Pose,
        /// What its scan returned, if it made one (m).
        scan: Option<ArrayVec<Option<f32>, SECTORS_MAX>>,
    },
    /// A robot alone hears another one.
    #[cfg(feature = "explore")]
    Heard {
        /// What that says.
        message: Message,
    },
    /// A robot decides.
    #[cfg(feature = "explore")]
    Announces {
        /// Who.
        robot: u16,
        /// The random bits that it draws in doing so.
        draws: ArrayVec<u32, DRAWS_MAX>,
    },
    /// Conflicts are resolved: the round is over.
    #[cfg(feature = "explore")]
    Rules {
        /// Which one, from 0.
        round: u32,
    },
}

impl<'a> Record<'a> {
    /// From its bytes, all of them; `None` if they are no record.
    pub fn read(bytes: &'a [u8]) -> Option<Self> {
        let (record, rest) = postcard::take_from_bytes(bytes).ok()?;
        rest.is_empty().then_some(record)
    }
}

/// A record longer than [`FRAME_MAX`] bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TooLong;

impl core::fmt::Display for TooLong {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "a record of more than {FRAME_MAX} bytes")
    }
}

impl core::error::Error for TooLong {}

/// Writes a trace.
#[derive(Debug)]
pub struct TraceWriter<O> {
    output: O,
    records: u32,
}

impl<O: Output> TraceWriter<O> {
    /// An empty one.
    pub fn begin(mut output: O) -> Self {
        begin(&mut output, TRACE_MAGIC);
        Self { output, records: 0 }
    }

    /// One more record.
    ///
    /// # Errors
    /// [`TooLong`].
    pub fn write(&mut self, record: &Record<'_>) -> Result<(), TooLong> {
        let mut buffer = [0; FRAME_MAX];
        let bytes = postcard::to_slice(record, &mut buffer).map_err(|_| TooLong)?;
        write(&mut self.output, bytes);
        self.records += 1;
        Ok(())
    }

    /// Records so far.
    pub fn records(&self) -> u32 {
        self.records
    }

    /// The trace, with its end.
    ///
    /// # Errors
    /// [`TooLong`], which an end never is.
    pub fn end(mut self) -> Result<O, TooLong> {
        self.write(&Record::End { records: self.records })?;
        Ok(self.output)
    }
}
