//! Arguments of planners.

use std::path::PathBuf;

use pyo3::{
    exceptions::PyValueError,
    prelude::*,
    types::{PyDict, PyString},
};
use uchain_sim::{
    radio::LinkBudget,
    registry::{PlanArgument, PlanFor, Spot},
};

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
        PlanArgument::Cell(cell_m) => format!("cell_m={cell_m}"),
        PlanArgument::From(name) => format!("from_station={name:?}"),
        PlanArgument::To(name) => format!("to_station={name:?}"),
        PlanArgument::Budget => "budget".to_owned(),
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

/// A place: two numbers, or a name that the map has for it.
pub(super) fn spot(name: &str, value: Option<&Bound<'_, PyAny>>) -> PyResult<Option<Spot>> {
    let Some(value) = value else { return Ok(None) };
    if value.is_instance_of::<PyString>() {
        return value.extract().map(Spot::Named).map(Some);
    }
    let at_m: [f64; 2] = value.extract()?;
    let is_good = at_m.iter().all(|value| value.is_finite());
    let wrong = || PyValueError::new_err(format!("{name}: expected two numbers, in metres"));
    is_good.then_some(Some(Spot::At(at_m))).ok_or_else(wrong)
}

/// A link budget: a word, a path, or its keys in a dict.
pub(super) fn budget(value: Option<&Bound<'_, PyAny>>) -> PyResult<Option<LinkBudget>> {
    let Some(value) = value else { return Ok(None) };
    let text = match value.cast::<PyDict>() {
        Ok(keys) => {
            let pair = |(key, value): (Bound<'_, PyAny>, Bound<'_, PyAny>)| {
                Ok(format!("{}={:?}", key.extract::<String>()?, value.extract::<f64>()?))
            };
            keys.iter().map(pair).collect::<PyResult<Vec<String>>>()?.join(",")
        }
        Err(_) => value.extract::<PathBuf>()?.to_string_lossy().into_owned(),
    };
    LinkBudget::read(&text)
        .map(Some)
        .map_err(|error| PyValueError::new_err(error.to_string().replace("--budget", "budget")))
}
