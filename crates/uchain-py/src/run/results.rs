//! What a run leaves behind.

use std::{
    fmt::Write as _,
    path::PathBuf,
    sync::{Mutex, PoisonError},
};

use pyo3::{
    exceptions::PyAttributeError,
    prelude::*,
    types::{PyBytes, PyDict, PyTuple, PyType},
};
use uchain_sim::registry::Kept;

use super::{Picture, columns::Columns, event::Event, graph::Graph, summary::Summary};
use crate::{errors, scenario::Scenario};

/// What a run left behind.
///
/// It pickles as its numbers and its picture, which is drawn for it; nothing is flown again where it arrives.
///
/// >>> run = uchain.run(uchain.Scenario.from_name("straight").with_(duration_s=5), seed=7)
/// >>> run.seed, run.scenario.name, len(run.digest)
/// (7, 'straight', 16)
#[pyclass(frozen, subclass, module = "uchain")]
pub(crate) struct Run {
    /// What was flown.
    #[pyo3(get)]
    scenario: Py<Scenario>,
    /// Seed of all its noise.
    #[pyo3(get)]
    seed: u64,
    /// Whether all went as it should.
    #[pyo3(get)]
    ok: bool,
    /// A hash over every bit of every frame: 16 hexadecimal digits, equal wherever the same is flown.
    #[pyo3(get)]
    digest: String,
    /// What the run came to, in numbers: the very ones of `summary.json`.
    #[pyo3(get)]
    summary: Py<Summary>,
    /// What happened, in order: a tuple of `Event`, at most the first 100,000.
    #[pyo3(get)]
    events: Py<PyTuple>,
    tables: Py<PyDict>,
    graph: Option<Py<Graph>>,
    drawing: Mutex<Drawing>,
}

/// A picture that is drawn when it is wanted.
enum Drawing {
    /// By what was kept for it.
    Kept(Box<dyn Kept>),
    /// It is there.
    Drawn(Vec<u8>),
}

impl Run {
    pub(crate) fn of(
        scenario: Py<Scenario>,
        seed: u64,
        mut kept: Box<dyn Kept>,
        json: &str,
        py: Python<'_>,
    ) -> PyResult<Self> {
        let log = kept.take_log();
        let tables = PyDict::new(py);
        for table in log.tables {
            tables.set_item(table.name, Columns::of(py, table)?)?;
        }
        let graph = kept.graph().map(|graph| Graph::of(py, graph).and_then(|graph| Py::new(py, graph)));
        Ok(Self {
            scenario,
            seed,
            ok: kept.verdict().outcome().is_success(),
            digest: kept.digest().to_owned(),
            summary: Summary::read(py, json)?.unbind(),
            events: Event::all(py, log.events)?.unbind(),
            tables: tables.unbind(),
            graph: graph.transpose()?,
            drawing: Mutex::new(Drawing::Kept(kept)),
        })
    }

    /// A table by its name.
    fn table<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let tables = self.tables.bind(py);
        if let Some(table) = tables.get_item(name)? {
            return Ok(table);
        }
        let known: Vec<String> = tables.keys().iter().map(|key| key.to_string()).collect();
        let mission = self.scenario.get().mission();
        Err(PyAttributeError::new_err(if known.is_empty() {
            format!("no {name}: they were not kept (frames=None), or a run of this mission has none")
        } else {
            format!(
                "the run of a scenario of this mission ({mission}) has no {name}: it has {}",
                known.join(", ")
            )
        }))
    }

    /// The picture, drawn without the interpreter's lock.
    fn png(&self, py: Python<'_>) -> PyResult<Vec<u8>> {
        let drawn = py.detach(|| {
            let mut drawing = self.drawing.lock().unwrap_or_else(PoisonError::into_inner);
            let png = match &mut *drawing {
                Drawing::Drawn(png) => return Ok(Ok(png.clone())),
                Drawing::Kept(kept) => errors::caught(|| kept.picture())?,
            };
            if let Ok(png) = &png {
                *drawing = Drawing::Drawn(png.clone());
            }
            Ok::<_, PyErr>(png)
        })?;
        drawn.map_err(|error| errors::flight(&error))
    }

    fn word<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        self.summary.bind(py).as_any().get_item(name)
    }
}

#[pymethods]
impl Run {
    /// What it came to in a word, such as "completed".
    #[getter]
    fn outcome<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.word(py, "outcome")
    }

    /// What it came to, with numbers.
    #[getter]
    fn verdict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.word(py, "verdict")
    }

    /// Robots over time, `Columns`: a row for each tick (20 per simulated second), or for each decision.
    ///
    /// Times are those of the end of the tick, places those in the map's frame, x east and y north. Of a chain: `time_s`,
    /// `decision`, `leader`, `head_reach_m`, `head_pilot_mps`, `head_allowed_mps`, `head_asked_mps`, shape (rows,);
    /// `x_m`, `y_m`, `heading_rad`, `forward_mps`, `lateral_mps`, `yaw_rate_radps`, `airborne`, `wall_contacts`,
    /// `uav_contacts`, `tof_nw_m`, `tof_ne_m`, `tof_sw_m`, `tof_se_m`, shape (rows, UAVs). Of an exploration: `time_s`,
    /// `decision`, `round`, shape (rows,); `x_m`, `y_m`, `z_m`, `heading_rad`, `level`, `purpose`, `moves`, `holds`, `mfl`,
    /// `wall_contacts`, `robot_contacts`, `level_passes`, shape (rows, robots).
    ///
    /// Raises `AttributeError` if no frames were kept.
    #[getter]
    fn frames<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.table(py, "frames")
    }

    /// Links of a chain over time, `Columns`: a row for each decision.
    ///
    /// `time_s` and `decided_s` (when the losses were measured, at the start of the tick), `worst_link_db`, `spread_db`,
    /// shape (rows,); `true_db`, `filtered_db`, `raw_db`, `front_silence_s`, `rear_silence_s`, shape (rows, UAVs): a link
    /// stands at the UAV at its front end, toward the head, and NaN where that has none.
    ///
    /// Raises `AttributeError` if no frames were kept, or it is no chain.
    #[getter]
    fn links<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.table(py, "links")
    }

    /// Rounds of an exploration, `Columns`: a row for each round in which robots scanned and decided, and one for the end.
    ///
    /// `time_s`, `decided_s` (at the start of the tick), `round`, `nodes`, `edges`, `hubs` (nodes with a frontier),
    /// `moving`, `distance_m`, `wall_contacts`, `robot_contacts`, `coverage` (share of the reachable ground that was seen,
    /// 0 to 1), shape (rows,).
    ///
    /// Raises `AttributeError` if no frames were kept, or it is no exploration.
    #[getter]
    fn rounds<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.table(py, "rounds")
    }

    /// All tables over time by their names: a dict of `Columns`.
    #[getter]
    fn tables<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.tables.bind(py).copy()
    }

    /// The graph that explorers made; None if nobody made one.
    #[getter]
    fn graph(&self, py: Python<'_>) -> Option<Py<Graph>> {
        self.graph.as_ref().map(|graph| graph.clone_ref(py))
    }

    /// The run on one page, as `uchain run` draws it; written to `path`, too, if there is one. Notebooks show it.
    ///
    /// Raises `UchainError` if it cannot be drawn, `OSError` if it cannot be written.
    #[pyo3(signature = (path=None))]
    fn plot(&self, py: Python<'_>, path: Option<PathBuf>) -> PyResult<Picture> {
        let picture = Picture::of(py, &self.png(py)?);
        if let Some(path) = path {
            picture.write(py, &path)?;
        }
        Ok(picture)
    }

    /// For notebooks: what it came to, its numbers, its picture.
    fn _repr_html_(&self, py: Python<'_>) -> PyResult<String> {
        let escape = py.import("html")?.getattr("escape")?;
        let escaped = |text: &str| escape.call1((text,)).map(|text| text.to_string());
        let title = escaped(&self.__repr__(py)?.replace(['<', '>'], ""))?;
        let verdict = escaped(&self.verdict(py)?.to_string())?;
        let mut html = format!("<p><b>{title}</b><br>{verdict}</p><table>");
        for (name, value) in
            self.summary.bind(py).call_method0("items")?.extract::<Vec<(String, Bound<'_, PyAny>)>>()?
        {
            if !["outcome", "verdict"].contains(&name.as_str()) && value.extract::<f64>().is_ok() {
                let (name, value) = (escaped(&name)?, escaped(&value.to_string())?);
                // Writing to a String cannot fail.
                let _ = write!(html, "<tr><td>{name}</td><td>{value}</td></tr>");
            }
        }
        let png = PyBytes::new(py, &self.png(py)?);
        let base64 =
            py.import("base64")?.call_method1("b64encode", (png,))?.call_method1("decode", ("ascii",))?;
        Ok(html + &format!("</table><img src=\"data:image/png;base64,{base64}\" style=\"max-width: 100%\">"))
    }

    /// Pickled as its numbers and its picture.
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        Ok((slf.get_type().getattr("_unpickled")?, slf.get().parts(slf.py())?))
    }

    /// How pickle makes one.
    #[classmethod]
    #[expect(clippy::too_many_arguments, reason = "all that it is")]
    fn _unpickled(
        _: &Bound<'_, PyType>,
        scenario: Py<Scenario>,
        seed: u64,
        ok: bool,
        digest: String,
        summary: Py<Summary>,
        events: Py<PyTuple>,
        tables: Py<PyDict>,
        graph: Option<Py<Graph>>,
        png: Vec<u8>,
    ) -> Self {
        let drawing = Mutex::new(Drawing::Drawn(png));
        Self { scenario, seed, ok, digest, summary, events, tables, graph, drawing }
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let name = self.scenario.get().scene.name().to_owned();
        let (seed, sim_s) = (self.seed, self.word(py, "sim_s")?);
        Ok(format!("<uchain.Run {name}, seed {seed}: {}, {sim_s} s, {}>", self.outcome(py)?, self.digest))
    }
}

impl Run {
    /// All that it is, for pickle.
    pub(crate) fn parts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let png = PyBytes::new(py, &self.png(py)?);
        let graph = self.graph(py);
        (
            self.scenario.clone_ref(py),
            self.seed,
            self.ok,
            &self.digest,
            self.summary.clone_ref(py),
            self.events.clone_ref(py),
            self.tables.clone_ref(py),
            graph,
            png,
        )
            .into_pyobject(py)
    }
}

pub(super) fn fill(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Run>()
}
