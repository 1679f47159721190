//! Ranges of a scenario's own fields, and of every room's Params under their table's name.

use uchain_core::{
    chain::{LinkParams, TakeoffParams},
    params::OutOfRange,
};

use super::{ConfigError, MapConfig, Scenario, document::Document, keys::join};
use crate::clock;

/// Length of a tick (s). Every period is a multiple of it.
pub(super) const TICK_S: f64 = 1.0 / clock::TICKS_PER_S;

/// Longest run (s): a day.
pub(super) const DURATION_MAX_S: f64 = 86_400.0;

/// Most UAVs in one chain.
pub const UAVS_MAX: usize = 1000;

/// Most steps a pilot may take.
const PILOT_MAX: usize = 10_000;

/// Most entries of each list of planned faults.
const FAULTS_MAX: usize = 10_000;

/// Longest name of a scenario.
pub(super) const NAME_LENGTH_MAX: usize = 64;

/// Farthest place in a map's own frame (m): a surveyor's coordinates; `f64` keeps a millimetre there with ease.
pub(super) const FRAME_MAX_M: f64 = 1e9;

/// Farthest corner of a corridor (m); `f32` keeps a centimetre there.
pub(super) const COORDINATE_MAX_M: f64 = 100_000.0;

/// The first value outside its range.
pub(super) fn values(scenario: &Scenario, document: &Document<'_>) -> Result<(), ConfigError> {
    let check = Check { document };
    check.name(&scenario.name)?;
    check.ranged("", scenario.check())?;
    check.ticks("duration_s", scenario.duration_s)?;
    check.map(&scenario.map)?;
    check.chain(scenario)?;
    check.pilot(scenario)?;
    check.params(scenario)?;
    check.faults(scenario)?;
    check.ticks("equalize.decision_s", f64::from(scenario.equalize.decision_s))?;
    check.ticks("tof.period_s", f64::from(scenario.tof.period_s))
}

/// Thresholds of the head and of relays that leave the next relay no chance to take off, and so are no chain to fly; a
/// plan may ask for them.
pub(super) fn thresholds(scenario: &Scenario, document: &Document<'_>) -> Result<(), ConfigError> {
    let check = Check { document };
    let (link, s_min_db) = (&scenario.link, scenario.takeoff.s_min_db);
    if link.head_back_db < link.head_stop_db {
        let expected = format!(
            "must be at least link.head_stop_db = {}: the head stops before it flies back",
            link.head_stop_db
        );
        return Err(check.invalid("link.head_back_db", &link.head_back_db, expected));
    }
    if scenario.chain.uavs < 2 {
        return Ok(());
    }
    let defaults = (LinkParams::default(), TakeoffParams::default().s_min_db);
    let set =
        |key: &str, default_db: f32| format!(" --set link.{key}={}", s_min_db + default_db - defaults.1);
    let remedy = [
        set("head_stop_db", defaults.0.head_stop_db),
        set("head_back_db", defaults.0.head_back_db),
        set("relay_back_db", defaults.0.relay_back_db),
    ]
    .concat();
    for (key, got_db, what) in [
        ("link.head_stop_db", link.head_stop_db, "the head stops"),
        ("link.relay_back_db", link.relay_back_db, "relays fly back"),
    ] {
        if got_db > s_min_db {
            continue;
        }
        // The key that was written is the one to point at.
        let is_s_min = document.written("takeoff.s_min_db").is_some() && document.written(key).is_none();
        let (name, value_db, twin) = if is_s_min {
            ("takeoff.s_min_db", s_min_db, format!("must lie below {key} = {got_db}"))
        } else {
            (key, got_db, format!("must lie above takeoff.s_min_db = {s_min_db}"))
        };
        let expected = format!("{twin}: else {what} before the next relay takes off; such as{remedy}");
        return Err(check.invalid(name, &value_db, expected));
    }
    Ok(())
}

pub(super) struct Check<'d> {
    pub(super) document: &'d Document<'d>,
}

impl Check<'_> {
    pub(super) fn invalid(&self, key: &str, got: &dyn ToString, expected: impl Into<String>) -> ConfigError {
        ConfigError::Invalid {
            at: self.document.origin(key),
            key: key.to_owned(),
            got: self.document.written(key).unwrap_or_else(|| got.to_string()),
            expected: expected.into(),
        }
    }

    pub(super) fn range(&self, key: &str, got: f64, low: f64, high: f64) -> Result<(), ConfigError> {
        if (low..=high).contains(&got) {
            return Ok(());
        }
        Err(self.invalid(key, &got, format!("must lie in {low}..={high}")))
    }

    /// The outcome of a table's own check, under the table's name.
    pub(super) fn ranged(&self, table: &str, checked: Result<(), OutOfRange>) -> Result<(), ConfigError> {
        checked.map_err(|OutOfRange { key, got, low, high }| {
            let key = join(table, key);
            self.invalid(&key, &got, format!("must lie in {low}..={high}"))
        })
    }

    pub(super) fn ticks(&self, key: &str, got_s: f64) -> Result<(), ConfigError> {
        if clock::is_period(got_s) {
            return Ok(());
        }
        Err(self.invalid(key, &got_s, format!("must be a multiple of the tick, {TICK_S} s")))
    }

    pub(super) fn name(&self, name: &str) -> Result<(), ConfigError> {
        let plain = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
        if (1..=NAME_LENGTH_MAX).contains(&name.len()) && name.chars().all(plain) {
            return Ok(());
        }
        let expected = format!(
            "must be 1 to {NAME_LENGTH_MAX} of the letters a-z, A-Z, 0-9, - and _ (it names the output folder)"
        );
        Err(self.invalid("name", &format!("{name:?}"), expected))
    }

    pub(super) fn map(&self, map: &MapConfig) -> Result<(), ConfigError> {
        match map {
            MapConfig::Corridor(corridor) => {
                self.ranged("map.corridor", corridor.check())?;
                for (i, corner) in corridor.centre_line_m.iter().enumerate() {
                    let key = format!("map.corridor.centre_line_m.{i}");
                    if !(2..=3).contains(&corner.len()) {
                        let got = format!("{} numbers", corner.len());
                        return Err(self.invalid(&key, &got, "must be [x, y] or [x, y, r]"));
                    }
                    for (j, &value_m) in corner.iter().enumerate() {
                        let low_m = if j == 2 { 0.0 } else { -COORDINATE_MAX_M };
                        self.range(&format!("{key}.{j}"), value_m, low_m, COORDINATE_MAX_M)?;
                    }
                }
                Ok(())
            }
            MapConfig::Walls(walls) => {
                let outer = walls.outer_m.iter().enumerate().map(|(i, at)| (format!("outer_m.{i}"), at));
                let inner = walls.inner_m.iter().enumerate().flat_map(|(loop_, corners)| {
                    let key = move |(i, at)| (format!("inner_m.{loop_}.{i}"), at);
                    corners.iter().enumerate().map(key)
                });
                outer.chain(inner).try_for_each(|(key, &at)| self.point(&format!("map.walls.{key}"), at))
            }
            MapConfig::Movingai(grid) => self.ranged("map.movingai", grid.check()),
            MapConfig::Ros(ros) => {
                let cell_m = ros.cell_m.map_or(Ok(()), |m| self.range("map.ros.cell_m", m, 0.001, 1000.0));
                cell_m.and_then(|()| self.ranged("map.ros", ros.check()))
            }
        }
    }

    fn chain(&self, scenario: &Scenario) -> Result<(), ConfigError> {
        let chain = &scenario.chain;
        self.ranged("chain", chain.check())?;
        self.point("chain.base_m", chain.base_m)?;
        if let Some(goal_m) = chain.goal_m {
            self.point("chain.goal_m", goal_m)?;
        }
        let Some(spawns) = &chain.spawns_m else { return Ok(()) };
        if spawns.len() != chain.uavs {
            let expected = format!(
                "must be one place per UAV (chain.uavs = {}); with these places: --set chain.uavs={}; without them UAVs \
                 wait in a row",
                chain.uavs,
                spawns.len().max(1)
            );
            return Err(self.invalid("chain.spawns_m", &format!("{} places", spawns.len()), expected));
        }
        spawns.iter().enumerate().try_for_each(|(i, &at)| self.point(&format!("chain.spawns_m.{i}"), at))
    }

    pub(super) fn point(&self, key: &str, at: [f64; 2]) -> Result<(), ConfigError> {
        // An array takes as many as it holds and asks no further.
        if let Some(count) = self.document.count(key).filter(|&count| count != at.len()) {
            return Err(self.invalid(key, &format!("{count} numbers"), "expected two numbers [x, y]"));
        }
        at.iter().enumerate().try_for_each(|(j, &value_m)| {
            self.range(&format!("{key}.{j}"), value_m, -FRAME_MAX_M, FRAME_MAX_M)
        })
    }

    fn pilot(&self, scenario: &Scenario) -> Result<(), ConfigError> {
        let pilot = &scenario.pilot;
        if pilot.len() > PILOT_MAX {
            let expected = format!("must be at most {PILOT_MAX} steps");
            return Err(self.invalid("pilot", &format!("{} steps", pilot.len()), expected));
        }
        let mut before_s = None;
        for (i, step) in pilot.iter().enumerate() {
            self.ranged(&format!("pilot.{i}"), step.check())?;
            if let Some(before_s) = before_s.filter(|&b| step.start_s <= b) {
                let expected = format!("must be later than the step before it, which starts at {before_s} s");
                return Err(self.invalid(&format!("pilot.{i}.start_s"), &step.start_s, expected));
            }
            before_s = Some(step.start_s);
        }
        Ok(())
    }

    fn params(&self, scenario: &Scenario) -> Result<(), ConfigError> {
        let tables = [
            ("kalman", scenario.kalman.check()),
            ("equalize", scenario.equalize.check()),
            ("center", scenario.center.check()),
            ("takeoff", scenario.takeoff.check()),
            ("link", scenario.link.check()),
            ("radio", scenario.radio.check()),
            ("packets", scenario.packets.check()),
            ("tof", scenario.tof.check()),
            ("flow", scenario.flow.check()),
            ("motion", scenario.motion.check()),
        ];
        tables.into_iter().try_for_each(|(table, checked)| self.ranged(table, checked))
    }

    fn faults(&self, scenario: &Scenario) -> Result<(), ConfigError> {
        let faults = &scenario.faults;
        self.ranged("faults", faults.check())?;
        for (key, count) in [("faults.deaf", faults.deaf.len()), ("faults.dead", faults.dead.len())] {
            if count > FAULTS_MAX {
                let expected = format!("must be at most {FAULTS_MAX} entries");
                return Err(self.invalid(key, &format!("{count} entries"), expected));
            }
        }
        let uavs = scenario.chain.uavs;
        for (i, deaf) in faults.deaf.iter().enumerate() {
            let entry = format!("faults.deaf.{i}");
            self.one_of_the_chain(&entry, deaf.uav, uavs)?;
            self.ranged(&entry, deaf.check())?;
            let Some(stop_s) = deaf.stop_s else { continue };
            let (key, start_s) = (format!("{entry}.stop_s"), deaf.start_s);
            if !stop_s.is_finite() || stop_s <= start_s {
                let expected = format!("must be later than start_s = {start_s}; without it, to the end");
                return Err(self.invalid(&key, &stop_s, expected));
            }
            self.range(&key, stop_s, 0.0, DURATION_MAX_S)?;
        }
        faults.dead.iter().enumerate().try_for_each(|(i, dead)| {
            let entry = format!("faults.dead.{i}");
            self.one_of_the_chain(&entry, dead.uav, uavs)?;
            self.ranged(&entry, dead.check())
        })
    }

    fn one_of_the_chain(&self, entry: &str, uav: usize, uavs: usize) -> Result<(), ConfigError> {
        if uav < uavs {
            return Ok(());
        }
        let expected = format!("must be a UAV of the chain: 0, the head, to {}", uavs.saturating_sub(1));
        Err(self.invalid(&format!("{entry}.uav"), &uav, expected))
    }
}
