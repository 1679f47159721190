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
pub(super) fn array<'py>(py: Python<'py>, table: &Table, name: &str) -> Option<Bound<'py, PyAny>> {
    let place = table.columns().iter().position(|column| column.name == name)?;
    let blocks = || table.blocks().iter().filter_map(|block| block.values().get(place));
    let array = match table.columns().get(place)?.kind {
        Kind::Count => {
            let counts = || blocks().filter_map(|v| if let Values::Counts(v) = v { Some(v) } else { None });
            let whole: Option<Vec<i64>> = counts().flatten().copied().collect();
            if let Some(counts) = whole {
                PyArray1::from_vec(py, counts).into_any()
            } else {
                // Whole numbers know no NaN.
                let numbers = counts().flatten().map(|count| count.map_or(f64::NAN, |count| count as f64));
                PyArray1::from_vec(py, numbers.collect()).into_any()
            }
        }
        Kind::Number => {
            let numbers = blocks().filter_map(|v| if let Values::Numbers(v) = v { Some(v) } else { None });
            PyArray1::from_vec(py, numbers.flatten().copied().collect::<Vec<f64>>()).into_any()
        }
        Kind::Single => {
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
    Some(array)
}

/// An array for every list.
fn arrays<T: numpy::Element + Copy>(py: Python<'_>, lists: &Lists<T>) -> impl Iterator<Item = Py<PyAny>> {
    lists.iter().map(move |list| match list {
        Some(list) => PyArray1::from_slice(py, list).into_any().unbind(),
        None => py.None(),
    })
}
