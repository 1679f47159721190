//! A scenario's text: read once, checked once, trusted after.

mod check;
mod diagnose;
mod document;
mod heading;
#[cfg(feature = "schema")]
pub mod help;
mod keys;
mod load;
mod source;
#[cfg(test)]
mod tests;

pub use check::Check;
pub(crate) use check::{DURATION_MAX_S, TICK_S};
pub(crate) use diagnose::shorten;
pub use diagnose::{Choices, ConfigError, Origin};
pub use document::Document;
#[cfg(feature = "sweep")]
pub(crate) use document::plain_key;
pub use heading::Heading;
pub use keys::{Keys, KnownKeys, Table};
pub(crate) use load::explain as explain_error;
pub use source::{PRESETS, Preset, Source, TEXT_MAX_BYTES, builtin, builtin_names};

pub use crate::map::{
    CorridorConfig, CsvConfig, MapConfig, MovingAiConfig, RosConfig, SubtConfig, SurvexConfig, WallsConfig,
    kind_of_map,
};
