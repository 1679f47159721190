//! Values of Python as values of TOML.

use pyo3::{
    exceptions::{PyTypeError, PyValueError},
    prelude::*,
    types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyString, PyTuple},
};

/// Deepest lists within lists: as deep as TOML is read.
const DEPTH_MAX: usize = 80;
/// Most numbers and words in one value: more than any scenario may hold.
const PARTS_MAX: usize = 1_000_000;

/// A value as TOML has it, for `key=value`: a word gets its quotes. Numbers keep every digit.
///
/// # Errors
/// `TypeError` of what TOML has no word for, `ValueError` of a number or a list beyond its limits; both name the key.
pub(crate) fn toml_text(key: &str, value: &Bound<'_, PyAny>) -> PyResult<String> {
    Ok(toml_value(key, value)?.to_string())
}

/// A value as TOML has it.
///
/// # Errors
/// Those of [`toml_text`].
pub(crate) fn toml_value(key: &str, value: &Bound<'_, PyAny>) -> PyResult<toml::Value> {
    let mut parts = 0;
    part(key, value, 0, &mut parts)
}

fn part(key: &str, value: &Bound<'_, PyAny>, depth: usize, parts: &mut usize) -> PyResult<toml::Value> {
    *parts += 1;
    if depth > DEPTH_MAX || *parts > PARTS_MAX {
        let most = format!("at most {PARTS_MAX} parts, {DEPTH_MAX} levels deep");
        return Err(PyValueError::new_err(format!("{key}: too large a value; expected {most}")));
    }
    if value.is_instance_of::<PyBool>() {
        return Ok(toml::Value::Boolean(value.extract()?));
    }
    if value.is_instance_of::<PyInt>() {
        let number = value.extract().map_err(|_| {
            PyValueError::new_err(format!("{key}: a whole number beyond 64 bits; expected a smaller one"))
        });
        return Ok(toml::Value::Integer(number?));
    }
    if value.is_instance_of::<PyFloat>() {
        return Ok(toml::Value::Float(value.extract()?));
    }
    if value.is_instance_of::<PyString>() {
        return Ok(toml::Value::String(value.extract()?));
    }
    if value.is_instance_of::<PyList>() || value.is_instance_of::<PyTuple>() {
        let mut items = Vec::new();
        for item in value.try_iter()? {
            items.push(part(key, &item?, depth + 1, parts)?);
        }
        return Ok(toml::Value::Array(items));
    }
    if let Ok(dict) = value.cast::<PyDict>() {
        let mut table = toml::map::Map::new();
        for (name, item) in dict {
            let name: String = name
                .extract()
                .map_err(|_| PyTypeError::new_err(format!("{key}: a table's keys are expected to be str")))?;
            table.insert(name, part(key, &item, depth + 1, parts)?);
        }
        return Ok(toml::Value::Table(table));
    }
    // Paths, and numbers and arrays of numpy.
    for method in ["__fspath__", "tolist"] {
        if value.hasattr(method)? {
            let plain = value.call_method0(method)?;
            return part(key, &plain, depth + 1, parts);
        }
    }
    let got = value.get_type().name()?.to_string();
    Err(PyTypeError::new_err(format!(
        "{key}: a value of type {got}; expected bool, int, float, str, a path, a list or a dict of them"
    )))
}
