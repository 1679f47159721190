//! The missions there are, and which of them a scenario is.

use super::{
    chain::{Course, Scenario, thresholds},
    explore::{ExploreScenario, Site},
};
use crate::{
    config::{ConfigError, Document, Source},
    map::Map,
};

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
        let document = Document::parse(source, sets)?;
        if is_exploration(&document) {
            return Site::read(source, sets).map(|site| Self::Explore(Box::new(site)));
        }
        let course = Course::read(source, sets)?;
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
    let is_exploration = is_exploration(&Document::parse(source, sets)?);
    let (name, description) = if is_exploration {
        ExploreScenario::parse(source, sets).map(|scenario| (scenario.name, scenario.description))?
    } else {
        Scenario::parse(source, sets).map(|scenario| (scenario.name, scenario.description))?
    };
    Ok(About { name, description, is_exploration })
}

/// Whether a scenario has the table of an exploration.
pub(super) fn is_exploration(document: &Document<'_>) -> bool {
    document.has("explore")
}
