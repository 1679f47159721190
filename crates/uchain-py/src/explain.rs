//! What keys of scenarios mean.

use pyo3::{
    prelude::*,
    types::{PyDict, PyTuple},
};
use uchain_sim::config::help;

use crate::{errors, registry};

/// One key or table of a scenario: what it is, what it may be, where it comes from.
///
/// `str()` of it is the card of `uchain explain`.
///
/// >>> [sigma] = uchain.explain("sigma_db")
/// >>> sigma.key, sigma.unit, sigma.range
/// ('radio.sigma_db', 'dB', (0.0, 50.0))
#[pyclass(frozen, module = "uchain")]
pub(crate) struct Explanation(help::Explanation);

#[pymethods]
impl Explanation {
    /// Full name; the first entry stands for a list of tables: `pilot.0.speed_mps`.
    #[getter]
    fn key(&self) -> &str {
        &self.0.key
    }

    /// Whether it holds keys of its own.
    #[getter]
    fn is_table(&self) -> bool {
        self.0.is_table
    }

    /// What it is, in a sentence or several.
    #[getter]
    fn meaning(&self) -> &str {
        &self.0.meaning
    }

    /// What it is called in formulae, or None.
    #[getter]
    fn symbol(&self) -> Option<&str> {
        self.0.symbol.as_deref()
    }

    /// The formula it stands in, or None.
    #[getter]
    fn equation(&self) -> Option<&str> {
        self.0.equation.as_deref()
    }

    /// Where it, or its value, comes from, or None.
    #[getter]
    fn source(&self) -> Option<&str> {
        self.0.source.as_deref()
    }

    /// Kind of value: "number", "whole number", "true or false", "word" (one of the choices), "text", "list", "table" or
    /// "list of tables".
    #[getter]
    fn kind(&self) -> &str {
        self.0.kind
    }

    /// Unit of a number, or of the numbers in a list; None for a pure number and for what is no number.
    #[getter]
    fn unit(&self) -> Option<&str> {
        self.0.unit.map(|unit| unit.symbol)
    }

    /// Smallest and largest legal value of a number, both included, or None.
    #[getter]
    fn range(&self) -> Option<(f64, f64)> {
        self.0.range
    }

    /// What counts if it is not written, in TOML; None if there is no such value.
    #[getter]
    fn default(&self) -> Option<&str> {
        self.0.default.as_deref()
    }

    /// Whether it has to be written wherever its table is.
    #[getter]
    fn required(&self) -> bool {
        self.0.required
    }

    /// The words that may stand here and what they mean: a dict, empty where any may.
    #[getter]
    fn choices<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        pairs(py, self.0.choices.iter().map(|(word, meaning)| (word.as_str(), meaning.as_str())))
    }

    /// What presets write here: a dict of names and values in TOML.
    #[getter]
    fn presets<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        pairs(py, self.0.presets.iter().map(|written| (written.by, written.value.as_str())))
    }

    /// What scenarios that come along write here: a dict of names and values in TOML.
    #[getter]
    fn scenarios<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        pairs(py, self.0.scenarios.iter().map(|written| (written.by, written.value.as_str())))
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        other.cast::<Self>().is_ok_and(|other| self.0 == other.get().0)
    }

    fn __hash__(&self, py: Python<'_>) -> PyResult<isize> {
        self.0.key.as_str().into_pyobject(py)?.hash()
    }

    /// Pickled as its name, and explained anew where it arrives.
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, (String,))> {
        Ok((slf.get_type().getattr("_unpickled")?, (slf.get().0.key.clone(),)))
    }

    /// How pickle makes one.
    #[staticmethod]
    fn _unpickled(key: &str) -> PyResult<Self> {
        let found = registry().explain(key).map_err(|error| errors::scenario(&error))?;
        let same = found.into_iter().find(|explanation| explanation.key == key);
        same.map(Self).ok_or_else(|| errors::UchainError::new_err(format!("no key {key} in this version")))
    }

    fn __str__(&self) -> String {
        self.0.to_string()
    }

    fn __repr__(&self) -> String {
        format!("<uchain.Explanation {}: {}>", self.0.key, self.0.headline())
    }
}

fn pairs<'a, 'py>(
    py: Python<'py>,
    pairs: impl Iterator<Item = (&'a str, &'a str)>,
) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    for (name, value) in pairs {
        dict.set_item(name, value)?;
    }
    Ok(dict)
}

/// What is known of a key of scenarios, as `uchain explain` has it.
///
/// Parameters
/// ----------
/// key : str, optional
///     A full name (`radio.sigma_db`), the last part of it if only one key is called so, or a table (`radio`), for all
///     its keys. Without one, all keys.
///
/// Returns
/// -------
/// tuple of Explanation
///     A table comes before its keys.
///
/// Raises
/// ------
/// ScenarioError
///     No key is called so; it names the nearest one.
///
/// Examples
/// --------
/// >>> [key.key for key in uchain.explain("packets")][:2]
/// ['packets', 'packets.drop_rate']
/// >>> uchain.explain("sigma")
/// Traceback (most recent call last):
/// ...
/// uchain.ScenarioError: ...sigma...
#[pyfunction]
#[pyo3(signature = (key=None))]
fn explain<'py>(py: Python<'py>, key: Option<&str>) -> PyResult<Bound<'py, PyTuple>> {
    // Copied from a file, or from the command line.
    let key = key.unwrap_or_default().split('=').next().unwrap_or_default().trim();
    let found = errors::caught(|| registry().explain(key.trim_matches(['[', ']'])))?;
    let found = found.map_err(|error| errors::scenario(&error))?;
    PyTuple::new(py, found.into_iter().map(Explanation).collect::<Vec<_>>())
}

/// JSON Schema (draft 7) of scenario files, as `uchain schema` prints it: a dict.
///
/// >>> uchain.schema()["properties"]["radio"]["properties"]["sigma_db"]["minimum"]
/// 0.0
#[pyfunction]
fn schema(py: Python<'_>) -> PyResult<Bound<'_, PyAny>> {
    let text = errors::caught(|| registry().schema().to_string())?;
    py.import("json")?.call_method1("loads", (text,))
}

pub(crate) fn fill(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Explanation>()?;
    module.add_function(wrap_pyfunction!(explain, module)?)?;
    module.add_function(wrap_pyfunction!(schema, module)?)
}
