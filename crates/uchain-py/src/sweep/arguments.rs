//! Arguments of `sweep`, checked where they come in.

use pyo3::{Borrowed, exceptions::PyValueError, prelude::*, types::PyBool};
use uchain_sim::sweep::folder::{Record, Shard};

use crate::run::shown;

/// Most threads.
const THREADS_MAX: u64 = 1024;

/// A whole number between two others, both included.
fn whole(name: &str, value: &Bound<'_, PyAny>, low: u64, high: u64) -> PyResult<u64> {
    let number = if value.is_instance_of::<PyBool>() { None } else { value.extract::<u64>().ok() };
    number.filter(|number| (low..=high).contains(number)).ok_or_else(|| {
        let got = shown(value);
        PyValueError::new_err(format!("{name} = {got}: expected a whole number from {low} to {high}"))
    })
}

/// How often every variant is flown. What is too often, the design says.
#[derive(Debug, Clone, Copy)]
pub(super) struct Replicates(pub(super) u64);

impl<'a, 'py> FromPyObject<'a, 'py> for Replicates {
    type Error = PyErr;

    fn extract(value: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        whole("replicates", &value, 1, u64::MAX).map(Self)
    }
}

/// Runs at one time; none = one for every processor.
#[derive(Debug, Clone, Copy)]
pub(super) struct Threads(pub(super) Option<usize>);

impl<'a, 'py> FromPyObject<'a, 'py> for Threads {
    type Error = PyErr;

    fn extract(value: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        if value.is_none() {
            return Ok(Self(None));
        }
        whole("threads", &value, 1, THREADS_MAX).map(|threads| Self(Some(threads as usize)))
    }
}

/// Which part of a sweep.
#[derive(Debug, Clone, Copy)]
pub(super) struct Part(pub(super) Shard);

impl Part {
    pub(super) const WHOLE: Self = Self(Shard { number: 1, of: 1 });
}

impl<'a, 'py> FromPyObject<'a, 'py> for Part {
    type Error = PyErr;

    fn extract(value: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        if value.is_none() {
            return Ok(Self::WHOLE);
        }
        let pair: Option<(u64, u64)> = value.extract().ok();
        let shard = pair.filter(|(number, of)| (1..=*of).contains(number));
        shard.map(|(number, of)| Self(Shard { number, of })).ok_or_else(|| {
            let got = shown(&value);
            PyValueError::new_err(format!(
                "shard = {got}: expected (number, of) with number from 1 to of, such as (2, 4)"
            ))
        })
    }
}

/// Which runs leave a recording.
#[derive(Debug, Clone, Copy)]
pub(super) struct Recorded(pub(super) Record);

impl<'a, 'py> FromPyObject<'a, 'py> for Recorded {
    type Error = PyErr;

    fn extract(value: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        match value.extract::<String>().as_deref() {
            Ok("none") => Ok(Self(Record::None)),
            Ok("failed") => Ok(Self(Record::Failed)),
            Ok("all") => Ok(Self(Record::All)),
            _ => {
                let got = shown(&value);
                let message = format!("record = {got}: expected \"none\", \"failed\" or \"all\"");
                Err(PyValueError::new_err(message))
            }
        }
    }
}
