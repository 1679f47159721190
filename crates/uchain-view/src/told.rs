//! What a page says of a flight: a scenario with all that it takes to fly it, what a pilot asks for, and when.

use serde::{Deserialize, Serialize};
use uchain_core::chain::Follow;
use uchain_sim::{config::Source, map::Map, record::mcap::walls_to_csv};

/// A flight in a file, or in a link: what is needed to fly it again, bit for bit.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct FlightFile {
    kind: Kind,
    /// What messages call the scenario.
    pub(crate) label: String,
    /// The scenario in TOML.
    pub(crate) text: String,
    #[serde(default = "one", with = "crate::seed")]
    pub(crate) seed: u64,
    /// The walls, where the scenario names a file: a table as in recordings.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) walls_csv: Option<String>,
    /// Where the origin of these walls lies in the frame of the map's file (m).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) map_offset_m: Option<[f64; 2]>,
    /// What its pilot asked for, in order; nothing if the scenario's script is flown.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) inputs: Vec<TimedInput>,
}

pub(crate) fn one() -> u64 {
    1
}

#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Kind {
    Scenario,
}

impl FlightFile {
    pub(crate) fn new(source: &Source, seed: u64, walls: Option<&Map>) -> Self {
        Self {
            kind: Kind::Scenario,
            label: source.label.clone(),
            text: source.text.clone(),
            seed,
            walls_csv: walls.map(walls_to_csv),
            map_offset_m: walls.map(Map::offset_m),
            inputs: Vec::new(),
        }
    }

    /// The same, flown by hand.
    pub(crate) fn with_inputs(&self, inputs: Vec<TimedInput>) -> Self {
        Self { inputs, ..self.clone() }
    }
}

/// What a pilot asks for on a page.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct Input {
    pub(crate) speed_mps: f32,
    #[serde(default)]
    pub(crate) follow: Follow,
}

/// And when.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct TimedInput {
    pub(crate) tick: u64,
    pub(crate) speed_mps: f32,
    #[serde(default)]
    pub(crate) follow: Follow,
}

/// How far a page knows the graph of an exploration.
#[derive(Debug, Clone, Copy, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct Since {
    pub(crate) nodes: usize,
    pub(crate) labels: usize,
    pub(crate) edges: usize,
}

/// An input as a page says it, checked where it is flown.
impl From<TimedInput> for Input {
    fn from(timed: TimedInput) -> Self {
        Self { speed_mps: timed.speed_mps, follow: timed.follow }
    }
}
