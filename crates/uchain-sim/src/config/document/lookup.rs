//! What stands at a key of a document, and where it was written.

use std::ops::Range;

use toml::{Spanned, de::DeValue};

use super::{
    Document, line, line_of,
    path::{path_to, steps},
    whole,
};
use crate::config::{
    ConfigError, Origin, Preset,
    diagnose::{Choices, shorten},
};

impl<'i> Document<'i> {
    /// Where a span stands.
    pub fn place(&self, span: &Range<usize>) -> Origin {
        let in_preset = span.start.checked_sub(self.preset_start());
        match (self.set_at(span), self.preset, in_preset) {
            (Some(assignment), ..) => Origin::Set { assignment: shorten(assignment) },
            (None, Some(Preset { name, text }), Some(byte)) => {
                Origin::Preset { name, line: line(text, byte) }
            }
            _ => line_of(self.source, span.start),
        }
    }

    /// The document as a whole.
    pub fn whole(&self) -> Origin {
        whole(self.source)
    }

    /// Where a key (`pilot.0.speed_mps`) was written, else the table it belongs to.
    pub fn origin(&self, path: &str) -> Origin {
        let (found, exact) = self.follow(path);
        match found {
            Some(value) if exact || value.span() != self.root.span() => self.place(&value.span()),
            _ => self.whole(),
        }
    }

    /// The value of a key as it was written; `None` when it was not, or is not a single value.
    pub fn written(&self, path: &str) -> Option<String> {
        let (Some(value), true) = self.follow(path) else { return None };
        match value.get_ref() {
            DeValue::String(text) => Some(format!("\"{}\"", shorten(text))),
            DeValue::Integer(number) => Some(shorten(&number.to_string())),
            DeValue::Float(number) => Some(shorten(&number.to_string())),
            DeValue::Boolean(on) => Some(on.to_string()),
            DeValue::Datetime(time) => Some(time.to_string()),
            DeValue::Array(_) | DeValue::Table(_) => None,
        }
    }

    /// What stands at a key, in a few words; `None` where nothing does.
    pub fn shown(&self, path: &str) -> Option<String> {
        let (Some(value), true) = self.follow(path) else { return None };
        self.written(path).or_else(|| match value.get_ref() {
            DeValue::Array(items) => Some(format!("a list of {}", items.len())),
            DeValue::Table(_) => Some("a table".to_owned()),
            _ => None,
        })
    }

    /// An error about a key, at its place; `got` is said if it was not written.
    pub fn invalid(&self, key: &str, got: &str, expected: impl Into<String>) -> ConfigError {
        ConfigError::Invalid {
            at: self.origin(key),
            key: key.to_owned(),
            got: self.written(key).unwrap_or_else(|| got.to_owned()),
            expected: expected.into(),
        }
    }

    /// An error for a word that is none of those that may stand there.
    pub fn unknown_choice(&self, key: &str, got: &str, known: &[&str]) -> ConfigError {
        let known = known.iter().map(|&word| word.to_owned()).collect();
        let choices = Box::new(Choices::for_word(got, known));
        ConfigError::UnknownChoice { at: self.origin(key), key: key.to_owned(), got: shorten(got), choices }
    }

    /// How many entries a list has; `None` where no list was written.
    pub fn count(&self, path: &str) -> Option<usize> {
        let (Some(value), true) = self.follow(path) else { return None };
        if let DeValue::Array(items) = value.get_ref() { Some(items.len()) } else { None }
    }

    /// Whether a key is there.
    pub fn has(&self, path: &str) -> bool {
        self.follow(path).1
    }

    /// The deepest value on the way of a path, and whether the way was walked to its end.
    pub(super) fn follow(&self, path: &str) -> (Option<&Spanned<DeValue<'i>>>, bool) {
        let mut here = &self.root;
        for step in path.split('.') {
            let next = match here.get_ref() {
                DeValue::Table(table) => table.get(step),
                DeValue::Array(items) => step.parse::<usize>().ok().and_then(|i| items.get(i)),
                _ => None,
            };
            match next {
                Some(value) => here = value,
                None => return (Some(here), false),
            }
        }
        (Some(here), true)
    }

    /// The key path of the key or value with this span, tables included; empty for the whole. For a
    /// value that came by `--set` it is the path given there.
    pub(crate) fn path_of(&self, span: &Range<usize>) -> String {
        if let Some((path, _)) = self.set_at(span).and_then(|set| set.split_once('=')) {
            return shorten(&steps(path).join("."));
        }
        path_to(&self.root, span)
    }

    /// The assignment a span belongs to.
    fn set_at(&self, span: &Range<usize>) -> Option<&'i String> {
        self.sets.get(span.start.checked_sub(self.source.text.len() + 1)?)
    }
}
