//! What happened in a run.

use pyo3::{prelude::*, types::PyTuple};
use uchain_sim::record;

/// Something that happened in a run, as its recording says in `/log`.
///
/// >>> run = uchain.run(uchain.Scenario.from_name("straight").with_(duration_s=5))
/// >>> run.events[0].kind, run.events[0].robot, run.events[0].text
/// ('took-off', 0, 'UAV 0, the head: took off')
#[pyclass(frozen, eq, get_all, module = "uchain")]
#[derive(Clone, PartialEq)]
pub(crate) struct Event {
    /// Simulated time (s).
    time_s: f64,
    /// How grave it is: "info", "warning" or "error".
    gravity: String,
    /// What it is, for programs, such as "took-off" or "link-lost".
    kind: String,
    /// To whom it happened; None if to all.
    robot: Option<usize>,
    /// What it is, for people.
    text: String,
}

impl Event {
    pub(super) fn all(py: Python<'_>, events: Vec<record::Event>) -> PyResult<Bound<'_, PyTuple>> {
        let events = events.into_iter().map(|event| Self {
            time_s: event.time_s(),
            gravity: event.gravity.word().to_owned(),
            kind: event.kind.to_owned(),
            robot: event.robot,
            text: event.text,
        });
        PyTuple::new(py, events.collect::<Vec<_>>())
    }
}

#[pymethods]
impl Event {
    #[new]
    fn new(time_s: f64, gravity: String, kind: String, robot: Option<usize>, text: String) -> Self {
        Self { time_s, gravity, kind, robot, text }
    }

    #[expect(clippy::type_complexity, reason = "what pickle asks for: how to make it, and of what")]
    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> (Bound<'py, PyAny>, (f64, String, String, Option<usize>, String)) {
        let Self { time_s, gravity, kind, robot, text } = slf.get().clone();
        (slf.get_type().into_any(), (time_s, gravity, kind, robot, text))
    }

    fn __hash__(&self, py: Python<'_>) -> PyResult<isize> {
        (self.time_s, &self.gravity, &self.kind, self.robot, &self.text).into_pyobject(py)?.hash()
    }

    fn __repr__(&self) -> String {
        format!("<uchain.Event {:.2} s {} {}: {}>", self.time_s, self.gravity, self.kind, self.text)
    }
}

pub(super) fn fill(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Event>()
}
