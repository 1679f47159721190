//! The missions there are. Everything above this room knows missions only through it: a new one is a folder and a line
//! in [`Registry::default`].

#[cfg(all(feature = "record", feature = "draw"))]
mod flight;
#[cfg(all(feature = "record", feature = "draw"))]
mod kept;
#[cfg(feature = "sweep")]
mod keys;
mod map;
mod mission;
mod plan;
mod radio;
#[cfg(all(feature = "record", feature = "draw"))]
mod recording;
mod scene;
mod watch;

#[cfg(feature = "sweep")]
use std::any::Any;
use std::sync::{Arc, LazyLock};

#[cfg(feature = "schema")]
use crate::config::help;
use crate::{
    config::{ConfigError, Document, Keys, KnownKeys, Source},
    map::Map,
    mission::{Scene, chain::Course, explore::Site},
};

#[cfg(all(feature = "record", feature = "draw"))]
pub use flight::{Flight, FlightError};
#[cfg(all(feature = "record", feature = "draw"))]
pub use kept::Kept;
#[cfg(feature = "sweep")]
pub(crate) use keys::ValueKind;
pub use map::Typed;
pub use mission::{AnyMission, Flown, Of, Whole};
#[cfg(feature = "fit")]
pub use plan::{FittedCase, FittedPlan};
pub use plan::{
    PlanArgument, PlanCourse, PlanFlight, PlanFlightError, PlanFor, PlanRequest, PlanRequestError, Spot,
    named,
};
pub use radio::RadioIn;
#[cfg(all(feature = "record", feature = "draw"))]
pub use recording::{AnyRecording, Inspection};
pub use scene::AnyScene;
#[cfg(feature = "record")]
pub use scene::{Output, RecordedRun};
pub use watch::{Now, Watch};

/// The missions that a scenario or a recording may be of.
#[derive(Debug, Clone, Copy)]
pub struct Registry(&'static [&'static dyn AnyMission]);

impl Default for Registry {
    /// All missions of this crate.
    fn default() -> Self {
        Self(&[&Of::<Course>::NEW, &Of::<Site>::NEW])
    }
}

/// What a scenario says of itself.
#[derive(Debug, Clone)]
pub struct About {
    /// Its name.
    pub name: String,
    /// One line that says what happens.
    pub description: String,
    /// What is flown in it.
    pub mission: &'static dyn AnyMission,
}

/// The keys of all our missions.
static KNOWN: LazyLock<Arc<KnownKeys>> = LazyLock::new(|| Arc::new(Registry::default().all_keys()));

impl Registry {
    /// These missions. A scenario is of the first one whose table it has, else of the first that needs none.
    pub const fn new(missions: &'static [&'static dyn AnyMission]) -> Self {
        Self(missions)
    }

    /// The missions.
    pub fn missions(self) -> &'static [&'static dyn AnyMission] {
        self.0
    }

    fn all_keys(self) -> KnownKeys {
        let keys: Vec<&Keys> = self.0.iter().map(|mission| mission.keys()).collect();
        KnownKeys::of(&keys)
    }

    /// The keys of all missions: what is read or looked up without knowing whose it is.
    fn known(self) -> Arc<KnownKeys> {
        if std::ptr::eq(self.0, Self::default().0) { KNOWN.clone() } else { Arc::new(self.all_keys()) }
    }

    /// What a scenario is of.
    fn mission_of(self, document: &Document<'_>) -> &'static dyn AnyMission {
        let has =
            |mission: &&&dyn AnyMission| mission.keys().marker.is_some_and(|marker| document.has(marker));
        let found =
            self.0.iter().find(has).or_else(|| self.0.iter().find(|mission| mission.keys().marker.is_none()));
        found.copied().unwrap_or(&Of::<Course>::NEW)
    }

    /// Reads, checks and lays out a scenario of any mission, with `sets` (`key=value`) written over it.
    ///
    /// ```
    /// use uchain_sim::{config::builtin, mission::{chain::Course, explore::Site}, registry::Registry};
    /// let read = |name| Registry::default().read(&builtin(name).unwrap(), &[]).unwrap();
    /// assert!(read("corner").get::<Course>().is_some());
    /// assert!(read("apartment").get::<Site>().is_some());
    /// ```
    ///
    /// # Errors
    /// What is wrong with it, and where that was written.
    pub fn read(self, source: &Source, sets: &[String]) -> Result<Arc<dyn AnyScene>, ConfigError> {
        let known = self.known();
        let document = Document::parse(source, sets, &known)?;
        self.mission_of(&document).lay(&document, None, None)
    }

    /// Like [`Registry::read`], in a map that was built before: it stands where the scenario names a file, which is not read.
    ///
    /// # Errors
    /// Those of [`Registry::read`].
    pub fn read_in(
        self,
        source: &Source,
        sets: &[String],
        map: Map,
    ) -> Result<Arc<dyn AnyScene>, ConfigError> {
        let known = self.known();
        let document = Document::parse(source, sets, &known)?;
        self.mission_of(&document).lay(&document, Some(map), None)
    }

    /// Like [`Registry::read`], sharing what is worth it with other scenes; `shared` is what
    /// [`AnyMission::shared`] gives.
    ///
    /// # Errors
    /// Those of [`Registry::read`].
    #[cfg(feature = "sweep")]
    pub(crate) fn read_sharing(
        self,
        source: &Source,
        sets: &[String],
        shared: &(dyn Any + Send + Sync),
    ) -> Result<Arc<dyn AnyScene>, ConfigError> {
        let known = self.known();
        let document = Document::parse(source, sets, &known)?;
        self.mission_of(&document).lay(&document, None, Some(shared))
    }

    /// What is added to the words of the scenarios of a mission.
    fn extensions<S: Scene>(self) -> S::Extensions {
        let added = self.0.iter().find_map(|mission| mission.as_any().downcast_ref::<Of<S>>());
        added.map_or(S::BUILTIN, Of::extensions)
    }

    /// Reads, checks and lays out a chain's scenario, as [`Course::read`] does. What a slip of the finger may have meant is
    /// looked for among the keys of all missions, not of chains alone.
    ///
    /// # Errors
    /// Those of [`Course::read`].
    pub fn chain(self, source: &Source, sets: &[String]) -> Result<Arc<Course>, ConfigError> {
        let known = self.known();
        Course::from_document(&Document::parse(source, sets, &known)?, self.extensions::<Course>())
    }

    /// JSON Schema (draft 7) of a scenario file. Names, types, ranges, defaults and descriptions are those of the laws'
    /// own declarations. What a schema cannot say is left to [`Registry::read`]: multiples of the tick, keys that must
    /// agree, whether the scenario can be flown.
    ///
    /// ```
    /// let schema = uchain_sim::registry::Registry::default().schema();
    /// assert_eq!(schema["properties"]["equalize"]["properties"]["k_db_per_m"]["maximum"], 10000.0);
    /// ```
    #[cfg(feature = "schema")]
    pub fn schema(self) -> serde_json::Value {
        help::schema(self.0.iter().map(|mission| (mission.keys(), mission.schema())))
    }

    /// What is known of a key, given by its full name (`radio.alpha_wall`, `pilot.0.speed_mps`) or, if only one key is
    /// called so, by the last part of it. Of a table (`radio`), all its keys; of the empty name, all keys. A table comes
    /// before its keys.
    ///
    /// ```
    /// use uchain_sim::registry::Registry;
    /// let explain = |name| Registry::default().explain(name);
    /// let alpha = &explain("alpha_wall").unwrap()[0];
    /// assert_eq!((alpha.key.as_str(), alpha.default.as_deref()), ("radio.alpha_wall", Some("6")));
    /// assert!(explain("law").unwrap_err().to_string().contains("equalize.law, center.law"));
    /// ```
    ///
    /// # Errors
    /// [`ConfigError::NoSuchKey`] with the nearest name, or the keys whose names end so.
    #[cfg(feature = "schema")]
    pub fn explain(self, name: &str) -> Result<Vec<help::Explanation>, ConfigError> {
        help::explain(name, &self.schema(), &self.known())
    }

    /// Reads a scenario of any mission, its values checked one by one; nothing is laid out.
    ///
    /// # Errors
    /// What is wrong with it, and where that was written.
    pub fn describe(self, source: &Source, sets: &[String]) -> Result<About, ConfigError> {
        let known = self.known();
        let document = Document::parse(source, sets, &known)?;
        let mission = self.mission_of(&document);
        let [name, description] = mission.describe(&document)?;
        Ok(About { name, description, mission })
    }
}
