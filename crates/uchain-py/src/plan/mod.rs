//! What a planner asks before anyone flies: `plan` and `optimum`.

mod arguments;
mod optimum;

use std::{path::PathBuf, sync::atomic::Ordering};

use pyo3::{prelude::*, types::PyTuple};
use uchain_sim::{
    map::Tunnel,
    mission::chain::{self, PlanError, PlanRow, PlanSteps, PlanTable, UAVS_MAX, plan_png, plan_while},
    record::table::{Column, Table, Values},
    registry::{PlanRequest, PlanRequestError},
};

use crate::{
    errors::{self, ScenarioError},
    registry,
    run::{Columns, Picture, Summary, array},
    work::off_the_lock,
};
use arguments::{asked_for, count, length, number, point, typed};

/// The best chains against the depth of the head, and the time they take. Nothing was simulated.
///
/// `print(plan)` is the table of `uchain plan`. Notebooks show its picture.
///
/// >>> plan = uchain.plan("straight", to_m=10)
/// >>> plan.uavs_needed, plan.rows["depth_m"][-1]
/// (3, np.float64(10.0))
#[pyclass(frozen, module = "uchain")]
pub(crate) struct Plan {
    /// All numbers, the very ones of `plan.json`.
    #[pyo3(get)]
    summary: Py<Summary>,
    /// A row for each depth, `Columns`: `depth_m`, `relays_needed`, `bottleneck_db`, `time_min`, `first_relay_min`,
    /// `feasible`, shape (rows,). NaN where nobody knows.
    #[pyo3(get)]
    rows: Py<Columns>,
    /// The least worst link with 1, 2, … links, at each depth (dB): shape (rows, links), float64; NaN where it is not
    /// listed.
    #[pyo3(get)]
    bottleneck_by_links_db: Py<PyAny>,
    /// What the planner wants to know, in one sentence.
    #[pyo3(get)]
    answer: String,
    text: String,
    picture: Py<Picture>,
}

#[pymethods]
impl Plan {
    /// UAVs needed at the worst depth, the head included; None where no number would do.
    #[getter]
    fn uavs_needed<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.summary.bind(py).as_any().get_item("uavs_needed")
    }

    /// The plan on one page, as `uchain plan` draws it; written to `path`, too, if there is one.
    ///
    /// Raises `OSError` if it cannot be written.
    #[pyo3(signature = (path=None))]
    fn plot(&self, py: Python<'_>, path: Option<PathBuf>) -> PyResult<Py<Picture>> {
        if let Some(path) = path {
            self.picture.get().write(py, &path)?;
        }
        Ok(self.picture.clone_ref(py))
    }

    fn _repr_png_<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.picture.bind(py).call_method0("_repr_png_")
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let (py, this) = (slf.py(), slf.get());
        let parts = (
            this.summary.clone_ref(py),
            this.rows.clone_ref(py),
            this.bottleneck_by_links_db.clone_ref(py),
            &this.answer,
            &this.text,
            this.picture.clone_ref(py),
        );
        Ok((slf.get_type().getattr("_unpickled")?, parts.into_pyobject(py)?))
    }

    /// How pickle makes one.
    #[staticmethod]
    fn _unpickled(
        summary: Py<Summary>,
        rows: Py<Columns>,
        bottleneck_by_links_db: Py<PyAny>,
        answer: String,
        text: String,
        picture: Py<Picture>,
    ) -> Self {
        Self { summary, rows, bottleneck_by_links_db, answer, text, picture }
    }

    fn __str__(&self) -> &str {
        &self.text
    }

    fn __repr__(&self) -> String {
        format!("<uchain.Plan: {}>", self.answer)
    }
}

/// The rows of a plan as columns.
fn columns(rows: &[PlanRow]) -> Table {
    let column = |name, of: fn(&PlanRow) -> Option<f64>| {
        let values = rows.iter().map(|row| of(row).unwrap_or(f64::NAN)).collect();
        Column { name, is_per_robot: false, values: Values::Numbers(values) }
    };
    let feasible = rows.iter().map(|row| row.feasible).collect();
    let columns = vec![
        column("depth_m", |row| Some(row.depth_m)),
        column("relays_needed", |row| row.relays_needed.map(|relays| relays as f64)),
        column("bottleneck_db", |row| row.bottleneck_db),
        column("time_min", |row| row.time_min),
        column("first_relay_min", |row| row.first_relay_min),
        Column { name: "feasible", is_per_robot: false, values: Values::Flags(feasible) },
    ];
    Table { name: "plan", rows: rows.len(), crew: 0, columns }
}

/// The least worst links of all rows, and how many stand in each row.
fn by_links(rows: &[PlanRow]) -> (Vec<f64>, usize) {
    let widest = rows.iter().map(|row| row.bottleneck_by_links_db.len()).max().unwrap_or(0);
    let all_db = rows.iter().flat_map(|row| {
        let known = row.bottleneck_by_links_db.iter().copied();
        known.chain(std::iter::repeat(f64::NAN)).take(widest)
    });
    (all_db.collect(), widest)
}

fn refused(error: PlanRequestError) -> PyErr {
    ScenarioError::new_err(match error {
        PlanRequestError::BareMap { map, needs_base, needs_goal } => {
            let missing = match (needs_base, needs_goal) {
                (true, false) => "base_m=(X, Y)",
                (false, true) => "goal_m=(X, Y)",
                _ => "base_m=(X, Y) and goal_m=(X, Y)",
            };
            format!(
                "{map} is a bare map: add {missing}, in the map's own frame (m), such as base_m=(-50.15, 34.03)"
            )
        }
        error => error.to_string(),
    })
}

fn no_plan(error: &PlanError) -> PyErr {
    ScenarioError::new_err(error.to_string())
}

/// How many UAVs a tunnel needs, and how long that takes, without a flight: what `uchain plan` computes.
///
/// Parameters
/// ----------
/// what : str, os.PathLike or Scenario
///     A scenario of a chain, its name or its file; or a ROS map (`map.yaml`), which needs `base_m` and `goal_m`.
/// to_m : float, optional
///     How deep the head is to go (m, more than 0); by default as deep as the tunnel is known.
/// step_m : float, optional
///     Distance between the rows (m, more than 0).
/// uavs : int, optional
///     UAVs at hand, the head included; by default the scenario's, for a bare map as many as it takes.
/// speed_mps : float, optional
///     Speed of the head (m/s, more than 0 and at most 1); by default the scenario's.
/// base_m, goal_m : tuple of two floats, optional
///     Where the base stands, and the deepest place the head may be sent to, in the map's own frame (m).
/// heading_deg : float, optional
///     Direction of the tunnel at the base (degrees, -360 to 360).
///
/// Returns
/// -------
/// Plan
///
/// Raises
/// ------
/// ScenarioError
///     What is asked for has no tunnel, is no chain, or is wrong in a value; the text says which.
/// ValueError, TypeError
///     An argument that is none of these.
///
/// Examples
/// --------
/// >>> print(uchain.plan("straight", to_m=12, uavs=2).answer)
/// 12 m need 2 relays (3 UAVs), 2 at hand: too few; ...
#[pyfunction]
#[pyo3(signature = (what, *, to_m=None, step_m=None, uavs=None, speed_mps=None, base_m=None, goal_m=None, heading_deg=None))]
#[expect(clippy::too_many_arguments, reason = "one for each option of the command line")]
fn plan(
    what: &Bound<'_, PyAny>,
    to_m: Option<f64>,
    step_m: Option<f64>,
    uavs: Option<&Bound<'_, PyAny>>,
    speed_mps: Option<f64>,
    base_m: Option<[f64; 2]>,
    goal_m: Option<[f64; 2]>,
    heading_deg: Option<f64>,
) -> PyResult<Plan> {
    let py = what.py();
    let (to_m, step_m) = (length("to_m", to_m)?, length("step_m", step_m)?);
    let is_speed = |mps: f64| mps > 0.0 && mps <= 1.0;
    let speed_mps = number("speed_mps", speed_mps, is_speed, "a speed in m/s, more than 0 and at most 1")?;
    let is_angle = |deg: f64| deg.abs() <= 360.0;
    let request = PlanRequest {
        what: &asked_for(what)?,
        sets: &[],
        uavs: count("uavs", uavs, 1, UAVS_MAX)?,
        speed_mps: speed_mps.map(|mps| mps as f32),
        base_m: point("base_m", base_m)?,
        heading_deg: number("heading_deg", heading_deg, is_angle, "an angle in degrees, from -360 to 360")?,
        goal_m: point("goal_m", goal_m)?,
        typed,
    };
    let made = off_the_lock(
        py,
        |stop| {
            errors::caught(|| {
                let (course, uavs) = registry().plan_course(&request).map_err(refused)?;
                let deepest_m = to_m.or_else(|| course.tunnel.as_ref().map(Tunnel::length_m));
                let steps = PlanSteps::new(deepest_m.unwrap_or(1.0), step_m);
                let mut go_on = || !stop.load(Ordering::Relaxed);
                let plan = plan_while(&course, to_m, steps.plan_m, uavs, &mut go_on);
                let plan = plan.map_err(|error| no_plan(&error))?;
                finished(&plan, &steps)
            })
        },
        |_| Ok(()),
    )?;
    let Finished { json, table, by_links: (by_links_db, links), answer, text, png } = made??;
    let rows = table.rows;
    Ok(Plan {
        summary: Summary::read(py, &json)?.unbind(),
        rows: Py::new(py, Columns::of(py, table)?)?,
        bottleneck_by_links_db: array(py, by_links_db, rows, Some(links))?.unbind(),
        answer,
        text,
        picture: Py::new(py, Picture::of(py, &png))?,
    })
}

struct Finished {
    json: String,
    table: Table,
    by_links: (Vec<f64>, usize),
    answer: String,
    text: String,
    png: Vec<u8>,
}

fn finished(plan: &chain::Plan, steps: &PlanSteps) -> PyResult<Finished> {
    let unknown = |error: &dyn std::fmt::Display| errors::UchainError::new_err(error.to_string());
    let shown = PlanTable::new(plan, steps);
    let answer = shown.answer();
    Ok(Finished {
        json: serde_json::to_string(plan).map_err(|error| unknown(&error))?,
        table: columns(&plan.rows),
        by_links: by_links(&plan.rows),
        png: plan_png(plan, &answer).map_err(|error| unknown(&error))?,
        text: shown.text(),
        answer,
    })
}

pub(crate) fn fill(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Plan>()?;
    module.add_function(wrap_pyfunction!(plan, module)?)?;
    optimum::fill(module)
}
