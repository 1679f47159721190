//! Scenarios: what is flown.

use std::sync::Arc;

use pyo3::{
    prelude::*,
    types::{PyDict, PyType},
};
use uchain_sim::{
    config::{Source, builtin, builtin_names},
    registry::AnyScene,
};

use crate::{errors, registry};

/// A scenario, checked and laid out in its map: what is flown, by whom, for how long. It does not change; `with_` makes
/// another one.
#[pyclass(frozen, module = "uchain")]
pub(crate) struct Scenario {
    pub(crate) source: Source,
    pub(crate) sets: Vec<String>,
    pub(crate) scene: Arc<dyn AnyScene>,
}

impl Scenario {
    /// Reads, checks and lays out.
    fn lay(source: Source, sets: Vec<String>) -> PyResult<Self> {
        let scene = registry().read(&source, &sets).map_err(|error| errors::scenario(&error))?;
        Ok(Self { source, sets, scene })
    }
}

#[pymethods]
impl Scenario {
    /// The scenario of this name that comes along; `uchain.scenarios()` lists them.
    #[classmethod]
    fn from_name(_: &Bound<'_, PyType>, name: &str) -> PyResult<Self> {
        let source = Source::find(name).map_err(|error| errors::scenario(&error))?;
        Self::lay(source, Vec::new())
    }

    /// What happens in it, in one line.
    fn __repr__(&self) -> String {
        format!("<uchain.Scenario {}>", self.scene.title())
    }
}

/// Names and descriptions of the scenarios that come along.
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
