//! Ranges of what all scenarios have, and of every room's Params under their table's name.

use uchain_core::params::OutOfRange;

use super::{ConfigError, Heading, MapConfig, document::Document, keys::join};
use crate::{
    clock,
    map::{FRAME_MAX_M, Fault},
};

/// Length of a tick (s). Every period is a multiple of it.
pub(crate) const TICK_S: f64 = 1.0 / clock::TICKS_PER_S;

/// Longest run (s): a day.
pub(crate) const DURATION_MAX_S: f64 = 86_400.0;

/// Longest name of a scenario.
pub(crate) const NAME_LENGTH_MAX: usize = 64;

/// Checks the values of a scenario, and says of a wrong one where it was written.
///
/// ```
/// use uchain_sim::config::{Check, Document, KnownKeys, builtin};
/// let (source, known) = (builtin("corner").unwrap(), KnownKeys::of(&[]));
/// let sets = ["duration_s=0.07".to_owned()];
/// let document = Document::parse(&source, &sets, &known).unwrap();
/// let error = Check { document: &document }.ticks("duration_s", 0.07).unwrap_err();
/// assert!(error.to_string().ends_with("must be a multiple of the tick, 0.05 s"), "{error}");
/// ```
pub struct Check<'d> {
    /// What holds the values.
    pub document: &'d Document<'d>,
}

impl Check<'_> {
    /// An error about a key, at its place; `got` is said if it was not written.
    pub fn invalid(&self, key: &str, got: &dyn ToString, expected: impl Into<String>) -> ConfigError {
        ConfigError::Invalid {
            at: self.document.origin(key),
            key: key.to_owned(),
            got: self.document.written(key).unwrap_or_else(|| got.to_string()),
            expected: expected.into(),
        }
    }

    /// A number by its legal range, both ends included.
    ///
    /// # Errors
    /// [`ConfigError::Invalid`].
    pub fn range(&self, key: &str, got: f64, low: f64, high: f64) -> Result<(), ConfigError> {
        if (low..=high).contains(&got) {
            return Ok(());
        }
        Err(self.invalid(key, &got, format!("must lie in {low}..={high}")))
    }

    /// What every scenario says first: name, duration and map.
    ///
    /// # Errors
    /// The first [`ConfigError::Invalid`].
    pub fn heading(&self, heading: &Heading) -> Result<(), ConfigError> {
        self.name(&heading.name)?;
        self.ranged("", heading.check())?;
        self.ticks("duration_s", heading.duration_s)?;
        self.map(&heading.map)
    }

    /// The outcome of a table's own check, under the table's name; the empty name is the top of the file.
    ///
    /// # Errors
    /// [`ConfigError::Invalid`].
    pub fn ranged(&self, table: &str, checked: Result<(), OutOfRange>) -> Result<(), ConfigError> {
        checked.map_err(|OutOfRange { key, got, low, high }| {
            let key = join(table, key);
            self.invalid(&key, &got, format!("must lie in {low}..={high}"))
        })
    }

    /// A time that has to be a multiple of the tick (s).
    ///
    /// # Errors
    /// [`ConfigError::Invalid`].
    pub fn ticks(&self, key: &str, got_s: f64) -> Result<(), ConfigError> {
        if clock::is_period(got_s) {
            return Ok(());
        }
        Err(self.invalid(key, &got_s, format!("must be a multiple of the tick, {TICK_S} s")))
    }

    /// The scenario's name: it names the output folder.
    ///
    /// # Errors
    /// [`ConfigError::Invalid`].
    pub fn name(&self, name: &str) -> Result<(), ConfigError> {
        let plain = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
        if (1..=NAME_LENGTH_MAX).contains(&name.len()) && name.chars().all(plain) {
            return Ok(());
        }
        let expected = format!(
            "must be 1 to {NAME_LENGTH_MAX} of the letters a-z, A-Z, 0-9, - and _ (it names the output folder)"
        );
        Err(self.invalid("name", &format!("{name:?}"), expected))
    }

    /// Every number of `[map]`; nothing is read or laid out.
    ///
    /// # Errors
    /// The first [`ConfigError::Invalid`].
    pub fn map(&self, map: &MapConfig) -> Result<(), ConfigError> {
        let table = map.format().table;
        map.legal().map_err(|Fault { key, got, expected }| {
            self.invalid(&format!("{table}.{key}"), &got, expected)
        })?;
        map.places().into_iter().try_for_each(|(key, at)| self.point(&format!("{table}.{key}"), at))
    }

    /// A place in the map's own frame (m).
    ///
    /// # Errors
    /// [`ConfigError::Invalid`].
    pub fn point(&self, key: &str, at: [f64; 2]) -> Result<(), ConfigError> {
        // An array takes as many as it holds and asks no further.
        if let Some(count) = self.document.count(key).filter(|&count| count != at.len()) {
            return Err(self.invalid(key, &format!("{count} numbers"), "expected two numbers [x, y]"));
        }
        at.iter().enumerate().try_for_each(|(j, &value_m)| {
            self.range(&format!("{key}.{j}"), value_m, -FRAME_MAX_M, FRAME_MAX_M)
        })
    }
}
