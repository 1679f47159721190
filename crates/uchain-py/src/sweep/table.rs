//! Tables: a row a run.

use std::{path::PathBuf, sync::Arc};

use pyo3::{
    exceptions::{PyKeyError, PyTypeError},
    prelude::*,
    types::{PyBytes, PyCapsule, PyDict, PyType},
};
use pyo3_arrow::ffi::to_schema_pycapsule;
use uchain_sim::sweep::{folder::Folder, table};

use super::{arrow, columns, html, report::Report};
use crate::{errors, registry, run::shown, work::off_the_lock};

/// Rows of a sweep, one for every run, in the order of the runs.
///
/// Every data frame takes it as it is, without a package that uchain would need: `polars.DataFrame(table)`,
/// `pandas.DataFrame.from_arrow(table)`, `pyarrow.table(table)`, `duckdb.sql("from table")`. What is absent is null there.
///
/// Columns are `run`, `variant`, `replicate`, `seed`, those of the design, `failed` (why a run failed, absent if it did
/// not) and the numbers of the summary; the guide to results says what they mean. It does not change, can be pickled, and
/// two of the same sweep with the same rows are equal, bit for bit.
///
/// >>> straight = uchain.Scenario.from_name("straight").with_(duration_s=5)
/// >>> table = uchain.sweep(straight, {"radio.sigma_db": [0, 4]}, replicates=3, progress=False)
/// >>> len(table), table.columns[:6]
/// (6, ['run', 'variant', 'replicate', 'seed', 'radio.sigma_db', 'failed'])
/// >>> table["radio.sigma_db"]
/// array([0., 0., 0., 4., 4., 4.])
#[pyclass(frozen, module = "uchain")]
pub(crate) struct Table {
    pub(super) table: Arc<table::Table>,
}

impl Table {
    pub(super) fn of(table: table::Table) -> Self {
        Self { table: Arc::new(table) }
    }
}

#[pymethods]
impl Table {
    /// Names of the columns.
    #[getter]
    fn columns(&self) -> Vec<&str> {
        self.table.columns().iter().map(|column| column.name.as_str()).collect()
    }

    /// What the columns hold: a dict of names to `int64`, `float64`, `float32`, `text`, `list of float64` or
    /// `list of float32`.
    #[getter]
    fn schema<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let schema = PyDict::new(py);
        for column in self.table.columns() {
            schema.set_item(&column.name, columns::name(column.kind))?;
        }
        Ok(schema)
    }

    /// What was flown, as in a folder's `sweep.json`: a dict of scenario (its text), set, design, replicates, seed, runs,
    /// version and more. Rows are a function of this and nothing else.
    #[getter]
    fn about<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let json = serde_json::to_string(self.table.manifest());
        let json = json.map_err(|error| errors::SweepError::new_err(error.to_string()))?;
        py.import("json")?.call_method1("loads", (json,))
    }

    /// Name of the scenario.
    #[getter]
    #[expect(clippy::misnamed_getters, reason = "the manifest keeps the scenario's text under this name")]
    fn scenario(&self) -> &str {
        &self.table.manifest().name
    }

    /// Root seed.
    #[getter]
    fn seed(&self) -> u64 {
        self.table.manifest().seed
    }

    /// Runs of every variant.
    #[getter]
    fn replicates(&self) -> u64 {
        self.table.manifest().replicates
    }

    /// Number of variants.
    #[getter]
    fn variants(&self) -> u64 {
        self.table.sweep().variants()
    }

    /// Whether all runs of the sweep are there; those of a shard are not.
    #[getter]
    fn is_complete(&self) -> bool {
        self.table.whole().is_ok()
    }

    /// How many of its runs failed: they could not be flown, or their mission failed.
    #[getter]
    fn failed(&self, py: Python<'_>) -> u64 {
        py.detach(|| self.table.totals().failed)
    }

    /// Hash of the digests of all runs, 16 hex digits: what `uchain sweep` says at its end.
    #[getter]
    fn digest(&self, py: Python<'_>) -> String {
        py.detach(|| self.table.totals().digest)
    }

    /// Writes the rows as Parquet: of a complete sweep the very bytes of `runs.parquet` that `uchain sweep` writes. The file
    /// is there whole or not at all.
    ///
    /// Raises `OSError` if it cannot be written.
    #[expect(clippy::needless_pass_by_value, reason = "an argument from Python")]
    fn to_parquet(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        let written = off_the_lock(py, |_| errors::caught(|| self.table.write(&path)), |_| Ok(()))??;
        written.map_err(errors::sweep)
    }

    /// What the sweep came to, variant by variant: means, their 95 % intervals (Student's t), medians, failures, pictures.
    ///
    /// Raises `SweepError` if runs are missing.
    ///
    /// >>> straight = uchain.Scenario.from_name("straight").with_(duration_s=5)
    /// >>> table = uchain.sweep(straight, {"radio.sigma_db": [0, 4]}, replicates=3, progress=False)
    /// >>> print(table.report())
    /// # Sweep of straight
    /// <BLANKLINE>
    /// - 6 runs: 2 variants × 3 replicates
    /// ...
    fn report(slf: &Bound<'_, Self>) -> PyResult<Report> {
        Report::of(slf)
    }

    fn __len__(&self) -> usize {
        usize::try_from(self.table.rows()).unwrap_or(usize::MAX)
    }

    /// A column as an array of numpy, shape (rows,). Numbers are float64 or float32, NaN where they are absent; whole
    /// numbers are int64, or float64 if any is absent; words and lists are objects, `None` where they are absent. A list is
    /// an array of its own.
    ///
    /// Raises `KeyError` if there is no such column.
    fn __getitem__<'py>(&self, py: Python<'py>, name: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let got = shown(name);
        let Ok(name) = name.extract::<String>() else {
            let message = format!("[{got}]: expected the name of a column; `columns` lists them");
            return Err(PyTypeError::new_err(message));
        };
        columns::array(py, &self.table, &name).ok_or_else(|| {
            PyKeyError::new_err(format!("no column {got}; `columns` lists those that there are"))
        })
    }

    fn __contains__(&self, name: &Bound<'_, PyAny>) -> bool {
        let name: Option<String> = name.extract().ok();
        name.is_some_and(|name| self.table.columns().iter().any(|column| column.name == name))
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        Ok(self.columns().into_pyobject(py)?.try_iter()?.into_any())
    }

    /// The rows as a stream of Arrow's, batch by batch, for data frames.
    #[pyo3(signature = (requested_schema=None))]
    fn __arrow_c_stream__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let stream = Bound::new(py, arrow::stream(&self.table))?;
        stream.call_method1("__arrow_c_stream__", (requested_schema,))
    }

    /// The columns as a schema of Arrow's.
    fn __arrow_c_schema__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyCapsule>> {
        Ok(to_schema_pycapsule(py, arrow::schema(self.table.columns()).as_ref())?)
    }

    fn __eq__(&self, py: Python<'_>, other: &Bound<'_, PyAny>) -> bool {
        other.cast::<Self>().is_ok_and(|other| {
            let other = &other.get().table;
            py.detach(|| self.table == *other)
        })
    }

    /// Pickled as what was flown, and its rows as they are written to files.
    #[expect(clippy::type_complexity, reason = "what pickle asks for: how to make it, and of what")]
    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> PyResult<(Bound<'py, PyAny>, (String, Bound<'py, PyBytes>))> {
        let (py, table) = (slf.py(), &slf.get().table);
        let bytes = py.detach(|| errors::caught(|| table.to_bytes()))?;
        let (about, rows) = bytes.map_err(errors::sweep)?;
        Ok((slf.get_type().getattr("_unpickled")?, (about, PyBytes::new(py, &rows))))
    }

    /// How pickle makes one.
    #[classmethod]
    #[expect(clippy::needless_pass_by_value, reason = "arguments from Python")]
    fn _unpickled(cls: &Bound<'_, PyType>, about: String, rows: &[u8]) -> PyResult<Self> {
        let rows = rows.to_vec();
        let read = || errors::caught(|| table::Table::from_bytes(registry(), &about, rows));
        Ok(Self::of(cls.py().detach(read)?.map_err(errors::sweep)?))
    }

    fn __repr__(&self) -> String {
        let manifest = self.table.manifest();
        let (rows, columns) = (self.table.rows(), self.table.columns().len());
        let of = if rows == manifest.runs { String::new() } else { format!(" of {}", manifest.runs) };
        format!("<uchain.Table {}: {rows}{of} runs, {columns} columns>", manifest.name)
    }

    /// The first rows of what is short.
    fn _repr_html_(&self) -> String {
        html::of(&self.table, self.__repr__().trim_matches(['<', '>']))
    }
}

/// The table in a folder of `uchain sweep`, or of `uchain.sweep(…, out=folder)`: all rows of a sweep that is complete,
/// else those that were flown so far.
///
/// Raises `SweepError` if the folder holds no sweep, or a damaged one; `OSError` if it cannot be read.
///
/// >>> straight = uchain.Scenario.from_name("straight").with_(duration_s=5)
/// >>> table = uchain.sweep(straight, replicates=3, out="sweeps/straight", progress=False)
/// >>> uchain.open_sweep("sweeps/straight") == table
/// True
#[pyfunction]
#[expect(clippy::needless_pass_by_value, reason = "an argument from Python")]
pub(super) fn open_sweep(py: Python<'_>, folder: PathBuf) -> PyResult<Table> {
    let read = || table::Table::read(&Folder::open(&folder)?.with_missions(registry()));
    let read = off_the_lock(py, |_| errors::caught(read), |_| Ok(()))??;
    read.map(Table::of).map_err(errors::sweep)
}

/// One table of many: all shards of a sweep, in any order, are the whole table, byte for byte.
///
/// Parameters
/// ----------
/// tables : iterable of Table
///     Tables of one sweep, no run in two of them.
///
/// Raises
/// ------
/// SweepError
///     No tables, tables of different sweeps, a run that is in two of them.
///
/// >>> def part(shard):
/// ...     straight = uchain.Scenario.from_name("straight").with_(duration_s=2)
/// ...     return uchain.sweep(straight, replicates=9, shard=shard, progress=False)
/// >>> uchain.concat([part((2, 2)), part((1, 2))]) == part((1, 1))
/// True
#[pyfunction]
pub(super) fn concat(py: Python<'_>, tables: &Bound<'_, PyAny>) -> PyResult<Table> {
    let mut shards: Vec<Arc<table::Table>> = Vec::new();
    let wrong = |got: &Bound<'_, PyAny>| {
        PyTypeError::new_err(format!("tables: {}: expected a list of uchain.Table", shown(got)))
    };
    for table in tables.try_iter().map_err(|_| wrong(tables))? {
        let table = table?;
        shards.push(table.cast::<Table>().map_err(|_| wrong(&table))?.get().table.clone());
    }
    let joined = py.detach(|| {
        let tables: Vec<&table::Table> = shards.iter().map(Arc::as_ref).collect();
        errors::caught(|| table::Table::concat(&tables))
    })?;
    joined.map(Table::of).map_err(errors::sweep)
}
