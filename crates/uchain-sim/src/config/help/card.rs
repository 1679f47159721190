//! What is known of one key, for people.

use std::fmt::{self, Write as _};

use super::{Explanation, Unit, Written};

/// Columns of the screen that are used.
const WIDTH: usize = 100;
/// Columns before a value.
const INDENT: usize = 13;

/// All that is known of it, in lines for people.
impl fmt::Display for Explanation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&card(self))
    }
}

fn card(key: &Explanation) -> String {
    let mut text = format!("{}\n\n", key.key);
    text += &wrapped(&key.meaning, 2);
    text.push('\n');
    let mut line = |name: &str, value: &str| {
        let value = wrapped(value, INDENT);
        let _ = write!(text, "  {name:<9}{}", value.get(INDENT - 2..).unwrap_or_default());
    };
    for (name, value) in [("symbol", &key.symbol), ("equation", &key.equation)] {
        if let Some(value) = value {
            line(name, value);
        }
    }
    line("value", &kind(key));
    if let Some((low, high)) = key.range {
        line("range", &format!("{low} to {high}"));
    }
    for (i, (word, meaning)) in key.choices.iter().enumerate() {
        line(if i == 0 { "choices" } else { "" }, &format!("{word}: {meaning}"));
    }
    line("default", &default(key));
    if let Some(source) = &key.source {
        line("source", source);
    }
    for (name, written) in [("presets", &key.presets), ("scenarios", &key.scenarios)] {
        if written.is_empty() {
            line(name, "none writes it");
        }
        for (i, Written { by, value, source }) in written.iter().enumerate() {
            let source = source.as_ref().map(|source| format!(" ({source})")).unwrap_or_default();
            line(if i == 0 { name } else { "" }, &format!("{by}: {value}{source}"));
        }
    }
    if let Some(value) = example(key) {
        let (table, name) = key.key.rsplit_once('.').unwrap_or(("", &key.key));
        let heading = match table.replace(".0", "") {
            plain if plain != table => format!("[[{plain}]]"),
            plain if plain.is_empty() => "# above all tables".to_owned(),
            plain => format!("[{plain}]"),
        };
        let bare = if key.kind == "word" { value.trim_matches('"') } else { value };
        let assignment = format!("{}={bare}", key.key);
        let needs_quotes = assignment.contains([' ', '"', '[']);
        let quote = if needs_quotes { "'" } else { "" };
        // To be copied: never broken.
        let _ = writeln!(text, "  in a file  {heading}\n{:INDENT$}{name} = {value}", "");
        let _ = writeln!(text, "  or         --set {quote}{assignment}{quote}");
    }
    text
}

/// A value that may stand there.
fn example(key: &Explanation) -> Option<&str> {
    let mut written = key.presets.iter().chain(&key.scenarios).map(|written| written.value.as_str());
    if key.key.contains(".0.") {
        return written.find_map(|value| value.split(", ").next());
    }
    key.default.as_deref().into_iter().chain(written).find(|value| !value.ends_with('…'))
}

/// Kind and unit of a value, in words.
fn kind(key: &Explanation) -> String {
    let unit = match (key.unit, key.kind) {
        (Some(Unit { symbol, words }), _) if symbol == words => format!(", {words}"),
        (Some(Unit { symbol, words }), _) => format!(", {words} ({symbol})"),
        (None, "number" | "whole number") => ", no unit".to_owned(),
        (None, _) => String::new(),
    };
    format!("{}{unit}", key.kind)
}

fn default(key: &Explanation) -> String {
    match (&key.default, key.required) {
        (Some(value), _) => value.clone(),
        (None, true) => "none, it has to be written".to_owned(),
        (None, false) => "none, it may be left out".to_owned(),
    }
}

/// Words in lines of at most [`WIDTH`] columns, each with so many spaces before it.
fn wrapped(text: &str, indent: usize) -> String {
    let mut lines = String::new();
    let mut line = " ".repeat(indent);
    for word in text.split_whitespace() {
        let is_begun = line.len() > indent;
        if is_begun && line.chars().count() + 1 + word.chars().count() > WIDTH {
            lines += &line;
            lines.push('\n');
            line = " ".repeat(indent);
        } else if is_begun {
            line.push(' ');
        }
        line += word;
    }
    lines + &line + "\n"
}
