//! A scenario's text as a table that remembers where each value was written: in the text, by `--set`, or in
//! a preset.

mod lookup;
mod merge;
mod path;

use std::path::Path;

use toml::{
    Spanned,
    de::{DeTable, DeValue},
};

use super::{
    ConfigError, Preset, Source,
    diagnose::{Origin, not_an_entry, shorten},
    keys::KnownKeys,
    kind_of_map,
};

use merge::{fill_in, map_spans};
use path::steps;

#[cfg(feature = "sweep")]
pub(crate) use path::plain_key;

/// The parsed text. A value that came by `--set` number `i` has a span of its own behind the text,
/// which starts at `text.len() + 1 + i`; behind those lie the spans of the preset's text.
pub struct Document<'i> {
    source: &'i Source,
    sets: &'i [String],
    /// What may be written in it.
    known: &'i KnownKeys,
    /// Where each of `sets` leads.
    paths: Vec<Vec<String>>,
    preset: Option<Preset>,
    root: Spanned<DeValue<'i>>,
}

impl<'i> Document<'i> {
    /// Reads a text, writes `sets` over it and fills in its preset. `known` are the keys that short names and slips of
    /// the finger are looked up in.
    ///
    /// # Errors
    /// The text is no TOML, an assignment has no place to go, or the preset is unknown.
    pub fn parse(source: &'i Source, sets: &'i [String], known: &'i KnownKeys) -> Result<Self, ConfigError> {
        let text = source.text.as_str();
        let parsed = DeTable::parse(text);
        let table = parsed.map_err(|error| ConfigError::Syntax {
            at: error.span().map_or_else(|| whole(source), |span| line_of(source, span.start)),
            message: shorten_message(error.message()),
        })?;
        let span = table.span();
        let root = Spanned::new(span, DeValue::Table(table.into_inner()));
        let mut document = Self { source, sets, known, paths: Vec::new(), preset: None, root };
        for (index, assignment) in sets.iter().enumerate() {
            document.set(index, assignment)?;
        }
        document.choose_preset()?;
        Ok(document)
    }

    /// Fills in what the preset has to say, if one is named and known.
    fn choose_preset(&mut self) -> Result<(), ConfigError> {
        let (Some(value), true) = self.follow("preset") else { return Ok(()) };
        // What is no text at all, the deserializer explains.
        let DeValue::String(name) = value.get_ref() else { return Ok(()) };
        let preset = Preset::named(name).map_err(|choices| ConfigError::UnknownChoice {
            at: self.place(&value.span()),
            key: "preset".to_owned(),
            got: shorten(name),
            choices: Box::new(choices),
        })?;
        self.fill_in(preset)
    }

    /// Writes every value of a preset that is not written yet.
    pub(crate) fn fill_in(&mut self, preset: Preset) -> Result<(), ConfigError> {
        let table = DeTable::parse(preset.text).map_err(|error| ConfigError::Syntax {
            at: Origin::Preset {
                name: preset.name,
                line: line(preset.text, error.span().unwrap_or_default().start),
            },
            message: shorten_message(error.message()),
        })?;
        let start = self.preset_start();
        let mut values = Spanned::new(table.span(), DeValue::Table(table.into_inner()));
        map_spans(&mut values, &|span| span.start + start..span.end + start);
        fill_in(&mut self.root, values);
        self.preset = Some(preset);
        Ok(())
    }

    /// Where the spans of the preset's text begin.
    fn preset_start(&self) -> usize {
        self.source.text.len() + 1 + self.sets.len()
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
        let steps = self.resolve(path);
        if steps.iter().any(String::is_empty) || steps.len() > 8 {
            return Err(wrong("expected key=value with a key such as equalize.v_max_mps".to_owned()));
        }
        let start = self.source.text.len() + 1 + index;
        let mut value = match DeValue::parse(text.trim()) {
            Ok(value) => value,
            // What begins like a list, a table or a text in quotes was meant to be one, and no bare word.
            Err(error) if text.trim().starts_with(['[', '{', '"', '\'']) => {
                let value = shorten(text.trim());
                return Err(wrong(format!(
                    "not a value in TOML: {value}: {}",
                    shorten_message(error.message())
                )));
            }
            Err(_) => Spanned::new(0..0, DeValue::String(text.trim().into())),
        };
        map_spans(&mut value, &|_| start..start + 1);

        let mut here = &mut self.root;
        for (depth, step) in steps.iter().enumerate() {
            let parent = shorten(&steps.get(..depth).unwrap_or_default().join("."));
            here = match here.get_mut() {
                DeValue::Table(table) if table.is_empty() && step.parse::<usize>().is_ok() => {
                    return Err(wrong(not_an_entry(&parent, 0, step)));
                }
                DeValue::Table(table) => {
                    let key = Spanned::new(start..start + 1, step.clone().into());
                    let empty = DeValue::Table(DeTable::new());
                    table.entry(key).or_insert_with(|| Spanned::new(start..start + 1, empty))
                }
                DeValue::Array(items) => {
                    let count = items.len();
                    let item = step.parse::<usize>().ok().and_then(|i| items.get_mut(i));
                    item.ok_or_else(|| wrong(not_an_entry(&parent, count, step)))?
                }
                _ => return Err(wrong(format!("{parent} is a single value, it holds no other keys"))),
            };
        }
        *here = value;
        self.paths.push(steps);
        Ok(())
    }

    /// The steps to where a key leads that was typed.
    pub(crate) fn resolve(&self, typed: &str) -> Vec<String> {
        let mut steps = steps(typed);
        if let [map, key] = &steps[..]
            && map == "map"
        {
            // `map.cell_m` is that of whatever kind of map it is.
            let kind =
                self.kind_of_map().filter(|kind| self.known.key(&format!("map.{kind}"), key).is_some());
            steps.splice(1..1, kind.map(str::to_owned));
        }
        steps
    }

    /// Where each of the assignments leads, in their order.
    #[cfg(feature = "sweep")]
    pub(crate) fn paths(&self) -> &[Vec<String>] {
        &self.paths
    }

    /// The one table within `map`, as far as there is only one we know.
    fn kind_of_map(&self) -> Option<&'static str> {
        let (Some(map), true) = self.follow("map") else { return None };
        let DeValue::Table(map) = map.get_ref() else { return None };
        let [kind] = map.keys().collect::<Vec<_>>()[..] else { return None };
        self.known.table_within("map", kind.get_ref())
    }

    /// What may be written in it.
    pub(super) fn known(&self) -> &'i KnownKeys {
        self.known
    }

    /// Where relative paths in it start.
    pub fn folder(&self) -> &Path {
        &self.source.folder
    }

    /// The values, each of the right type.
    ///
    /// # Errors
    /// What is no value of `T`, and where that was written.
    pub fn values<T: serde::de::DeserializeOwned>(&self) -> Result<T, ConfigError> {
        let root = toml::de::ValueDeserializer::from(self.root());
        T::deserialize(root).map_err(|error| super::explain_error(&error, self))
    }

    /// The value tree, for the deserializer.
    pub(crate) fn root(&self) -> Spanned<DeValue<'i>> {
        self.root.clone()
    }

    /// The value tree without one table at the top, and that table: as it is written, or empty if it is not. Every value
    /// keeps its span.
    pub(crate) fn without(&self, table: &str) -> [Spanned<DeValue<'i>>; 2] {
        let mut rest = self.root();
        let empty = Spanned::new(rest.span(), DeValue::Table(DeTable::new()));
        let DeValue::Table(top) = rest.get_mut() else { return [rest, empty] };
        let taken = top.remove(table).unwrap_or(empty);
        [rest, taken]
    }
}

fn whole(source: &Source) -> Origin {
    if is_map(source) {
        return Origin::Map { file: source.label.clone() };
    }
    Origin::Whole { label: source.label.clone() }
}

/// Whether a map stands for its exploration, in a text that nobody has written.
fn is_map(source: &Source) -> bool {
    kind_of_map(Path::new(&source.label)).is_some()
}

fn line_of(source: &Source, byte: usize) -> Origin {
    if is_map(source) {
        return whole(source);
    }
    Origin::Line { label: source.label.clone(), line: line(&source.text, byte) }
}

/// The line a byte stands in, from 1.
fn line(text: &str, byte: usize) -> usize {
    let before = text.as_bytes().get(..byte).unwrap_or(text.as_bytes());
    before.split(|&b| b == b'\n').count()
}

/// A parser's message, on one line.
fn shorten_message(message: &str) -> String {
    message.chars().take(300).map(|c| if c.is_control() { ' ' } else { c }).collect()
}
