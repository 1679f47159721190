mod missions;

use std::collections::{BTreeMap, BTreeSet};

use super::{
    super::{ConfigError, KnownKeys, PRESETS, Source, builtin, keys::join},
    Explanation,
    schema::entries,
};
use crate::{
    map::FORMATS,
    mission::{
        Scene as _,
        chain::{ChainConfig, Course, Scenario, UAVS_MAX},
        explore::{ExploreScenario, Site},
    },
    registry::Registry,
};

fn explain(name: &str) -> Result<Vec<Explanation>, ConfigError> {
    Registry::default().explain(name)
}

fn schema() -> serde_json::Value {
    Registry::default().schema()
}

/// Scenarios that have every table between them.
const STRAIGHT: &str = "straight";
const APARTMENT: &str = "apartment";

/// The whole scenario in TOML.
fn parse(name: &str, set: &str) -> Result<String, ConfigError> {
    let source = builtin(name).or_else(|| Source::find(name).ok()).unwrap();
    if builtin(name).is_none() || name == APARTMENT {
        return ExploreScenario::parse(&source, &[set.to_owned()]).map(|read| read.to_toml().unwrap());
    }
    let faults = "faults={deaf=[{uav=0,side=\"back\"}],dead=[{uav=1,start_s=5}]}";
    Scenario::parse(&source, &[faults.to_owned(), set.to_owned()]).map(|read| read.to_toml().unwrap())
}

fn parse_for(key: &str, set: &str) -> Result<String, ConfigError> {
    let is_in = |table: &str| key.starts_with(table);
    // A map that nobody reads.
    let bare = FORMATS.iter().filter(|format| is_in(format.table)).find_map(|format| format.ends.first());
    match bare {
        Some(end) => parse(&format!("city.{end}"), set),
        None if is_in("map.walls") || is_in("explore") => parse(APARTMENT, set),
        None => parse(STRAIGHT, set),
    }
}

/// The keys that are looked up.
fn known() -> KnownKeys {
    KnownKeys::of(&[Course::KEYS, Site::KEYS])
}

fn all() -> Vec<Explanation> {
    explain("").unwrap()
}

#[test]
fn the_keys_that_are_explained_are_those_that_the_reader_takes() {
    let mut explained: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for Explanation { key, kind, .. } in all() {
        let (table, name) = key.rsplit_once('.').unwrap_or(("", &key));
        explained.entry(table.to_owned()).or_default().insert(name.to_owned());
        if kind == "list of tables" {
            explained.entry(format!("{key}.0")).or_default();
        }
    }
    for (table, names) in &explained {
        // The reader's own list of what it takes stands in its answer to a key it does not know.
        let set = match table.as_str() {
            "" => "nonsense=1".to_owned(),
            "map" => "map={nonsense=1}".to_owned(),
            table => format!("{table}.nonsense=1"),
        };
        let said = parse_for(table, &set).unwrap_err();
        let (ConfigError::UnknownKey { choices, .. } | ConfigError::UnknownChoice { choices, .. }) = said
        else {
            panic!("{set}: {said}")
        };
        let mut known: BTreeSet<String> = choices.known.into_iter().collect();
        if table.is_empty() {
            // A chain takes all but this one, which makes it none.
            known.insert("explore".to_owned());
        }
        assert_eq!(&known, names, "[{table}]");
    }
    // The list by which a misplaced key is found is complete as well.
    let mut listed: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for (table, key) in known().keys() {
        listed.entry(table.to_owned()).or_default().insert(key.name.to_owned());
    }
    explained.remove("map");
    assert_eq!(listed, explained);
}

#[test]
fn every_number_has_a_range_and_it_is_the_readers() {
    for Explanation { key, kind, range, .. } in all() {
        if !kind.ends_with("number") {
            continue;
        }
        let (low, high) = range.unwrap_or_else(|| panic!("{key} has no range"));
        let step = |bound: f64| if kind == "number" { 1e-3 * bound.abs().max(1e-3) } else { 1.0 };
        let message = |value: f64| match parse_for(&key, &format!("{key}={value}")) {
            Ok(_) => String::new(),
            Err(error) => error.to_string(),
        };
        for beyond in [low - step(low), high + step(high)] {
            let said = message(beyond);
            let is_range = said.contains(&format!("must lie in {low}..={high}"))
                || said.contains(&format!(": expected a whole number, {low} to {high}"));
            let is_other =
                [": expected a whole number, not negative", "must be a UAV of the chain", "must be later"];
            assert!(
                is_range || is_other.iter().any(|other| said.contains(other)),
                "{key} = {beyond}: {said}"
            );
        }
        for bound in [low, high] {
            assert!(!message(bound).contains("must lie in"), "{key} = {bound}: {}", message(bound));
        }
    }
    let uavs = ChainConfig::KEYS.iter().find(|key| key.name == "uavs").unwrap();
    assert_eq!(uavs.range, Some((1.0, UAVS_MAX as f64)));
}

#[test]
fn every_key_is_explained_in_full() {
    for key in all() {
        let Explanation { key, kind, meaning, unit, default, source, choices, .. } = &key;
        assert!(meaning.len() > 5 && meaning.ends_with(['.', ')']), "{key}: {meaning:?}");
        assert!(choices.iter().all(|(_, meaning)| !meaning.is_empty()), "{key}: {choices:?}");
        let symbol = unit.map_or("1", |unit| unit.symbol);
        let counts = *kind == "whole number" && unit.is_none();
        if kind.ends_with("number") && !counts {
            assert!(meaning.contains(&format!("({symbol})")), "{key}: no ({symbol}) in {meaning:?}");
        }
        let is_tunable = kind.ends_with("number") && default.is_some();
        assert!(!is_tunable || source.is_some(), "{key} has a default from nowhere");
    }
}

#[test]
fn ranges_and_words_are_those_beside_the_laws() {
    let schema = schema();
    let entries = entries(&schema);
    for (table, key) in known().keys() {
        let path = join(table, key.name);
        let entry = entries.iter().find(|entry| entry.path == path).unwrap();
        let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
        let said = entry.schema["description"].as_str().unwrap();
        if path == "map" {
            // In files it names the kinds of maps there are, one by one.
            assert!(FORMATS.iter().all(|format| said.contains(&format!("`[{}]`", format.table))), "{said}");
        } else {
            assert_eq!(words(said), words(key.doc), "{path}");
        }
        if let Some((low, high)) = key.range {
            let bound = |name: &str| entry.schema[name].as_f64().unwrap();
            assert_eq!((bound("minimum"), bound("maximum")), (low, high), "{path}");
        }
    }
}

#[test]
fn defaults_are_what_is_flown_if_nothing_is_written() {
    let flown = |name: &str| toml::Value::Table(parse(name, "name=x").unwrap().parse().unwrap());
    let (chain, exploration) = (flown(STRAIGHT), flown(APARTMENT));
    let mut compared = 0;
    for Explanation { key, default, scenarios, .. } in all() {
        let (name, flown) =
            if key.starts_with("explore") { (APARTMENT, &exploration) } else { (STRAIGHT, &chain) };
        let (Some(default), false) = (default, scenarios.iter().any(|w| w.by == name)) else {
            continue;
        };
        let mut here = Some(flown);
        for step in key.split('.') {
            here = here.and_then(|value| value.get(step).or_else(|| value.get(step.parse::<usize>().ok()?)));
        }
        // What is left out of a file, and the entries of `parse`, are not in the other list.
        let Some(value) = here.filter(|value| !value.is_array()) else { continue };
        let same = match value.as_float() {
            Some(float) => default.parse::<f32>().unwrap() == float as f32,
            None => default == value.to_string(),
        };
        assert!(same, "{key}: {default} is not {value}");
        compared += 1;
    }
    assert!(compared > 85, "{compared}");
}

#[test]
fn a_key_is_found_by_its_full_name_by_its_last_part_and_by_the_name_of_its_table() {
    let keys = |name: &str| explain(name).unwrap().into_iter().map(|found| found.key).collect::<Vec<_>>();
    for name in ["pilot.0.speed_mps", "pilot.1.speed_mps", "pilot.speed_mps", "speed_mps"] {
        assert_eq!(keys(name), ["pilot.0.speed_mps"], "{name}");
    }
    assert_eq!(keys("flow"), ["flow", "flow.noise_mps"]);
    assert_eq!(keys("chain.base_m.1"), ["chain.base_m"]);
    let no = |name: &str| explain(name).unwrap_err().to_string();
    assert_eq!(no("law"), "no key is called 'law' (known: equalize.law, center.law)");
    assert_eq!(no("radio.alfa_wall"), "no key is called 'radio.alfa_wall'; did you mean 'radio.alpha_wall'?");
    for name in ["center.tof_range_m", "tof_range_m"] {
        assert!(no(name).ends_with("; did you mean 'tof.range_m'?"), "{}", no(name));
    }
    assert_eq!(no("0"), "no key is called '0'");
}

#[test]
fn an_explanation_says_who_writes_the_key() {
    let written = |name: &str| {
        let found = &explain(name).unwrap()[0];
        let pairs = |list: &[super::Written]| {
            list.iter().map(|w| format!("{} {}", w.by, w.value)).collect::<Vec<_>>()
        };
        (pairs(&found.presets), pairs(&found.scenarios))
    };
    assert_eq!(written("v_max_mps").0, ["cavemod 0.3", "frontiers2021 0.375"]);
    assert_eq!(written("follow_distance_m").1, ["stata 0.8"]);
    assert!(written("speed_mps").1.contains(&"corner 0.2, 0.0".to_owned()));
}

/// Nobody has to take a preset's number on trust.
#[test]
fn every_value_of_every_preset_says_where_it_is_from() {
    const SOURCES: [&str; 4] = ["the authors' simulator", "the authors' firmware", "Laclau 2021, ", "ours: "];
    let all = explain("").unwrap();
    for preset in PRESETS {
        let table: toml::Table = preset.text.parse().unwrap();
        let values = table.values().filter_map(toml::Value::as_table).map(toml::Table::len).sum::<usize>();
        let written = all.iter().flat_map(|key| &key.presets).filter(|written| written.by == preset.name);
        let sources: Vec<&str> = written.filter_map(|written| written.source.as_deref()).collect();
        assert_eq!(sources.len(), values, "{}: a value without a comment", preset.name);
        let unknown: Vec<&&str> =
            sources.iter().filter(|source| !SOURCES.iter().any(|known| source.starts_with(known))).collect();
        assert!(unknown.is_empty(), "{}: {unknown:?}", preset.name);
    }
    let head = &explain("link.head_stop_db").unwrap()[0];
    assert!(
        head.to_string().contains("cavemod: 65.0 (the authors' firmware: one threshold for all)"),
        "{head}"
    );
}
