//! What every key of a scenario means. All of it is read off the declarations beside the laws, as the missions hand
//! them in: there is no second list.

mod card;
mod schema;
pub(crate) mod shape;
#[cfg(test)]
mod tests;
mod units;
mod values;

pub(crate) use schema::schema;
pub use schema::{schema_of, schema_with_table};
pub use units::Unit;
pub use values::Written;

use serde_json::{Map, Value};

use super::{ConfigError, diagnose::Choices, keys::KnownKeys};
use schema::{Entry, entries};
use values::{in_presets, in_scenarios, short};

/// One key or table of a scenario.
#[derive(Debug, Clone, PartialEq)]
pub struct Explanation {
    /// Full name; the first entry stands for a list of tables: `pilot.0.speed_mps`.
    pub key: String,
    /// Whether it holds keys of its own.
    pub is_table: bool,
    /// What it is, in a sentence or several.
    pub meaning: String,
    /// What it is called in formulae.
    pub symbol: Option<String>,
    /// The formula it stands in.
    pub equation: Option<String>,
    /// Where it, or its value, comes from.
    pub source: Option<String>,
    /// Kind of value: "number", "whole number", "true or false", "word" (one of the choices), "text", "list", "table",
    /// "list of tables".
    pub kind: &'static str,
    /// Unit of a number, or of the numbers in a list; `None` for a pure number and for what is no number.
    pub unit: Option<Unit>,
    /// Smallest and largest legal value of a number, or of each number in a list, both included.
    pub range: Option<(f64, f64)>,
    /// What counts if it is not written, in TOML; `None` if there is no such value.
    pub default: Option<String>,
    /// Whether it has to be written wherever its table is.
    pub required: bool,
    /// The words that may stand here, each with its meaning; empty where any may.
    pub choices: Vec<(String, String)>,
    /// What the presets write here.
    pub presets: Vec<Written>,
    /// What the compiled-in scenarios write here.
    pub scenarios: Vec<Written>,
}

/// What is known of a key, given by its full name (`radio.alpha_wall`, `pilot.0.speed_mps`) or, if only one key is
/// called so, by the last part of it. Of a table (`radio`), all its keys; of the empty name, all keys. A table comes
/// before its keys. `schema` is that of a scenario, `known` are its keys.
///
/// # Errors
/// [`ConfigError::NoSuchKey`] with the nearest name, or the keys whose names end so.
pub(crate) fn explain(
    name: &str,
    schema: &Value,
    known: &KnownKeys,
) -> Result<Vec<Explanation>, ConfigError> {
    let entries = entries(schema);
    let asked = plain(name);
    let within = format!("{asked}.");
    let chosen = |entry: &&Entry<'_>| {
        name.is_empty() || plain(&entry.path) == asked || plain(&entry.path).starts_with(&within)
    };
    let found: Vec<Explanation> = entries.iter().filter(chosen).map(Explanation::new).collect();
    if !found.is_empty() {
        return Ok(found);
    }
    match known.called(name).as_slice() {
        [only] => explain(only, schema, known),
        several => Err(no_such_key(name, several, &entries, known)),
    }
}

fn no_such_key(name: &str, called_so: &[String], entries: &[Entry<'_>], all: &KnownKeys) -> ConfigError {
    let paths = || entries.iter().map(|entry| entry.path.clone());
    let choices = if called_so.is_empty() {
        let near = || Choices::for_word(name, paths().collect()).nearest.or_else(|| all.nearly_called(name));
        let nearest = all.renamed(name).map(str::to_owned).or_else(near);
        let alike = |path: &String| name.len() > 2 && path.contains(name) && Some(path) != nearest.as_ref();
        let known = paths().filter(alike).collect();
        Choices { nearest, known }
    } else {
        Choices { nearest: None, known: called_so.to_vec() }
    };
    ConfigError::no_such_key(name, choices)
}

/// A name without the numbers of entries in lists.
fn plain(path: &str) -> String {
    let is_name = |step: &&str| !step.is_empty() && !step.bytes().all(|byte| byte.is_ascii_digit());
    path.split('.').filter(is_name).collect::<Vec<_>>().join(".")
}

impl Explanation {
    fn new(entry: &Entry<'_>) -> Self {
        let Entry { path, required, is_table, schema } = entry;
        let text = |key: &str| schema.get(key).and_then(Value::as_str).unwrap_or_default();
        let (meaning, [symbol, equation, source]) = taken_apart(text("description"));
        let item = schema.get("items").unwrap_or(&Value::Null);
        let bound = |key: &str| schema.get(key).or(item.get(key)).and_then(Value::as_f64);
        let choices = if *is_table { Vec::new() } else { choices(schema) };
        let kind = match text("type") {
            "array" if *is_table => "list of tables",
            _ if *is_table => "table",
            "number" => "number",
            "integer" => "whole number",
            "boolean" => "true or false",
            "array" => "list",
            _ if !choices.is_empty() => "word",
            _ => "text",
        };
        let name = path.rsplit('.').next().unwrap_or_default();
        let measures = ["number", "whole number", "list"].contains(&kind);
        Self {
            key: path.clone(),
            is_table: *is_table,
            meaning,
            symbol,
            equation,
            source,
            kind,
            unit: units::unit(name).filter(|_| measures),
            range: bound("minimum").zip(bound("maximum")),
            default: schema.get("default").map(short),
            required: *required,
            choices,
            presets: in_presets(path),
            scenarios: in_scenarios(path),
        }
    }

    /// The first sentence of the meaning.
    pub fn headline(&self) -> &str {
        let end = self.meaning.find(". ").unwrap_or(self.meaning.len());
        self.meaning.get(..end).unwrap_or_default().trim_end_matches('.')
    }
}

/// Words of an enum, each with its meaning.
fn choices(schema: &Map<String, Value>) -> Vec<(String, String)> {
    let words = schema.get("enum").and_then(Value::as_array).map(Vec::as_slice).unwrap_or_default();
    let meanings = schema.get("x-taplo").and_then(|taplo| taplo["docs"]["enumValues"].as_array());
    let meanings = meanings.map(Vec::as_slice).unwrap_or_default();
    let text = |value: &Value| taken_apart(value.as_str().unwrap_or_default()).0;
    words.iter().zip(meanings).map(|(word, meaning)| (text(word), text(meaning))).collect()
}

/// A doc comment as its meaning, symbol, equation and source.
fn taken_apart(doc: &str) -> (String, [Option<String>; 3]) {
    const ITEMS: [&str; 3] = ["- Symbol: ", "- Equation: ", "- Source: "];
    let mut meaning = Vec::new();
    let mut items = [const { None }; 3];
    for line in doc.replace('`', "").lines().map(str::trim).filter(|line| !line.is_empty()) {
        match ITEMS.iter().zip(&mut items).find_map(|(start, item)| Some((line.strip_prefix(start)?, item))) {
            Some((words, item)) => *item = Some(words.to_owned()),
            None => meaning.push(line.to_owned()),
        }
    }
    (meaning.join(" "), items)
}
