//! The missions there are, and which of them a scenario is.

use std::sync::LazyLock;

use super::{
    chain::{self, Course, Scenario, thresholds},
    explore::{self, ExploreScenario, Site},
};
#[cfg(feature = "schema")]
use crate::config::help::{self, Explanation};
use crate::{
    config::{ConfigError, Document, KnownKeys, Source},
    map::Map,
};

/// The keys of all missions: what is read or looked up without knowing whose it is.
static KNOWN: LazyLock<KnownKeys> = LazyLock::new(|| KnownKeys::of(&[&chain::KEYS, &explore::KEYS]));

/// A scenario of either kind, laid out and checked.
#[derive(Debug, Clone)]
pub enum Mission {
    /// A chain: the scenario has a table `[chain]`.
    Chain(Box<Course>),
    /// An exploration: it has a table `[explore]`.
    Explore(Box<Site>),
}

impl Mission {
    /// Reads, checks and lays out a scenario of either kind.
    ///
    /// ```
    /// use uchain_sim::{mission::Mission, config::builtin};
    /// let read = |name| Mission::read(&builtin(name).unwrap(), &[]).unwrap();
    /// assert!(matches!(read("corner"), Mission::Chain(_)));
    /// assert!(matches!(read("apartment"), Mission::Explore(_)));
    /// ```
    ///
    /// # Errors
    /// Those of [`Course::read`] and [`Site::read`]; thresholds of a chain that would keep its relays on the ground.
    pub fn read(source: &Source, sets: &[String]) -> Result<Self, ConfigError> {
        let document = document(source, sets)?;
        if is_exploration(&document) {
            return Site::from_document(&document, None).map(|site| Self::Explore(Box::new(site)));
        }
        let course = Course::from_document(&document, None)?;
        thresholds(&course.scenario, &document)?;
        Ok(Self::Chain(Box::new(course)))
    }

    /// What one should know before the start.
    pub fn notes(&self) -> Vec<String> {
        match self {
            Self::Chain(course) => course.notes(),
            Self::Explore(site) => site.notes(),
        }
    }

    /// What it is flown in.
    pub fn map(&self) -> &Map {
        match self {
            Self::Chain(course) => &course.map,
            Self::Explore(site) => &site.map,
        }
    }
}

/// What a scenario says of itself.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct About {
    /// Its name.
    pub name: String,
    /// One line that says what happens.
    pub description: String,
    /// Whether it is an exploration, else it is a chain.
    pub is_exploration: bool,
}

/// Reads a scenario of either kind, its values checked one by one; nothing is laid out.
///
/// # Errors
/// Those of [`Scenario::parse`] and [`ExploreScenario::parse`].
pub fn describe(source: &Source, sets: &[String]) -> Result<About, ConfigError> {
    let document = document(source, sets)?;
    let is_exploration = is_exploration(&document);
    let (name, description) = if is_exploration {
        let scenario = ExploreScenario::from_document(&document)?;
        (scenario.name, scenario.description)
    } else {
        let scenario = Scenario::from_document(&document)?;
        (scenario.name, scenario.description)
    };
    Ok(About { name, description, is_exploration })
}

/// Reads, checks and lays out a chain's scenario, as [`Course::read`] does. What a slip of the finger may have meant is
/// looked for among the keys of all missions, not of chains alone.
///
/// # Errors
/// Those of [`Course::read`].
pub fn course(source: &Source, sets: &[String]) -> Result<Course, ConfigError> {
    Course::from_document(&document(source, sets)?, None)
}

/// JSON Schema (draft 7) of a scenario file. Names, types, ranges, defaults and descriptions are those of the laws'
/// own declarations. What a schema cannot say is left to [`Mission::read`]: multiples of the tick, keys that must agree,
/// whether the tunnel can be flown.
///
/// ```
/// let schema = uchain_sim::mission::schema();
/// assert_eq!(schema["properties"]["equalize"]["properties"]["k_db_per_m"]["maximum"], 10000.0);
/// ```
#[cfg(feature = "schema")]
pub fn schema() -> serde_json::Value {
    help::schema([(&chain::KEYS, chain::schema()), (&explore::KEYS, explore::schema())])
}

/// What is known of a key, given by its full name (`radio.alpha_wall`, `pilot.0.speed_mps`) or, if only one key is
/// called so, by the last part of it. Of a table (`radio`), all its keys; of the empty name, all keys. A table comes
/// before its keys.
///
/// ```
/// use uchain_sim::mission::explain;
/// let alpha = &explain("alpha_wall").unwrap()[0];
/// assert_eq!((alpha.key.as_str(), alpha.default.as_deref()), ("radio.alpha_wall", Some("6")));
/// assert!(explain("law").unwrap_err().to_string().contains("equalize.law, center.law"));
/// ```
///
/// # Errors
/// [`ConfigError::NoSuchKey`] with the nearest name, or the keys whose names end so.
#[cfg(feature = "schema")]
pub fn explain(name: &str) -> Result<Vec<Explanation>, ConfigError> {
    help::explain(name, &schema(), &KNOWN)
}

/// A scenario's text, to be read by whichever mission it is of.
pub(super) fn document<'i>(source: &'i Source, sets: &'i [String]) -> Result<Document<'i>, ConfigError> {
    Document::parse(source, sets, &KNOWN)
}

/// Reads the values of a scenario, each of the right type, whatever it is.
#[cfg(feature = "sweep")]
pub(super) fn read_values(document: &Document<'_>) -> Result<(), ConfigError> {
    if is_exploration(document) {
        ExploreScenario::unchecked(document).map(drop)
    } else {
        Scenario::unchecked(document).map(drop)
    }
}

/// Whether a scenario has the table of an exploration.
fn is_exploration(document: &Document<'_>) -> bool {
    explore::KEYS.marker.is_some_and(|marker| document.has(marker))
}
