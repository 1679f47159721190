//! uchain for Python: the module `uchain._uchain`, which the package `uchain` is made of.
//!
//! Nothing here computes: every function is a signature, one call into [`uchain_sim`] without the interpreter's lock, and
//! a table of errors. [`fill`] makes a module of it for missions with laws of one's own in Rust; `examples/own_law/` is
//! one.

#![allow(clippy::doc_markdown, clippy::doc_link_with_quotes, reason = "documentation that Python shows")]

// One mathematics for the whole module: its runs have the same bits as those of the command line.
use uchain_libm as _;

mod command;
mod env;
mod errors;
mod explain;
mod laws;
mod own_law;
mod plan;
mod recording;
mod run;
mod scenario;
mod sweep;
mod value;
mod work;

use std::sync::OnceLock;

use pyo3::{prelude::*, types::PyType};
use uchain_sim::registry::Registry;

/// The missions of this module: its first [`fill`] says which.
static MISSIONS: OnceLock<Registry> = OnceLock::new();

/// The missions that scenarios and recordings may be of.
pub(crate) fn registry() -> Registry {
    MISSIONS.get().copied().unwrap_or_default()
}

/// Fills a module with all that uchain offers Python, for scenarios and recordings of these missions. A process has one
/// such module of a shared library: what the first call says holds.
///
/// # Errors
/// Python's own, when it cannot make a class.
pub fn fill(module: &Bound<'_, PyModule>, missions: Registry) -> PyResult<()> {
    MISSIONS.get_or_init(|| missions);
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    command::fill(module)?;
    errors::fill(module)?;
    own_law::fill(module)?;
    env::fill(module)?;
    scenario::fill(module)?;
    run::fill(module)?;
    sweep::fill(module)?;
    recording::fill(module)?;
    plan::fill(module)?;
    explain::fill(module)?;
    belongs(module, &package(module)?)?;
    laws::fill(module)
}

/// The package that shows a module: itself, if it is in none.
fn package(module: &Bound<'_, PyModule>) -> PyResult<String> {
    let name = module.name()?;
    let name = name.to_str()?;
    Ok(name.rsplit_once('.').map_or(name, |(package, _)| package).to_owned())
}

/// Classes are found by the name of what shows them, so that instances can be pickled.
fn belongs(module: &Bound<'_, PyModule>, shown_by: &str) -> PyResult<()> {
    for (_, value) in module.dict() {
        if let Ok(class) = value.cast::<PyType>() {
            class.setattr("__module__", shown_by)?;
        }
    }
    Ok(())
}

#[pymodule]
fn _uchain(module: &Bound<'_, PyModule>) -> PyResult<()> {
    fill(module, Registry::default())
}
