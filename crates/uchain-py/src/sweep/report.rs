//! Reports: what a sweep came to, variant by variant.

use std::{
    path::PathBuf,
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
};

use numpy::PyArray1;
use pyo3::{
    exceptions::PyKeyError,
    prelude::*,
    types::{PyDict, PyList},
};
use uchain_sim::analyse::Estimate;
use uchain_sim::sweep::{
    folder::FolderError,
    report::{Failures, Metric, failures, markdown, metric, metrics, picture, save},
    table,
};

use super::table::Table;
use crate::{errors, run::Picture, work::off_the_lock};

/// What a sweep came to, variant by variant: what `uchain report` says. `str()` of it is text in Markdown.
///
/// Source: intervals are those of Student's t-distribution, 95 % for the mean of a variant.
#[pyclass(frozen, module = "uchain")]
pub(crate) struct Report {
    owner: Py<Table>,
    table: Arc<table::Table>,
    metrics: Vec<Metric>,
    failures: Failures,
    text: String,
}

impl Report {
    pub(super) fn of(owner: &Bound<'_, Table>) -> PyResult<Self> {
        let table = owner.get().table.clone();
        let work = || -> Result<_, FolderError> {
            table.whole()?;
            let told = |_: u64, _: &_| Ok::<(), FolderError>(());
            let columns = metrics(table.sweep());
            let metrics: Vec<Metric> =
                columns.iter().map(|column| metric(&*table, column, told)).collect::<Result<_, _>>()?;
            let failures = failures(&*table, table.sweep())?;
            let text = markdown(table.manifest(), table.sweep(), &table.totals(), &metrics, &failures);
            Ok((metrics, failures, text))
        };
        let done = off_the_lock(owner.py(), |_| errors::caught(work), |_| Ok(()))??;
        let (metrics, failures, text) = done.map_err(errors::sweep)?;
        Ok(Self { owner: owner.clone().unbind(), table, metrics, failures, text })
    }
}

impl Report {
    /// Draws those in which there is something to see.
    fn drawn<'a>(&self, py: Python<'_>, metrics: &[&'a Metric]) -> PyResult<Vec<(&'a str, Picture)>> {
        let work = |stop: &AtomicBool| {
            let mut drawn = Vec::new();
            for metric in metrics {
                if stop.load(Ordering::Relaxed) {
                    break;
                }
                if let Some(picture) = picture(&*self.table, self.table.sweep(), metric)? {
                    drawn.push((metric.name.as_str(), picture.png));
                }
            }
            Ok(drawn)
        };
        let drawn = off_the_lock(py, |stop| errors::caught(|| work(stop)), |_| Ok(()))??;
        let drawn: Vec<_> = drawn.map_err(errors::report)?;
        Ok(drawn.into_iter().map(|(name, png)| (name, Picture::of(py, &png))).collect())
    }
}

#[pymethods]
impl Report {
    /// Statistics of every number of the summary, of the first 1000 variants: a dict of names to dicts of arrays of numpy,
    /// shape (variants,): `runs` that have the number (int64), `mean`, `mean_low` and `mean_high` (the ends of its 95 %
    /// interval), `median` (float64, NaN where there is none).
    #[getter]
    fn numbers<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let numbers = PyDict::new(py);
        for metric in &self.metrics {
            let cells = || metric.cells.iter().copied();
            let count =
                |cell: Option<Estimate>| cell.map_or(0, |cell| i64::try_from(cell.count).unwrap_or(i64::MAX));
            let runs: Vec<i64> = cells().map(count).collect();
            let mean = cells().map(|cell| cell.map_or(f64::NAN, |cell| cell.mean)).collect();
            let median = cells().map(|cell| cell.map_or(f64::NAN, |cell| cell.median)).collect();
            let ends = cells().map(|cell| cell.filter(|cell| cell.half_width.is_some()));
            let ends = ends.map(|cell| cell.map_or((f64::NAN, f64::NAN), |cell| cell.interval()));
            let (low, high): (Vec<f64>, Vec<f64>) = ends.unzip();
            let columns = PyDict::new(py);
            columns.set_item("runs", PyArray1::from_vec(py, runs))?;
            for (name, values) in [("mean", mean), ("mean_low", low), ("mean_high", high), ("median", median)]
            {
                columns.set_item(name, PyArray1::from_vec(py, values))?;
            }
            numbers.set_item(&metric.name, columns)?;
        }
        Ok(numbers)
    }

    /// Why runs failed: a list of dicts with `failed` (the outcome's word, or why a run was not flown), `verdict` (the words
    /// of the first, with numbers), `runs` (how many) and `first` (the first of them). At most 20 different reasons.
    #[getter]
    fn failures<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let all = PyList::empty(py);
        for reason in &self.failures.reasons {
            let row = PyDict::new(py);
            row.set_item("failed", &reason.words)?;
            row.set_item("verdict", &reason.verdict)?;
            row.set_item("runs", reason.runs)?;
            row.set_item("first", reason.first)?;
            all.append(row)?;
        }
        Ok(all)
    }

    /// The picture of a number: its mean over what is varied with the 95 % interval, or how it is distributed if there is
    /// one variant only. None if there is nothing in it to see: it is the same in all runs, or in none.
    ///
    /// Raises `KeyError` if the summary has no such number.
    ///
    /// >>> straight = uchain.Scenario.from_name("straight").with_(duration_s=5)
    /// >>> table = uchain.sweep(straight, {"radio.sigma_db": [0, 4]}, replicates=3, progress=False)
    /// >>> table.report().picture("head_reach_m")
    /// <uchain.Picture 1400 x ... px, ... bytes>
    fn picture(&self, py: Python<'_>, name: &str) -> PyResult<Option<Picture>> {
        let metric = self.metrics.iter().find(|metric| metric.name == name);
        let metric = metric.ok_or_else(|| {
            PyKeyError::new_err(format!("no number '{name}'; `numbers` has those that there are"))
        })?;
        Ok(self.drawn(py, &[metric])?.pop().map(|(_, picture)| picture))
    }

    /// All pictures there are: a dict of names to `Picture`. Drawing them takes some 50 ms each.
    fn pictures<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let pictures = PyDict::new(py);
        for (name, picture) in self.drawn(py, &self.metrics.iter().collect::<Vec<_>>())? {
            pictures.set_item(name, picture)?;
        }
        Ok(pictures)
    }

    /// Writes the files of `uchain report` into a folder, which is made if it is absent: `report.md`, `report.csv` and
    /// pictures (PNG, SVG) in `plots`. An older report there goes first.
    ///
    /// Raises `SweepError` if `plots` holds something else, `OSError` if a file cannot be written.
    #[expect(clippy::needless_pass_by_value, reason = "an argument from Python")]
    fn save(&self, py: Python<'_>, folder: PathBuf) -> PyResult<()> {
        let work = || save(&*self.table, self.table.sweep(), &folder).map(drop);
        let saved = off_the_lock(py, |_| errors::caught(work), |_| Ok(()))??;
        saved.map_err(errors::report)
    }

    fn __str__(&self) -> &str {
        &self.text
    }

    /// The text without links to pictures, which are in no file.
    fn _repr_markdown_(&self) -> String {
        let lines = self.text.lines().filter(|line| !line.starts_with("!["));
        lines.flat_map(|line| [line, "\n"]).collect()
    }

    fn __repr__(&self) -> String {
        format!("<uchain.Report of {} runs of {}>", self.table.rows(), self.table.manifest().name)
    }

    /// Pickled as its table.
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, (Bound<'py, Table>,))> {
        let owner = self.owner.bind(py);
        Ok((owner.get_type().getattr("report")?, (owner.clone(),)))
    }
}
