//! What a node is set to: the values of a scenario that a node on a drone has.

use serde::Deserialize;
use toml::de::ValueDeserializer;
use uchain_core::chain::{CenterParams, EqualizeParams, KalmanParams, LinkParams, NodeParams, TakeoffParams};

use crate::{
    config::{Check, Choices, ConfigError, Document, Keys, KnownKeys, Source, explain_error},
    mission::chain::agreed,
    sense::TofParams,
};

/// How an error about a key begins that a scenario has and a node has not: nothing may stand there.
pub const NO_VALUE: &str = "no value of a node";

/// The tables of a scenario that a node reads, and of the distance sensors their range.
const KEYS: Keys = Keys {
    marker: None,
    tables: &[
        ("kalman", KalmanParams::KEYS),
        ("equalize", EqualizeParams::KEYS),
        ("center", CenterParams::KEYS),
        ("takeoff", TakeoffParams::KEYS),
        ("link", LinkParams::KEYS),
        ("tof", TofParams::KEYS),
    ],
    renamed: &[("center.tof_range_m", "tof.range_m")],
};

/// What a replay is flown with.
#[derive(Debug, Clone)]
pub struct Settings {
    /// The values of the laws.
    pub params: NodeParams,
    /// Its place where the log tells none; 0 is the head.
    pub place: u16,
    /// Somebody asked for that place: a log that tells another one is noted.
    pub is_place_asked: bool,
    /// The log begins in the air: it takes off at its first packet, and has risen at once.
    pub is_airborne: bool,
}

/// The values as they are written; those of a preset that are no node's are passed over.
#[derive(Deserialize)]
struct Written {
    #[serde(default)]
    kalman: KalmanParams,
    #[serde(default)]
    equalize: EqualizeParams,
    #[serde(default)]
    center: CenterParams,
    #[serde(default)]
    takeoff: TakeoffParams,
    #[serde(default)]
    link: LinkParams,
    #[serde(default)]
    tof: TofParams,
}

impl Settings {
    /// The defaults, with `sets` (`key=value`) written over them as over a scenario, `preset=NAME` among them. A relay
    /// at place 1.
    ///
    /// ```
    /// use uchain_sim::log::Settings;
    /// let settings = Settings::read(&["preset=cavemod".into(), "link.lost_s=2".into()]).unwrap();
    /// assert_eq!((settings.params.equalize.decision_s, settings.params.link.lost_s), (0.1, 2.0));
    /// let error = Settings::read(&["radio.sigma_db=3".into()]).unwrap_err();
    /// assert!(error.to_string().contains("no value of a node"));
    /// ```
    ///
    /// # Errors
    /// A key that a node has not, a value it must not have; each names its place.
    pub fn read(sets: &[String]) -> Result<Self, ConfigError> {
        let source = Source { label: "a node".to_owned(), text: String::new(), folder: "".into() };
        let known = KnownKeys::of(&[&KEYS]);
        let document = Document::parse(&source, sets, &known)?;
        for set in sets {
            of_a_node(set, &document)?;
        }
        let root = ValueDeserializer::from(document.root());
        let written = Written::deserialize(root).map_err(|error| explain_error(&error, &document))?;
        let check = Check { document: &document };
        for (table, checked) in [
            ("kalman", written.kalman.check()),
            ("equalize", written.equalize.check()),
            ("center", written.center.check()),
            ("takeoff", written.takeoff.check()),
            ("link", written.link.check()),
            ("tof", written.tof.check()),
        ] {
            check.ranged(table, checked)?;
        }
        agreed(&written.link, written.takeoff.s_min_db, true, &document)?;
        let Written { kalman, equalize, center, takeoff, link, tof } = written;
        let params = NodeParams { kalman, equalize, center, takeoff, link, tof_range_m: tof.range_m };
        Ok(Self { params, place: 1, is_place_asked: false, is_airborne: false })
    }

    /// What the node is made with.
    pub(super) fn node_params(&self) -> NodeParams {
        let mut params = self.params.clone();
        if self.is_airborne {
            let takeoff = &mut params.takeoff;
            takeoff.s_min_db = f32::NEG_INFINITY;
            (takeoff.launch_hold_s, takeoff.rise_s, takeoff.hover_s) = (0.0, 0.0, 0.0);
            takeoff.after_previous_s = 0.0;
            takeoff.launch = uchain_core::chain::Launch::Threshold;
        }
        params
    }
}

/// An error for a key of a scenario that is nothing to a node.
fn of_a_node(set: &str, document: &Document<'_>) -> Result<(), ConfigError> {
    let steps = document.resolve(set.split('=').next().unwrap_or_default());
    let table = steps.first().map_or("", String::as_str);
    let is_known = match steps.as_slice() {
        [only] => only == "preset" || KEYS.tables.iter().any(|(name, _)| name == only),
        [tof, key, ..] if tof == "tof" => key == "range_m",
        _ => KEYS.tables.iter().any(|(name, _)| *name == table),
    };
    if is_known {
        return Ok(());
    }
    let key = steps.join(".");
    let tables = KEYS.tables.iter().map(|(name, _)| *name).filter(|name| *name != "tof");
    let known: Vec<String> = tables
        .map(|name| format!("{name}.…"))
        .chain(["tof.range_m".to_owned(), "preset".to_owned()])
        .collect();
    let nearest =
        Choices::for_word(table, KEYS.tables.iter().map(|(name, _)| (*name).to_owned()).collect()).nearest;
    let meant = nearest
        .filter(|name| name != table)
        .map(|name| format!("did you mean '{name}'? "))
        .unwrap_or_default();
    Err(document.invalid(&key, "…", format!("{NO_VALUE}: {meant}expected one of {}", known.join(", "))))
}
