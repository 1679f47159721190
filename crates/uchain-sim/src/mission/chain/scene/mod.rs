//! A scenario laid out in its tunnel: everything a run needs, shared by many runs.

mod everywhere;
mod from_base;
mod goal;
mod notes;
mod optimality;
mod places;

use std::sync::{Arc, OnceLock};

use glam::Vec2;
use uchain_core::chain::{Brain, NodeParams};

use super::{
    Chain, ChainExtensions, Leveller, OwnLaw, OwnLeveller, Scenario,
    config::{KEYS, KNOWN, thresholds, values},
    law::Nobody,
};
use crate::{
    analyse::optimum::{BottleneckTable, TableCache},
    config::{ConfigError, Document, Keys, MapConfig, Source},
    map::{Map, Tunnel},
    mission::Scene,
    radio::{Antenna, NO_LINK_DB, RadioModel, finite_db},
    scene::{in_rock, lay_map, lay_radio, refuse, room_near, to_a_micrometre},
    seed::Seed,
    sense::GridRays,
};

pub use everywhere::{Everywhere, ReachedCell};
pub use from_base::FromBase;
pub use goal::Farthest;
pub use optimality::CourseOptimum;
use optimality::LongTunnel;
use places::{Spots, waiting_places};

/// Lower than this an antenna stands on the floor (m).
const ON_GROUND_M: f32 = 0.1;

/// Where a UAV waits, in the map's frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spawn {
    /// Place (m).
    pub at: Vec2,
    /// Direction of the body's x axis, counter-clockwise from the map's x axis (rad).
    pub heading_rad: f32,
}

/// A scenario laid out in its tunnel. Everything in it has been checked; nothing changes any more.
#[derive(Debug, Clone)]
pub struct Course {
    /// What was asked for.
    pub scenario: Scenario,
    /// The tunnel, shared with all that fly in it.
    pub map: Arc<Map>,
    /// Tunnel distance from the base to anywhere.
    pub from_base: FromBase,
    /// The base station, in the map's frame (m).
    pub base: Vec2,
    /// The middle of the tunnel from the base on, where it is known: a corridor's centre line, and on other maps
    /// the middle of the way to `chain.goal_m`. It ends at the goal if there is one.
    pub tunnel: Option<Tunnel>,
    /// Where the UAVs wait, head first.
    pub spawns: Vec<Spawn>,
    /// Radio without noise.
    pub radio: Arc<dyn RadioModel>,
    /// Distances to the walls, as the ToF sensors measure them.
    pub rays: Arc<GridRays>,
    /// Whose law all UAVs fly by; `None`: the built-in node's.
    pub law: Option<OwnLaw>,
    /// Who levels the links of the built-in node's relays; `None`: they themselves, by
    /// [`equalize`](uchain_core::chain::equalize).
    pub leveller: Option<OwnLeveller>,
    /// Drawn by the first who needs it, shared by all runs.
    pub(crate) table: OnceLock<Arc<BottleneckTable>>,
    /// Whether the tunnel is too long for a table, and what takes its place.
    pub(crate) long: OnceLock<Option<Arc<LongTunnel>>>,
    /// Tables shared with other courses.
    pub(crate) tables: Arc<TableCache>,
}

impl Course {
    /// Reads, checks and lays out a scenario, in one go.
    ///
    /// ```
    /// use uchain_sim::{mission::chain::Course, config::builtin};
    /// let course = Course::read(&builtin("corner").unwrap(), &[]).unwrap();
    /// assert_eq!(course.spawns.len(), course.scenario.chain.uavs);
    /// ```
    ///
    /// # Errors
    /// Those of [`Scenario::parse`] and [`Course::lay_out`]; each names its place, `--set` included.
    pub fn read(source: &Source, sets: &[String]) -> Result<Arc<Self>, ConfigError> {
        Self::from_document(&Document::parse(source, sets, &KNOWN)?, Self::BUILTIN)
    }

    /// Lays out what a document says.
    pub(crate) fn from_document(
        document: &Document<'_>,
        extensions: ChainExtensions,
    ) -> Result<Arc<Self>, ConfigError> {
        let scenario = Scenario::from_document(document)?;
        Self::lay_in(scenario, document, None, &Arc::default(), extensions).map(Arc::new)
    }

    /// Builds the tunnel and finds everyone's place in it. `source` gives the folder for the map's path
    /// and the lines for messages.
    ///
    /// # Errors
    /// A value out of range; a map that cannot be read or built; the base or a UAV in rock or nearer to a
    /// wall than its radius; UAVs that overlap; a UAV from which no way leads to the base.
    pub fn lay_out(scenario: Scenario, source: &Source) -> Result<Arc<Self>, ConfigError> {
        let document = Document::parse(source, &[], &KNOWN)?;
        values(&scenario, &document)?;
        Self::lay_in(scenario, &document, None, &Arc::default(), Self::BUILTIN).map(Arc::new)
    }

    fn lay_in(
        scenario: Scenario,
        document: &Document<'_>,
        built: Option<Map>,
        tables: &Arc<TableCache>,
        extensions: ChainExtensions,
    ) -> Result<Self, ConfigError> {
        let law = extensions.law(scenario.chain.brain.as_deref(), document)?;
        let (map, line) = match built {
            // A corridor is built all the same, as its middle comes with it.
            Some(map) if !matches!(scenario.map, MapConfig::Corridor(_)) => (map, None),
            _ => lay_map(&scenario.map, scenario.chain.base_m, document)?,
        };
        let radius_m = scenario.motion.radius_m;
        let spots = Spots { map: &map, radius_m, document };
        let [x_m, y_m] = scenario.chain.base_m;
        let base = map.to_local([x_m, y_m]);
        if let Some(in_rock) = in_rock(&map, base) {
            let room = room_near(&map, base, radius_m);
            let expected = format!("the base is {in_rock}; expected free space{room}");
            return Err(spots.invalid("chain.base_m", &format!("[{x_m}, {y_m}]"), expected));
        }
        let radio = lay_radio(&scenario.radio, &map, extensions.radios, document)?;
        let refused = |cause| refuse(document, "chain.base_m", cause);
        let from_base = FromBase::new(&map, base).map_err(refused)?;
        let tunnel = spots.tunnel(&scenario, line, base)?;
        let from_base = from_base.along(tunnel.as_ref()).map_err(refused)?;

        let mut spawns: Vec<Spawn> = Vec::with_capacity(scenario.chain.uavs);
        let heading_rad = scenario.chain.heading_deg.to_radians();
        for (index, place) in waiting_places(&scenario).into_iter().enumerate() {
            let [place_x_m, place_y_m] = place.at_m.map(to_a_micrometre);
            let at = map.to_local(place.at_m);
            spots.stands_free(index, &place, at, &spawns)?;
            if !from_base.leads_to(&map, spawns.iter().map(|spawn| spawn.at), at) {
                let expected = format!(
                    "no way leads from the base to UAV {index} at ({place_x_m}, {place_y_m}) m; both must be in \
                     the same tunnel"
                );
                return Err(spots.invalid("chain.base_m", &format!("[{x_m}, {y_m}]"), expected));
            }
            spawns.push(Spawn { at, heading_rad });
        }
        let rays = Arc::new(GridRays::new(&map, scenario.tof.range_m));
        let (table, tables) = (OnceLock::new(), tables.clone());
        let map = Arc::new(map);
        Ok(Self {
            scenario,
            map,
            from_base,
            base,
            tunnel,
            spawns,
            radio,
            rays,
            law,
            leveller: None,
            table,
            long: OnceLock::new(),
            tables,
        })
    }

    /// The same scenario, flown by a law of one's own: `make` makes the brain of a UAV, of its id and of what the scenario
    /// says of the built-in laws. `name` is what the scenario says from now on (`chain.brain`): a recording tells whose law
    /// was flown.
    ///
    /// ```
    /// use uchain_libm as _; // the same bits on every system
    /// use uchain_core::chain::{Brain, Command, Observation};
    /// use uchain_sim::{config::builtin, mission::chain::Course, run::run};
    /// #[derive(Debug)]
    /// struct Hover;
    /// impl Brain for Hover {
    ///     fn decide(&mut self, _: &Observation) -> Command {
    ///         Command { airborne: true, ..Command::default() }
    ///     }
    /// }
    /// let course = Course::read(&builtin("corner").unwrap(), &["duration_s=5".into()]).unwrap();
    /// let hovering = course.with_law("hover", |_, _| Hover);
    /// assert_ne!(run(&course, 1, &mut ()).unwrap().digest, run(&hovering, 1, &mut ()).unwrap().digest);
    /// ```
    #[must_use]
    pub fn with_law<B: Brain + 'static>(
        &self,
        name: &str,
        make: impl Fn(usize, &NodeParams) -> B + Send + Sync + 'static,
    ) -> Arc<Self> {
        let mut course = self.clone();
        course.scenario.chain.brain = Some(name.to_owned());
        course.law = Some(OwnLaw::new(make));
        Arc::new(course)
    }

    /// The same scenario, its built-in relays levelled by whoever `make` makes for each run. `name` is what the scenario says
    /// from now on (`chain.brain`).
    ///
    /// ```
    /// use std::ops::ControlFlow;
    /// use uchain_libm as _; // the same bits on every system
    /// use uchain_core::chain::{EqualizeParams, equalize};
    /// use uchain_sim::{
    ///     config::builtin,
    ///     mission::chain::{Asked, Course, Leveller},
    ///     run::run,
    /// };
    /// /// Eq. 12, with a gain of its own.
    /// #[derive(Debug)]
    /// struct Gain(EqualizeParams);
    /// impl Leveller for Gain {
    ///     fn level(&mut self, _: u64, asked: &[Asked], level_mps: &mut [f32]) -> ControlFlow<()> {
    ///         for (level_mps, Asked { levelling, .. }) in level_mps.iter_mut().zip(asked) {
    ///             *level_mps = equalize(levelling.back_db, levelling.front_db, &self.0);
    ///         }
    ///         ControlFlow::Continue(())
    ///     }
    /// }
    /// let course = Course::read(&builtin("straight").unwrap(), &["duration_s=90".into()]).unwrap();
    /// let digest = |course: &std::sync::Arc<Course>| run(course, 1, &mut ()).unwrap().digest;
    /// let same = course.with_leveller("eq-12", |course| Gain(course.scenario.equalize.clone()));
    /// assert_eq!(digest(&same), digest(&course));
    /// let other =
    ///     course.with_leveller("soft", |_| Gain(EqualizeParams { k_db_per_m: 40.0, ..EqualizeParams::default() }));
    /// assert_ne!(digest(&other), digest(&course));
    /// ```
    #[must_use]
    pub fn with_leveller<L: Leveller + 'static>(
        &self,
        name: &str,
        make: impl Fn(&Self) -> L + Send + Sync + 'static,
    ) -> Arc<Self> {
        let mut course = self.clone();
        course.scenario.chain.brain = Some(name.to_owned());
        course.leveller = Some(OwnLeveller::new(make));
        Arc::new(course)
    }

    /// What the scenario says of the built-in laws.
    pub fn node_params(&self) -> NodeParams {
        let scenario = &self.scenario;
        NodeParams {
            kalman: scenario.kalman.clone(),
            equalize: scenario.equalize.clone(),
            center: scenario.center.clone(),
            takeoff: scenario.takeoff.clone(),
            link: scenario.link.clone(),
            tof_range_m: scenario.tof.range_m,
        }
    }

    /// The same scenario with a radio of one's own. `word` is what the scenario says from now on (`radio.model`): a recording
    /// tells whose radio it was.
    #[must_use]
    pub fn with_radio(&self, word: &str, radio: Arc<dyn RadioModel>) -> Arc<Self> {
        let mut course = self.clone();
        word.clone_into(&mut course.scenario.radio.model);
        (course.radio, course.table, course.long) = (radio, OnceLock::new(), OnceLock::new());
        Arc::new(course)
    }

    /// The base's antenna.
    pub fn base_antenna(&self) -> Antenna {
        Antenna::from(self.base).on_ground(self.scenario.chain.base_height_m < ON_GROUND_M)
    }

    /// What a link loses, noise off (dB); always a number.
    pub fn loss_db(&self, from: &Antenna, to: &Antenna) -> f32 {
        finite_db(self.radio.loss_db(&self.map, from, to))
    }

    /// What no link over a straight distance (m) falls short of (dB); minus infinity where the model does not say.
    pub(crate) fn least_loss_db(&self, apart_m: f32) -> f32 {
        let least_db = self.radio.least_loss_db(apart_m);
        // As a loss that is no number does, one at least as bad counts as no link.
        if least_db.is_nan() { f32::NEG_INFINITY } else { least_db.min(NO_LINK_DB) }
    }

    /// How deep in the tunnel a place lies (m), negative behind the base; `None` where the tunnel's middle is not
    /// known.
    pub fn depth_m(&self, at: Vec2) -> Option<f32> {
        self.tunnel.as_ref().map(|tunnel| tunnel.depth_m(at) as f32)
    }

    /// A UAV in mid-tunnel that flies along it, or the base at depth 0.
    pub(crate) fn antenna_at(&self, depth_m: f64) -> Option<Antenna> {
        let (at, heading_rad) = self.tunnel.as_ref()?.at(depth_m);
        Some(if depth_m > 0.0 {
            Antenna::flying(at, heading_rad)
        } else {
            Antenna { at, ..self.base_antenna() }
        })
    }
}

impl Scene for Course {
    type Mission = Chain;
    /// Tables of optima.
    type Shared = Arc<TableCache>;
    type Extensions = ChainExtensions;
    const BUILTIN: ChainExtensions = ChainExtensions { brains: &[], radios: &[] };
    const KIND: &'static str = "a chain";
    const ROBOT: &'static str = "UAV";
    const KEYS: &'static Keys = &KEYS;

    fn describe(document: &Document<'_>, _: ChainExtensions) -> Result<[String; 2], ConfigError> {
        Scenario::from_document(document).map(|scenario| [scenario.name, scenario.description])
    }

    #[cfg(feature = "schema")]
    fn schema(extensions: ChainExtensions) -> serde_json::Value {
        super::config::schema(extensions)
    }

    fn takes(document: &Document<'_>, _: ChainExtensions) -> bool {
        Scenario::unchecked(document).is_ok()
    }

    fn title(&self) -> String {
        let preset = self.scenario.preset.as_ref().map(|name| format!(", preset {name}")).unwrap_or_default();
        format!("{}{preset}", self.scenario.name)
    }

    fn lay(
        document: &Document<'_>,
        map: Option<Map>,
        shared: &Self::Shared,
        extensions: ChainExtensions,
    ) -> Result<Arc<Self>, ConfigError> {
        let scenario = Scenario::from_document(document)?;
        let was_flown = map.is_some();
        let course = Self::lay_in(scenario, document, map, shared, extensions)?;
        // What was recorded has been flown, whatever is asked of scenarios today.
        if !was_flown {
            thresholds(&course.scenario, document)?;
        }
        Ok(Arc::new(course))
    }

    fn read_recorded(
        source: &Source,
        map: Map,
        extensions: ChainExtensions,
    ) -> Result<Arc<Self>, ConfigError> {
        let document = Document::parse(source, &[], &KNOWN)?;
        let mut scenario = Scenario::from_document(&document)?;
        let brain = scenario.chain.brain.clone();
        if extensions.law(brain.as_deref(), &document).is_ok() {
            return Self::read_in(source, map, extensions);
        }
        scenario.chain.brain = None;
        let mut course = Self::lay_in(scenario, &document, Some(map), &Arc::default(), extensions)?;
        course.scenario.chain.brain = brain;
        course.leveller = Some(OwnLeveller::new(|_| Nobody));
        Ok(Arc::new(course))
    }

    fn name(&self) -> &str {
        &self.scenario.name
    }

    fn duration_s(&self) -> f64 {
        self.scenario.duration_s
    }

    fn crew(&self) -> usize {
        self.spawns.len()
    }

    fn map(&self) -> &Arc<Map> {
        &self.map
    }

    fn seeded(self: &Arc<Self>, seed: u64) -> Arc<Self> {
        match self.radio.seeded(Seed(seed)) {
            Some(radio) => self.with_radio(&self.scenario.radio.model, radio),
            None => self.clone(),
        }
    }

    fn notes(&self) -> Vec<String> {
        Self::notes(self)
    }

    fn to_toml(&self) -> Result<String, toml::ser::Error> {
        self.scenario.to_toml()
    }
}
