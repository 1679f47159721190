//! From text to a checked [`Scenario`].

use serde::Deserialize;
use toml::de::ValueDeserializer;

use super::{
    ConfigError, Scenario, Source, check,
    diagnose::{Choices, Origin, shorten},
    document::Document,
    mission,
};

impl Scenario {
    /// Reads a scenario, writes `sets` (`key=value`, the value in TOML or a bare word) over it and checks
    /// every value on its own. Whether the tunnel can be built and flown is up to
    /// [`Course::lay`](super::Course::lay).
    ///
    /// ```
    /// use uchain_sim::config::{Scenario, builtin};
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
        let document = Document::parse(source, sets)?;
        Self::from_document(&document)
    }

    pub(super) fn from_document(document: &Document<'_>) -> Result<Self, ConfigError> {
        mission::is_chain(document)?;
        let scenario = Self::deserialize(ValueDeserializer::from(document.root()))
            .map_err(|error| explain(&error, document))?;
        check::values(&scenario, document)?;
        Ok(scenario)
    }
}

/// Puts the deserializer's words into ours.
pub(super) fn explain(error: &toml::de::Error, document: &Document<'_>) -> ConfigError {
    let span = error.span().unwrap_or_default();
    let path = document.path_of(&span);
    let at = if path.is_empty() { document.whole() } else { document.place(&span) };
    let message = error.message();
    if let Some((got, known)) = unknown(message, "unknown field `") {
        return unknown_key(at, &path, got, known);
    }
    if let Some((got, known)) = unknown(message, "unknown variant `") {
        // The variants of `map` are tables: there the word is a key.
        if path.split('.').any(|step| step == shorten(got)) {
            return unknown_key(at, &path, got, known);
        }
        let choices = Box::new(Choices::for_word(got, known));
        return ConfigError::UnknownChoice { at, key: path, got: shorten(got), choices };
    }
    if let Some(key) = message.strip_prefix("missing field `").and_then(|m| m.strip_suffix('`')) {
        return ConfigError::Missing { at, key: join(&path, key) };
    }
    if message.starts_with("wanted exactly 1 element") {
        let expected =
            "expected one of the tables [map.corridor], [map.walls] and [map.ros], and only one".to_owned();
        return ConfigError::Invalid { at, key: path, got: "{ … }".to_owned(), expected };
    }
    let (found, expected) = message.rsplit_once(", expected ").unwrap_or((message, "another value"));
    ConfigError::Invalid {
        at,
        got: document.written(&path).unwrap_or_else(|| shorten(found)),
        key: path,
        expected: format!("expected {}", plain_type(expected)),
    }
}

fn unknown_key(at: Origin, path: &str, got: &str, known: Vec<String>) -> ConfigError {
    let steps: Vec<&str> = path.split('.').filter(|step| !step.is_empty()).collect();
    let depth = steps.iter().rposition(|step| *step == shorten(got)).unwrap_or(steps.len());
    let table = steps.get(..depth).unwrap_or_default().join(".");
    ConfigError::UnknownKey {
        at,
        key: join(&table, &shorten(got)),
        choices: Box::new(Choices::for_word(got, known)),
    }
}

/// ``unknown field `got`, expected `a` or `b` `` as (got, [a, b]).
fn unknown<'m>(message: &'m str, start: &str) -> Option<(&'m str, Vec<String>)> {
    let rest = message.strip_prefix(start)?;
    let end = rest.rfind("`, expected ").or_else(|| rest.rfind("`, there are no "))?;
    let (got, known) = rest.split_at_checked(end)?;
    // "`, expected `a` or `b`": every second piece between backticks is a name.
    let known = known.split('`').skip(2).step_by(2).map(str::to_owned).collect();
    Some((got, known))
}

/// Rust's names of types in plain words.
fn plain_type(expected: &str) -> String {
    let words = match expected {
        "f32" | "f64" => "a number",
        "u32" | "u64" | "usize" => "a whole number, not negative",
        "a boolean" => "true or false",
        "a sequence" => "a list [ … ]",
        "an array of length 2" => "two numbers [x, y]",
        other if other.starts_with("struct ") => "a table",
        other => other,
    };
    shorten(words)
}

fn join(table: &str, key: &str) -> String {
    if table.is_empty() { key.to_owned() } else { format!("{table}.{key}") }
}
