//! The brain of an exploring robot, driven by hand.

use std::sync::{Mutex, MutexGuard, PoisonError};

use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, ToPyArray};
use pyo3::{exceptions::PyValueError, prelude::*, types::PyDict};
use uchain_core::explore::{self, ExploreParams, Observation, Point, Pose, Ssg};
use uchain_sim::seed::{Seed, Source, Stream};

use super::{message::Message, params::from_keywords};
use crate::errors;

/// Where a robot is about to fly.
#[pyclass(frozen, module = "uchain.laws", get_all)]
pub(super) struct Target {
    /// Why: "explore", "backtrack", "home", "park" or "wait".
    purpose: &'static str,
    /// End of the move, in the team's frame (m).
    x_m: f32,
    /// End of the move, in the team's frame (m).
    y_m: f32,
    /// Level it has flown on so far.
    level: u16,
}

#[pymethods]
impl Target {
    fn __repr__(&self) -> String {
        let Self { purpose, x_m, y_m, level } = self;
        format!("Target(purpose='{purpose}', x_m={x_m}, y_m={y_m}, level={level})")
    }
}

/// What an explorer asks of its body for one move.
#[pyclass(frozen, module = "uchain.laws", get_all)]
pub(super) struct Move {
    /// Where to fly, straight, in the team's frame (m).
    x_m: f32,
    /// Where to fly, straight, in the team's frame (m).
    y_m: f32,
    /// Heading to have there (rad).
    heading_rad: f32,
    /// Level to be on there.
    level: u16,
    /// Height of that level (m).
    z_m: f32,
    /// Whether a scan is wanted there.
    scan: bool,
    /// It stays this round to let another one pass.
    hold: bool,
}

#[pymethods]
impl Move {
    fn __repr__(&self) -> String {
        let Self { x_m, y_m, level, .. } = self;
        format!("Move(x_m={x_m}, y_m={y_m}, level={level})")
    }
}

/// What an explorer has of its own: its brain, its graph, its random numbers.
struct Mind {
    robot: explore::Explorer,
    graph: Ssg,
    draw: Stream,
}

/// The brain of one exploring robot, with a graph of its own (Kim 2021, Algorithm 2).
///
/// Robot `robot` of `robots` (1 to 1000); what is random is drawn by `seed`. Parameters are keywords with the keys of a
/// scenario's table `explore`. A round is: `perceive`, `announce`, `hear` what the others said, `resolve`.
///
/// Raises `TypeError` of an unknown parameter, `ValueError` of one out of its range.
///
/// >>> import numpy as np
/// >>> from uchain.laws import Explorer
/// >>> robot = Explorer()
/// >>> said = robot.perceive(0.0, 0.0, scan_m=np.full(18, 0.5, np.float32))  # walls all around
/// >>> robot.announce()[0].purpose
/// 'park'
#[pyclass(frozen, module = "uchain.laws")]
pub(super) struct Explorer(Mutex<Mind>);

impl Explorer {
    fn mind(&self) -> MutexGuard<'_, Mind> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

fn wrapped(said: Vec<explore::Message>) -> Vec<Message> {
    said.into_iter().map(Message).collect()
}

#[pymethods]
impl Explorer {
    #[new]
    #[pyo3(signature = (robot=0, robots=1, *, seed=0, **params))]
    fn new(robot: u16, robots: u16, seed: u64, params: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        const ROBOTS_MAX: u16 = 1000;
        if robot >= robots || robots > ROBOTS_MAX {
            let expected = format!("a robot from 0 to robots - 1, of at most {ROBOTS_MAX} robots");
            return Err(PyValueError::new_err(format!("robot {robot} of {robots}: expected {expected}")));
        }
        let params: ExploreParams = from_keywords(params)?;
        let graph = Ssg::new(params, robots).map_err(|error| PyValueError::new_err(error.to_string()))?;
        let draw = Seed(seed).stream(robot.into(), Source::Choice);
        Ok(Self(Mutex::new(Mind { robot: explore::Explorer::new(robot, robots), graph, draw })))
    }

    /// A round begins: where it is in the team's frame (m, rad), and what it has scanned.
    ///
    /// `scan_m` (sectors,) float32: per sector, sector 0 at the x axis and on counter-clockwise, the distance to the
    /// nearest obstacle grown by the body (m), NaN or infinity where none is in range; None if it has not scanned.
    /// `arrived`: it is where the last move ended. Returns what it says to the others.
    ///
    /// Raises `ValueError` of a scan of another number of sectors, or if its graph is full.
    #[pyo3(signature = (x_m, y_m, heading_rad=0.0, *, scan_m=None, arrived=true))]
    #[expect(clippy::needless_pass_by_value, reason = "arguments from Python")]
    fn perceive(
        &self,
        x_m: f32,
        y_m: f32,
        heading_rad: f32,
        scan_m: Option<PyReadonlyArray1<'_, f32>>,
        arrived: bool,
    ) -> PyResult<Vec<Message>> {
        let scan: Option<Vec<Option<f32>>> = scan_m.as_ref().map(|scan| {
            scan.as_array().iter().map(|&return_m| return_m.is_finite().then_some(return_m)).collect()
        });
        let seen = Observation {
            pose: Pose { at: Point { x_m, y_m }, heading_rad },
            arrived,
            scan: scan.as_deref(),
        };
        let mut said = Vec::new();
        let mind = &mut *self.mind();
        let done = errors::caught(|| mind.robot.perceive(&mut mind.graph, &seen, &mut said))?;
        done.map_err(|error| PyValueError::new_err(error.to_string()))?;
        Ok(wrapped(said))
    }

    /// Decides where to fly. Returns the target, and what it says to the others.
    fn announce(&self) -> PyResult<(Target, Vec<Message>)> {
        let mut said = Vec::new();
        let mind = &mut *self.mind();
        let draw = &mut mind.draw;
        let target = errors::caught(|| mind.robot.announce(&mut mind.graph, &mut || draw.bits(), &mut said))?;
        let explore::Target { purpose, to, level, .. } = target;
        let target = Target { purpose: purpose.word(), x_m: to.x_m, y_m: to.y_m, level };
        Ok((target, wrapped(said)))
    }

    /// Takes in what another robot said.
    ///
    /// Raises `ValueError` of a node that the graph cannot take.
    #[expect(clippy::needless_pass_by_value, reason = "arguments from Python")]
    fn hear(&self, messages: Vec<PyRef<'_, Message>>) -> PyResult<()> {
        let mind = &mut *self.mind();
        for message in &messages {
            let done = errors::caught(|| {
                mind.robot.hear(&message.0);
                mind.graph.apply(&message.0)
            })?;
            done.map_err(|error| PyValueError::new_err(error.to_string()))?;
        }
        Ok(())
    }

    /// Flies by its own target and those it has heard this round: levels, and who waits (Kim 2021, Algorithm 2, lines 18
    /// to 21).
    fn resolve(&self) -> PyResult<Move> {
        let mind = &mut *self.mind();
        let asked = errors::caught(|| mind.robot.resolve(mind.graph.params()))?;
        Ok(Move {
            x_m: asked.to.x_m,
            y_m: asked.to.y_m,
            heading_rad: asked.heading_rad,
            level: asked.level,
            z_m: asked.z_m,
            scan: asked.scan,
            hold: asked.hold,
        })
    }

    /// Places of the nodes it knows, in the team's frame (m): shape (nodes, x and y), float32.
    #[getter]
    fn nodes_m<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f32>>> {
        let places: Vec<f32> = {
            let mind = self.mind();
            let slots = 0..mind.graph.len();
            slots.filter_map(|slot| mind.graph.at(slot)).flat_map(|at| [at.x_m, at.y_m]).collect()
        };
        let flat: Bound<'py, PyArray1<f32>> = places.to_pyarray(py);
        flat.reshape([places.len() / 2, 2])
    }

    /// How many nodes it knows that have frontiers left.
    #[getter]
    fn hubs(&self) -> usize {
        self.mind().graph.hub_count()
    }

    fn __repr__(&self) -> String {
        let mind = self.mind();
        format!("<uchain.laws.Explorer: {} nodes, {} hubs>", mind.graph.len(), mind.graph.hub_count())
    }
}
