//! What a planner asks for: a scenario's tunnel, or that of a bare map.

use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use super::Registry;
use crate::{
    config::{ConfigError, Source, kind_of_map},
    mission::chain::{Course, PilotStep},
};

/// The head's speed where nobody says (m/s).
const SPEED_MPS: f32 = 0.2;

/// What is planned for.
#[derive(Debug, Clone)]
pub enum PlanFor {
    /// A scenario, and what is written over it (`key=value`).
    Scenario(Source, Vec<String>),
    /// A map file alone.
    Map(String),
}

impl PlanFor {
    /// By a name or a path.
    ///
    /// # Errors
    /// No scenario is called so, or it cannot be read.
    pub fn find(what: &str) -> Result<Self, ConfigError> {
        match kind_of_map(Path::new(what)) {
            Some(_) => Ok(Self::Map(what.to_owned())),
            None => Source::find(what).map(|source| Self::Scenario(source, Vec::new())),
        }
    }
}

/// An argument that stands for a key of the scenario.
#[derive(Debug, Clone, Copy)]
pub enum PlanArgument<'a> {
    /// The map file.
    Map(&'a str),
    /// Where the base stands (m), `chain.base_m`.
    Base([f64; 2]),
    /// The deepest place the head may be sent to (m), `chain.goal_m`.
    Goal([f64; 2]),
    /// Direction of the tunnel at the base (degrees), `chain.heading_deg`.
    Heading(f64),
}

/// What a planner asks for.
#[derive(Debug)]
pub struct PlanRequest<'a> {
    /// What is planned for.
    pub what: &'a PlanFor,
    /// Values written over it (`key=value`).
    pub sets: &'a [String],
    /// UAVs at hand, the head included; the scenario's if nobody says, for a bare map as many as it takes.
    pub uavs: Option<usize>,
    /// Speed of the head (m/s); the scenario's if nobody says, for a bare map 0.2.
    pub speed_mps: Option<f32>,
    /// Where the base stands (m).
    pub base_m: Option<[f64; 2]>,
    /// Direction of the tunnel at the base (degrees).
    pub heading_deg: Option<f64>,
    /// The deepest place the head may be sent to (m).
    pub goal_m: Option<[f64; 2]>,
    /// How an argument was typed, for messages about it.
    pub typed: fn(PlanArgument<'_>) -> String,
}

/// Why there is nothing to plan for.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PlanRequestError {
    /// The scenario.
    #[error(transparent)]
    Config(#[from] ConfigError),
    /// A bare map's own fault: nobody typed a key.
    #[error("{0}")]
    Map(String),
    /// A bare map says neither where the base is nor where to go.
    #[error("{map} is a bare map: its base and its goal have to be said")]
    BareMap {
        /// The map.
        map: String,
        /// Whether the base was not said.
        needs_base: bool,
        /// Whether the goal was not said.
        needs_goal: bool,
    },
}

/// A `key=value` made of another argument: the assignment, and what was typed for it.
struct Short {
    assignment: String,
    typed: String,
}

impl Registry {
    /// The tunnel that is asked for, its head at the speed that is asked for, and the UAVs at hand if anybody said how many.
    /// Nothing is flown, so nobody asks whether all of them find room to wait.
    ///
    /// # Errors
    /// [`PlanRequestError`].
    #[expect(clippy::default_trait_access, reason = "the type of a pilot's `follow` is the core's")]
    pub fn plan_course(self, asked: &PlanRequest<'_>) -> Result<(Course, Option<usize>), PlanRequestError> {
        let (source, written, is_map) = match asked.what {
            PlanFor::Scenario(source, written) => (source.clone(), written.clone(), false),
            PlanFor::Map(map) => (asked.bare(map)?, Vec::new(), true),
        };
        let shorts = asked.shorts();
        let sets: Vec<String> = written
            .into_iter()
            .chain(shorts.iter().map(|short| short.assignment.clone()))
            .chain(asked.sets.iter().cloned())
            .collect();
        let scene = self.chain(&source, &sets).map_err(|error| asked.explain(error, &shorts))?;
        let mut course = Arc::unwrap_or_clone(scene);

        let uavs = asked.uavs.or((!is_map).then_some(course.scenario.chain.uavs));
        if let Some(speed_mps) = asked.speed_mps {
            let pilot = &mut course.scenario.pilot;
            match pilot.iter_mut().find(|step| step.speed_mps > 0.0) {
                Some(step) => step.speed_mps = speed_mps,
                None => pilot.push(PilotStep { start_s: 0.0, speed_mps, follow: Default::default() }),
            }
        }
        Ok((course, uavs))
    }
}

impl PlanRequest<'_> {
    /// A bare map's path, and the key that it goes to.
    fn map(&self) -> Option<(&str, String)> {
        let PlanFor::Map(map) = self.what else { return None };
        kind_of_map(Path::new(map)).map(|kind| (map.as_str(), format!("map.{kind}.file")))
    }

    fn shorts(&self) -> Vec<Short> {
        let short = |assignment, argument| Short { assignment, typed: (self.typed)(argument) };
        let point = |key: &str, [x, y]: [f64; 2], argument| short(format!("{key}=[{x:?}, {y:?}]"), argument);
        let map = self.map().map(|(map, key)| short(format!("{key}={map}"), PlanArgument::Map(map)));
        let base = self.base_m.map(|at| point("chain.base_m", at, PlanArgument::Base(at)));
        let goal = self.goal_m.map(|at| point("chain.goal_m", at, PlanArgument::Goal(at)));
        let heading = self
            .heading_deg
            .map(|deg| short(format!("chain.heading_deg={deg:?}"), PlanArgument::Heading(deg)));
        [map, base, goal, heading].into_iter().flatten().collect()
    }

    /// Names what was typed; of a bare map's own faults nobody typed a key.
    fn explain(&self, error: ConfigError, shorts: &[Short]) -> PlanRequestError {
        match (error, self.map()) {
            (ConfigError::Map { key, cause, .. }, Some((map, maps_key))) if maps_key == key => {
                let cause = cause.to_string();
                let says_where = cause.starts_with(map);
                PlanRequestError::Map(if says_where { cause } else { format!("{map}: {cause}") })
            }
            (error, _) => shorts
                .iter()
                .fold(error, |error, short| error.typed_as(&short.assignment, &short.typed))
                .into(),
        }
    }

    /// A scenario around a map: one UAV at the base, ahead of it the goal.
    fn bare(&self, map: &str) -> Result<Source, PlanRequestError> {
        let (needs_base, needs_goal) = (self.base_m.is_none(), self.goal_m.is_none());
        if needs_base || needs_goal {
            return Err(PlanRequestError::BareMap { map: map.to_owned(), needs_base, needs_goal });
        }
        let stem = Path::new(map).file_stem().unwrap_or_default().to_string_lossy();
        let plain = |c: char| if c.is_ascii_alphanumeric() || c == '_' { c } else { '-' };
        let name: String = stem.chars().take(64).map(plain).collect();
        let text = format!(
            "name = \"{name}\"\nduration_s = 1.0\n[chain]\nuavs = 1\n[[pilot]]\nstart_s = 0.0\nspeed_mps = {SPEED_MPS:?}\n"
        );
        Ok(Source { label: map.to_owned(), text, folder: PathBuf::new() })
    }
}
