//! A scenario: every room's Params under one roof, read once, checked once, trusted after.

mod load;
mod scenario;

pub use load::{ConfigError, builtin, builtin_names};
pub use scenario::{ChainConfig, CorridorConfig, MapConfig, PilotStep, RosConfig, Scenario};
