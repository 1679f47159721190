//! What is wrong with a scenario, in words that help to mend it.

use std::fmt;

use super::{TEXT_MAX_BYTES, builtin_names};
use crate::map::MapError;

/// Where a value was written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Origin {
    /// A line of the scenario file, counted from 1.
    Line {
        /// The file, or `<builtin corner>`.
        label: String,
        /// Line, from 1.
        line: usize,
    },
    /// The scenario as a whole: the value is not written anywhere in it.
    Whole {
        /// The file, or `<builtin corner>`.
        label: String,
    },
    /// A map that stands for its exploration: nobody wrote a scenario around it.
    Map {
        /// The file.
        file: String,
    },
    /// A line of a compiled-in preset.
    Preset {
        /// The preset's name.
        name: &'static str,
        /// Line, from 1.
        line: usize,
    },
    /// An assignment on the command line.
    Set {
        /// `key=value` as given.
        assignment: String,
    },
    /// Another argument on the command line that stands for an assignment.
    Argument {
        /// As it may be typed, such as `--base=0,0`.
        typed: String,
    },
}

impl fmt::Display for Origin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line { label, line } => write!(f, "{label}:{line}"),
            Self::Whole { label } => f.write_str(label),
            Self::Map { file } => f.write_str(file),
            Self::Preset { name, line } => write!(f, "<preset {name}>:{line}"),
            Self::Set { assignment } => write!(f, "--set {assignment}"),
            Self::Argument { typed } => f.write_str(typed),
        }
    }
}

/// Why a scenario cannot be flown. Every message names the place, the key, what was found and what was
/// expected.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ConfigError {
    /// No compiled-in scenario of this name.
    #[error(
        "unknown scenario '{name}'{choices}; a path to a file works as well if it holds a / or ends in .toml"
    )]
    UnknownScenario {
        /// The name asked for.
        name: String,
        /// What could stand there.
        choices: Box<Choices>,
    },
    /// No compiled-in preset of this name.
    #[error("unknown preset '{name}'{choices}")]
    UnknownPreset {
        /// The name asked for.
        name: String,
        /// What could stand there.
        choices: Box<Choices>,
    },
    /// No key of this name in any scenario.
    #[error("no key is called '{key}'{choices}")]
    NoSuchKey {
        /// The name asked for.
        key: String,
        /// Names near it; not all of them.
        choices: Box<Choices>,
    },
    /// The file cannot be read.
    #[error("{label}: cannot read the scenario: {cause}{choices}")]
    Read {
        /// The file.
        label: String,
        /// What the system said.
        cause: std::io::Error,
        /// A scenario file beside it, if one is called nearly so.
        choices: Box<Choices>,
    },
    /// A file that is neither a map nor a scenario.
    #[error(
        "{label}: neither a scenario in TOML nor a map that is read here; maps may be {known}; save other pictures as PNG"
    )]
    NotAMap {
        /// The file.
        label: String,
        /// The kinds of map files there are.
        known: String,
    },
    /// The file is longer than any scenario.
    #[error("{label}: longer than {TEXT_MAX_BYTES} bytes, expected a scenario in TOML")]
    TooLong {
        /// The file.
        label: String,
    },
    /// The file is not UTF-8.
    #[error("{label}: not UTF-8 text from byte {byte} on, expected a scenario in TOML")]
    NotText {
        /// The file.
        label: String,
        /// Offset of the first byte that is not text.
        byte: usize,
    },
    /// Not TOML.
    #[error("{at}: not valid TOML: {message}")]
    Syntax {
        /// Where.
        at: Origin,
        /// What the parser found and expected.
        message: String,
    },
    /// A `--set` that names no place a value could go.
    #[error("{at}: {message}")]
    Set {
        /// The assignment.
        at: Origin,
        /// What is wrong with it.
        message: String,
    },
    /// A key that nothing reads.
    #[error("{at}: unknown key '{key}'{choices}")]
    UnknownKey {
        /// Where.
        at: Origin,
        /// The key with its tables, as written.
        key: String,
        /// What could stand there.
        choices: Box<Choices>,
    },
    /// A word that is none of the choices.
    #[error("{at}: {key} = \"{got}\": unknown choice{choices}")]
    UnknownChoice {
        /// Where.
        at: Origin,
        /// The key with its tables.
        key: String,
        /// The word found.
        got: String,
        /// What could stand there.
        choices: Box<Choices>,
    },
    /// A key without which nothing flies.
    #[error("{at}: missing key '{key}'")]
    Missing {
        /// Where its table stands.
        at: Origin,
        /// The key with its tables.
        key: String,
    },
    /// A value of the wrong type, outside its range, or at odds with another one.
    #[error("{at}: {key} = {got}: {expected}")]
    Invalid {
        /// Where.
        at: Origin,
        /// The key with its tables.
        key: String,
        /// What was found.
        got: String,
        /// What was expected.
        expected: String,
    },
    /// The tunnel cannot be built.
    #[error("{}", of_map(at, key, cause))]
    Map {
        /// Where.
        at: Origin,
        /// The key with its tables.
        key: String,
        /// What the map room said.
        cause: Box<MapError>,
    },
}

impl ConfigError {
    /// Names a value by the argument it came from, where a program made its `assignment` (`key=value`) out of an
    /// argument of its own, `typed`. An error about anything else stays as it is.
    #[must_use]
    pub fn typed_as(self, assignment: &str, typed: &str) -> Self {
        self.written_at(assignment, Origin::Argument { typed: shorten(typed) })
    }

    /// Names a value by the place it was written in, where a program made its `assignment` (`key=value`) out of what
    /// stands there. An error about anything else stays as it is.
    #[must_use]
    pub fn written_at(mut self, assignment: &str, place: Origin) -> Self {
        if let Some(at) = self.place_mut()
            && *at == (Origin::Set { assignment: shorten(assignment) })
        {
            *at = place;
        }
        self
    }

    /// The line of the scenario's text that is wrong, counted from 1; `None` if it is no single line of it.
    pub fn line(&self) -> Option<usize> {
        match self.place()? {
            Origin::Line { line, .. } => Some(*line),
            _ => None,
        }
    }

    /// The key that is wrong, with its tables; `None` if it is none.
    pub fn key(&self) -> Option<&str> {
        match self {
            Self::UnknownKey { key, .. }
            | Self::UnknownChoice { key, .. }
            | Self::Missing { key, .. }
            | Self::Invalid { key, .. }
            | Self::Map { key, .. } => Some(key),
            _ => None,
        }
    }

    fn place(&self) -> Option<&Origin> {
        match self {
            Self::Syntax { at, .. }
            | Self::Set { at, .. }
            | Self::UnknownKey { at, .. }
            | Self::UnknownChoice { at, .. }
            | Self::Missing { at, .. }
            | Self::Invalid { at, .. }
            | Self::Map { at, .. } => Some(at),
            _ => None,
        }
    }

    fn place_mut(&mut self) -> Option<&mut Origin> {
        match self {
            Self::Syntax { at, .. }
            | Self::Set { at, .. }
            | Self::UnknownKey { at, .. }
            | Self::UnknownChoice { at, .. }
            | Self::Missing { at, .. }
            | Self::Invalid { at, .. }
            | Self::Map { at, .. } => Some(at),
            Self::UnknownScenario { .. }
            | Self::UnknownPreset { .. }
            | Self::NoSuchKey { .. }
            | Self::Read { .. }
            | Self::NotAMap { .. }
            | Self::TooLong { .. }
            | Self::NotText { .. } => None,
        }
    }

    pub(super) fn unknown_scenario(name: &str) -> Self {
        let known: Vec<String> = builtin_names().iter().map(|&n| n.to_owned()).collect();
        Self::UnknownScenario { name: shorten(name), choices: Box::new(Choices::for_word(name, known)) }
    }

    #[cfg(feature = "schema")]
    pub(super) fn no_such_key(name: &str, choices: Choices) -> Self {
        Self::NoSuchKey { key: shorten(name), choices: Box::new(choices) }
    }

    pub(super) fn unknown_preset(name: &str, choices: Choices) -> Self {
        Self::UnknownPreset { name: shorten(name), choices: Box::new(choices) }
    }
}

/// What is wrong with a map. Where nobody wrote a scenario, a map's own fault has no key.
fn of_map(at: &Origin, key: &str, cause: &MapError) -> String {
    match at {
        Origin::Map { file } if cause.is_of_a_file() && key.starts_with("map.") => {
            let cause = cause.to_string();
            if cause.starts_with(file.as_str()) { cause } else { format!("{file}: {cause}") }
        }
        _ => format!("{at}: {key}: {cause}"),
    }
}

/// Text as it may stand in a message: printable, on one line, of bounded length.
pub(crate) fn shorten(text: &str) -> String {
    const LONGEST: usize = 60;
    let mut short: String =
        text.chars().take(LONGEST).map(|c| if c.is_control() { '\u{fffd}' } else { c }).collect();
    if text.chars().nth(LONGEST).is_some() {
        short.push('…');
    }
    short
}

/// What to write instead of a `step` that is no entry of a list.
pub(super) fn not_an_entry(list: &str, count: usize, step: &str) -> String {
    let step = shorten(step);
    match count {
        0 => format!("{list} has no entries: write all of it, such as --set '{list}=[…]'"),
        _ if step.parse::<usize>().is_ok() => {
            format!("{list} is a list of {count}: expected an index below {count} after it, got '{step}'")
        }
        _ => format!("{list} is a list of {count}: write which one, such as {list}.0.{step}"),
    }
}

/// The names that are known where an unknown one was found.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Choices {
    /// The one nearest to what was found, if any is near enough to be meant.
    pub nearest: Option<String>,
    /// All of them.
    pub known: Vec<String>,
}

impl Choices {
    /// What could stand where `got` does.
    pub(crate) fn for_word(got: &str, known: Vec<String>) -> Self {
        let got = shorten(&got.to_lowercase());
        let near = known
            .iter()
            .map(|name| (strsim::damerau_levenshtein(&got, name), name))
            .min_by_key(|(edits, _)| *edits)
            .filter(|(edits, name)| *edits <= 1 + name.chars().count().max(got.chars().count()) / 3)
            .map(|(_, name)| name);
        // A part of a name, if it is a part of one only.
        let mut holding = known.iter().filter(|name| got.len() > 2 && name.contains(&got));
        let whole = holding.next().filter(|_| holding.next().is_none());
        let nearest = near.or(whole).cloned();
        Self { nearest, known }
    }
}

impl fmt::Display for Choices {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(name) = &self.nearest {
            write!(f, "; did you mean '{name}'?")?;
        }
        if !self.known.is_empty() {
            write!(f, " (known: {})", self.known.join(", "))?;
        }
        Ok(())
    }
}
