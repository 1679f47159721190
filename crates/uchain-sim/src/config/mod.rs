//! A scenario: every room's Params under one roof, read once, checked once, trusted after.

mod check;
mod course;
mod diagnose;
mod document;
#[cfg(feature = "schema")]
pub mod help;
mod keys;
mod load;
mod mission;
mod scenario;
mod source;
#[cfg(test)]
mod tests;

pub use check::UAVS_MAX;
pub use course::{Course, Spawn};
#[cfg(feature = "sweep")]
pub(crate) use diagnose::shorten;
pub use diagnose::{Choices, ConfigError, Origin};
#[cfg(feature = "sweep")]
pub(crate) use document::plain_key;
pub use mission::{About, ExploreScenario, Mission, Site, TeamConfig, VehicleKind, describe};
#[cfg(feature = "sweep")]
pub(crate) use mission::{ValueKind, kind_of, resolve};
pub use scenario::{
    ChainConfig, CorridorConfig, MapConfig, MovingAiConfig, PilotStep, RosConfig, Scenario, WallsConfig,
};
pub use source::{PRESETS, Preset, Source, TEXT_MAX_BYTES, builtin, builtin_names, kind_of_map};
