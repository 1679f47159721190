//! What a law of one's own may answer: speeds, and nothing else.

use numpy::PyReadonlyArrayDyn;
use pyo3::{
    prelude::*,
    types::{PyBool, PyFloat},
};

use super::params::float32_type;

/// A value in a message.
pub(crate) fn shown(value: &Bound<'_, PyAny>) -> String {
    const MOST: usize = 80;
    let text = value.repr().map_or_else(|_| "?".to_owned(), |text| text.to_string());
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    if text.chars().count() <= MOST { text } else { text.chars().take(MOST).chain(['…']).collect() }
}

fn type_of(value: &Bound<'_, PyAny>) -> String {
    value.get_type().name().map_or_else(|_| "?".to_owned(), |name| name.to_string())
}

/// What kind of numbers an array or scalar of numpy holds: 'f', 'i', 'u'; `None` of anything else.
fn kind(value: &Bound<'_, PyAny>) -> Option<String> {
    value.getattr("dtype").ok()?.getattr("kind").ok()?.extract().ok()
}

/// The speed that a law returns for one relay (m/s), or what is wrong with it.
pub(super) fn speed_mps(value: &Bound<'_, PyAny>) -> Result<f32, String> {
    let wrong = || {
        let (shown, kind) = (shown(value), type_of(value));
        format!("returned {shown} ({kind}): expected one finite number, the forward speed (m/s)")
    };
    let is_plain = value.is_exact_instance_of::<PyFloat>()
        || float32_type(value.py()).is_ok_and(|float32| value.get_type().is(float32));
    if !is_plain {
        let is_number = match kind(value) {
            Some(kind) => {
                let is_scalar =
                    value.getattr("shape").is_ok_and(|shape| shape.len().is_ok_and(|len| len == 0));
                is_scalar && ["f", "i", "u"].contains(&kind.as_str())
            }
            None => !value.is_none() && !value.is_instance_of::<PyBool>(),
        };
        if !is_number {
            return Err(wrong());
        }
    }
    let speed_mps = value.extract::<f64>().map_err(|_| wrong())? as f32;
    if speed_mps.is_finite() { Ok(speed_mps) } else { Err(wrong()) }
}

/// The speeds that stand in an array of this shape (m/s), or what is wrong with it. Whether they are finite is not asked.
pub(crate) fn speeds_mps(value: &Bound<'_, PyAny>, shape: &[usize]) -> Result<Vec<f32>, String> {
    let expected = format!("expected float32 of shape {}", as_python(shape));
    if let Ok(array) = value.extract::<PyReadonlyArrayDyn<'_, f32>>() {
        let array = array.as_array();
        if array.shape() != shape {
            return Err(format!("float32 of shape {}: {expected}", as_python(array.shape())));
        }
        return Ok(array.iter().copied().collect());
    }
    let wrong = || format!("{} ({}): {expected}", shown(value), type_of(value));
    if value.is_none() {
        return Err(wrong());
    }
    let numpy = value.py().import("numpy").map_err(|_| wrong())?;
    let array = numpy.call_method1("asarray", (value,)).map_err(|_| wrong())?;
    if !kind(&array).is_some_and(|kind| ["f", "i", "u"].contains(&kind.as_str())) {
        return Err(wrong());
    }
    let array = array.call_method1("astype", ("float64",)).map_err(|_| wrong())?;
    match array.extract::<PyReadonlyArrayDyn<'_, f64>>() {
        Ok(array) if array.as_array().shape() == shape => {
            Ok(array.as_array().iter().map(|&speed_mps| speed_mps as f32).collect())
        }
        Ok(array) => Err(format!("an array of shape {}: {expected}", as_python(array.as_array().shape()))),
        Err(_) => Err(wrong()),
    }
}

/// A shape as Python writes it.
fn as_python(shape: &[usize]) -> String {
    match shape {
        [one] => format!("({one},)"),
        _ => format!("({})", shape.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")),
    }
}
