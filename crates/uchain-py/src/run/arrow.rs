//! Numbers over time as a tidy table, for data frames.

use std::sync::Arc;

use arrow_array::{
    ArrayRef, BooleanArray, Float32Array, Float64Array, RecordBatch, StringArray, UInt8Array, UInt32Array,
};
use arrow_schema::{Field, Schema};
use numpy::{PyArrayDyn, PyArrayMethods, PyUntypedArray, PyUntypedArrayMethods};
use pyo3::{exceptions::PyValueError, prelude::*};
use pyo3_arrow::PyTable;

use super::columns::Columns;

/// Numbers over time as a table with a row for each instant and robot, which everything takes that takes Arrow.
///
/// It is made of its columns whenever somebody reads it. `len()` is the number of its rows.
#[pyclass(frozen, module = "uchain")]
pub(crate) struct Tidy(pub(super) Py<Columns>);

#[pymethods]
impl Tidy {
    #[pyo3(signature = (requested_schema=None))]
    fn __arrow_c_stream__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        stream(py, self.0.get(), requested_schema)
    }

    fn __len__(&self, py: Python<'_>) -> PyResult<usize> {
        let columns = self.0.get();
        Ok(columns.rows() * crew(py, columns)?.unwrap_or(1))
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, (Py<Columns>,))> {
        Ok((slf.get_type().getattr("_unpickled")?, (slf.get().0.clone_ref(slf.py()),)))
    }

    /// How pickle makes one.
    #[staticmethod]
    fn _unpickled(columns: Py<Columns>) -> Self {
        Self(columns)
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        Ok(format!("<uchain.Tidy {}: {} rows>", self.0.get().name(), self.__len__(py)?))
    }
}

/// Robots in each row; `None` where there are none.
fn crew(py: Python<'_>, columns: &Columns) -> PyResult<Option<usize>> {
    let mut crew = None;
    for array in columns.arrays(py).values() {
        if let [_, robots] = array.cast::<PyUntypedArray>()?.shape() {
            crew = Some(*robots);
        }
    }
    Ok(crew)
}

/// A row for each instant and robot.
fn stream<'py>(
    py: Python<'py>,
    columns: &Columns,
    requested_schema: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let refused = |error: &dyn std::fmt::Display| PyValueError::new_err(error.to_string());
    let crew = crew(py, columns)?;
    let mut fields = Vec::new();
    let mut arrays: Vec<ArrayRef> = Vec::new();
    let mut add = |name: &str, array: ArrayRef| {
        fields.push(Field::new(name, array.data_type().clone(), false));
        arrays.push(array);
    };
    for (name, array) in columns.arrays(py) {
        let words = columns.words_of(py, &name)?;
        add(&name.to_string(), tidy(&array, crew, words.as_deref())?);
        // First when, then who, then what.
        if let Some(robots) = crew.filter(|_| name.eq("time_s").unwrap_or(false)) {
            let numbers = (0..columns.rows()).flat_map(|_| 0..robots as u32);
            add("robot", Arc::new(UInt32Array::from_iter_values(numbers)));
        }
    }
    let schema = Arc::new(Schema::new(fields));
    let batch = RecordBatch::try_new(schema.clone(), arrays).map_err(|error| refused(&error))?;
    let table = Bound::new(py, PyTable::try_new(vec![batch], schema)?)?;
    table.call_method1("__arrow_c_stream__", (requested_schema,))
}

/// A column with a value for each instant and robot; what belongs to an instant is each robot's.
fn tidy(array: &Bound<'_, PyAny>, crew: Option<usize>, words: Option<&[String]>) -> PyResult<ArrayRef> {
    let times = |array: &Bound<'_, PyUntypedArray>| if array.ndim() == 1 { crew.unwrap_or(1) } else { 1 };
    let times = times(array.cast()?);
    if let Ok(values) = values::<f64>(array, times) {
        return Ok(Arc::new(Float64Array::from(values)));
    }
    if let Ok(values) = values::<f32>(array, times) {
        return Ok(Arc::new(Float32Array::from(values)));
    }
    if let Ok(values) = values::<u32>(array, times) {
        return Ok(Arc::new(UInt32Array::from(values)));
    }
    if let Ok(values) = values::<bool>(array, times) {
        return Ok(Arc::new(BooleanArray::from(values)));
    }
    let values = values::<u8>(array, times)?;
    Ok(match words {
        Some(words) => {
            let word = |index: &u8| words.get(usize::from(*index)).map_or("", String::as_str);
            Arc::new(StringArray::from_iter_values(values.iter().map(word)))
        }
        None => Arc::new(UInt8Array::from(values)),
    })
}

/// All values of an array, row by row, each so many times.
fn values<T: numpy::Element + Copy>(array: &Bound<'_, PyAny>, times: usize) -> PyResult<Vec<T>> {
    let array = array.cast::<PyArrayDyn<T>>()?.try_readonly();
    let array = array.map_err(|error| PyValueError::new_err(error.to_string()))?;
    let all = array.as_array();
    Ok(if times == 1 {
        all.iter().copied().collect()
    } else {
        all.iter().flat_map(|value| std::iter::repeat_n(*value, times)).collect()
    })
}
