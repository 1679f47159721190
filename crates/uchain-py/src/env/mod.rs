//! Commands from outside: many worlds of one scenario, step by step.

mod truth;
mod worlds;

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use pyo3::{
    exceptions::{PyTypeError, PyValueError},
    prelude::*,
    types::PyBool,
};
use uchain_sim::{clock::period_ticks, mission::chain::Course};

use crate::{
    errors::{self, LawError, UchainError},
    own_law::{self, LawParams, SeenArrays, array, speeds_mps},
    run::Summary,
    scenario::Scenario,
    work::off_the_lock,
};
use truth::Truth;
use worlds::{Refused, Worlds, follow_of};

/// Most worlds of one environment.
const WORLDS_MAX: usize = 4096;
/// Most UAVs in all of them.
const UAVS_MAX: usize = 65_536;
/// More ticks of UAVs in one step than this, and Ctrl-C is looked for meanwhile.
const LONG: usize = 50_000;

/// Chains whose relays are told from outside how fast to fly: one world, or many of one scenario side by side.
///
/// Each world stands at a decision, says what its relays know (`SeenArrays`, shape (worlds, relays), relay `j` is UAV
/// `j + 1`), and goes on to its next decision with the forward speeds it is given. All else is the scenario's: take-off,
/// filters, overrides, bounds, centering, and the pilot's script. A world that gets Eq. 12 flies as `uchain run` does.
///
/// Parameters
/// ----------
/// what : str, os.PathLike or Scenario
///     The scenario of a chain.
/// worlds : int
///     How many, 1 to 4,096, of at most 65,536 UAVs in all.
/// seed : int
///     World `w` has the seed `seed + w`, and flies as `uchain run --seed` does with it.
///
/// Raises
/// ------
/// ScenarioError
///     A scenario that cannot be flown.
/// ValueError, TypeError
///     One that is no chain's, or whose UAVs fly by a law of their own; an argument that is none of these.
///
/// Examples
/// --------
/// >>> import numpy as np
/// >>> env = uchain.ChainEnv(uchain.Scenario.from_name("straight").with_(duration_s=20), worlds=2, seed=1)
/// >>> seen = env.reset()
/// >>> while not env.done.all():
/// ...     s_d = seen.front_db - seen.back_db
/// ...     seen = env.step(s_d / (3 * env.params.k_db_per_m) / env.params.decision_s)
/// >>> env.summaries()[0].digest == uchain.run(env.scenario, seed=1).digest
/// True
#[pyclass(frozen, module = "uchain")]
pub(crate) struct ChainEnv {
    /// What is flown.
    #[pyo3(get)]
    scenario: Py<Scenario>,
    /// How many worlds.
    #[pyo3(get)]
    worlds: usize,
    /// How many relays each has: UAVs, the head left out.
    #[pyo3(get)]
    relays: usize,
    /// What the scenario says of levelling: `LawParams`.
    #[pyo3(get)]
    params: Py<LawParams>,
    course: Arc<Course>,
    inner: Mutex<Worlds>,
}

/// A whole number from 0 on, and no truth value.
fn whole(value: &Bound<'_, PyAny>, name: &str, most: u64) -> PyResult<u64> {
    let number = if value.is_instance_of::<PyBool>() { None } else { value.extract::<u64>().ok() };
    number.filter(|number| *number <= most).ok_or_else(|| {
        let shown = own_law::shown(value);
        PyValueError::new_err(format!("{name} = {shown}: expected a whole number from 0 to {most}"))
    })
}

impl ChainEnv {
    /// All worlds; another thread that steps them is waited for. Never called with the interpreter's lock.
    fn lock(&self) -> MutexGuard<'_, Worlds> {
        // Worlds that a panic left half done say so themselves.
        self.inner.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Does something with the worlds without the interpreter's lock.
    fn with<T: Send>(&self, py: Python<'_>, work: impl FnOnce(&mut Worlds) -> T + Send) -> PyResult<T> {
        py.detach(|| errors::caught(|| work(&mut self.lock())))
    }

    fn seed_of(seed: &Bound<'_, PyAny>, worlds: usize) -> PyResult<u64> {
        whole(seed, "seed", u64::MAX - worlds as u64)
    }

    fn seen(&self, py: Python<'_>) -> PyResult<SeenArrays> {
        let filling = self.with(py, Worlds::seen)??;
        filling.done(py, Some(self.relays), LawParams::one(&self.course.scenario.equalize))
    }
}

/// What the worlds refuse, as an exception.
fn refused(refused: Refused) -> PyErr {
    match refused {
        Refused::Speed(words) => LawError::new_err(words),
        Refused::Pilot(words) => PyValueError::new_err(words),
        Refused::State(words) => UchainError::new_err(words),
    }
}

impl From<Refused> for PyErr {
    fn from(words: Refused) -> Self {
        refused(words)
    }
}

#[pymethods]
impl ChainEnv {
    #[new]
    #[pyo3(signature = (what, worlds=None, seed=None), text_signature = "(what, worlds=1, seed=0)")]
    fn new(
        what: &Bound<'_, PyAny>,
        worlds: Option<&Bound<'_, PyAny>>,
        seed: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let py = what.py();
        let scenario = Scenario::of(what)?;
        let course = own_law::course(&*scenario.get().scene)?.clone();
        let uavs = course.spawns.len();
        let most = WORLDS_MAX.min(UAVS_MAX / uavs.max(1));
        let worlds = worlds.map_or(Ok(1), |worlds| whole(worlds, "worlds", most as u64))? as usize;
        if worlds == 0 {
            return Err(PyValueError::new_err(format!("worlds = 0: expected 1 to {most}")));
        }
        let seed = seed.map_or(Ok(0), |seed| Self::seed_of(seed, worlds))?;
        let start = |stop: &_| errors::caught(|| Worlds::start(&course, worlds, seed, stop));
        let inner = Mutex::new(off_the_lock(py, start, |_| Ok(()))??);
        let params = Py::new(py, LawParams::one(&course.scenario.equalize))?;
        Ok(Self {
            scenario: scenario.unbind(),
            worlds,
            relays: uavs.saturating_sub(1),
            params,
            course,
            inner,
        })
    }

    /// All worlds back to their first decision, in the memory they have. Returns what their relays know then: nobody asks.
    ///
    /// `seed`: world `w` has the seed `seed + w` from now on; None: the seeds it has, so that the same flights are flown
    /// again.
    #[pyo3(signature = (seed=None))]
    fn reset(&self, py: Python<'_>, seed: Option<&Bound<'_, PyAny>>) -> PyResult<SeenArrays> {
        let seed = seed.map(|seed| Self::seed_of(seed, self.worlds)).transpose()?;
        off_the_lock(py, |stop| errors::caught(|| self.lock().reset(seed, stop)), |_| Ok(()))??;
        self.seen(py)
    }

    /// Every world that is not done goes on to its next decision.
    ///
    /// `forward_mps` (worlds, relays) float32: the forward speed of each relay that asks (m/s), bounded by `equalize.v_max_mps`;
    /// float64 and whole numbers are taken, too. Where nobody asks the number is passed over, NaN as well. `pilot_mps`: what
    /// the pilot of the head asks for from the next tick on (m/s, -1 to 1), one number or (worlds,), NaN for nothing new; the
    /// scenario's script is over with it. `follow`: the wall he asks to follow, "centre", "left" or "right"; with
    /// `pilot_mps` only.
    ///
    /// Returns what the relays know at that next decision. Raises `LawError` of a speed that is no number where a relay asks,
    /// of a wrong shape or dtype; `ValueError` of what no pilot may ask for; `UchainError` if all worlds are done. Then
    /// nothing has moved.
    #[pyo3(signature = (forward_mps, pilot_mps=None, follow=None))]
    fn step(
        &self,
        py: Python<'_>,
        forward_mps: &Bound<'_, PyAny>,
        pilot_mps: Option<&Bound<'_, PyAny>>,
        follow: Option<&str>,
    ) -> PyResult<SeenArrays> {
        let speeds = speeds_mps(forward_mps, &[self.worlds, self.relays])
            .map_err(|what| LawError::new_err(format!("forward_mps = {what}")))?;
        let pilots = pilot_mps.map(|pilot_mps| self.pilots(pilot_mps)).transpose()?;
        if follow.is_some() && pilots.is_none() {
            return Err(PyValueError::new_err("follow without pilot_mps: expected both, or neither"));
        }
        let follow = follow.map_or(Ok(None), |word| follow_of(word).map(Some))?;
        let ticks =
            self.worlds * (self.relays + 1) * period_ticks(self.course.scenario.equalize.decision_s) as usize;
        if ticks > LONG {
            off_the_lock(
                py,
                |stop| errors::caught(|| self.lock().step(&speeds, pilots.as_deref(), follow, Some(stop))),
                |_| Ok(()),
            )???;
        } else {
            self.with(py, |worlds| worlds.step(&speeds, pilots.as_deref(), follow, None))??;
        }
        self.seen(py)
    }

    /// Which worlds are over: (worlds,) bool.
    #[getter]
    fn done(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        array(py, self.with(py, |worlds| worlds.done())?, None)
    }

    /// Simulated time of each world (s): (worlds,) float64.
    #[getter]
    fn time_s(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        array(py, self.with(py, |worlds| worlds.time_s())?, None)
    }

    /// Seed of each world: (worlds,) uint64.
    #[getter]
    fn seeds(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        array(py, self.with(py, |worlds| worlds.seeds())?, None)
    }

    /// What each world has come to so far, in the order of the worlds: a `Summary` each, as that of a run, but for how long the
    /// computer flew.
    fn summaries<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, Summary>>> {
        let texts = self.with(py, |worlds| worlds.summaries())?;
        let texts = texts.map_err(|error| UchainError::new_err(error.to_string()))?;
        texts.iter().map(|text| Summary::read(py, text)).collect()
    }

    /// What nobody in the air knows: places and true losses as of now, for rewards and pictures; a law that reads it flies in
    /// no tunnel.
    fn truth(&self, py: Python<'_>) -> PyResult<Truth> {
        let filling = self.with(py, |worlds| truth::Filling::of(worlds.flights()))?;
        filling.done(py, self.relays + 1)
    }

    /// Pickled as scenario, number of worlds and seed; under way it is not.
    #[expect(clippy::type_complexity, reason = "what pickle asks for: how to make it, and of what")]
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, (Py<Scenario>, usize, u64))> {
        let (py, this) = (slf.py(), slf.get());
        let first = this.with(py, |worlds| worlds.first_seed())?;
        let seed = first.ok_or_else(|| {
            PyTypeError::new_err(
                "an environment under way cannot be pickled: reset() it, or pickle its scenario",
            )
        })?;
        Ok((slf.get_type().into_any(), (this.scenario.clone_ref(py), this.worlds, seed)))
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let done = self.with(py, |worlds| worlds.done())?.into_iter().filter(|done| *done).count();
        let (name, worlds, relays) = (self.scenario.get().scene.name(), self.worlds, self.relays);
        Ok(format!("<uchain.ChainEnv {name}: {worlds} worlds of {relays} relays, {done} done>"))
    }
}

impl ChainEnv {
    /// What the pilot of each world asks for (m/s); NaN for nothing new.
    fn pilots(&self, pilot_mps: &Bound<'_, PyAny>) -> PyResult<Vec<f32>> {
        let is_number = !pilot_mps.hasattr("__len__")? && !pilot_mps.is_instance_of::<PyBool>();
        if let Some(one_mps) = pilot_mps.extract::<f64>().ok().filter(|_| is_number) {
            return Ok(vec![one_mps as f32; self.worlds]);
        }
        speeds_mps(pilot_mps, &[self.worlds])
            .map_err(|what| PyValueError::new_err(format!("pilot_mps = {what}, or one number")))
    }
}

pub(crate) fn fill(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Truth>()?;
    module.add_class::<ChainEnv>()
}
