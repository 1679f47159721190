//! The command `uchain`.

use pyo3::prelude::*;

/// The command line: what the command `uchain` does, with `sys.argv`.
///
/// Returns the exit code, 0 if all went well; `uchain --help` lists the others.
#[pyfunction]
#[pyo3(signature = (args=None))]
fn main(py: Python<'_>, args: Option<Vec<String>>) -> PyResult<u8> {
    let args = match args {
        Some(args) => std::iter::once("uchain".to_owned()).chain(args).collect(),
        None => py.import("sys")?.getattr("argv")?.extract::<Vec<String>>()?,
    };
    // Ctrl-C is the command's own, as in the terminal.
    let signal = py.import("signal")?;
    let interrupt = signal.getattr("SIGINT")?;
    let before = signal.call_method1("signal", (&interrupt, signal.getattr("SIG_DFL")?)).ok();
    let code = py.detach(|| uchain_cli::code_with(crate::registry(), args));
    if let Some(before) = before {
        signal.call_method1("signal", (interrupt, before))?;
    }
    Ok(code)
}

pub(crate) fn fill(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(main, module)?)
}
