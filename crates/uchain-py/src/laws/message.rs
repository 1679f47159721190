//! What explorers say to each other.

use pyo3::{prelude::*, types::PyTuple};
use uchain_core::explore;

/// What one explorer says to all that hear it: hand it to the others' `hear`.
#[pyclass(frozen, module = "uchain.laws")]
#[derive(Clone)]
pub(super) struct Message(pub(super) explore::Message);

#[pymethods]
impl Message {
    /// "pose", "node", "spent" or "target".
    #[getter]
    fn kind(&self) -> &'static str {
        match &self.0 {
            explore::Message::Pose { .. } => "pose",
            explore::Message::Node(_) => "node",
            explore::Message::Spent(_) => "spent",
            explore::Message::Target(_) => "target",
        }
    }

    /// Where it is about, in the team's frame (m): x and y. None of a "spent", which names a node.
    #[getter]
    fn at_m<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyTuple>>> {
        let at = match &self.0 {
            explore::Message::Pose { at, .. } => *at,
            explore::Message::Node(node) => node.at,
            explore::Message::Target(target) => target.to,
            explore::Message::Spent(_) => return Ok(None),
        };
        (at.x_m, at.y_m).into_pyobject(py).map(Some)
    }

    fn __repr__(&self) -> String {
        format!("<uchain.laws.Message {}>", self.kind())
    }
}
