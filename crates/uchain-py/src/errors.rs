//! Errors of Rust as exceptions of Python: the words are the command line's, remedies included.

use std::panic::{AssertUnwindSafe, catch_unwind};

use pyo3::{create_exception, exceptions::PyException, prelude::*};
use uchain_sim::{config::ConfigError, record::RecordError, registry::FlightError};

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

create_exception!(
    uchain,
    RecordingError,
    UchainError,
    "A recording that cannot be read or written: its text says file, place and reason."
);

/// Of a run that was stopped by who was shown its frames.
pub(crate) fn record(error: &RecordError) -> PyErr {
    let remedy = match error {
        RecordError::TooMuch { .. } => {
            "; keep those of decisions, frames=\"decisions\", or none, frames=None"
        }
        _ => "",
    };
    UchainError::new_err(format!("{error}{remedy}"))
}

/// Of the results of a run.
pub(crate) fn flight(error: &FlightError) -> PyErr {
    UchainError::new_err(error.to_string())
}

/// Of a scenario.
pub(crate) fn scenario(error: &ConfigError) -> PyErr {
    ScenarioError::new_err(error.to_string())
}

/// Does something that should not panic; if it does, that is an exception like any other.
///
/// # Errors
/// `UchainError` with what the panic said.
pub(crate) fn caught<T>(work: impl FnOnce() -> T) -> PyResult<T> {
    // Whatever was being made is given up.
    catch_unwind(AssertUnwindSafe(work)).map_err(|panic| {
        let said = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
        let said = said.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_default();
        UchainError::new_err(format!("a fault in uchain, please report it: {said}"))
    })
}

pub(crate) fn fill(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let py = module.py();
    module.add("UchainError", py.get_type::<UchainError>())?;
    module.add("ScenarioError", py.get_type::<ScenarioError>())?;
    module.add("RecordingError", py.get_type::<RecordingError>())
}
