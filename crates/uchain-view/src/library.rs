//! What a page can know without a flight: the scenarios that are compiled in, what keys mean, what is wrong with a text.

use std::path::PathBuf;

use serde::Serialize;
use serde_json::{Value, json};
use uchain_sim::{
    clock::TICK_S,
    config::{PRESETS, Source, TEXT_MAX_BYTES, builtin, builtin_names, help},
    registry::Registry,
};

use crate::problem::Problem;

/// The engine, and the scenarios that are compiled in. Those whose map is a file do not fly on a page by themselves.
pub(crate) fn about() -> Result<Value, Problem> {
    let mut scenarios = Vec::new();
    for source in builtin_names().iter().filter_map(|name| builtin(name)) {
        let about = Registry::default().describe(&source, &[])?;
        let kind = about.mission.kind();
        let flies = !names_a_file(&source.text);
        scenarios.push(
            json!({ "name": about.name, "description": about.description, "mission": kind, "flies": flies }),
        );
    }
    let presets: Vec<Value> = PRESETS
        .iter()
        .map(|preset| json!({ "name": preset.name, "description": preset.description() }))
        .collect();
    let version = env!("CARGO_PKG_VERSION");
    Ok(json!({ "version": version, "tick_s": TICK_S, "scenarios": scenarios, "presets": presets }))
}

/// Whether a scenario's map is a file.
fn names_a_file(text: &str) -> bool {
    let map = text.parse::<toml::Table>().ok().and_then(|mut table| table.remove("map"));
    map.and_then(|map| map.as_table().map(|kinds| kinds.values().any(|kind| kind.get("file").is_some())))
        .unwrap_or(false)
}

/// The text of a scenario that is compiled in.
pub(crate) fn text(name: &str) -> Result<String, Problem> {
    match builtin(name) {
        Some(source) => Ok(source.text),
        None => Err(Problem::new(format!(
            "no scenario is called {name:?}: there are {}",
            builtin_names().join(", ")
        ))),
    }
}

/// A text that is to be a scenario.
pub(crate) fn source(text: String, label: String) -> Result<Source, Problem> {
    if text.len() as u64 > TEXT_MAX_BYTES {
        return Err(Problem::new(format!(
            "{label}: longer than {TEXT_MAX_BYTES} bytes, expected a scenario in TOML"
        )));
    }
    Ok(Source { label, text, folder: PathBuf::new() })
}

/// What a text comes to as a scenario.
pub(crate) fn check(text: String, label: String) -> Result<Value, Problem> {
    let scene = Registry::default().read(&source(text, label)?, &[])?;
    Ok(json!({
        "title": scene.title(),
        "mission": scene.kind(),
        "crew": scene.crew(),
        "duration_s": scene.duration_s(),
        "notes": scene.notes(),
    }))
}

/// A key or table of a scenario.
#[derive(Serialize)]
pub(crate) struct Card {
    key: String,
    is_table: bool,
    meaning: String,
    symbol: Option<String>,
    equation: Option<String>,
    source: Option<String>,
    kind: &'static str,
    unit: Option<&'static str>,
    range: Option<(f64, f64)>,
    default: Option<String>,
    required: bool,
    choices: Vec<(String, String)>,
}

/// What a key means, or all keys of a table, or all.
pub(crate) fn explain(key: &str) -> Result<Vec<Card>, Problem> {
    let card = |card: help::Explanation| Card {
        key: card.key,
        is_table: card.is_table,
        meaning: card.meaning,
        symbol: card.symbol,
        equation: card.equation,
        source: card.source,
        kind: card.kind,
        unit: card.unit.map(|unit| unit.symbol),
        range: card.range,
        default: card.default,
        required: card.required,
        choices: card.choices,
    };
    Ok(Registry::default().explain(key)?.into_iter().map(card).collect())
}
