//! Errors of Rust as exceptions of Python: the words are the command line's, remedies included.

use std::panic::{AssertUnwindSafe, catch_unwind};

use pyo3::{create_exception, exceptions::PyException, prelude::*};
use uchain_sim::{
    config::ConfigError,
    record::RecordError,
    registry::FlightError,
    sweep::{DesignError, folder::FolderError, report::ReportError},
};

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

create_exception!(
    uchain,
    SweepError,
    UchainError,
    "A sweep that cannot be flown, a folder that cannot be gone on with, tables that do not fit: its text says what was \
     expected and what to do."
);

/// Of a sweep, its folder, its table.
pub(crate) fn sweep(error: FolderError) -> PyErr {
    let text = match error {
        FolderError::Design(DesignError::Config(error)) => return scenario(&error),
        FolderError::Design(DesignError::Read { label, cause }) => {
            return system(&cause, &format!("{label}: cannot read the design: {cause}"));
        }
        FolderError::Io { path, doing, cause } => {
            return system(&cause, &format!("{}: cannot {doing}: {cause}", path.display()));
        }
        FolderError::Exists { folder } => {
            format!(
                "{} holds a sweep already: resume=True goes on with it; or name another folder",
                folder.display()
            )
        }
        FolderError::Missing { missing, runs, first } => format!(
            "{missing} of {runs} runs are missing, the first is run {first}: fly them, or join all shards by uchain.concat"
        ),
        FolderError::Damaged { file, why, remedy } => {
            format!("{} is damaged: {why}; {}", file.display(), remedy.replace("--resume", "resume=True"))
        }
        other => other.to_string(),
    };
    SweepError::new_err(text)
}

/// Of a sweep's report.
pub(crate) fn report(error: ReportError) -> PyErr {
    match error {
        ReportError::Folder(error) => sweep(error),
        other => UchainError::new_err(other.to_string()),
    }
}

/// Of the system: `FileNotFoundError`, `PermissionError` and their like, with our words.
fn system(cause: &std::io::Error, words: &str) -> PyErr {
    std::io::Error::new(cause.kind(), words).into()
}

create_exception!(
    uchain,
    LawError,
    UchainError,
    "A law of one's own that gave no speed: its text says tick, time and relay; what the law raised is its cause."
);

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
    module.add("LawError", py.get_type::<LawError>())?;
    module.add("ScenarioError", py.get_type::<ScenarioError>())?;
    module.add("RecordingError", py.get_type::<RecordingError>())?;
    module.add("SweepError", py.get_type::<SweepError>())
}
