//! What is wrong with bytes that are no packet.

use super::{SIZE_MAX, SIZE_MIN, VERSION};

/// Why bytes are no packet.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum WireError {
    /// Too few bytes.
    Short {
        /// How many there are.
        got: usize,
    },
    /// Too many bytes.
    Long {
        /// How many there are.
        got: usize,
    },
    /// A packet of another version, or no packet at all.
    Version {
        /// Its first byte.
        got: u8,
    },
    /// No choice of a wall.
    Follow {
        /// The bits in its place.
        got: u8,
    },
    /// A section that ends behind the packet's end, or has another length than its kind.
    Section {
        /// Its kind.
        kind: u8,
        /// Bytes of its body, by its first byte.
        length: u8,
    },
}

impl core::fmt::Display for WireError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Short { got } => {
                write!(f, "{got} bytes: expected {SIZE_MIN} to {SIZE_MAX}; part of the packet is missing")
            }
            Self::Long { got } => write!(
                f,
                "{got} bytes: expected {SIZE_MIN} to {SIZE_MAX}; own words and a route do not go into one packet"
            ),
            Self::Version { got } => write!(
                f,
                "byte 0, the version, is {got}: expected {VERSION}; all UAVs and the base need firmware with the same one"
            ),
            Self::Follow { got } => {
                write!(f, "byte 1, the wall to follow, is {got}: expected 0 (centre), 1 (left) or 2 (right)")
            }
            Self::Section { kind, length } => write!(
                f,
                "a section of kind {kind} with {length} bytes: expected one that ends within the packet, and 8 bytes of \
                 kind 1, own words"
            ),
        }
    }
}

impl core::error::Error for WireError {}
