//! Ways to values: as they are typed, one key in many spellings, and as they are found in a tree.

use std::ops::Range;

use toml::{Spanned, de::DeValue};

use crate::config::diagnose::shorten;

/// The steps of a key. Spaces around dots, quotes around a step and leading zeros of an index are spellings of the same
/// one.
pub(super) fn steps(typed: &str) -> Vec<String> {
    let mut quote = None;
    let is_dot = |c: char| {
        match quote {
            Some(open) if c == open => quote = None,
            None if matches!(c, '"' | '\'') => quote = Some(c),
            _ => {}
        }
        c == '.' && quote.is_none()
    };
    typed.split(is_dot).map(|step| step_of(step.trim())).collect()
}

/// A step without its quotes and zeros.
fn step_of(typed: &str) -> String {
    let quoted = |quote: char| typed.strip_prefix(quote)?.strip_suffix(quote);
    let step = quoted('"').or_else(|| quoted('\'')).unwrap_or(typed);
    step.parse::<usize>().map_or_else(|_| step.to_owned(), |index| index.to_string())
}

/// The spelling of a key that all others are measured by.
#[cfg(feature = "sweep")]
pub(crate) fn plain_key(typed: &str) -> String {
    steps(typed).join(".")
}

/// One step on the way to a value.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Step<'a> {
    Key(&'a str),
    Index(usize),
}

/// The way to the key or value with this span, tables included; empty for the whole.
pub(super) fn path_to(root: &Spanned<DeValue<'_>>, span: &Range<usize>) -> String {
    let mut steps = Vec::new();
    search(root, span, &mut steps);
    let words: Vec<String> = steps
        .iter()
        .map(|step| match step {
            Step::Key(key) => shorten(key),
            Step::Index(index) => index.to_string(),
        })
        .collect();
    words.join(".")
}

/// Depth-first; the parser bounds the depth (80).
fn search<'a>(value: &'a Spanned<DeValue<'_>>, span: &Range<usize>, steps: &mut Vec<Step<'a>>) -> bool {
    if value.span() == *span {
        return true;
    }
    match value.get_ref() {
        DeValue::Table(table) => {
            for (key, value) in table {
                steps.push(Step::Key(key.get_ref()));
                if key.span() == *span || search(value, span, steps) {
                    return true;
                }
                steps.pop();
            }
        }
        DeValue::Array(items) => {
            for (index, value) in items.iter().enumerate() {
                steps.push(Step::Index(index));
                if search(value, span, steps) {
                    return true;
                }
                steps.pop();
            }
        }
        _ => {}
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(feature = "sweep")]
    #[test]
    fn all_spellings_of_a_key_are_one_key() {
        for typed in [
            "radio.sigma_db",
            " radio . sigma_db ",
            "radio.\"sigma_db\"",
            "'radio' . sigma_db",
            "radio.\tsigma_db",
        ] {
            assert_eq!(plain_key(typed), "radio.sigma_db", "{typed}");
        }
        for typed in ["pilot.0.follow", "pilot.00.follow", "pilot. 0 .follow", "pilot.+0.'follow'"] {
            assert_eq!(plain_key(typed), "pilot.0.follow", "{typed}");
        }
        // Other keys are others, and what is no key stays as it is.
        assert_ne!(plain_key("pilot.10.follow"), plain_key("pilot.1.follow"));
        assert_eq!(plain_key("\"radio.sigma_db"), "\"radio.sigma_db");
        assert_eq!(plain_key("a..b"), "a..b");
    }
}
