//! Arguments of planners.

use std::path::PathBuf;

use pyo3::{exceptions::PyValueError, prelude::*, types::PyString};
use uchain_sim::registry::{PlanArgument, PlanFor};

use crate::{run::shown, scenario::Scenario};

/// A scenario, or a bare map by its path.
pub(super) fn asked_for(what: &Bound<'_, PyAny>) -> PyResult<PlanFor> {
    if what.is_instance_of::<PyString>() || what.hasattr("__fspath__")? {
        let path: PathBuf = what.extract()?;
        if let Some(Ok(map @ PlanFor::Map(_))) = path.to_str().map(PlanFor::find) {
            return Ok(map);
        }
    }
    let scenario = Scenario::of(what)?;
    let Scenario { source, sets, .. } = scenario.get();
    Ok(PlanFor::Scenario(source.clone(), sets.clone()))
}

/// An argument as it may be typed.
pub(super) fn typed(argument: PlanArgument<'_>) -> String {
    match argument {
        PlanArgument::Map(map) => map.to_owned(),
        PlanArgument::Base([x, y]) => format!("base_m=({x}, {y})"),
        PlanArgument::Goal([x, y]) => format!("goal_m=({x}, {y})"),
        PlanArgument::Heading(deg) => format!("heading_deg={deg}"),
    }
}

/// A number within its bounds.
pub(super) fn number(
    name: &str,
    value: Option<f64>,
    is_good: impl Fn(f64) -> bool,
    expected: &str,
) -> PyResult<Option<f64>> {
    match value {
        Some(value) if !is_good(value) => {
            Err(PyValueError::new_err(format!("{name} = {value}: expected {expected}")))
        }
        value => Ok(value),
    }
}

pub(super) fn length(name: &str, value: Option<f64>) -> PyResult<Option<f64>> {
    number(name, value, |value| value.is_finite() && value > 0.0, "a length in metres, more than 0")
}

/// A whole number within its bounds.
pub(super) fn count(
    name: &str,
    value: Option<&Bound<'_, PyAny>>,
    least: usize,
    most: usize,
) -> PyResult<Option<usize>> {
    let Some(value) = value else { return Ok(None) };
    let number = value.extract::<usize>().ok().filter(|number| (least..=most).contains(number));
    number.map(Some).ok_or_else(|| {
        let message = format!("{name} = {}: expected a whole number from {least} to {most}", shown(value));
        PyValueError::new_err(message)
    })
}

pub(super) fn point(name: &str, value: Option<[f64; 2]>) -> PyResult<Option<[f64; 2]>> {
    let is_good = value.is_none_or(|[x, y]| x.is_finite() && y.is_finite());
    is_good
        .then_some(value)
        .ok_or_else(|| PyValueError::new_err(format!("{name}: expected two numbers, in metres")))
}
