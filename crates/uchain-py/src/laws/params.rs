//! Parameters of a law as keywords: names, ranges and defaults are those of scenarios.

use pyo3::{
    IntoPyObjectExt,
    exceptions::{PyTypeError, PyValueError},
    prelude::*,
    types::PyDict,
};
use serde::{Serialize, de::DeserializeOwned};
use uchain_core::{
    chain::{CenterParams, EqualizeParams, KalmanParams, LinkParams, TakeoffParams},
    explore::ExploreParams,
    params::{Key, OutOfRange},
};

use crate::value::toml_value;

/// Parameters that a law declares.
pub(super) trait Params: Default + Serialize + DeserializeOwned {
    /// What they are called.
    const KEYS: &'static [Key];
    /// The first that is out of its range.
    fn check(&self) -> Result<(), OutOfRange>;
}

macro_rules! params {
    ($($Name:ty)*) => {
        $(impl Params for $Name {
            const KEYS: &'static [Key] = <$Name>::KEYS;
            fn check(&self) -> Result<(), OutOfRange> {
                self.check()
            }
        })*
    };
}

params! { KalmanParams EqualizeParams CenterParams TakeoffParams LinkParams ExploreParams }

/// Parameters by their keywords; those that are not given have the law's defaults.
///
/// # Errors
/// `TypeError` of an unknown keyword, with the known ones; `ValueError` of a value of another type or out of its range.
pub(super) fn from_keywords<P: Params>(given: Option<&Bound<'_, PyDict>>) -> PyResult<P> {
    let mut table = toml::map::Map::new();
    for (key, value) in given.into_iter().flatten() {
        let key: String = key.extract()?;
        if P::KEYS.iter().all(|known| known.name != key) {
            let known: Vec<&str> = P::KEYS.iter().map(|known| known.name).collect();
            let message = format!("unknown parameter '{key}'; there are {}", known.join(", "));
            return Err(PyTypeError::new_err(message));
        }
        // A whole number is a number as well.
        let value = match toml_value(&key, &value)? {
            toml::Value::Integer(whole) if is_number(&P::default(), &key) => toml::Value::Float(whole as f64),
            value => value,
        };
        table.insert(key, value);
    }
    let params: P = toml::Value::Table(table)
        .try_into()
        .map_err(|error: toml::de::Error| PyValueError::new_err(error.to_string().trim().to_owned()))?;
    params.check().map_err(|error| PyValueError::new_err(error.to_string()))?;
    Ok(params)
}

/// Whether a parameter is a number with a fraction.
fn is_number<P: Params>(params: &P, key: &str) -> bool {
    matches!(
        toml::Value::try_from(params),
        Ok(toml::Value::Table(table)) if matches!(table.get(key), Some(toml::Value::Float(_)))
    )
}

/// Parameters as a dict.
pub(super) fn to_dict<'py, P: Params>(py: Python<'py>, params: &P) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    let table = toml::Value::try_from(params).map_err(|error| PyValueError::new_err(error.to_string()))?;
    for (key, value) in table.as_table().into_iter().flatten() {
        let value = match value {
            toml::Value::Boolean(switch) => switch.into_bound_py_any(py)?,
            toml::Value::Integer(whole) => whole.into_bound_py_any(py)?,
            toml::Value::Float(number) => number.into_bound_py_any(py)?,
            toml::Value::String(word) => word.into_bound_py_any(py)?,
            other => other.to_string().into_bound_py_any(py)?,
        };
        dict.set_item(key, value)?;
    }
    Ok(dict)
}
