//! A scenario's text as a table that remembers where each value was written, `--set` included.

use std::ops::Range;

use toml::{
    Spanned,
    de::{DeTable, DeValue},
};

use super::{
    ConfigError, Source,
    diagnose::{Origin, shorten},
};

/// The parsed text. A value that came by `--set` number `i` has a span of its own behind the text,
/// which starts at `text.len() + 1 + i`.
pub(super) struct Document<'i> {
    source: &'i Source,
    sets: &'i [String],
    root: Spanned<DeValue<'i>>,
}

/// One step on the way to a value.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Step<'a> {
    Key(&'a str),
    Index(usize),
}

impl<'i> Document<'i> {
    pub(super) fn parse(source: &'i Source, sets: &'i [String]) -> Result<Self, ConfigError> {
        let text = source.text.as_str();
        let parsed = DeTable::parse(text);
        let table = parsed.map_err(|error| ConfigError::Syntax {
            at: error.span().map_or_else(|| whole(source), |span| line_of(source, span.start)),
            message: shorten_message(error.message()),
        })?;
        let span = table.span();
        let root = Spanned::new(span, DeValue::Table(table.into_inner()));
        let mut document = Self { source, sets, root };
        for (index, assignment) in sets.iter().enumerate() {
            document.set(index, assignment)?;
        }
        Ok(document)
    }

    /// Writes one `key=value` over what the text says.
    fn set(&mut self, index: usize, assignment: &'i str) -> Result<(), ConfigError> {
        let wrong = |message: String| ConfigError::Set {
            at: Origin::Set { assignment: shorten(assignment) },
            message,
        };
        let Some((path, text)) = assignment.split_once('=') else {
            return Err(wrong("expected key=value, such as equalize.v_max_mps=0.2".to_owned()));
        };
        let steps: Vec<&str> = path.split('.').map(str::trim).collect();
        if steps.iter().any(|step| step.is_empty()) || steps.len() > 8 {
            return Err(wrong("expected key=value with a key such as equalize.v_max_mps".to_owned()));
        }
        let start = self.source.text.len() + 1 + index;
        let mut value = DeValue::parse(text.trim())
            .unwrap_or_else(|_| Spanned::new(0..0, DeValue::String(text.trim().into())));
        move_span(&mut value, &(start..start + 1));

        let mut here = &mut self.root;
        for (depth, &step) in steps.iter().enumerate() {
            let parent = shorten(&steps.get(..depth).unwrap_or_default().join("."));
            here = match here.get_mut() {
                DeValue::Table(table) => {
                    let key = Spanned::new(start..start + 1, step.into());
                    let empty = DeValue::Table(DeTable::new());
                    table.entry(key).or_insert_with(|| Spanned::new(start..start + 1, empty))
                }
                DeValue::Array(items) => {
                    let count = items.len();
                    let item = step.parse::<usize>().ok().and_then(|i| items.get_mut(i));
                    item.ok_or_else(|| {
                        wrong(format!(
                            "{parent} is a list of {count}: expected an index below {count} after it, got \
                             '{}'",
                            shorten(step)
                        ))
                    })?
                }
                _ => return Err(wrong(format!("{parent} is a single value, it holds no other keys"))),
            };
        }
        *here = value;
        Ok(())
    }

    /// The value tree, for the deserializer.
    pub(super) fn root(&self) -> Spanned<DeValue<'i>> {
        self.root.clone()
    }

    /// Where a span stands.
    pub(super) fn place(&self, span: &Range<usize>) -> Origin {
        match self.set_at(span) {
            Some(assignment) => Origin::Set { assignment: shorten(assignment) },
            None => line_of(self.source, span.start),
        }
    }

    /// The document as a whole.
    pub(super) fn whole(&self) -> Origin {
        whole(self.source)
    }

    /// Where a key (`pilot.0.speed_mps`) was written, else the table it belongs to.
    pub(super) fn origin(&self, path: &str) -> Origin {
        let (found, exact) = self.follow(path);
        match found {
            Some(value) if exact || value.span() != self.root.span() => self.place(&value.span()),
            _ => self.whole(),
        }
    }

    /// The value of a key as it was written; `None` when it was not, or is not a single value.
    pub(super) fn written(&self, path: &str) -> Option<String> {
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

    /// The deepest value on the way of a path, and whether the way was walked to its end.
    fn follow(&self, path: &str) -> (Option<&Spanned<DeValue<'i>>>, bool) {
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
    pub(super) fn path_of(&self, span: &Range<usize>) -> String {
        if let Some((path, _)) = self.set_at(span).and_then(|set| set.split_once('=')) {
            return shorten(path);
        }
        let mut steps = Vec::new();
        search(&self.root, span, &mut steps);
        let words: Vec<String> = steps
            .iter()
            .map(|step| match step {
                Step::Key(key) => shorten(key),
                Step::Index(index) => index.to_string(),
            })
            .collect();
        words.join(".")
    }

    /// The assignment a span belongs to.
    fn set_at(&self, span: &Range<usize>) -> Option<&'i String> {
        self.sets.get(span.start.checked_sub(self.source.text.len() + 1)?)
    }
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

/// Gives a value and all it holds one span. The parser bounds the depth (80).
fn move_span(value: &mut Spanned<DeValue<'_>>, span: &Range<usize>) {
    let mut inner = std::mem::replace(value.get_mut(), DeValue::Boolean(false));
    match &mut inner {
        DeValue::Table(table) => {
            let entries = std::mem::take(table);
            for (key, mut held) in entries {
                move_span(&mut held, span);
                table.insert(Spanned::new(span.clone(), key.into_inner()), held);
            }
        }
        DeValue::Array(items) => items.iter_mut().for_each(|held| move_span(held, span)),
        _ => {}
    }
    *value = Spanned::new(span.clone(), inner);
}

fn whole(source: &Source) -> Origin {
    Origin::Whole { label: source.label.clone() }
}

fn line_of(source: &Source, byte: usize) -> Origin {
    let before = source.text.as_bytes().get(..byte).unwrap_or(source.text.as_bytes());
    let line = before.split(|&b| b == b'\n').count();
    Origin::Line { label: source.label.clone(), line }
}

/// A parser's message, on one line.
fn shorten_message(message: &str) -> String {
    message.chars().take(300).map(|c| if c.is_control() { ' ' } else { c }).collect()
}
