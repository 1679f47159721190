//! `uchain explain`: what is known of a key, for people.

use std::fmt::Write as _;

use uchain_sim::{
    config::help::{Explanation, Unit, Written},
    registry::Registry,
};

use crate::{exit::Failure, print};

/// Columns of the screen that are used.
const WIDTH: usize = 100;
/// Columns before a value.
const INDENT: usize = 13;

pub(crate) fn explain(registry: Registry, key: Option<&str>) -> Result<(), Failure> {
    // Copied from a file, or from --set.
    let key = key.unwrap_or_default().split('=').next().unwrap_or_default().trim();
    let found = registry.explain(key.trim_matches(['[', ']']))?;
    match found.as_slice() {
        [only] if !only.is_table => print(&card(only)),
        several => print(&list(several)),
    }
}

/// One line per key, a heading per table.
fn list(keys: &[Explanation]) -> String {
    let width = |key: &Explanation| key.key.chars().count();
    let widest = keys.iter().filter(|key| !key.is_table).map(width).max().unwrap_or(0);
    let mut text = String::new();
    if keys.first().is_some_and(|key| !key.is_table && !key.key.contains('.')) {
        text += "At the top of the file, above all tables\n";
    }
    for key in keys {
        let headline = key.headline();
        if key.is_table {
            let gap = if text.is_empty() { "" } else { "\n" };
            let name = if key.kind == "list of tables" {
                format!("[[{}]]", key.key)
            } else {
                format!("[{}]", key.key)
            };
            // Writing to a String cannot fail.
            let _ = writeln!(text, "{gap}{name} {headline}");
        } else {
            let line = format!("  {:widest$}  {headline}", key.key);
            let _ = writeln!(text, "{}", cut(&line));
        }
    }
    text + "\nMore on each: uchain explain KEY\n"
}

/// All that is known of one key.
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
        for (i, Written { by, value }) in written.iter().enumerate() {
            line(if i == 0 { name } else { "" }, &format!("{by}: {value}"));
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

fn cut(line: &str) -> String {
    if line.chars().nth(WIDTH).is_none() {
        return line.to_owned();
    }
    line.chars().take(WIDTH - 1).chain(['…']).collect()
}
