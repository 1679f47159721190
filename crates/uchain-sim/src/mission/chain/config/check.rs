//! Ranges of a chain's scenario, and keys of it that must agree.

use uchain_core::chain::{LinkParams, TakeoffParams};

use super::Scenario;
use crate::{
    config::{Check, ConfigError, DURATION_MAX_S, Document},
    pilot::INPUTS_MAX,
};

/// Most UAVs in one chain.
pub const UAVS_MAX: usize = 1000;

/// Most entries of each list of planned faults.
const FAULTS_MAX: usize = 10_000;

/// The first value outside its range.
pub(crate) fn values(scenario: &Scenario, document: &Document<'_>) -> Result<(), ConfigError> {
    let check = Check { document };
    check.name(&scenario.name)?;
    check.ranged("", scenario.check())?;
    check.ticks("duration_s", scenario.duration_s)?;
    check.map(&scenario.map)?;
    chain(&check, scenario)?;
    pilot(&check, scenario)?;
    params(&check, scenario)?;
    faults(&check, scenario)?;
    check.ticks("equalize.decision_s", f64::from(scenario.equalize.decision_s))?;
    check.ticks("tof.period_s", f64::from(scenario.tof.period_s))
}

/// Thresholds of the head and of relays that leave the next relay no chance to take off, and so are no chain to fly; a
/// plan may ask for them.
pub(crate) fn thresholds(scenario: &Scenario, document: &Document<'_>) -> Result<(), ConfigError> {
    let has_relays = scenario.chain.uavs > 1;
    agreed(&scenario.link, scenario.takeoff.s_min_db, has_relays, document)
}

/// The same of one node's values.
pub(crate) fn agreed(
    link: &LinkParams,
    s_min_db: f32,
    has_relays: bool,
    document: &Document<'_>,
) -> Result<(), ConfigError> {
    let check = Check { document };
    if link.head_back_db < link.head_stop_db {
        let expected = format!(
            "must be at least link.head_stop_db = {}: the head stops before it flies back",
            link.head_stop_db
        );
        return Err(check.invalid("link.head_back_db", &link.head_back_db, expected));
    }
    if !has_relays {
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

fn chain(check: &Check<'_>, scenario: &Scenario) -> Result<(), ConfigError> {
    let chain = &scenario.chain;
    check.ranged("chain", chain.check())?;
    check.point("chain.base_m", chain.base_m)?;
    if let Some(goal_m) = chain.goal_m {
        check.point("chain.goal_m", goal_m)?;
    }
    let Some(spawns) = &chain.spawns_m else { return Ok(()) };
    if spawns.len() != chain.uavs {
        let expected = format!(
            "must be one place per UAV (chain.uavs = {}); with these places: --set chain.uavs={}; without them UAVs \
             wait in a row",
            chain.uavs,
            spawns.len().max(1)
        );
        return Err(check.invalid("chain.spawns_m", &format!("{} places", spawns.len()), expected));
    }
    spawns.iter().enumerate().try_for_each(|(i, &at)| check.point(&format!("chain.spawns_m.{i}"), at))
}

fn pilot(check: &Check<'_>, scenario: &Scenario) -> Result<(), ConfigError> {
    let pilot = &scenario.pilot;
    // A flight by hand is a scenario.
    if pilot.len() > INPUTS_MAX {
        let expected = format!("must be at most {INPUTS_MAX} steps");
        return Err(check.invalid("pilot", &format!("{} steps", pilot.len()), expected));
    }
    let mut before_s = None;
    for (i, step) in pilot.iter().enumerate() {
        check.ranged(&format!("pilot.{i}"), step.check())?;
        if let Some(before_s) = before_s.filter(|&b| step.start_s <= b) {
            let expected = format!("must be later than the step before it, which starts at {before_s} s");
            return Err(check.invalid(&format!("pilot.{i}.start_s"), &step.start_s, expected));
        }
        before_s = Some(step.start_s);
    }
    Ok(())
}

fn params(check: &Check<'_>, scenario: &Scenario) -> Result<(), ConfigError> {
    let tables = [
        ("kalman", scenario.kalman.check()),
        ("equalize", scenario.equalize.check()),
        ("center", scenario.center.check()),
        ("takeoff", scenario.takeoff.check()),
        ("link", scenario.link.check()),
        ("radio", scenario.radio.check_all()),
        ("packets", scenario.packets.check()),
        ("tof", scenario.tof.check()),
        ("flow", scenario.flow.check()),
        ("motion", scenario.motion.check()),
    ];
    tables.into_iter().try_for_each(|(table, checked)| check.ranged(table, checked))
}

fn faults(check: &Check<'_>, scenario: &Scenario) -> Result<(), ConfigError> {
    let faults = &scenario.faults;
    check.ranged("faults", faults.check())?;
    for (key, count) in [("faults.deaf", faults.deaf.len()), ("faults.dead", faults.dead.len())] {
        if count > FAULTS_MAX {
            let expected = format!("must be at most {FAULTS_MAX} entries");
            return Err(check.invalid(key, &format!("{count} entries"), expected));
        }
    }
    let uavs = scenario.chain.uavs;
    for (i, deaf) in faults.deaf.iter().enumerate() {
        let entry = format!("faults.deaf.{i}");
        one_of_the_chain(check, &entry, deaf.uav, uavs)?;
        check.ranged(&entry, deaf.check())?;
        let Some(stop_s) = deaf.stop_s else { continue };
        let (key, start_s) = (format!("{entry}.stop_s"), deaf.start_s);
        if !stop_s.is_finite() || stop_s <= start_s {
            let expected = format!("must be later than start_s = {start_s}; without it, to the end");
            return Err(check.invalid(&key, &stop_s, expected));
        }
        check.range(&key, stop_s, 0.0, DURATION_MAX_S)?;
    }
    faults.dead.iter().enumerate().try_for_each(|(i, dead)| {
        let entry = format!("faults.dead.{i}");
        one_of_the_chain(check, &entry, dead.uav, uavs)?;
        check.ranged(&entry, dead.check())
    })
}

fn one_of_the_chain(check: &Check<'_>, entry: &str, uav: usize, uavs: usize) -> Result<(), ConfigError> {
    if uav < uavs {
        return Ok(());
    }
    let expected = format!("must be a UAV of the chain: 0, the head, to {}", uavs.saturating_sub(1));
    Err(check.invalid(&format!("{entry}.uav"), &uav, expected))
}
