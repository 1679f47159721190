//! A chain's scenario: its shape, and from text to a checked one. Field names are the file's keys.

mod check;

use std::sync::LazyLock;

use serde::{Deserialize, Serialize};
use toml::de::ValueDeserializer;
use uchain_core::chain::{CenterParams, EqualizeParams, Follow, KalmanParams, LinkParams, TakeoffParams};

use crate::{
    config::{ConfigError, Document, Keys, KnownKeys, MapConfig, Source, explain_error},
    radio::{Dead, Deaf, FaultConfig, PacketParams, RadioParams},
    sense::{FlowParams, TofParams},
    world::MotionParams,
};

pub use check::UAVS_MAX;
#[cfg(feature = "log")]
pub(crate) use check::agreed;
pub(super) use check::{thresholds, values};

/// Keys of a chain's scenario.
pub(crate) const KEYS: Keys = Keys {
    marker: None,
    tables: &[
        ("", Scenario::KEYS),
        ("chain", ChainConfig::KEYS),
        ("pilot.0", PilotStep::KEYS),
        ("kalman", KalmanParams::KEYS),
        ("equalize", EqualizeParams::KEYS),
        ("center", CenterParams::KEYS),
        ("takeoff", TakeoffParams::KEYS),
        ("link", LinkParams::KEYS),
        ("radio", RadioParams::KEYS),
        ("packets", PacketParams::KEYS),
        ("faults", FaultConfig::KEYS),
        ("faults.deaf.0", Deaf::KEYS),
        ("faults.dead.0", Dead::KEYS),
        ("tof", TofParams::KEYS),
        ("flow", FlowParams::KEYS),
        ("motion", MotionParams::KEYS),
    ],
    renamed: &[("center.tof_range_m", "tof.range_m")],
};

/// What a chain's scenario is read with where nobody asks which mission it is of.
pub(crate) static KNOWN: LazyLock<KnownKeys> = LazyLock::new(|| KnownKeys::of(&[&KEYS]));

/// A chain's scenario as JSON Schema, with these words for whose law it flies by.
#[cfg(feature = "schema")]
pub(crate) fn schema(extensions: super::ChainExtensions) -> serde_json::Value {
    let mut schema = crate::config::help::schema_of::<Scenario>();
    if let Some(brain) = schema.pointer_mut("/properties/chain/properties/brain") {
        let own = "A law of the program's own.";
        let meanings =
            std::iter::once("The built-in law (Laclau 2021, Algorithm 1).").chain(std::iter::repeat(own));
        let choice =
            |(word, meaning)| serde_json::json!({ "type": "string", "const": word, "description": meaning });
        brain["oneOf"] = extensions.words().into_iter().zip(meanings).map(choice).collect();
    }
    crate::radio::RadioKind::add_to_schema(extensions.radios, &mut schema["properties"]["radio"]);
    schema
}

uchain_core::params! {
    /// One mission in one map. All tables but `map`, `chain` and `pilot` may be left out.
    #[derive(Serialize, Deserialize)]
    #[serde(deny_unknown_fields)]
    pub struct Scenario {
        /// Short name; it names the output folder.
        #[schemars(schema_with = "crate::config::help::shape::name")]
        pub name: String;
        /// One line that says what happens.
        #[serde(default)]
        pub description: String;
        /// Name of a preset, which fills in what is not written here.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[schemars(schema_with = "crate::config::help::shape::preset")]
        pub preset: Option<String>;
        /// Simulated time (s); a multiple of the tick, 0.05 s.
        pub duration_s: f64, in 0.05..=86_400.0;
        /// The tunnel: one of the tables of [`FORMATS`](crate::map::FORMATS).
        #[schemars(description = format!("The tunnel: one of {}.", crate::map::tables("`")))]
        pub map: MapConfig;
        /// Who flies and where they wait.
        pub chain: ChainConfig;
        /// What the pilot asks of the head, in order of time.
        pub pilot: Vec<PilotStep>;
        /// Filter of each link end.
        #[serde(default)]
        pub kalman: KalmanParams;
        /// Law that levels the two links of a relay.
        #[serde(default)]
        pub equalize: EqualizeParams;
        /// Law that keeps a UAV in mid-tunnel.
        #[serde(default)]
        pub center: CenterParams;
        /// When the next UAV takes off.
        #[serde(default)]
        pub takeoff: TakeoffParams;
        /// Head override, retreat, lost links.
        #[serde(default)]
        pub link: LinkParams;
        /// Path loss.
        #[serde(default)]
        pub radio: RadioParams;
        /// Delivery of packets.
        #[serde(default)]
        pub packets: PacketParams;
        /// Planned faults.
        #[serde(default)]
        pub faults: FaultConfig;
        /// Distance sensors.
        #[serde(default)]
        pub tof: TofParams;
        /// Optic flow.
        #[serde(default)]
        pub flow: FlowParams;
        /// The body.
        #[serde(default)]
        pub motion: MotionParams;
    }
}

uchain_core::params! {
    /// Who flies and where they wait.
    #[derive(Serialize, Deserialize)]
    #[serde(deny_unknown_fields)]
    pub struct ChainConfig {
        /// UAVs, the head included.
        /// - Symbol: `n`
        /// - Source: Laclau 2021, §3.1; a head and 3 relays in its §6.1.3
        pub uavs: usize, in 1..=1000;
        /// Name of a law of one's own that all UAVs fly by, instead of the built-in one; the program that flies the
        /// scenario brings it.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pub brain: Option<String>;
        /// The base station (m).
        #[schemars(schema_with = "crate::config::help::shape::point")]
        pub base_m: [f64; 2];
        /// Height of the base's antenna above the floor (m): below 0.1 m it stands on the floor, for `radio.ground_db`.
        /// - Source: ours
        #[serde(default = "default_base_height_m")]
        pub base_height_m: f32, in 0.0..=1000.0;
        /// The deepest place the head may be sent to (m). A map without a centre line needs it for what is counted in
        /// depth: the optimum and the plan.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[schemars(schema_with = "crate::config::help::shape::point")]
        pub goal_m: Option<[f64; 2]>;
        /// How long a UAV flies on one battery (s), for the plan.
        /// - Source: Laclau 2021, §7 (5 to 15 min); the value is ours
        #[serde(default = "default_endurance_s")]
        pub endurance_s: f32, in 1.0..=86_400.0;
        /// Direction of the tunnel at the base, counter-clockwise from the map's x axis (degrees).
        /// - Source: ours
        #[serde(default)]
        pub heading_deg: f32, in -360.0..=360.0;
        /// Distance between waiting UAVs, in a row from the base along `heading_deg`, the head farthest (m).
        /// - Source: ours
        #[serde(default = "default_spacing_m")]
        pub spacing_m: f32, in 0.0..=100.0;
        /// Explicit waiting places instead of the row, head first, one per UAV (m).
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[schemars(schema_with = "crate::config::help::shape::points")]
        pub spawns_m: Option<Vec<[f64; 2]>>;
    }
}

fn default_base_height_m() -> f32 {
    1.0
}

fn default_endurance_s() -> f32 {
    420.0
}

fn default_spacing_m() -> f32 {
    0.25
}

uchain_core::params! {
    /// What the pilot asks of the head from one moment on.
    #[derive(Copy, Serialize, Deserialize)]
    #[serde(deny_unknown_fields)]
    pub struct PilotStep {
        /// From when on (s), later than the step before.
        pub start_s: f64, in 0.0..=86_400.0;
        /// Forward speed, negative backward (m/s).
        /// - Source: Laclau 2021, §6.1.3 (0.2)
        pub speed_mps: f32, in -1.0..=1.0;
        /// Wall to follow.
        /// - Source: Laclau 2021, Eq. 21 and §7
        #[serde(default)]
        pub follow: Follow;
    }
}

impl Scenario {
    /// Reads a scenario, writes `sets` (`key=value`, the value in TOML or a bare word) over it and checks
    /// every value on its own. Whether the tunnel can be built and flown is up to
    /// [`Course::lay_out`](super::Course::lay_out).
    ///
    /// ```
    /// use uchain_sim::{mission::chain::Scenario, config::builtin};
    /// let source = builtin("corner").unwrap();
    /// let scenario = Scenario::parse(&source, &["chain.uavs=3".to_owned()]).unwrap();
    /// assert_eq!(scenario.chain.uavs, 3);
    /// let error = Scenario::parse(&source, &["chain.uavz=3".to_owned()]).unwrap_err();
    /// assert!(error.to_string().contains("did you mean 'uavs'?"));
    /// ```
    ///
    /// # Errors
    /// The first thing found wrong, with its place.
    pub fn parse(source: &Source, sets: &[String]) -> Result<Self, ConfigError> {
        let document = Document::parse(source, sets, &KNOWN)?;
        Self::from_document(&document)
    }

    /// The whole scenario in TOML: every value it has, whether written, set, from a preset or by default. Read
    /// again it is the same scenario, without a preset.
    ///
    /// # Errors
    /// None that a scenario from [`Scenario::parse`] could cause.
    ///
    /// ```
    /// use uchain_sim::{mission::chain::Scenario, config::{Source, builtin}};
    /// let scenario = Scenario::parse(&builtin("bend").unwrap(), &["chain.uavs=3".to_owned()]).unwrap();
    /// let text = scenario.to_toml().unwrap();
    /// assert!(text.contains("uavs = 3") && text.contains("sigma_db = "));
    /// let again = Source { text, ..builtin("bend").unwrap() };
    /// assert_eq!(Scenario::parse(&again, &[]).unwrap(), scenario);
    /// ```
    pub fn to_toml(&self) -> Result<String, toml::ser::Error> {
        toml::to_string(&Self { preset: None, ..self.clone() })
    }

    pub(crate) fn from_document(document: &Document<'_>) -> Result<Self, ConfigError> {
        let scenario = Self::unchecked(document)?;
        values(&scenario, document)?;
        Ok(scenario)
    }

    /// With values of the right types, whatever they are.
    pub(crate) fn unchecked(document: &Document<'_>) -> Result<Self, ConfigError> {
        is_chain(document)?;
        Self::deserialize(ValueDeserializer::from(document.root()))
            .map_err(|error| explain_error(&error, document))
    }
}

/// An error for what is no chain at all, where one is asked for.
fn is_chain(document: &Document<'_>) -> Result<(), ConfigError> {
    if !document.has("explore") {
        return Ok(());
    }
    if document.has("chain") {
        return Err(document.invalid(
            "chain",
            "{ … }",
            "belongs to a chain, and a scenario with [explore] is an exploration; expected one of the two",
        ));
    }
    Err(ConfigError::Invalid {
        at: document.origin("explore"),
        key: "explore".to_owned(),
        got: "{ … }".to_owned(),
        expected: "this is an exploration; expected a chain, with [chain] and [[pilot]]".to_owned(),
    })
}
