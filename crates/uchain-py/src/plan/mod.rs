//! What a planner asks before anyone flies: `plan` and `optimum`.

mod arguments;
mod optimum;

use std::{path::PathBuf, sync::atomic::Ordering};

use pyo3::{prelude::*, types::PyTuple};
use uchain_sim::{
    map::Tunnel,
    mission::chain::{
        self, Course, Place, PlanError, PlanOptions, PlanRow, PlanSteps, PlanTable, RESERVE, Reach, UAVS_MAX,
        plan_png, plan_while,
    },
    record::table::{Column, Table, Values},
    registry::{PlanFlight, PlanFlightError, PlanRequest, PlanRequestError, named},
};

use crate::{
    errors::{self, ScenarioError},
    registry,
    run::{Columns, Picture, Summary, array},
    work::off_the_lock,
};
use arguments::{asked_for, count, length, number, spot, typed};

// The default of `reserve` below: Python shows the default of an argument only where it is written as a number.
const _: () = assert!(RESERVE.to_bits() == 0.2_f64.to_bits());

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
    /// `home_min`, `feasible`, shape (rows,). NaN where nobody knows.
    #[pyo3(get)]
    rows: Py<Columns>,
    /// Where the relays stand with the head as deep as it is to go, a row for each, the one next to the head first, `Columns`:
    /// `relay`, `x_m`, `y_m` (the map file's own frame), `depth_m`, `link_db`, `front_db`, `margin_db`, `launch_min`,
    /// `airborne_min`, `spare_min`.
    #[pyo3(get)]
    places: Py<Columns>,
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
            this.places.clone_ref(py),
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
        places: Py<Columns>,
        bottleneck_by_links_db: Py<PyAny>,
        answer: String,
        text: String,
        picture: Py<Picture>,
    ) -> Self {
        Self { summary, rows, places, bottleneck_by_links_db, answer, text, picture }
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
        column("home_min", |row| row.home_min),
        Column { name: "feasible", is_per_robot: false, values: Values::Flags(feasible) },
    ];
    Table { name: "plan", rows: rows.len(), crew: 0, columns }
}

/// The places of the relays as columns.
fn places(places: &[Place]) -> Table {
    let column = |name, of: fn(&Place) -> Option<f64>| {
        let values = places.iter().map(|place| of(place).unwrap_or(f64::NAN)).collect();
        Column { name, is_per_robot: false, values: Values::Numbers(values) }
    };
    let columns = vec![
        column("relay", |place| Some(place.relay as f64)),
        column("x_m", |place| Some(place.x_m)),
        column("y_m", |place| Some(place.y_m)),
        column("depth_m", |place| Some(place.depth_m)),
        column("link_db", |place| Some(place.link_db)),
        column("front_db", |place| Some(place.front_db)),
        column("margin_db", |place| Some(place.margin_db)),
        column("launch_min", |place| place.launch_min),
        column("airborne_min", |place| place.airborne_min),
        column("spare_min", |place| place.spare_min),
    ];
    Table { name: "places", rows: places.len(), crew: 0, columns }
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
        PlanRequestError::BareMap { map, needs_base, needs_goal, places } => {
            let missing = match (needs_base, needs_goal) {
                (true, false) => "base_m=(X, Y)",
                (false, true) => "goal_m=(X, Y)",
                _ => "base_m=(X, Y) and goal_m=(X, Y)",
            };
            format!(
                "{map} is a bare map: add {missing}, in the map's own frame (m), such as base_m=(-50.15, 34.03){}",
                named(&places)
            )
        }
        error => error.to_string(),
    })
}

fn no_plan(error: &PlanError) -> PyErr {
    ScenarioError::new_err(error.to_string())
}

fn not_flown(error: &PlanFlightError) -> PyErr {
    ScenarioError::new_err(error.to_string())
}

/// How many UAVs a tunnel needs, where they stand and whether their batteries last, without a flight: what `uchain plan`
/// computes.
///
/// Parameters
/// ----------
/// what : str, os.PathLike or Scenario
///     A scenario of a chain, its name or its file; or a map (`map.yaml`, a drawing, a survey), which needs `base_m` and
///     `goal_m`.
/// to_m : float, optional
///     How deep the head is to go (m, more than 0); by default as deep as the tunnel is known.
/// step_m : float, optional
///     Distance between the rows (m, more than 0).
/// uavs : int, optional
///     UAVs at hand, the head included; by default the scenario's, for a bare map as many as it takes.
/// speed_mps : float, optional
///     Speed of the head (m/s, more than 0 and at most 1); by default the scenario's.
/// base_m, goal_m : tuple of two floats or str, optional
///     Where the base stands, and the deepest place the head may be sent to, in the map's own frame (m), or names that the map
///     has for them.
/// heading_deg : float, optional
///     Direction of the tunnel at the base (degrees, -360 to 360).
/// cell_m : float, optional
///     Side of a cell or pixel (m, more than 0), where the map file does not say it.
/// from_station, to_station : str, optional
///     Stations of a survey between which a branch is cut out; base and goal are there unless they are given.
/// stay_min : float
///     How long the head stays at its goal (min, 0 to 1440).
/// reserve : float
///     Share of each battery that nobody may use (0 to 0.9).
/// budget : str, os.PathLike or dict, optional
///     What limit and reference loss are worked out from: "crazyflie", a TOML file, or a dict with `tx_dbm`, `tx_gain_dbi`,
///     `rx_gain_dbi`, `sensitivity_dbm`, `margin_db`, `frequency_mhz`.
/// everywhere : bool
///     Work out how much of the map is in reach with so many relays, too: `plan.summary["everywhere"]`. Without `goal_m` a
///     bare map is planned to the place that is farthest from its base.
/// fly : int, optional
///     Fly the plan with seeds 1 to `fly` (at most 1000) and set flights beside plan: `plan.summary["flown"]`.
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
#[pyo3(signature = (what, *, to_m=None, step_m=None, uavs=None, speed_mps=None, base_m=None, goal_m=None, heading_deg=None, cell_m=None, from_station=None, to_station=None, stay_min=0.0, reserve=0.2, budget=None, everywhere=false, fly=None))]
#[expect(clippy::too_many_arguments, reason = "one for each option of the command line")]
fn plan(
    what: &Bound<'_, PyAny>,
    to_m: Option<f64>,
    step_m: Option<f64>,
    uavs: Option<&Bound<'_, PyAny>>,
    speed_mps: Option<f64>,
    base_m: Option<&Bound<'_, PyAny>>,
    goal_m: Option<&Bound<'_, PyAny>>,
    heading_deg: Option<f64>,
    cell_m: Option<f64>,
    from_station: Option<&str>,
    to_station: Option<&str>,
    stay_min: f64,
    reserve: f64,
    budget: Option<&Bound<'_, PyAny>>,
    everywhere: bool,
    fly: Option<&Bound<'_, PyAny>>,
) -> PyResult<Plan> {
    let py = what.py();
    let (to_m, step_m) = (length("to_m", to_m)?, length("step_m", step_m)?);
    let is_speed = |mps: f64| mps > 0.0 && mps <= 1.0;
    let speed_mps = number("speed_mps", speed_mps, is_speed, "a speed in m/s, more than 0 and at most 1")?;
    let is_angle = |deg: f64| deg.abs() <= 360.0;
    let is_stay = |min: f64| (0.0..=1440.0).contains(&min);
    number("stay_min", Some(stay_min), is_stay, "minutes, from 0 to 1440")?;
    let is_share = |share: f64| (0.0..=0.9).contains(&share);
    number("reserve", Some(reserve), is_share, "a share, from 0 to 0.9")?;
    let (base, goal) = (spot("base_m", base_m)?, spot("goal_m", goal_m)?);
    let (budget, fly) = (arguments::budget(budget)?, count("fly", fly, 1, 1000)?);
    let request = PlanRequest {
        what: &asked_for(what)?,
        sets: &[],
        uavs: count("uavs", uavs, 1, UAVS_MAX)?,
        speed_mps: speed_mps.map(|mps| mps as f32),
        base: base.as_ref(),
        heading_deg: number("heading_deg", heading_deg, is_angle, "an angle in degrees, from -360 to 360")?,
        goal: goal.as_ref(),
        cell_m: length("cell_m", cell_m)?,
        from: from_station,
        to: to_station,
        to_farthest: everywhere,
        budget: budget.as_ref(),
        typed,
    };
    let made = off_the_lock(
        py,
        |stop| {
            errors::caught(|| {
                let made_for = registry().plan_course(&request).map_err(refused)?;
                let course = &*made_for.course;
                let deepest_m = to_m.or_else(|| course.tunnel.as_ref().map(Tunnel::length_m));
                let steps = PlanSteps::new(deepest_m.unwrap_or(1.0), step_m);
                let options = PlanOptions {
                    to_m,
                    step_m: steps.plan_m,
                    uavs: made_for.uavs,
                    stay_s: 60.0 * stay_min,
                    reserve,
                };
                let mut go_on = || !stop.load(Ordering::Relaxed);
                let plan = plan_while(course, &options, &mut go_on);
                let mut plan = plan.map_err(|error| no_plan(&error))?;
                plan.budget = made_for.budget;
                if everywhere {
                    let reached = course.relays_everywhere();
                    let reached =
                        reached.map_err(|cause| ScenarioError::new_err(format!("everywhere: {cause}")))?;
                    plan.everywhere = Some(Reach::of(&reached));
                }
                if let Some(seeds) = fly {
                    let flight = PlanFlight::new(course, &plan).map_err(|error| not_flown(&error))?;
                    let flown = flight.fly(seeds as u64, &|_| !stop.load(Ordering::Relaxed));
                    plan.flown = Some(flown.map_err(|error| not_flown(&error))?);
                }
                finished(course, &plan, &steps)
            })
        },
        |_| Ok(()),
    )?;
    let Finished { json, table, places, by_links: (by_links_db, links), answer, text, png } = made??;
    let rows = table.rows;
    Ok(Plan {
        summary: Summary::read(py, &json)?.unbind(),
        rows: Py::new(py, Columns::of(py, table)?)?,
        places: Py::new(py, Columns::of(py, places)?)?,
        bottleneck_by_links_db: array(py, by_links_db, rows, Some(links))?.unbind(),
        answer,
        text,
        picture: Py::new(py, Picture::of(py, &png))?,
    })
}

struct Finished {
    json: String,
    table: Table,
    places: Table,
    by_links: (Vec<f64>, usize),
    answer: String,
    text: String,
    png: Vec<u8>,
}

fn finished(course: &Course, plan: &chain::Plan, steps: &PlanSteps) -> PyResult<Finished> {
    let unknown = |error: &dyn std::fmt::Display| errors::UchainError::new_err(error.to_string());
    let shown = PlanTable::new(plan, steps);
    let answer = shown.answer();
    Ok(Finished {
        json: serde_json::to_string(plan).map_err(|error| unknown(&error))?,
        table: columns(&plan.rows),
        places: places(&plan.places),
        by_links: by_links(&plan.rows),
        png: plan_png(course, plan, &answer).map_err(|error| unknown(&error))?,
        text: shown.text(),
        answer,
    })
}

pub(crate) fn fill(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Plan>()?;
    module.add_function(wrap_pyfunction!(plan, module)?)?;
    optimum::fill(module)
}
