//! Every key of a scenario by its full name, to find the one that was meant.

use uchain_core::{
    chain::{CenterParams, EqualizeParams, KalmanParams, LinkParams, TakeoffParams},
    explore::ExploreParams,
    params::Key,
};

use super::{CorridorConfig, MovingAiConfig, RosConfig, WallsConfig, diagnose::Choices};
use crate::mission::{
    chain::{ChainConfig, PilotStep, Scenario},
    explore::TeamConfig,
};
use crate::{
    radio::{Dead, Deaf, FaultConfig, PacketParams, PathLossParams},
    sense::{FlowParams, TofParams},
    world::{MotionParams, QuadrotorParams},
};

/// What the top of a scenario file may hold beside [`Scenario::KEYS`].
pub(super) const EXPLORE: Key = Key {
    name: "explore",
    range: None,
    doc: "Robots that explore together. A scenario with this table has neither `chain` nor `pilot`, nor any of the \
          tables behind them.",
};

/// Every table with its keys, some in several parts; of a list of tables the first entry stands for all.
pub(super) const TABLES: [(&str, &[Key]); 24] = [
    ("", Scenario::KEYS),
    ("", &[EXPLORE]),
    ("map.corridor", CorridorConfig::KEYS),
    ("map.walls", WallsConfig::KEYS),
    ("map.movingai", MovingAiConfig::KEYS),
    ("map.ros", RosConfig::KEYS),
    ("chain", ChainConfig::KEYS),
    ("pilot.0", PilotStep::KEYS),
    ("kalman", KalmanParams::KEYS),
    ("equalize", EqualizeParams::KEYS),
    ("center", CenterParams::KEYS),
    ("takeoff", TakeoffParams::KEYS),
    ("link", LinkParams::KEYS),
    ("radio", PathLossParams::KEYS),
    ("packets", PacketParams::KEYS),
    ("faults", FaultConfig::KEYS),
    ("faults.deaf.0", Deaf::KEYS),
    ("faults.dead.0", Dead::KEYS),
    ("tof", TofParams::KEYS),
    ("flow", FlowParams::KEYS),
    ("motion", MotionParams::KEYS),
    ("explore", TeamConfig::KEYS),
    ("explore", ExploreParams::KEYS),
    ("explore.quadrotor", QuadrotorParams::KEYS),
];

/// Whether a table has this key.
pub(super) fn holds(table: &str, key: &str) -> bool {
    TABLES
        .iter()
        .filter(|(name, _)| *name == table)
        .any(|(_, keys)| keys.iter().any(|known| known.name == key))
}

/// `table.key`; a key of the whole stands alone.
pub(super) fn join(table: &str, key: &str) -> String {
    if table.is_empty() { key.to_owned() } else { format!("{table}.{key}") }
}

/// Keys that files once had, and the one that says it now.
const RENAMED: [(&str, &str); 1] = [("center.tof_range_m", "tof.range_m")];

/// The present name of a key that is called otherwise now, by its full name or the last part of it.
pub(super) fn renamed(key: &str) -> Option<&'static str> {
    let is_it = |old: &str| old == key || old.rsplit('.').next() == Some(key);
    RENAMED.iter().find(|(old, _)| is_it(old)).map(|(_, new)| *new)
}

/// Full names of the keys and tables whose last part is `word`.
pub(super) fn called(word: &str) -> Vec<String> {
    all().filter(|(_, name)| *name == word).map(|(table, name)| join(table, name)).collect()
}

/// Full name of the one key whose last part is `word` but for a slip of the finger.
pub(super) fn nearly_called(word: &str) -> Option<String> {
    let nearest = Choices::for_word(word, all().map(|(_, name)| name.to_owned()).collect()).nearest?;
    let slips = strsim::damerau_levenshtein(word, &nearest);
    let [only] = <[String; 1]>::try_from(called(&nearest)).ok()?;
    (slips <= 1 + word.len() / 8 || nearest.contains(word)).then_some(only)
}

/// Table and name of every key and table.
fn all() -> impl Iterator<Item = (&'static str, &'static str)> {
    let keys = TABLES.iter().flat_map(|(table, keys)| keys.iter().map(move |key| (*table, key.name)));
    // The tables of a choice are nobody's keys.
    let within = TABLES.iter().filter_map(|(table, _)| table.rsplit_once('.'));
    keys.chain(within.filter(|(_, name)| *name != "0"))
}
