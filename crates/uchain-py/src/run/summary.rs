//! What a run came to, in numbers.

use pyo3::{
    exceptions::{PyAttributeError, PyKeyError, PyTypeError},
    prelude::*,
    types::{PyDict, PyIterator, PyList, PyString},
};

/// What a run came to: the very numbers of `summary.json`, by attribute and by key.
///
/// A mapping. Objects in it are summaries themselves, lists are lists. What is not known is None.
///
/// >>> run = uchain.run(uchain.Scenario.from_name("straight").with_(duration_s=5))
/// >>> run.summary.uavs == run.summary["uavs"]
/// True
/// >>> run.summary.scenario
/// 'straight'
#[pyclass(frozen, mapping, module = "uchain")]
pub(crate) struct Summary(Py<PyDict>);

impl Summary {
    /// Of the text of `summary.json`.
    pub(crate) fn read<'py>(py: Python<'py>, json: &str) -> PyResult<Bound<'py, Self>> {
        let object_hook = PyDict::new(py);
        object_hook.set_item("object_hook", py.get_type::<Self>())?;
        let read = py.import("json")?.getattr("loads")?.call((json,), Some(&object_hook))?;
        Ok(read.cast_into::<Self>()?)
    }

    fn missing(&self, py: Python<'_>, name: &str) -> String {
        let known: Vec<String> = self.0.bind(py).keys().iter().map(|key| key.to_string()).collect();
        format!("no '{name}' in this summary: it has {}", known.join(", "))
    }
}

#[pymethods]
impl Summary {
    #[new]
    #[pyo3(signature = (values, /))]
    fn new(values: &Bound<'_, PyDict>) -> PyResult<Self> {
        if values.keys().iter().any(|key| !key.is_instance_of::<PyString>()) {
            return Err(PyTypeError::new_err("expected a dict whose keys are str"));
        }
        Ok(Self(values.copy()?.unbind()))
    }

    fn __getitem__<'py>(&self, py: Python<'py>, key: &str) -> PyResult<Bound<'py, PyAny>> {
        let found = self.0.bind(py).get_item(key)?;
        found.ok_or_else(|| PyKeyError::new_err(self.missing(py, key)))
    }

    fn __getattr__<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let found = self.0.bind(py).get_item(name)?;
        found.ok_or_else(|| PyAttributeError::new_err(self.missing(py, name)))
    }

    fn __dir__<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyList>> {
        let names = slf.get_type().dir()?;
        names.call_method1("extend", (slf.get().0.bind(slf.py()).keys(),))?;
        Ok(names)
    }

    fn __contains__(&self, key: &Bound<'_, PyAny>) -> PyResult<bool> {
        self.0.bind(key.py()).contains(key)
    }

    fn __len__(&self, py: Python<'_>) -> usize {
        self.0.bind(py).len()
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyIterator>> {
        self.0.bind(py).keys().try_iter()
    }

    /// Names, in the order of `summary.json`.
    fn keys<'py>(&self, py: Python<'py>) -> Bound<'py, PyList> {
        self.0.bind(py).keys()
    }

    /// Values, in the order of the names.
    fn values<'py>(&self, py: Python<'py>) -> Bound<'py, PyList> {
        self.0.bind(py).values()
    }

    /// Pairs of a name and its value.
    fn items<'py>(&self, py: Python<'py>) -> Bound<'py, PyList> {
        self.0.bind(py).items()
    }

    /// The value of a name, or `default` if there is none.
    #[pyo3(signature = (key, default=None, /))]
    fn get<'py>(
        &self,
        key: &Bound<'py, PyAny>,
        default: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Option<Bound<'py, PyAny>>> {
        Ok(self.0.bind(key.py()).get_item(key)?.or(default))
    }

    /// The same as dicts and lists, through and through: what `json` takes.
    ///
    /// >>> import json
    /// >>> summary = uchain.run(uchain.Scenario.from_name("straight").with_(duration_s=5)).summary
    /// >>> json.loads(json.dumps(summary.to_dict())) == summary.to_dict()
    /// True
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let plain_dict = PyDict::new(py);
        for (key, value) in self.0.bind(py) {
            plain_dict.set_item(key, plain(&value, 0)?)?;
        }
        Ok(plain_dict)
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> PyResult<bool> {
        let py = other.py();
        match other.cast::<Self>() {
            Ok(other) => self.0.bind(py).eq(other.get().0.bind(py)),
            Err(_) => self.to_dict(py)?.eq(other),
        }
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> (Bound<'py, PyAny>, (Py<PyDict>,)) {
        (slf.get_type().into_any(), (slf.get().0.clone_ref(slf.py()),))
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let lines: Vec<String> = self
            .0
            .bind(py)
            .iter()
            .map(|(key, value)| Ok(format!("{key}={}", super::shown(&value))))
            .collect::<PyResult<_>>()?;
        Ok(format!("Summary({})", lines.join(", ")))
    }
}

/// Deepest nesting of lists in a summary.
const DEEPEST: usize = 16;

fn plain<'py>(value: &Bound<'py, PyAny>, depth: usize) -> PyResult<Bound<'py, PyAny>> {
    let py = value.py();
    if let Ok(summary) = value.cast::<Summary>() {
        return Ok(summary.get().to_dict(py)?.into_any());
    }
    match value.cast::<PyList>() {
        Ok(list) if depth < DEEPEST => {
            let items: Vec<Bound<'py, PyAny>> =
                list.iter().map(|item| plain(&item, depth + 1)).collect::<PyResult<_>>()?;
            Ok(PyList::new(py, items)?.into_any())
        }
        _ => Ok(value.clone()),
    }
}

pub(super) fn fill(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Summary>()?;
    super::columns::is_a_mapping(&module.py().get_type::<Summary>())
}
