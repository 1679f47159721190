//! The deserializer's words in ours.

use super::{
    ConfigError, Document,
    diagnose::{Choices, Origin, shorten},
    keys::{KnownKeys, join},
};
use crate::map::tables;

/// Puts the deserializer's words into ours.
pub(crate) fn explain(error: &toml::de::Error, document: &Document<'_>) -> ConfigError {
    let span = error.span().unwrap_or_default();
    let path = document.path_of(&span);
    let at = if path.is_empty() { document.whole() } else { document.place(&span) };
    let message = error.message();
    if let Some((got, known)) = unknown(message, "unknown field `") {
        return unknown_key(at, &path, got, known, document.known());
    }
    if let Some((got, known)) = unknown(message, "unknown variant `") {
        // The variants of `map` are tables: there the word is a key.
        if path.split('.').any(|step| step == shorten(got)) {
            return unknown_key(at, &path, got, known, document.known());
        }
        let choices = Box::new(Choices::for_word(got, known));
        return ConfigError::UnknownChoice { at, key: path, got: shorten(got), choices };
    }
    if let Some(key) = message.strip_prefix("missing field `").and_then(|m| m.strip_suffix('`')) {
        return ConfigError::Missing { at, key: join(&path, key) };
    }
    if path == "map" && message.starts_with("wanted exactly 1 element") {
        if let Some((table, name)) = misplaced(&path, document) {
            let at = document.origin(&join(&path, name));
            let choices = Choices { nearest: Some(join(table, name)), known: Vec::new() };
            return ConfigError::UnknownKey { at, key: join(&path, name), choices: Box::new(choices) };
        }
        let expected = format!("expected {}", maps());
        return ConfigError::Invalid { at, key: path, got: "{ … }".to_owned(), expected };
    }
    let (found, expected) = message.rsplit_once(", expected ").unwrap_or((message, message));
    // Of a value within a `--set` the path is that of the whole: there the one that was found is meant.
    let got = match document.shown(&path) {
        Some(got) if !is_within(found, &got) => got,
        _ => plain_value(found),
    };
    let expected = if path == "map" { maps() } else { plain_type(expected, &path, document.known()) };
    ConfigError::Invalid { at, got, key: path, expected: format!("expected {expected}") }
}

/// What a map may be.
fn maps() -> String {
    format!("one of the tables {}, and only one", tables(""))
}

/// Whether a message is about a piece of a list or table that was given as a whole.
fn is_within(found: &str, got: &str) -> bool {
    let is_whole = (got.starts_with("a list")
        && (found.ends_with("sequence") || found.starts_with("invalid length")))
        || (got == "a table" && found.ends_with("map"));
    got.starts_with("a ") && found.starts_with("invalid ") && !is_whole
}

/// A value as a deserializer names it, in plain words.
fn plain_value(found: &str) -> String {
    let value = found.strip_prefix("invalid type: ").or_else(|| found.strip_prefix("invalid value: "));
    match value {
        Some("map") => "a table".to_owned(),
        Some("sequence") => "a list".to_owned(),
        // "integer `5`", "floating point `5.0`", "boolean `true`", "string "a"".
        Some(value) => shorten(value.split_once(' ').map_or(value, |(_, value)| value).trim_matches('`')),
        None => match found.strip_prefix("invalid length ") {
            Some(count) => format!("a list of {count}"),
            None => "a value of another kind".to_owned(),
        },
    }
}

/// A key of one of the tables within `path` that was written in `path` itself.
fn misplaced(path: &str, document: &Document<'_>) -> Option<(&'static str, &'static str)> {
    document.known().keys_within(path).find(|(_, name)| document.written(&join(path, name)).is_some())
}

/// `known` are the keys that could stand there, `all` those that could stand anywhere.
fn unknown_key(at: Origin, path: &str, got: &str, known: Vec<String>, all: &KnownKeys) -> ConfigError {
    let steps: Vec<&str> = path.split('.').filter(|step| !step.is_empty()).collect();
    let depth = steps.iter().rposition(|step| *step == shorten(got)).unwrap_or(steps.len());
    let table = steps.get(..depth).unwrap_or_default().join(".");
    let key = join(&table, &shorten(got));
    let mut choices = Box::new(Choices::for_word(got, known));
    // A right key in a wrong table is more likely than a slip in its name.
    if let Some(new) = all.renamed(&key) {
        choices.nearest = Some(new.to_owned());
    } else if let [elsewhere] = all.called(got).as_slice() {
        choices.nearest = Some(elsewhere.clone());
    } else if choices.nearest.is_none() {
        choices.nearest = all.nearly_called(got);
    }
    ConfigError::UnknownKey { at, key, choices }
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

/// The range of a key by its full name; of an entry of a list that of all of them.
fn range_of(path: &str, all: &KnownKeys) -> Option<(f64, f64)> {
    let number = |step: &str| step.parse::<usize>().is_ok();
    let plain: Vec<&str> = path.split('.').map(|step| if number(step) { "0" } else { step }).collect();
    let (table, name) = plain.split_last().map(|(name, table)| (table.join("."), *name))?;
    all.key(&table, name)?.range
}

/// Rust's names of types in plain words.
fn plain_type(expected: &str, path: &str, all: &KnownKeys) -> String {
    let words = match expected {
        "f32" | "f64" => "a number",
        "u16" | "u32" | "u64" | "usize" => {
            return range_of(path, all).map_or_else(
                || "a whole number, not negative".to_owned(),
                |(low, high)| format!("a whole number, {low} to {high}"),
            );
        }
        "a string" => "text in quotes",
        other if other.starts_with("wanted ") => "one of its words, in quotes",
        other if other.contains("float") => "a number that is not as large",
        "a boolean" => "true or false",
        "a sequence" => "a list [ … ]",
        "an array of length 2" => "two numbers [x, y]",
        other if other.starts_with("struct ") => "a table",
        other if other.starts_with(char::is_lowercase) && other.contains(' ') => other,
        _ => "a value of another kind",
    };
    shorten(words)
}
