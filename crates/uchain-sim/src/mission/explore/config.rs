//! The shape of a scenario of an exploration. Field names are the file's keys.

use std::sync::LazyLock;

use serde::{Deserialize, Serialize};
use toml::{
    Spanned,
    de::{DeTable, DeValue, ValueDeserializer},
};
use uchain_core::{
    explore::{ExploreParams, StrategyKind},
    params::{Key, OutOfRange},
};

use crate::config::{
    Check, Choices, ConfigError, DURATION_MAX_S, Document, Heading, Keys, KnownKeys, MapConfig, Source,
    TICK_S, explain_error as explain,
};
use crate::{
    mission::{
        Scene as _,
        explore::{Site, SiteExtensions},
    },
    radio::{Disc, PacketParams, RadioParams},
    world::QuadrotorParams,
};

/// What is said of a key of a chain in an exploration.
const BELONGS_TO_A_CHAIN: &str =
    "belongs to a chain, and a scenario with [explore] is an exploration; expected one of the two";

/// Keys of a scenario that only chains have, in the order in which they are looked for: a preset brings tables with it.
const CHAIN_ONLY: [&str; 12] = [
    "preset", "chain", "pilot", "kalman", "equalize", "center", "takeoff", "link", "faults", "tof", "flow",
    "motion",
];

/// Tables of a chain that an exploration may have as well.
const RADIO: &str = "radio";
const PACKETS: &str = "packets";

/// The table that makes a scenario an exploration.
const EXPLORE: Key = Key {
    name: "explore",
    range: None,
    doc: "Robots that explore together. A scenario with this table has neither `chain` nor `pilot`, nor any of the \
          tables behind them.",
};

/// The key of `[explore]` whose words a program can add to.
const STRATEGY: &str = "strategy";

/// Keys of an exploration's scenario.
pub(crate) const KEYS: Keys = Keys {
    marker: Some(EXPLORE.name),
    tables: &[
        ("", &[EXPLORE]),
        (EXPLORE.name, TeamConfig::KEYS),
        (EXPLORE.name, ExploreParams::KEYS),
        ("explore.quadrotor", QuadrotorParams::KEYS),
        (RADIO, RadioParams::KEYS),
        (PACKETS, PacketParams::KEYS),
    ],
    renamed: &[],
};

/// What an exploration's scenario is read with where nobody asks which mission it is of.
pub(crate) static KNOWN: LazyLock<KnownKeys> = LazyLock::new(|| KnownKeys::of(&[&KEYS]));

/// An exploration's scenario as JSON Schema.
#[cfg(feature = "schema")]
pub(crate) fn schema(extensions: SiteExtensions) -> serde_json::Value {
    use crate::{
        config::help::{schema_of, schema_with_table},
        radio::RadioKind,
    };

    let mut params = schema_of::<ExploreParams>();
    if let Some(words) = params["properties"][STRATEGY]["oneOf"].as_array_mut() {
        words.extend(extensions.strategies.iter().map(
            |own| serde_json::json!({ "type": "string", "const": own.word(), "description": own.meaning() }),
        ));
    }
    let mut schema = schema_with_table(&EXPLORE, [schema_of::<TeamConfig>(), params]);
    let mut radio = schema_of::<RadioParams>();
    RadioKind::add_to_schema(extensions.radios, &mut radio);
    schema["properties"][RADIO] = radio;
    schema["properties"][PACKETS] = schema_of::<PacketParams>();
    schema
}

/// One exploration of one map. In the file, [`TeamConfig`] and [`ExploreParams`] are one table, `[explore]`.
#[derive(Debug, Clone, PartialEq)]
pub struct ExploreScenario {
    /// Short name; it names the output folder.
    pub name: String,
    /// One line that says what happens.
    pub description: String,
    /// Longest simulated time (s), a multiple of the tick.
    pub duration_s: f64,
    /// The place.
    pub map: MapConfig,
    /// Who explores.
    pub team: TeamConfig,
    /// How they do.
    pub params: ExploreParams,
    /// What a link between robots loses, and its noise; `None`: all hear all, or all within `explore.range_m`.
    pub radio: Option<RadioParams>,
    /// Delivery of packets over `radio`.
    pub packets: PacketParams,
}

/// What flies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum VehicleKind {
    /// A point that flies straight at one speed.
    #[default]
    PointMass,
    /// A quadrotor with six degrees of freedom, as `[explore.quadrotor]` says.
    Quadrotor,
}

uchain_core::params! {
    /// Who explores, from where, and with what.
    #[derive(Serialize, Deserialize)]
    #[serde(default, deny_unknown_fields)]
    pub struct TeamConfig {
        /// Robots.
        /// - Source: Kim 2021, §7.2 (1 to 6)
        pub robots: u16 = 3, in 1..=1000;
        /// Around where robots start if `spawns_m` says nothing (m): side by side. Without a value that is the place with
        /// the most room in the largest part of the map.
        #[serde(skip_serializing_if = "Option::is_none")]
        #[schemars(schema_with = "crate::config::help::shape::point")]
        pub start_m: Option<[f64; 2]> = None;
        /// Where robots start, in order (m). Of more places than robots the first are used.
        #[schemars(schema_with = "crate::config::help::shape::points")]
        pub spawns_m: Vec<[f64; 2]> = Vec::new();
        /// Heading at the start, counter-clockwise from the map's x axis (degrees).
        /// - Source: ours
        pub heading_deg: f32 = 0.0, in -360.0..=360.0;
        /// How far the seed may move a start along x and along y (m).
        /// - Source: ours
        pub scatter_m: f32 = 0.0, in 0.0..=10.0;
        /// Range of messages (m), at least two moves and the air between robots. What a robot hears it passes on.
        /// Without a value all hear all.
        /// - Symbol: `R_c`
        #[serde(skip_serializing_if = "Option::is_none")]
        #[schemars(range(min = 0.1, max = 1_000_000.0))]
        pub range_m: Option<f32> = None;
        /// Time that a scan takes (s); a multiple of the tick, 0.05 s.
        /// - Source: ours
        pub scan_s: f32 = 0.0, in 0.0..=600.0;
        /// Standard deviation of where a robot believes it is, along x and along y, at every new observation (m).
        /// - Source: ours
        pub position_sigma_m: f32 = 0.0, in 0.0..=1.0;
        /// How far over ground from a robot above one counts as being in its downwash (m). It is counted; nobody feels
        /// it.
        /// - Source: ours (the arm of Kim 2021, §7.2, 0.2 m, and a rotor of 0.1 m)
        pub downwash_radius_m: f32 = 0.3, in 0.0..=10.0;
        /// What flies.
        pub vehicle: VehicleKind = VehicleKind::PointMass;
        /// Ground speed (m/s); the greatest one of a quadrotor.
        /// - Source: ours
        pub v_mps: f32 = 0.5, in 0.01..=20.0;
        /// Greatest speed of climb and descent (m/s).
        /// - Source: ours
        pub climb_mps: f32 = 0.5, in 0.01..=20.0;
        /// The quadrotor, where that is what flies.
        pub quadrotor: QuadrotorParams = QuadrotorParams::default();
    }
}

impl ExploreScenario {
    /// Reads an exploration, writes `sets` (`key=value`) over it and checks every value on its own.
    ///
    /// ```
    /// use uchain_sim::{mission::explore::ExploreScenario, config::builtin};
    /// let source = builtin("apartment").unwrap();
    /// let scenario = ExploreScenario::parse(&source, &["explore.robots=4".to_owned()]).unwrap();
    /// assert_eq!(scenario.team.robots, 4);
    /// let error = ExploreScenario::parse(&source, &["explore.robot=4".to_owned()]).unwrap_err();
    /// assert!(error.to_string().contains("did you mean 'robots'?"));
    /// ```
    ///
    /// # Errors
    /// The first thing found wrong, with its place.
    pub fn parse(source: &Source, sets: &[String]) -> Result<Self, ConfigError> {
        Self::from_document(&Document::parse(source, sets, &KNOWN)?, Site::BUILTIN)
    }

    /// The whole scenario in TOML: every value it has, whether written, set or by default. Read again it is the same
    /// scenario.
    ///
    /// # Errors
    /// None that a scenario from [`ExploreScenario::parse`] could cause.
    ///
    /// ```
    /// use uchain_sim::{mission::explore::ExploreScenario, config::{Source, builtin}};
    /// let scenario = ExploreScenario::parse(&builtin("corridors").unwrap(), &["explore.robots=2".to_owned()]).unwrap();
    /// let again = Source { text: scenario.to_toml().unwrap(), ..builtin("corridors").unwrap() };
    /// assert_eq!(ExploreScenario::parse(&again, &[]).unwrap(), scenario);
    /// ```
    pub fn to_toml(&self) -> Result<String, toml::ser::Error> {
        #[derive(Serialize)]
        struct File<'a> {
            name: &'a str,
            description: &'a str,
            duration_s: f64,
            map: &'a MapConfig,
            explore: Table<'a>,
            #[serde(skip_serializing_if = "Option::is_none")]
            radio: Option<&'a RadioParams>,
            #[serde(skip_serializing_if = "Option::is_none")]
            packets: Option<&'a PacketParams>,
        }
        #[derive(Serialize)]
        struct Table<'a> {
            #[serde(flatten)]
            team: &'a TeamConfig,
            #[serde(flatten)]
            params: &'a ExploreParams,
        }
        let Self { name, description, duration_s, map, team, params, radio, packets } = self;
        toml::to_string(&File {
            name,
            description,
            duration_s: *duration_s,
            map,
            explore: Table { team, params },
            radio: radio.as_ref(),
            packets: radio.as_ref().map(|_| packets),
        })
    }

    pub(crate) fn from_document(
        document: &Document<'_>,
        extensions: SiteExtensions,
    ) -> Result<Self, ConfigError> {
        let scenario = Self::unchecked(document, extensions)?;
        scenario.check(document)?;
        Ok(scenario)
    }

    /// With values of the right types, whatever they are.
    pub(crate) fn unchecked(
        document: &Document<'_>,
        extensions: SiteExtensions,
    ) -> Result<Self, ConfigError> {
        if let Some(key) = CHAIN_ONLY.iter().find(|key| document.has(key)) {
            return Err(document.invalid(key, "{ … }", BELONGS_TO_A_CHAIN));
        }
        let [mut heading, table] = document.without(EXPLORE.name);
        let has_radio = document.has(RADIO) || document.has(PACKETS);
        let [radio, packets] = [RADIO, PACKETS].map(|name| take(&mut heading, name));
        let [team, mut params] = split(table);
        let own = own_strategy(&mut params, document, extensions)?;
        let heading =
            Heading::deserialize(ValueDeserializer::from(heading)).map_err(|e| explain(&e, document))?;
        let team =
            TeamConfig::deserialize(ValueDeserializer::from(team)).map_err(|e| explain(&e, document))?;
        let mut params = ExploreParams::deserialize(ValueDeserializer::from(params))
            .map_err(|error| with_own_words(with_team_keys(explain(&error, document)), extensions))?;
        params.strategy = own.unwrap_or(params.strategy);
        let radio =
            RadioParams::deserialize(ValueDeserializer::from(radio)).map_err(|e| explain(&e, document))?;
        let packets =
            PacketParams::deserialize(ValueDeserializer::from(packets)).map_err(|e| explain(&e, document))?;
        let radio = has_radio.then_some(radio);
        let Heading { name, description, duration_s, map } = heading;
        Ok(Self { name, description, duration_s, map, team, params, radio, packets })
    }

    /// The first value outside its range.
    pub(crate) fn check(&self, document: &Document<'_>) -> Result<(), ConfigError> {
        let check = Check { document };
        check.name(&self.name)?;
        check.range("duration_s", self.duration_s, TICK_S, DURATION_MAX_S)?;
        check.ticks("duration_s", self.duration_s)?;
        check.map(&self.map)?;
        let in_explore = |OutOfRange { key, got, low, high }: OutOfRange| {
            check.invalid(&format!("explore.{key}"), &got, format!("must lie in {low}..={high}"))
        };
        self.team.check().map_err(in_explore)?;
        self.params.check().map_err(in_explore)?;
        self.team.start_m.map_or(Ok(()), |at| check.point("explore.start_m", at))?;
        check.ranged("explore.quadrotor", self.team.quadrotor.check())?;
        for (i, &at) in self.team.spawns_m.iter().enumerate() {
            check.point(&format!("explore.spawns_m.{i}"), at)?;
        }
        if self.team.scan_s > 0.0 {
            check.ticks("explore.scan_s", self.team.scan_s.into())?;
        }
        let range_m = self.team.range_m.map(f64::from);
        range_m.map_or(Ok(()), |range_m| check.range("explore.range_m", range_m, 0.1, 1_000_000.0))?;
        if let Some(radio) = &self.radio {
            check.ranged(RADIO, radio.check_all())?;
            check.ranged(PACKETS, self.packets.check())?;
            if let Some(range_m) = self.team.range_m {
                let expected = "a range of messages beside a radio, which has its own; expected one of the two, such as \
                                --set radio.model=disc --set radio.range_m=…";
                return Err(check.invalid("explore.range_m", &range_m, expected));
            }
            if self.packets.delay_ticks > 0 {
                let expected = "robots answer each other within a round; expected 0, as only packets of a chain are late";
                return Err(check.invalid("packets.delay_ticks", &self.packets.delay_ticks, expected));
            }
            if self.packets.wire {
                let expected = "robots tell each other a graph, which has no bytes yet; expected false, as only packets of a \
                                chain are sent as bytes";
                return Err(check.invalid("packets.wire", &true, expected));
            }
        }
        // Robots that would meet within the round have to hear of each other.
        let least_m = self.range_needed_m();
        let needed = format!("must be at least {least_m}: two moves of r_s_m and the air between robots");
        let disc = self.radio.as_ref().filter(|radio| radio.model == Disc::WORD);
        let too_near = |range_m: &f32| *range_m < least_m;
        if let Some(range_m) = self.team.range_m.filter(too_near) {
            return Err(check.invalid("explore.range_m", &range_m, needed + "; without it all hear all"));
        }
        match disc.and_then(|radio| radio.range_m).filter(too_near) {
            Some(range_m) => Err(check.invalid("radio.range_m", &range_m, needed)),
            None => Ok(()),
        }
    }

    /// How far apart robots are at most that could meet within a round (m).
    fn range_needed_m(&self) -> f32 {
        2.0 * self.params.r_s_m + self.params.conflict_m()
    }
}

/// A table at the top, taken out of what is left of a document; an empty one if it is not there.
fn take<'i>(top: &mut Spanned<DeValue<'i>>, name: &str) -> Spanned<DeValue<'i>> {
    let empty = Spanned::new(top.span(), DeValue::Table(DeTable::new()));
    let DeValue::Table(top) = top.get_mut() else { return empty };
    top.remove(name).unwrap_or(empty)
}

/// The table `[explore]` in two: what is said of the team, and all else. Every value keeps its span.
fn split(mut params: Spanned<DeValue<'_>>) -> [Spanned<DeValue<'_>>; 2] {
    let mut team = Spanned::new(params.span(), DeValue::Table(DeTable::new()));
    if let (DeValue::Table(params), DeValue::Table(team)) = (params.get_mut(), team.get_mut()) {
        for (key, value) in std::mem::take(params) {
            let is_team = TeamConfig::KEYS.iter().any(|known| known.name == key.get_ref());
            if is_team {
                team.insert(key, value)
            } else {
                params.insert(key, value)
            };
        }
    }
    [team, params]
}

/// The strategy of the program's own that `[explore]` names, taken out of it: the word means nothing to whoever reads the
/// rest.
fn own_strategy(
    params: &mut Spanned<DeValue<'_>>,
    document: &Document<'_>,
    extensions: SiteExtensions,
) -> Result<Option<StrategyKind>, ConfigError> {
    let DeValue::Table(params) = params.get_mut() else { return Ok(None) };
    let word = params.get(STRATEGY).and_then(|value| value.get_ref().as_str());
    let own = word.and_then(|word| extensions.strategies.iter().find(|own| own.word() == word));
    let Some(own) = own else { return Ok(None) };
    if extensions.strategy_words().filter(|word| *word == own.word()).count() > 1 {
        let (key, got) = (format!("explore.{STRATEGY}"), format!("\"{}\"", own.word()));
        return Err(document.invalid(&key, &got, "this program gives the word to more than one strategy"));
    }
    params.remove(STRATEGY);
    Ok(Some(*own))
}

/// A word that is no strategy could stand for one of the program's own as well.
fn with_own_words(error: ConfigError, extensions: SiteExtensions) -> ConfigError {
    match error {
        ConfigError::UnknownChoice { at, key, got, .. } if key == format!("explore.{STRATEGY}") => {
            let known = extensions.strategy_words().map(str::to_owned).collect();
            let choices = Box::new(Choices::for_word(&got, known));
            ConfigError::UnknownChoice { at, key, got, choices }
        }
        other => other,
    }
}

/// A key of `[explore]` that neither knows could stand for one of either.
fn with_team_keys(error: ConfigError) -> ConfigError {
    match error {
        ConfigError::UnknownKey { at, key, .. } if key.matches('.').count() == 1 => {
            let keys = |keys: &[Key]| keys.iter().map(|key| key.name.to_owned()).collect::<Vec<_>>();
            let known = [keys(TeamConfig::KEYS), keys(ExploreParams::KEYS)].concat();
            let got = key.rsplit('.').next().unwrap_or(&key);
            let choices = Box::new(Choices::for_word(got, known));
            ConfigError::UnknownKey { at, key, choices }
        }
        other => other,
    }
}
