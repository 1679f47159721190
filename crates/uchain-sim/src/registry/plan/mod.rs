//! What a planner asks for: a scenario's tunnel, or that of a bare map.

#[cfg(feature = "fit")]
mod fitted;
mod fly;
mod spot;

use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use super::Registry;
use crate::{
    config::{ConfigError, Document, Source, kind_of_map},
    map::Map,
    mission::{
        Scene as _,
        chain::{Course, PilotStep, Scenario},
    },
    radio::{Budgeted, LinkBudget},
    scene::lay_map,
};

#[cfg(feature = "fit")]
pub use fitted::{FittedCase, FittedPlan};
pub use fly::{PlanFlight, PlanFlightError};
pub use spot::Spot;

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
    /// Side of a cell (m), `cell_m` of the map's table.
    Cell(f64),
    /// Station where a branch begins that is cut out, `from` of the map's table.
    From(&'a str),
    /// Station where it ends, `to` of the map's table.
    To(&'a str),
    /// One of the values that a link budget comes to.
    Budget,
}

/// What a planner asks for.
#[derive(Debug, Clone, Copy)]
pub struct PlanRequest<'a> {
    /// What is planned for.
    pub what: &'a PlanFor,
    /// Values written over it (`key=value`).
    pub sets: &'a [String],
    /// UAVs at hand, the head included; the scenario's if nobody says, for a bare map as many as it takes.
    pub uavs: Option<usize>,
    /// Speed of the head (m/s); the scenario's if nobody says, for a bare map 0.2.
    pub speed_mps: Option<f32>,
    /// Where the base stands.
    pub base: Option<&'a Spot>,
    /// Direction of the tunnel at the base (degrees).
    pub heading_deg: Option<f64>,
    /// The deepest place the head may be sent to.
    pub goal: Option<&'a Spot>,
    /// Side of a cell (m), where the map file does not say it.
    pub cell_m: Option<f64>,
    /// Stations between which a branch of a survey is cut out; base and goal are there unless they are said.
    pub from: Option<&'a str>,
    /// The second of them.
    pub to: Option<&'a str>,
    /// Whether a bare map whose goal nobody says is planned down to the place that is farthest from its base along the
    /// passages.
    pub to_farthest: bool,
    /// What limit and reference loss are worked out from.
    pub budget: Option<&'a LinkBudget>,
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
    #[error("{map} is a bare map: its base and its goal have to be said{}", named(.places))]
    BareMap {
        /// The map.
        map: String,
        /// Whether the base was not said.
        needs_base: bool,
        /// Whether the goal was not said.
        needs_goal: bool,
        /// A few of the places that it names, and how many there are.
        places: (Vec<String>, usize),
    },
    /// A place that the map does not name.
    #[error("{typed}: the map names no such place{}", spot::choices(.near, *.count))]
    NoPlace {
        /// What was typed.
        typed: String,
        /// Names that are like it.
        near: Vec<String>,
        /// How many the map has.
        count: usize,
    },
}

/// Places that a map names, for the end of a message.
pub fn named((some, count): &(Vec<String>, usize)) -> String {
    match count {
        0 => String::new(),
        _ => format!("; it names {count} places, such as {}", some.join(", ")),
    }
}

/// What a plan is made for.
#[derive(Debug)]
pub struct PlanCourse {
    /// The tunnel, its head at the speed that is asked for.
    pub course: Arc<Course>,
    /// UAVs at hand, the head included, if anybody said how many.
    pub uavs: Option<usize>,
    /// What the budget came to.
    pub budget: Option<Budgeted>,
}

/// A `key=value` made of another argument: the assignment, and what was typed for it.
#[derive(Clone)]
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
    pub fn plan_course(self, asked: &PlanRequest<'_>) -> Result<PlanCourse, PlanRequestError> {
        let (source, written) = match asked.what {
            PlanFor::Scenario(source, written) => (source.clone(), written.clone()),
            PlanFor::Map(map) => (PlanRequest::bare(map), Vec::new()),
        };
        let known = self.known();
        let mut shorts = asked.shorts_of_the_map(&source, &written);
        let all = |shorts: &[Short]| -> Vec<String> {
            let typed = shorts.iter().map(|short| short.assignment.clone());
            written.iter().cloned().chain(typed).chain(asked.sets.iter().cloned()).collect()
        };
        let built = if asked.needs_the_map() {
            let sets = all(&[shorts.as_slice(), &asked.placeholders()].concat());
            let document = Document::parse(&source, &sets, &known)?;
            let laid = Scenario::unchecked(&document)
                .and_then(|scenario| lay_map(&scenario.map, scenario.chain.base_m, &document));
            match laid {
                Ok((map, _)) => Some(map),
                Err(_) if asked.lacks_a_place() => None,
                Err(error) => return Err(asked.explain(error, &shorts)),
            }
        } else {
            None
        };
        shorts.extend(asked.shorts_of_places(built.as_ref())?);

        let mut sets = all(&shorts);
        let mut budgeted = None;
        if let Some(budget) = asked.budget {
            let document = Document::parse(&source, &sets, &known)?;
            let scenario = Scenario::unchecked(&document).map_err(|error| asked.explain(error, &shorts))?;
            let applied =
                budget.applied(&scenario.radio, &scenario.takeoff, &scenario.link, &scenario.packets);
            for assignment in applied.sets() {
                shorts.push(Short {
                    typed: (asked.typed)(PlanArgument::Budget),
                    assignment: assignment.clone(),
                });
                sets.push(assignment);
            }
            budgeted = Some(applied);
        }
        let laid = match built {
            Some(map) => Document::parse(&source, &sets, &known).and_then(|document| {
                Course::lay(&document, Some(map), &Arc::default(), self.extensions::<Course>())
            }),
            None => self.chain(&source, &sets),
        };
        let mut course = laid.map_err(|error| asked.explain(error, &shorts))?;

        let is_map = matches!(asked.what, PlanFor::Map(_));
        let uavs = asked.uavs.or((!is_map).then_some(course.scenario.chain.uavs));
        if let Some(speed_mps) = asked.speed_mps {
            let pilot = &mut Arc::make_mut(&mut course).scenario.pilot;
            match pilot.iter_mut().find(|step| step.speed_mps > 0.0) {
                Some(step) => step.speed_mps = speed_mps,
                None => pilot.push(PilotStep { start_s: 0.0, speed_mps, follow: Default::default() }),
            }
        }
        Ok(PlanCourse { course, uavs, budget: budgeted })
    }
}

impl PlanRequest<'_> {
    /// A bare map's path, and the key that it goes to.
    fn map(&self) -> Option<(&str, String)> {
        let PlanFor::Map(map) = self.what else { return None };
        kind_of_map(Path::new(map)).map(|kind| (map.as_str(), format!("map.{kind}.file")))
    }

    /// The base, and the goal: where somebody said, else at the ends of the branch that is cut out.
    fn spots(&self) -> [Option<Spot>; 2] {
        let station = |name: Option<&str>| name.map(|name| Spot::Named(name.to_owned()));
        [self.base.cloned().or_else(|| station(self.from)), self.goal.cloned().or_else(|| station(self.to))]
    }

    /// Whether a bare map does not say where to go.
    fn lacks_a_place(&self) -> bool {
        matches!(self.what, PlanFor::Map(_)) && self.spots().iter().any(Option::is_none)
    }

    /// Whether its places have to be asked for.
    fn needs_the_map(&self) -> bool {
        let is_named = |spot: &Option<Spot>| matches!(spot, Some(Spot::Named(_)));
        self.lacks_a_place() || self.spots().iter().any(is_named)
    }

    /// What a bare map is read with before anybody knows where its base is.
    fn placeholders(&self) -> Vec<Short> {
        let (short, is_map) = ("chain.base_m=[0.0, 0.0]".to_owned(), matches!(self.what, PlanFor::Map(_)));
        is_map.then(|| Short { assignment: short, typed: String::new() }).into_iter().collect()
    }

    /// Values of the map's table.
    fn shorts_of_the_map(&self, source: &Source, written: &[String]) -> Vec<Short> {
        let short = |assignment, argument| Short { assignment, typed: (self.typed)(argument) };
        let (mut shorts, mut kind) = (Vec::new(), None);
        if let Some((map, key)) = self.map() {
            kind = kind_of_map(Path::new(map)).map(str::to_owned);
            shorts.push(short(format!("{key}={map}"), PlanArgument::Map(map)));
        } else if self.cell_m.is_some() || self.from.is_some() || self.to.is_some() {
            let known = Registry::default().known();
            let scenario =
                Document::parse(source, written, &known).and_then(|document| Scenario::unchecked(&document));
            kind = scenario.ok().map(|scenario| scenario.map.format().word().to_owned());
        }
        let kind = kind.unwrap_or_default();
        let quoted = |name: &str| toml::Value::String(name.to_owned()).to_string();
        if let Some(cell_m) = self.cell_m {
            shorts.push(short(format!("map.{kind}.cell_m={cell_m:?}"), PlanArgument::Cell(cell_m)));
        }
        if let Some(from) = self.from {
            shorts.push(short(format!("map.{kind}.from={}", quoted(from)), PlanArgument::From(from)));
        }
        if let Some(to) = self.to {
            shorts.push(short(format!("map.{kind}.to={}", quoted(to)), PlanArgument::To(to)));
        }
        shorts
    }

    /// Base, goal and heading; places by name are looked up in the map.
    fn shorts_of_places(&self, map: Option<&Map>) -> Result<Vec<Short>, PlanRequestError> {
        let [base, mut goal] = self.spots();
        // A scenario has a goal of its own, or a tunnel.
        if self.to_farthest && goal.is_none() && matches!(self.what, PlanFor::Map(_)) {
            goal = map.zip(base.as_ref()).and_then(|(map, base)| spot::farthest(map, base));
        }
        if let (PlanFor::Map(file), true) = (self.what, base.is_none() || goal.is_none()) {
            let places = map.map(Map::places).unwrap_or_default();
            return Err(PlanRequestError::BareMap {
                map: file.clone(),
                needs_base: base.is_none(),
                needs_goal: goal.is_none(),
                places: (spot::some(places), places.len()),
            });
        }
        let at = |spot: Option<Spot>, argument: &dyn Fn([f64; 2]) -> PlanArgument<'static>| match spot {
            None => Ok(None),
            Some(Spot::At(at_m)) => Ok(Some((at_m, (self.typed)(argument(at_m))))),
            Some(Spot::Named(name)) => {
                let places = map.map(Map::places).unwrap_or_default();
                spot::find(places, &name).map(|at_m| Some((at_m, name)))
            }
        };
        let short = |key: &str, spot: Option<([f64; 2], String)>| {
            spot.map(|([x, y], typed)| Short { assignment: format!("{key}=[{x:?}, {y:?}]"), typed })
        };
        let base = short("chain.base_m", at(base, &PlanArgument::Base)?);
        let goal = short("chain.goal_m", at(goal, &PlanArgument::Goal)?);
        let heading = self.heading_deg.map(|deg| Short {
            assignment: format!("chain.heading_deg={deg:?}"),
            typed: (self.typed)(PlanArgument::Heading(deg)),
        });
        Ok([base, goal, heading].into_iter().flatten().collect())
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
    pub(super) fn bare(map: &str) -> Source {
        let stem = Path::new(map).file_stem().unwrap_or_default().to_string_lossy();
        let plain = |c: char| if c.is_ascii_alphanumeric() || c == '_' { c } else { '-' };
        let name: String = stem.chars().take(64).map(plain).collect();
        let text = format!(
            "name = \"{name}\"\nduration_s = 1.0\n[chain]\nuavs = 1\n[[pilot]]\nstart_s = 0.0\nspeed_mps = {SPEED_MPS:?}\n"
        );
        Source { label: map.to_owned(), text, folder: PathBuf::new() }
    }
}
