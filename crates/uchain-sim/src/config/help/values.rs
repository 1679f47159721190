//! What presets and scenarios write at a key.

use serde_json::Value;

use super::super::{PRESETS, Preset, builtin, builtin_names};

/// What somebody wrote at a key.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Written {
    /// Name of the preset or scenario.
    pub by: &'static str,
    /// The value in TOML, shortened if it is long; of a list of tables the values in all its entries.
    pub value: String,
    /// Where a preset has it from: the comment behind it.
    pub source: Option<String>,
}

pub(super) fn in_presets(path: &str) -> Vec<Written> {
    let of = |preset: &Preset| {
        Some(Written { source: comment(preset.text, path), ..written(preset.name, preset.text, path)? })
    };
    PRESETS.iter().filter_map(of).collect()
}

/// What is said behind a value, on its line.
fn comment(text: &str, path: &str) -> Option<String> {
    let mut table = "";
    for line in text.lines().map(str::trim) {
        if let Some(heading) = line.strip_prefix('[').and_then(|line| line.strip_suffix(']')) {
            table = heading;
        } else if let Some((key, rest)) = line.split_once('=')
            && path.strip_prefix(table).and_then(|path| path.strip_prefix('.')) == Some(key.trim())
        {
            return rest.split_once(" # ").map(|(_, comment)| comment.trim().to_owned());
        }
    }
    None
}

pub(super) fn in_scenarios(path: &str) -> Vec<Written> {
    let texts = builtin_names().iter().filter_map(|name| Some((*name, builtin(name)?.text)));
    texts.filter_map(|(name, text)| written(name, &text, path)).collect()
}

fn written(by: &'static str, text: &str, path: &str) -> Option<Written> {
    // The compiled-in texts are tested; one that did not parse would have nothing to say.
    let table = toml::Value::Table(text.parse().ok()?);
    let mut found = Vec::new();
    let steps: Vec<&str> = path.split('.').collect();
    follow(&table, &steps, &mut found);
    let values: Vec<String> = found.into_iter().map(|value| shortened(&value.to_string())).collect();
    (!values.is_empty()).then(|| Written { by, value: values.join(", "), source: None })
}

fn follow<'v>(value: &'v toml::Value, steps: &[&str], found: &mut Vec<&'v toml::Value>) {
    let Some((step, rest)) = steps.split_first() else {
        // Tables speak through their keys.
        if !value.is_table() && !value.as_array().is_some_and(|items| items.iter().any(toml::Value::is_table))
        {
            found.push(value);
        }
        return;
    };
    match value {
        toml::Value::Table(table) => {
            if let Some(next) = table.get(*step) {
                follow(next, rest, found);
            }
        }
        toml::Value::Array(items) if *step == "0" => {
            for item in items {
                follow(item, rest, found);
            }
        }
        _ => {}
    }
}

/// A default in TOML, without the point of a whole number.
pub(super) fn short(value: &Value) -> String {
    match value {
        Value::Number(number) => number.as_f64().map_or_else(|| number.to_string(), |n| n.to_string()),
        other => shortened(&other.to_string()),
    }
}

fn shortened(text: &str) -> String {
    const LONGEST: usize = 60;
    if text.chars().nth(LONGEST).is_none() {
        return text.to_owned();
    }
    text.chars().take(LONGEST - 1).chain(['…']).collect()
}
