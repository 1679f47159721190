//! Scenarios: what is flown.

use std::{
    ffi::OsString,
    path::{Path, PathBuf},
    sync::Arc,
};

use numpy::{PyArray1, PyArray3, PyArrayMethods, ToPyArray};
use pyo3::{
    exceptions::{PyTypeError, PyValueError},
    prelude::*,
    types::{PyDict, PyString, PyType},
};
use uchain_sim::{
    config::{Source, builtin, builtin_names},
    registry::AnyScene,
};

use crate::{errors, registry, value::toml_text};

/// A scenario, checked and laid out in its map: what is flown, by whom, for how long.
///
/// It does not change; `with_` makes another one. Wherever a scenario is expected its name, or the path of a file, does
/// as well.
///
/// >>> import uchain
/// >>> corner = uchain.Scenario.from_name("corner")
/// >>> corner.robots, corner.duration_s
/// (4, 120.0)
/// >>> noisy = corner.with_(**{"radio.sigma_db": 3, "duration_s": 60})
/// >>> noisy.duration_s
/// 60.0
/// >>> corner.with_(**{"radio.sigma": 3})
/// Traceback (most recent call last):
/// ...
/// uchain.ScenarioError: --set radio.sigma=3: unknown key 'radio.sigma'; did you mean 'sigma_db'? ...
#[pyclass(frozen, module = "uchain")]
pub(crate) struct Scenario {
    pub(crate) source: Source,
    pub(crate) sets: Vec<String>,
    pub(crate) scene: Arc<dyn AnyScene>,
}

impl Scenario {
    /// Reads, checks and lays out.
    pub(crate) fn lay(py: Python<'_>, source: Source, sets: Vec<String>) -> PyResult<Self> {
        let scene = py.detach(|| errors::caught(|| registry().read(&source, &sets)))?;
        let scene = scene.map_err(|error| errors::scenario(&error))?;
        Ok(Self { source, sets, scene })
    }

    /// A scenario, or the one that a name or a path stands for.
    ///
    /// # Errors
    /// `TypeError` of anything else, `ScenarioError` of a scenario that cannot be flown.
    pub(crate) fn of<'py>(what: &Bound<'py, PyAny>) -> PyResult<Bound<'py, Self>> {
        if let Ok(scenario) = what.cast::<Self>() {
            return Ok(scenario.clone());
        }
        let (source, sets) = Self::read(what)?;
        Bound::new(what.py(), Self::lay(what.py(), source, sets)?)
    }

    /// The text of a scenario and what is written over it, not laid out yet: a sweep may vary what it cannot be laid out
    /// without.
    ///
    /// # Errors
    /// `TypeError` of what is no scenario, name or path, `ScenarioError` of one that is not there.
    pub(crate) fn read(what: &Bound<'_, PyAny>) -> PyResult<(Source, Vec<String>)> {
        if let Ok(scenario) = what.cast::<Self>() {
            let scenario = scenario.get();
            return Ok((scenario.source.clone(), scenario.sets.clone()));
        }
        let source = if what.is_instance_of::<PyString>() {
            Source::find(&what.extract::<String>()?)
        } else if what.hasattr("__fspath__")? {
            source_at(&what.extract::<PathBuf>()?)
        } else {
            let got = what.get_type().name()?.to_string();
            return Err(PyTypeError::new_err(format!(
                "expected a scenario: a name, the path of a file, or a uchain.Scenario; got {got}"
            )));
        };
        let source = source.map_err(|error| errors::scenario(&error))?;
        Ok((source, Vec::new()))
    }

    /// The values written over it: keys, and values as TOML.
    fn written(&self) -> impl Iterator<Item = (&str, &str)> {
        self.sets.iter().filter_map(|set| set.split_once('='))
    }
}

/// A file, whatever it is called.
fn source_at(path: &Path) -> Result<Source, uchain_sim::config::ConfigError> {
    match path.to_str() {
        // A map stands for its exploration; a name without a dot would be a built-in scenario's.
        Some(text) if path.extension().is_some() => Source::find(text),
        _ => Source::read(path),
    }
}

#[pymethods]
impl Scenario {
    /// The scenario of this name that comes along; `uchain.scenarios()` lists them.
    ///
    /// Raises `ScenarioError` with the nearest name if there is none.
    #[classmethod]
    fn from_name(cls: &Bound<'_, PyType>, name: &str) -> PyResult<Self> {
        let Some(source) = builtin(name) else {
            let known = builtin_names().join(", ");
            let error = match Source::find(name) {
                Err(error) => error.to_string(),
                Ok(_) => format!("'{name}' is a path; expected a name ({known}), or Scenario.from_file"),
            };
            return Err(errors::ScenarioError::new_err(error));
        };
        Self::lay(cls.py(), source, Vec::new())
    }

    /// The scenario in a file of at most 16 MiB: TOML, or a map (`.map`, `.yaml`, `.pgm`, `.png`), which stands for its
    /// exploration. Relative paths in it start where it lies.
    ///
    /// Raises `ScenarioError` that says file, line, key and remedy.
    #[classmethod]
    #[expect(clippy::needless_pass_by_value, reason = "an argument from Python")]
    fn from_file(cls: &Bound<'_, PyType>, path: PathBuf) -> PyResult<Self> {
        let source = source_at(&path).map_err(|error| errors::scenario(&error))?;
        Self::lay(cls.py(), source, Vec::new())
    }

    /// The scenario in a text of TOML. Relative paths in it start in `folder`, by default the working folder.
    ///
    /// Raises `ScenarioError` that says line, key and remedy.
    ///
    /// >>> text = uchain.Scenario.from_name("straight").toml
    /// >>> uchain.Scenario.from_toml(text).name
    /// 'straight'
    #[classmethod]
    #[pyo3(signature = (text, folder=None))]
    fn from_toml(cls: &Bound<'_, PyType>, text: String, folder: Option<PathBuf>) -> PyResult<Self> {
        let source = Source { label: "<toml>".to_owned(), text, folder: folder.unwrap_or_default() };
        Self::lay(cls.py(), source, Vec::new())
    }

    /// Another scenario with values written over this one, as `--set key=value` does on the command line: keys by their
    /// full names (`uchain.explain()` lists them), values as bool, int, float, str, lists or dicts of them.
    ///
    /// Raises `ScenarioError` of an unknown key, with the nearest one, and of a value out of its range.
    #[pyo3(signature = (**values))]
    fn with_(slf: &Bound<'_, Self>, values: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let this = slf.get();
        let mut sets = this.sets.clone();
        for (key, value) in values.into_iter().flatten() {
            let key: String = key.extract()?;
            if key.contains(['=', '\n']) {
                let message = format!("'{key}' is no key of a scenario; uchain.explain() lists them");
                return Err(PyValueError::new_err(message));
            }
            let text = toml_text(&key, &value)?;
            // What is written later holds.
            sets.retain(|set| set.split_once('=').is_none_or(|(earlier, _)| earlier != key));
            sets.push(format!("{key}={text}"));
        }
        Self::lay(slf.py(), this.source.clone(), sets)
    }

    /// Its name: letters, digits, hyphens.
    #[getter]
    fn name(&self) -> &str {
        self.scene.name()
    }

    /// What is flown, in a word: "chain", or "exploration".
    #[getter]
    pub(crate) fn mission(&self) -> &str {
        let kind = self.scene.kind();
        kind.split_once(' ').map_or(kind, |(_, word)| word)
    }

    /// How many fly.
    #[getter]
    fn robots(&self) -> usize {
        self.scene.crew()
    }

    /// The longest a run may take, in simulated time (s).
    #[getter]
    fn duration_s(&self) -> f64 {
        self.scene.duration_s()
    }

    /// What one should know before the start, in words; often nothing.
    #[getter]
    fn notes(&self) -> Vec<String> {
        self.scene.notes()
    }

    /// Its TOML, without the values that `with_` wrote over it.
    #[getter]
    fn toml(&self) -> &str {
        &self.source.text
    }

    /// What `with_` wrote over it: keys, and values as TOML.
    #[getter]
    fn overrides<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let written = PyDict::new(py);
        for (key, value) in self.written() {
            written.set_item(key, value)?;
        }
        Ok(written)
    }

    /// Its walls as line segments in the map's frame (m): shape (walls, 2 ends, x and y), float32.
    #[getter]
    fn walls_m<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f32>>> {
        let walls = self.scene.map().walls();
        let ends: Vec<f32> = walls.iter().flat_map(|wall| [wall.a.x, wall.a.y, wall.b.x, wall.b.y]).collect();
        let flat: Bound<'py, PyArray1<f32>> = ends.to_pyarray(py);
        flat.reshape([walls.len(), 2, 2])
    }

    /// Where the origin of the map's frame, which frames and walls are in, lies in the frame of the map's file, which keys of
    /// the scenario are in (m): x and y.
    #[getter]
    fn map_offset_m(&self) -> (f64, f64) {
        self.scene.map().offset_m().into()
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        other.cast::<Self>().is_ok_and(|other| {
            let other = other.get();
            self.source == other.source && self.sets == other.sets
        })
    }

    fn __hash__(&self, py: Python<'_>) -> PyResult<isize> {
        (&self.source.text, self.sets.join("\n")).into_pyobject(py)?.hash()
    }

    /// Pickled as its text and what was written over it; laid out anew where it arrives.
    #[expect(clippy::type_complexity, reason = "what pickle asks for: how to make it, and of what")]
    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> PyResult<(Bound<'py, PyAny>, (String, String, OsString, Vec<String>))> {
        let Source { label, text, folder } = slf.get().source.clone();
        Ok((slf.get_type().getattr("_unpickled")?, (label, text, folder.into(), slf.get().sets.clone())))
    }

    /// How pickle makes one.
    #[classmethod]
    fn _unpickled(
        cls: &Bound<'_, PyType>,
        label: String,
        text: String,
        folder: OsString,
        sets: Vec<String>,
    ) -> PyResult<Self> {
        Self::lay(cls.py(), Source { label, text, folder: folder.into() }, sets)
    }

    fn __repr__(&self) -> String {
        let written: Vec<String> = self.written().map(|(key, value)| format!(" {key}={value}")).collect();
        let (mission, robot) = (self.mission(), self.scene.robot());
        let count = self.scene.crew();
        let s = if count == 1 { "" } else { "s" };
        let duration_s = self.scene.duration_s();
        format!(
            "<uchain.Scenario {}{}: {mission}, {count} {robot}{s}, {duration_s} s>",
            self.name(),
            written.concat()
        )
    }
}

/// The scenarios that come along: a dict of names and what happens in them.
///
/// >>> uchain.scenarios()["straight"]
/// 'A straight tunnel: the head flies 10 m in, two relays level three links'
#[pyfunction]
fn scenarios(py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
    let named = PyDict::new(py);
    for source in builtin_names().iter().filter_map(|name| builtin(name)) {
        let about = registry().describe(&source, &[]).map_err(|error| errors::scenario(&error))?;
        named.set_item(about.name, about.description)?;
    }
    Ok(named)
}

pub(crate) fn fill(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Scenario>()?;
    module.add_function(wrap_pyfunction!(scenarios, module)?)
}
