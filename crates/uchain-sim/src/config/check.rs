//! Ranges of what all scenarios have, and of every room's Params under their table's name.

use uchain_core::params::OutOfRange;

use super::{ConfigError, Heading, MapConfig, document::Document, keys::join};
use crate::clock;

/// Length of a tick (s). Every period is a multiple of it.
pub(crate) const TICK_S: f64 = 1.0 / clock::TICKS_PER_S;

/// Longest run (s): a day.
pub(crate) const DURATION_MAX_S: f64 = 86_400.0;

/// Longest name of a scenario.
pub(crate) const NAME_LENGTH_MAX: usize = 64;

/// Farthest place in a map's own frame (m): a surveyor's coordinates; `f64` keeps a millimetre there with ease.
pub(crate) const FRAME_MAX_M: f64 = 1e9;

/// Farthest corner of a corridor (m); `f32` keeps a centimetre there.
pub(crate) const COORDINATE_MAX_M: f64 = 100_000.0;

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
        match map {
            MapConfig::Corridor(corridor) => {
                self.ranged("map.corridor", corridor.check())?;
                for (i, corner) in corridor.centre_line_m.iter().enumerate() {
                    let key = format!("map.corridor.centre_line_m.{i}");
                    if !(2..=3).contains(&corner.len()) {
                        let got = format!("{} numbers", corner.len());
                        return Err(self.invalid(&key, &got, "must be [x, y] or [x, y, r]"));
                    }
                    for (j, &value_m) in corner.iter().enumerate() {
                        let low_m = if j == 2 { 0.0 } else { -COORDINATE_MAX_M };
                        self.range(&format!("{key}.{j}"), value_m, low_m, COORDINATE_MAX_M)?;
                    }
                }
                Ok(())
            }
            MapConfig::Walls(walls) => {
                let outer = walls.outer_m.iter().enumerate().map(|(i, at)| (format!("outer_m.{i}"), at));
                let inner = walls.inner_m.iter().enumerate().flat_map(|(loop_, corners)| {
                    let key = move |(i, at)| (format!("inner_m.{loop_}.{i}"), at);
                    corners.iter().enumerate().map(key)
                });
                outer.chain(inner).try_for_each(|(key, &at)| self.point(&format!("map.walls.{key}"), at))
            }
            MapConfig::Movingai(grid) => self.ranged("map.movingai", grid.check()),
            MapConfig::Ros(ros) => {
                let cell_m = ros.cell_m.map_or(Ok(()), |m| self.range("map.ros.cell_m", m, 0.001, 1000.0));
                cell_m.and_then(|()| self.ranged("map.ros", ros.check()))
            }
        }
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
