//! Columns of a table as arrays of numpy.

use numpy::PyArray1;
use pyo3::{prelude::*, types::PyString};
use uchain_sim::{
    analyse::Kind,
    sweep::table::{Lists, Table, Values},
};

/// What the arrays of a kind hold.
pub(super) fn name(kind: Kind) -> &'static str {
    match kind {
        Kind::Count => "int64",
        Kind::Number => "float64",
        Kind::Single => "float32",
        Kind::Text => "text",
        Kind::Numbers => "list of float64",
        Kind::Singles => "list of float32",
    }
}

/// A column as an array; `None` if there is none of this name.
pub(super) fn array<'py>(py: Python<'py>, table: &Table, name: &str) -> PyResult<Option<Bound<'py, PyAny>>> {
    let Some(place) = table.columns().iter().position(|column| column.name == name) else { return Ok(None) };
    let blocks = || table.blocks().iter().filter_map(|block| block.values().get(place));
    let kind = table.columns().get(place).map(|column| column.kind);
    let array = match kind {
        Some(Kind::Count) => {
            let counts = || blocks().filter_map(|v| if let Values::Counts(v) = v { Some(v) } else { None });
            let whole: Option<Vec<i64>> = counts().flatten().copied().collect();
            match whole {
                Some(counts) => PyArray1::from_vec(py, counts).into_any(),
                // Whole numbers know no NaN.
                None => {
                    let numbers =
                        counts().flatten().map(|count| count.map_or(f64::NAN, |count| count as f64));
                    PyArray1::from_vec(py, numbers.collect()).into_any()
                }
            }
        }
        Some(Kind::Number) => {
            let numbers = blocks().filter_map(|v| if let Values::Numbers(v) = v { Some(v) } else { None });
            PyArray1::from_vec(py, numbers.flatten().copied().collect::<Vec<f64>>()).into_any()
        }
        Some(Kind::Single) => {
            let numbers = blocks().filter_map(|v| if let Values::Singles(v) = v { Some(v) } else { None });
            PyArray1::from_vec(py, numbers.flatten().copied().collect::<Vec<f32>>()).into_any()
        }
        _ => {
            let mut objects: Vec<Py<PyAny>> = Vec::new();
            for values in blocks() {
                match values {
                    Values::Texts(texts) => {
                        let object = |text: Option<&str>| match text {
                            Some(text) => PyString::new(py, text).into_any().unbind(),
                            None => py.None(),
                        };
                        objects.extend(texts.iter().map(object));
                    }
                    Values::NumberLists(lists) => objects.extend(arrays(py, lists)),
                    Values::SingleLists(lists) => objects.extend(arrays(py, lists)),
                    _ => {}
                }
            }
            PyArray1::from_vec(py, objects).into_any()
        }
    };
    Ok(Some(array))
}

/// An array for every list.
fn arrays<T: numpy::Element + Copy>(py: Python<'_>, lists: &Lists<T>) -> impl Iterator<Item = Py<PyAny>> {
    lists.iter().map(move |list| match list {
        Some(list) => PyArray1::from_slice(py, list).into_any().unbind(),
        None => py.None(),
    })
}
