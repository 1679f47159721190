//! Numbers over time, as arrays of numpy.

use super::arrow::Tidy;
use std::fmt::Write as _;

use numpy::{Element, PyArray1, PyArray2, PyUntypedArrayMethods, ndarray::Array2};
use pyo3::{
    exceptions::{PyKeyError, PyValueError},
    prelude::*,
    types::{PyDict, PyIterator, PyList, PyTuple, PyType},
};
use uchain_sim::record::table::{Table, Values};

/// Numbers over time: a mapping of names, with their units, to arrays of numpy.
///
/// Every array has one row for each instant: shape (rows,), or (rows, robots) where each robot has a number of its own.
/// Numbers are float64 (times) or float32, counts uint32, yes or no bool. What is not known is NaN. A column of words is
/// uint8, its words stand in `words`. Arrays are this object's own; nothing else reads them.
///
/// `tidy()` is a table of it for data frames.
///
/// >>> run = uchain.run(uchain.Scenario.from_name("straight").with_(duration_s=5))
/// >>> run.frames.rows, run.frames["x_m"].shape, str(run.frames["x_m"].dtype)
/// (100, (100, 4), 'float32')
/// >>> float(run.frames["time_s"][-1])
/// 5.0
#[pyclass(frozen, mapping, module = "uchain")]
pub(crate) struct Columns {
    /// What they are, such as "frames".
    #[pyo3(get)]
    name: String,
    /// Rows of every array.
    #[pyo3(get)]
    rows: usize,
    arrays: Py<PyDict>,
    words: Py<PyDict>,
}

impl Columns {
    pub(crate) fn of(py: Python<'_>, table: Table) -> PyResult<Self> {
        let (arrays, words) = (PyDict::new(py), PyDict::new(py));
        let Table { name, rows, crew, columns } = table;
        for column in columns {
            let width = column.is_per_robot.then_some(crew);
            let array = match column.values {
                Values::Numbers(values) => array(py, values, rows, width)?,
                Values::Singles(values) => array(py, values, rows, width)?,
                Values::Counts(values) => array(py, values, rows, width)?,
                Values::Flags(values) => array(py, values, rows, width)?,
                Values::Words(known, values) => {
                    words.set_item(column.name, PyTuple::new(py, known)?)?;
                    array(py, values, rows, width)?
                }
            };
            arrays.set_item(column.name, array)?;
        }
        Ok(Self { name: name.to_owned(), rows, arrays: arrays.unbind(), words: words.unbind() })
    }

    pub(super) fn name(&self) -> &str {
        &self.name
    }

    pub(super) fn rows(&self) -> usize {
        self.rows
    }

    pub(super) fn arrays<'py>(&self, py: Python<'py>) -> &Bound<'py, PyDict> {
        self.arrays.bind(py)
    }

    /// The words of a column of words.
    pub(super) fn words_of(&self, py: Python<'_>, name: &Bound<'_, PyAny>) -> PyResult<Option<Vec<String>>> {
        self.words.bind(py).get_item(name)?.map(|words| words.extract()).transpose()
    }
}

/// Values as an array, in the memory they are in.
pub(crate) fn array<T: Element>(
    py: Python<'_>,
    values: Vec<T>,
    rows: usize,
    width: Option<usize>,
) -> PyResult<Bound<'_, PyAny>> {
    let Some(width) = width else { return Ok(PyArray1::from_vec(py, values).into_any()) };
    let whole = Array2::from_shape_vec((rows, width), values);
    let whole = whole.map_err(|error| PyValueError::new_err(error.to_string()))?;
    Ok(PyArray2::from_owned_array(py, whole).into_any())
}

#[pymethods]
impl Columns {
    fn __getitem__<'py>(&self, py: Python<'py>, key: &str) -> PyResult<Bound<'py, PyAny>> {
        let found = self.arrays(py).get_item(key)?;
        found.ok_or_else(|| {
            let known: Vec<String> = self.arrays(py).keys().iter().map(|key| key.to_string()).collect();
            PyKeyError::new_err(format!("no column '{key}' in {}: there are {}", self.name, known.join(", ")))
        })
    }

    fn __contains__(&self, key: &Bound<'_, PyAny>) -> PyResult<bool> {
        self.arrays(key.py()).contains(key)
    }

    fn __len__(&self, py: Python<'_>) -> usize {
        self.arrays(py).len()
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyIterator>> {
        self.arrays(py).keys().try_iter()
    }

    /// Names of the columns.
    fn keys<'py>(&self, py: Python<'py>) -> Bound<'py, PyList> {
        self.arrays(py).keys()
    }

    /// The arrays, in the order of the names.
    fn values<'py>(&self, py: Python<'py>) -> Bound<'py, PyList> {
        self.arrays(py).values()
    }

    /// Pairs of a name and its array.
    fn items<'py>(&self, py: Python<'py>) -> Bound<'py, PyList> {
        self.arrays(py).items()
    }

    /// The array of a name, or `default` if there is none.
    #[pyo3(signature = (key, default=None, /))]
    fn get<'py>(
        &self,
        key: &Bound<'py, PyAny>,
        default: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Option<Bound<'py, PyAny>>> {
        Ok(self.arrays(key.py()).get_item(key)?.or(default))
    }

    /// Of every column of words, what its numbers 0, 1, … mean.
    #[getter]
    fn words<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.words.bind(py).copy()
    }

    /// The same as a table for data frames, a row for each instant and robot, whose number is in the column `robot`; columns
    /// of words are strings.
    ///
    /// Whatever takes Arrow takes it as it is: `polars.DataFrame(run.frames.tidy())`, `pyarrow.table(…)`,
    /// `pandas.DataFrame.from_arrow(…)`, duckdb by its name.
    ///
    /// >>> run = uchain.run(uchain.Scenario.from_name("straight").with_(duration_s=5))
    /// >>> len(run.frames.tidy())
    /// 400
    fn tidy(slf: &Bound<'_, Self>) -> Tidy {
        Tidy(slf.clone().unbind())
    }

    #[expect(clippy::type_complexity, reason = "what pickle asks for: how to make it, and of what")]
    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> PyResult<(Bound<'py, PyAny>, (String, usize, Py<PyDict>, Py<PyDict>))> {
        let (py, this) = (slf.py(), slf.get());
        let parts = (this.name.clone(), this.rows, this.arrays.clone_ref(py), this.words.clone_ref(py));
        Ok((slf.get_type().getattr("_unpickled")?, parts))
    }

    /// How pickle makes one.
    #[classmethod]
    fn _unpickled(
        _: &Bound<'_, PyType>,
        name: String,
        rows: usize,
        arrays: Py<PyDict>,
        words: Py<PyDict>,
    ) -> Self {
        Self { name, rows, arrays, words }
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let mut text = format!("<uchain.Columns {}: {} rows", self.name, self.rows);
        for (name, array) in self.arrays(py) {
            let array = array.cast_into::<numpy::PyUntypedArray>()?;
            let (name, dtype) = (name.to_string(), array.dtype().to_string());
            let shape: Vec<String> = array.shape().iter().map(usize::to_string).collect();
            // Writing to a String cannot fail.
            let _ = write!(text, "\n  {name:<16} {dtype:<8} ({})", shape.join(", "));
        }
        Ok(text + ">")
    }
}

/// Says so to `collections.abc`.
pub(super) fn is_a_mapping(class: &Bound<'_, PyType>) -> PyResult<()> {
    let mapping = class.py().import("collections.abc")?.getattr("Mapping")?;
    mapping.call_method1("register", (class,)).map(drop)
}

pub(super) fn fill(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Columns>()?;
    module.add_class::<Tidy>()?;
    is_a_mapping(&module.py().get_type::<Columns>())
}
