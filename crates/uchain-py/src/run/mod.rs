//! One run: flown, and looked into.

mod arrow;
mod columns;
mod event;
mod file;
mod graph;
mod picture;
mod results;
mod summary;

use std::{
    io::BufWriter,
    ops::ControlFlow,
    path::PathBuf,
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
};

use pyo3::{Borrowed, exceptions::PyValueError, prelude::*, types::PyBool};
use uchain_sim::{
    mission::Keep,
    record::RecordError,
    registry::{AnyScene, Kept, Now, Watch},
};

use crate::{
    errors,
    own_law::{OwnLaw, lacks_no_law},
    scenario::Scenario,
    work::off_the_lock_until,
};
pub(crate) use columns::{Columns, array};
use file::Unfinished;
pub(crate) use picture::Picture;
pub(crate) use results::Run;
pub(crate) use summary::Summary;

/// Stops a run at Ctrl-C.
pub(crate) struct Stopped<'a>(pub(crate) &'a AtomicBool);

impl Watch for Stopped<'_> {
    fn tick(&mut self, _: &Now<'_>) -> ControlFlow<()> {
        if self.0.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

/// A seed.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Seed(pub(crate) u64);

impl<'a, 'py> FromPyObject<'a, 'py> for Seed {
    type Error = PyErr;

    fn extract(seed: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        let number = if seed.is_instance_of::<PyBool>() { None } else { seed.extract().ok() };
        number.map(Self).ok_or_else(|| {
            let most = u64::MAX;
            let message = format!("seed = {}: expected a whole number from 0 to {most}", shown(&seed));
            PyValueError::new_err(message)
        })
    }
}

/// Which frames are kept.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Frames(pub(crate) Option<Keep>);

impl<'a, 'py> FromPyObject<'a, 'py> for Frames {
    type Error = PyErr;

    fn extract(frames: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        if frames.is_none() {
            return Ok(Self(None));
        }
        match frames.extract::<String>().as_deref() {
            Ok("ticks") => Ok(Self(Some(Keep::Ticks))),
            Ok("decisions") => Ok(Self(Some(Keep::Decisions))),
            _ => {
                let shown = shown(&frames);
                let message = format!("frames = {shown}: expected \"ticks\", \"decisions\" or None");
                Err(PyValueError::new_err(message))
            }
        }
    }
}

/// An argument, for a message about it.
pub(crate) fn shown(value: &Bound<'_, PyAny>) -> String {
    const MOST: usize = 60;
    let text = value.repr().map_or_else(|_| "?".to_owned(), |text| text.to_string());
    if text.chars().count() <= MOST { text } else { text.chars().take(MOST).chain(['…']).collect() }
}

/// Flies a scenario once, from its first tick to its last, and keeps what comes of it.
///
/// The same scenario and seed have the same bits, whoever flies them: this module, the command line, Rust. The
/// interpreter's lock is free meanwhile, so that threads of Python fly side by side. Ctrl-C ends a run at once.
///
/// Parameters
/// ----------
/// what : str, os.PathLike or Scenario
///     The name of a scenario that comes along, the path of a file, or a scenario.
/// seed : int
///     Seed of all noise in the run, from 0 to 2**64 - 1.
/// record : str or os.PathLike, optional
///     Where a recording goes (MCAP, the very bytes that `uchain run` writes). The file has its name only once it is whole.
/// frames : "ticks", "decisions" or None
///     Which frames are kept in `Run.frames`: all, those at which robots decide, or none. A run whose numbers over time
///     would take more than 2 GiB is refused before its first tick.
/// law : callable, optional
///     What levels the relays of a chain in place of the built-in law (Laclau 2021, Eq. 12): `law(seen) -> forward_mps` is
///     asked for each relay at each of its decisions, with a `Seen`, and returns the forward speed (m/s), which is bounded
///     by `equalize.v_max_mps`. All else stays the scenario's: take-off, filters, overrides, centering. An object with
///     `start(uav, params) -> callable` is a law with a memory: `start` is called before a relay's first decision, and what
///     it returns is asked for that relay. `uchain.batched(law)` is asked for all relays at once. Laws are called on a
///     thread of the run's own, with the interpreter's lock. The same law, scenario and seed have the same bits if the law
///     is a function of what it has seen.
///
/// Returns
/// -------
/// Run
///
/// Raises
/// ------
/// ScenarioError
///     A scenario that cannot be flown.
/// RecordingError
///     The recording cannot be written.
/// LawError
///     The law raised, or returned what is no finite number: the text says tick and relay, what it raised is `__cause__`.
/// UchainError
///     The numbers over time would take too much memory.
/// ValueError, TypeError
///     An argument that is none of these.
///
/// Examples
/// --------
/// >>> run = uchain.run(uchain.Scenario.from_name("straight").with_(duration_s=5), seed=3)
/// >>> run.summary.sim_s
/// 5.0
/// >>> run.frames["x_m"].shape
/// (100, 4)
/// >>> run.digest == uchain.run(run.scenario, seed=3, frames=None).digest
/// True
/// >>> uchain.run("straight", law=lambda seen: 0.05 * (seen.front_db - seen.back_db), frames=None).ok
/// True
#[pyfunction]
#[pyo3(signature = (what, seed=Seed(0), record=None, *, frames=Frames(Some(Keep::Ticks)), law=None))]
#[pyo3(text_signature = "(what, seed=0, record=None, *, frames='ticks', law=None)")]
fn run(
    what: &Bound<'_, PyAny>,
    seed: Seed,
    record: Option<PathBuf>,
    frames: Frames,
    law: Option<&Bound<'_, PyAny>>,
) -> PyResult<Run> {
    let scenario = Scenario::of(what)?;
    let scene = scenario.get().scene.clone();
    let Some(law) = law.map(OwnLaw::of).transpose()? else {
        lacks_no_law(&*scene)?;
        return fly(&scenario, &scene, seed.0, record, frames.0, |_| ());
    };
    let (scene, fault) = law.flying(what.py(), &*scene)?;
    let flown = fly(&scenario, &scene, seed.0, record, frames.0, |py| law.interrupt(py));
    flown.map_err(|error| fault.take().unwrap_or(error))
}

/// Flies a scene of a scenario and keeps what comes of it. `interrupted` ends what is in Python at Ctrl-C.
fn fly(
    scenario: &Bound<'_, Scenario>,
    scene: &Arc<dyn AnyScene>,
    seed: u64,
    record: Option<PathBuf>,
    frames: Option<Keep>,
    interrupted: impl Fn(Python<'_>) + Send + Sync,
) -> PyResult<Run> {
    let py = scenario.py();
    let mut file = record.map(Unfinished::begin).transpose()?;
    let flown = off_the_lock_until(
        py,
        |stop| {
            let to = file
                .as_mut()
                .map(|file| -> Box<dyn std::io::Write> { Box::new(BufWriter::new(file.bytes())) });
            errors::caught(|| timed(|| scene.keep(seed, frames, to, &mut Stopped(stop))))
        },
        |_| Ok(()),
        interrupted,
    )??;
    let (kept, wall_s): (Result<Box<dyn Kept>, RecordError>, f64) = flown;
    let kept = kept.map_err(|error| match (&error, &file) {
        (RecordError::Io(cause), Some(file)) => file.failed(cause),
        _ => errors::record(&error),
    })?;
    file.map(Unfinished::finish).transpose()?;
    let json = kept.json(Some(wall_s), env!("CARGO_PKG_VERSION"));
    Run::of(scenario.clone().unbind(), seed, kept, &json.map_err(|error| errors::flight(&error))?, py)
}

/// Works, and says how long that took (s).
#[expect(clippy::disallowed_methods, reason = "wall_s is the one number that is about this computer")]
fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let start = std::time::Instant::now();
    let done = work();
    (done, start.elapsed().as_secs_f64())
}

pub(crate) fn fill(module: &Bound<'_, PyModule>) -> PyResult<()> {
    results::fill(module)?;
    summary::fill(module)?;
    columns::fill(module)?;
    event::fill(module)?;
    graph::fill(module)?;
    picture::fill(module)?;
    module.add_function(wrap_pyfunction!(run, module)?)
}
