//! Missions and their scenes behind one face each.

use std::{any::Any, fmt::Debug, sync::Arc};

use super::AnyScene;
#[cfg(feature = "sweep")]
use crate::analyse::{Cell, Column};
#[cfg(feature = "record")]
use crate::mission::Recorded;
#[cfg(all(feature = "record", feature = "draw"))]
use crate::record::mcap::Opened;
use crate::{
    analyse::Verdict,
    config::{ConfigError, Document, Keys},
    map::Map,
    mission::{Scene, Shown, Summary as _},
    run::SummaryOf,
};

/// A mission of whatever kind.
pub trait AnyMission: Debug + Sync {
    /// The mission in a word, with its article: "a chain".
    fn kind(&self) -> &'static str;

    /// The keys that its scenarios may have.
    fn keys(&self) -> &'static Keys;

    /// A scenario of it as JSON Schema.
    #[cfg(feature = "schema")]
    fn schema(&self) -> serde_json::Value;

    /// Name and description of a scenario, its values checked one by one.
    ///
    /// # Errors
    /// What is wrong with it, and where that was written.
    fn describe(&self, document: &Document<'_>) -> Result<[String; 2], ConfigError>;

    /// Lays a scenario out; a `map` that was built before stands where it names one.
    ///
    /// # Errors
    /// What is wrong with it, and where that was written.
    fn lay(
        &self,
        document: &Document<'_>,
        map: Option<Map>,
        shared: Option<&(dyn Any + Send + Sync)>,
    ) -> Result<Arc<dyn AnyScene>, ConfigError>;

    /// Whether all values of a scenario are of the right types, whatever they are.
    fn takes(&self, document: &Document<'_>) -> bool;

    /// A recording of this mission.
    #[cfg(all(feature = "record", feature = "draw"))]
    fn recording(&self, opened: Opened<super::recording::Input>) -> Box<dyn super::AnyRecording>;

    /// What scenes of one sweep may share.
    fn shared(&self) -> Box<dyn Any + Send + Sync>;

    /// Columns of the numbers that a run comes to.
    #[cfg(feature = "sweep")]
    fn columns(&self) -> Vec<Column>;

    /// Itself, an [`Of`].
    fn as_any(&self) -> &dyn Any;
}

/// The mission that is flown in scenes of a kind, with what a program adds to the words of their scenarios.
pub struct Of<S: Scene>(S::Extensions);

impl<S: Scene> Of<S> {
    /// With the words that are built in.
    pub const NEW: Self = Self(S::BUILTIN);

    /// With these words besides. They are known to all that goes by the registry: the command line, sweeps, recordings
    /// that are flown again, explanations of keys and hints.
    pub const fn with(extensions: S::Extensions) -> Self {
        Self(extensions)
    }

    /// What was added.
    pub(super) fn extensions(&self) -> S::Extensions {
        self.0
    }
}

impl<S: Scene> Debug for Of<S> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(S::KIND)
    }
}

/// What a scene's mission can do for the doors: it can be looked at, and recorded if recordings are compiled in.
#[cfg(feature = "record")]
pub trait Whole: Scene<Mission: Shown + Recorded> {}
#[cfg(feature = "record")]
impl<S: Scene<Mission: Shown + Recorded>> Whole for S {}
/// What a scene's mission can do for the doors: it can be looked at.
#[cfg(not(feature = "record"))]
pub trait Whole: Scene<Mission: Shown> {}
#[cfg(not(feature = "record"))]
impl<S: Scene<Mission: Shown>> Whole for S {}

impl<S: Whole> AnyMission for Of<S> {
    fn kind(&self) -> &'static str {
        S::KIND
    }

    fn keys(&self) -> &'static Keys {
        S::KEYS
    }

    #[cfg(feature = "schema")]
    fn schema(&self) -> serde_json::Value {
        S::schema(self.0)
    }

    fn describe(&self, document: &Document<'_>) -> Result<[String; 2], ConfigError> {
        S::describe(document, self.0)
    }

    fn lay(
        &self,
        document: &Document<'_>,
        map: Option<Map>,
        shared: Option<&(dyn Any + Send + Sync)>,
    ) -> Result<Arc<dyn AnyScene>, ConfigError> {
        let shared =
            shared.and_then(|shared| shared.downcast_ref::<S::Shared>()).cloned().unwrap_or_default();
        S::lay(document, map, &shared, self.0).map(<dyn AnyScene>::of)
    }

    fn takes(&self, document: &Document<'_>) -> bool {
        S::takes(document, self.0)
    }

    #[cfg(all(feature = "record", feature = "draw"))]
    fn recording(&self, opened: Opened<super::recording::Input>) -> Box<dyn super::AnyRecording> {
        Box::new(crate::replay::Recording::<_, S>::from(opened).with_extensions(self.0))
    }

    fn shared(&self) -> Box<dyn Any + Send + Sync> {
        Box::new(S::Shared::default())
    }

    #[cfg(feature = "sweep")]
    fn columns(&self) -> Vec<Column> {
        let column = |(name, kind, _): &(&str, _, _)| Column {
            name: (*name).to_owned(),
            kind: *kind,
            is_result: true,
        };
        S::Mission::columns().iter().map(column).collect()
    }

    fn as_any(&self) -> &dyn Any {
        self
    }
}

/// What a run came to, of whatever mission.
#[derive(Debug)]
pub struct Flown {
    verdict: Verdict,
    digest: String,
    #[cfg(feature = "sweep")]
    cells: Vec<Cell>,
    summary: Box<dyn Any + Send + Sync>,
}

impl Flown {
    /// Of a run in a scene of a known mission.
    pub fn of<S: Whole>(summary: SummaryOf<S>) -> Self {
        Self {
            verdict: summary.verdict().clone(),
            digest: summary.digest().to_owned(),
            #[cfg(feature = "sweep")]
            cells: S::Mission::columns().iter().map(|(_, _, of)| of(&summary)).collect(),
            summary: Box::new(summary),
        }
    }

    /// What was found out about how it went.
    pub fn verdict(&self) -> &Verdict {
        &self.verdict
    }

    /// The run's digest.
    pub fn digest(&self) -> &str {
        &self.digest
    }

    /// The numbers it came to, under [`AnyMission::columns`].
    #[cfg(feature = "sweep")]
    pub fn cells(&self) -> &[Cell] {
        &self.cells
    }

    /// Its summary; `None` if it is of another type.
    pub fn summary<T: 'static>(&self) -> Option<&T> {
        self.summary.downcast_ref()
    }
}
