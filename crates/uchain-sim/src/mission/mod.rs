//! Missions: who flies, who waits, what they tell each other, and what comes of it. One folder each.

pub mod chain;
pub mod explore;
#[cfg(feature = "sweep")]
mod keys;
mod registry;

#[cfg(feature = "sweep")]
pub(crate) use keys::{ValueKind, kind_of, resolve};
pub use registry::{About, Mission, course, describe};
#[cfg(feature = "schema")]
pub use registry::{explain, schema};

/// What describes the messages of our missions.
#[cfg(feature = "record")]
pub(crate) const PROTO: &str = include_str!("uchain.proto");
