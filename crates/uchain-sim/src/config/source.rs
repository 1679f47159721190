//! Where a scenario's text comes from: compiled in by name, or a file.

use std::{
    io::{self, Read},
    path::{Path, PathBuf},
};

use super::{ConfigError, check::NAME_LENGTH_MAX, diagnose::Choices};
use crate::map::{kind_of_map, map_files};

/// Longest scenario file (bytes): one of a flight by hand with as many inputs as there may be takes half of it.
pub const TEXT_MAX_BYTES: u64 = 1 << 24;

/// The compiled-in scenarios; the one list of them.
const BUILTIN: [(&str, &str); 11] = [
    ("apartment", include_str!("../../scenarios/apartment.toml")),
    ("bend", include_str!("../../scenarios/bend.toml")),
    ("circuit", include_str!("../../scenarios/circuit.toml")),
    ("circuit-cavemod", include_str!("../../scenarios/circuit-cavemod.toml")),
    ("circuit-frontiers2021", include_str!("../../scenarios/circuit-frontiers2021.toml")),
    ("corner", include_str!("../../scenarios/corner.toml")),
    ("corridors", include_str!("../../scenarios/corridors.toml")),
    ("lab", include_str!("../../scenarios/lab.toml")),
    ("staircase", include_str!("../../scenarios/staircase.toml")),
    ("stata", include_str!("../../scenarios/stata.toml")),
    ("straight", include_str!("../../scenarios/straight.toml")),
];

/// Names of the compiled-in scenarios, sorted.
const NAMES: [&str; BUILTIN.len()] = {
    let mut names = [""; BUILTIN.len()];
    let mut i = 0;
    while i < BUILTIN.len() {
        names[i] = BUILTIN[i].0;
        i += 1;
    }
    names
};

/// Values that belong together, by one name: they fill in what a scenario does not write, and win over the
/// defaults.
///
/// ```
/// use uchain_sim::{config::{Preset, builtin}, mission::chain::Scenario};
/// let sets = ["preset=cavemod".to_owned(), "link.lost_s=2".to_owned()];
/// let scenario = Scenario::parse(&builtin("corner").unwrap(), &sets).unwrap();
/// assert_eq!(scenario.equalize.decision_s, 0.1); // from the preset
/// assert_eq!(scenario.link.lost_s, 2.0); // written by hand
/// assert!(Preset::find("frontiers2021").is_ok());
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Preset {
    /// What a scenario calls it by.
    pub name: &'static str,
    /// Tables of a scenario, in TOML; the first line is a comment that says whose values they are.
    pub text: &'static str,
}

/// The compiled-in presets; the one list of them.
pub const PRESETS: [Preset; 2] = [
    Preset { name: "cavemod", text: include_str!("../../presets/cavemod.toml") },
    Preset { name: "frontiers2021", text: include_str!("../../presets/frontiers2021.toml") },
];

impl Preset {
    /// The preset of this name.
    ///
    /// # Errors
    /// [`ConfigError::UnknownPreset`] with the nearest name.
    pub fn find(name: &str) -> Result<Self, ConfigError> {
        Self::named(name).map_err(|choices| ConfigError::unknown_preset(name, choices))
    }

    /// The preset of this name, else the names there are.
    pub(super) fn named(name: &str) -> Result<Self, Choices> {
        let known = || PRESETS.iter().map(|preset| preset.name.to_owned()).collect();
        let found = PRESETS.iter().find(|preset| preset.name == name).copied();
        found.ok_or_else(|| Choices::for_word(name, known()))
    }

    /// Whose values they are, in one line.
    pub fn description(&self) -> &'static str {
        self.text.lines().next().unwrap_or_default().trim_start_matches("# ")
    }
}

/// A scenario's text and where it stands.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Source {
    /// What messages call it: the file's path, or `<builtin corner>`.
    pub label: String,
    /// The TOML.
    pub text: String,
    /// Where relative paths in the text start; empty = the working folder.
    pub folder: PathBuf,
}

/// A compiled-in scenario; `None` if there is none of this name.
///
/// ```
/// assert!(uchain_sim::config::builtin("corner").is_some());
/// ```
pub fn builtin(name: &str) -> Option<Source> {
    let (name, text) = BUILTIN.iter().find(|(known, _)| *known == name)?;
    Some(Source { label: format!("<builtin {name}>"), text: (*text).to_owned(), folder: PathBuf::new() })
}

/// Names of the compiled-in scenarios, sorted.
pub fn builtin_names() -> &'static [&'static str] {
    &NAMES
}

impl Source {
    /// A compiled-in scenario by its name, or a file. A bare map, of any kind of [`FORMATS`](crate::map::FORMATS), stands for
    /// its exploration.
    ///
    /// # Errors
    /// [`ConfigError::UnknownScenario`] with the nearest name; those of [`Source::read`].
    pub fn find(name_or_path: &str) -> Result<Self, ConfigError> {
        let path = Path::new(name_or_path);
        if let Some(kind) = kind_of_map(path) {
            return Ok(Self::around_map(path, kind));
        }
        if is_toml(path) {
            return Self::read(path);
        }
        if let Some(builtin) = builtin(name_or_path) {
            return Ok(builtin);
        }
        if path.is_file() {
            return Self::read_other(path);
        }
        if name_or_path.contains(['/', '\\']) {
            return Self::read(path);
        }
        Err(ConfigError::unknown_scenario(name_or_path))
    }

    /// A scenario under another name than usual: anything else is neither scenario nor map.
    fn read_other(path: &Path) -> Result<Self, ConfigError> {
        let not_a_map = || ConfigError::NotAMap { label: path.display().to_string(), known: map_files() };
        match Self::read(path) {
            Ok(source) if source.text.parse::<toml::Table>().is_ok_and(|table| !table.is_empty()) => {
                Ok(source)
            }
            Ok(_) | Err(ConfigError::NotText { .. } | ConfigError::TooLong { .. }) => Err(not_a_map()),
            Err(error) => Err(error),
        }
    }

    /// Name of the file it was read from, without folders; `None` for a built-in scenario.
    ///
    /// ```
    /// use uchain_sim::config::{Source, builtin};
    /// assert_eq!(Source::find("maps/city.map").unwrap().file_name().as_deref(), Some("city.map"));
    /// assert_eq!(builtin("corner").unwrap().file_name(), None);
    /// ```
    pub fn file_name(&self) -> Option<String> {
        let is_builtin = self.label.starts_with("<builtin ");
        let name = Path::new(&self.label).file_name().filter(|_| !is_builtin)?;
        Some(name.to_string_lossy().into_owned())
    }

    /// Robots explore a map; all else is left to the defaults. The map itself is not read yet.
    fn around_map(path: &Path, kind: &str) -> Self {
        let plain = |c: char| if c.is_ascii_alphanumeric() || c == '_' { c } else { '-' };
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        let name: String = stem.chars().take(NAME_LENGTH_MAX).map(plain).collect();
        let file = toml::Value::String(path.display().to_string());
        let text = format!(
            "name = \"{name}\"\ndescription = \"Robots explore a map\"\nduration_s = 86400.0\n\
             [map.{kind}]\nfile = {file}\n[explore]\n"
        );
        Self { label: path.display().to_string(), text, folder: PathBuf::new() }
    }

    /// The text of a file of at most [`TEXT_MAX_BYTES`].
    ///
    /// # Errors
    /// [`ConfigError::Read`], [`ConfigError::TooLong`], [`ConfigError::NotText`].
    pub fn read(path: &Path) -> Result<Self, ConfigError> {
        let label = path.display().to_string();
        let cannot = |cause: io::Error| {
            let is_absent = cause.kind() == io::ErrorKind::NotFound;
            let nearest = is_absent.then(|| beside(path)).flatten();
            let choices = Box::new(Choices { nearest, known: Vec::new() });
            ConfigError::Read { label: label.clone(), cause, choices }
        };
        let file = std::fs::File::open(path).map_err(cannot)?;
        let mut bytes = Vec::new();
        file.take(TEXT_MAX_BYTES + 1).read_to_end(&mut bytes).map_err(cannot)?;
        if bytes.len() as u64 > TEXT_MAX_BYTES {
            return Err(ConfigError::TooLong { label });
        }
        let text = String::from_utf8(bytes).map_err(|error| ConfigError::NotText {
            label: label.clone(),
            byte: error.utf8_error().valid_up_to(),
        })?;
        Ok(Self { label, text, folder: path.parent().map(Path::to_owned).unwrap_or_default() })
    }
}

fn is_toml(path: &Path) -> bool {
    path.extension().is_some_and(|end| end.eq_ignore_ascii_case("toml"))
}

/// The path of a scenario file in the folder of an absent one that is called nearly like it.
fn beside(path: &Path) -> Option<String> {
    const MOST_ENTRIES: usize = 1000;
    let folder = path.parent()?;
    let here = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let entries = std::fs::read_dir(here).ok()?.take(MOST_ENTRIES).flatten();
    let names = entries.filter_map(|entry| entry.file_name().into_string().ok());
    let mut known: Vec<String> = names.filter(|name| is_toml(Path::new(name))).collect();
    known.sort();
    let nearest = Choices::for_word(path.file_name()?.to_str()?, known).nearest?;
    Some(folder.join(nearest).display().to_string())
}
