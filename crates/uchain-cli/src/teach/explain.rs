//! `uchain explain`: what is known of a key, for people.

use std::fmt::Write as _;

use uchain_sim::{config::help::Explanation, registry::Registry};

use crate::{exit::Failure, print};

/// Columns of the screen that are used.
const WIDTH: usize = 100;

pub(crate) fn explain(registry: Registry, key: Option<&str>) -> Result<(), Failure> {
    // Copied from a file, or from --set.
    let key = key.unwrap_or_default().split('=').next().unwrap_or_default().trim();
    let found = registry.explain(key.trim_matches(['[', ']']))?;
    match found.as_slice() {
        [only] if !only.is_table => print(&only.to_string()),
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

fn cut(line: &str) -> String {
    if line.chars().nth(WIDTH).is_none() {
        return line.to_owned();
    }
    line.chars().take(WIDTH - 1).chain(['…']).collect()
}
