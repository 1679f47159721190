//! Errors of Rust as exceptions of Python: the words are the command line's, remedies included.

use pyo3::{create_exception, exceptions::PyException, prelude::*};
use uchain_sim::config::ConfigError;

create_exception!(
    uchain,
    UchainError,
    PyException,
    "What went wrong in uchain; all its exceptions are of this kind."
);
create_exception!(
    uchain,
    ScenarioError,
    UchainError,
    "A scenario that cannot be flown: its text says file, line, key, what was expected and what to do."
);

/// Of a scenario.
pub(crate) fn scenario(error: &ConfigError) -> PyErr {
    ScenarioError::new_err(error.to_string())
}

pub(crate) fn fill(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let py = module.py();
    module.add("UchainError", py.get_type::<UchainError>())?;
    module.add("ScenarioError", py.get_type::<ScenarioError>())
}
