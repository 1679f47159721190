//! The module `uchain.laws`: the laws that fly on the drone, called one by one, for logs of real flights.

mod explorer;
mod kalman;
mod level;
mod message;
mod node;
mod params;
mod seen;
mod words;

use pyo3::prelude::*;

pub(crate) fn fill(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let laws = PyModule::new(module.py(), "laws")?;
    laws.add_class::<kalman::ScalarKalman>()?;
    laws.add_class::<level::Centering>()?;
    laws.add_function(wrap_pyfunction!(level::equalize, &laws)?)?;
    laws.add_function(wrap_pyfunction!(level::center, &laws)?)?;
    laws.add_class::<seen::Heard>()?;
    laws.add_class::<seen::Observation>()?;
    laws.add_class::<node::Command>()?;
    laws.add_class::<node::Packet>()?;
    laws.add_class::<node::Estimates>()?;
    laws.add_class::<node::Explanation>()?;
    laws.add_class::<node::Node>()?;
    laws.add_class::<message::Message>()?;
    laws.add_class::<explorer::Target>()?;
    laws.add_class::<explorer::Move>()?;
    laws.add_class::<explorer::Explorer>()?;
    of_package(module, &laws)?;
    module.add_submodule(&laws)
}

/// Instances are pickled by the name of the module that shows them.
fn of_package(module: &Bound<'_, PyModule>, laws: &Bound<'_, PyModule>) -> PyResult<()> {
    let package = crate::package(module)?;
    crate::belongs(laws, &format!("{package}.laws"))
}
