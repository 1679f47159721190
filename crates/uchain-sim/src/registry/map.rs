//! The map of a scenario, or of a map file alone.

use std::{path::Path, sync::Arc};

use super::Registry;
use crate::{
    config::{ConfigError, Document, Source, kind_of_map},
    map::Map,
    mission::explore::{ExploreScenario, Site},
    scene::lay_map,
};

/// An argument that stands for a `key=value`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Typed {
    /// The assignment.
    pub assignment: String,
    /// How it was typed, for messages about it.
    pub typed: String,
}

impl Registry {
    /// The map by the name of a scenario, or by the path of a scenario or a map file; `typed` and then `sets` (`key=value`)
    /// are written over the scenario, or over what stands for one around a map file.
    ///
    /// ```
    /// use uchain_sim::registry::Registry;
    /// let map = Registry::default().map("corner", &[], &[]).unwrap();
    /// assert!(map.walls().len() > 4);
    /// ```
    ///
    /// # Errors
    /// No scenario is called so, it cannot be read, or it is no map.
    pub fn map(self, what: &str, typed: &[Typed], sets: &[String]) -> Result<Arc<Map>, ConfigError> {
        let all: Vec<String> = typed.iter().map(|typed| &typed.assignment).chain(sets).cloned().collect();
        self.map_with(what, &all).map_err(|error| {
            typed.iter().fold(error, |error, typed| error.typed_as(&typed.assignment, &typed.typed))
        })
    }

    fn map_with(self, what: &str, sets: &[String]) -> Result<Arc<Map>, ConfigError> {
        let source = Source::find(what)?;
        if kind_of_map(Path::new(what)).is_none() {
            return Ok(self.read(&source, sets)?.map().clone());
        }
        // Nothing but the map is laid out: whether somebody finds a place to start in it is another question.
        let known = self.known();
        let document = Document::parse(&source, sets, &known)?;
        let scenario = ExploreScenario::from_document(&document, self.extensions::<Site>())?;
        Ok(Arc::new(lay_map(&scenario.map, [0.0; 2], &document)?.0))
    }
}
