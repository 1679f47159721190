//! Laws of one's own in Python: what levels the relays of a chain, in place of the built-in law.

mod answer;
mod arrays;
mod each;
mod flyer;
mod params;
mod seen;
mod together;

use std::{
    cell::Cell,
    sync::{Arc, Mutex, PoisonError},
};

use pyo3::{
    exceptions::{PyException, PyKeyboardInterrupt, PyTypeError, PyValueError},
    prelude::*,
};
use uchain_sim::{clock::time_s, mission::chain::Course, registry::AnyScene};

use crate::errors::LawError;
pub(crate) use answer::{shown, speeds_mps};
pub(crate) use arrays::{Filling, SeenArrays, array};
pub(crate) use flyer::LawFlyer;
pub(crate) use params::LawParams;

/// A law that sees all relays at once: `batched(law)`, also as a decorator, for `run(…, law=…)` and `sweep(…, law=…)`.
///
/// The law is a callable of `SeenArrays` with arrays (relays,), and returns their forward speeds (m/s): an array (relays,) of
/// float32; float64 and whole numbers are taken, too. In a sweep up to 256 runs fly side by side, and their relays are
/// asked together. A law that looks at each relay by itself has the rows of the same law asked relay by relay.
///
/// >>> import numpy as np
/// >>> @uchain.batched
/// ... def law(seen):
/// ...     s_d = seen.front_db - seen.back_db
/// ...     v_mps = s_d / (3 * seen.params.k_db_per_m) / seen.params.decision_s
/// ...     return np.clip(v_mps, -seen.params.v_max_mps, seen.params.v_max_mps)
/// >>> uchain.run("straight", law=law, frames=None).outcome
/// 'completed'
#[pyclass(frozen, name = "batched", module = "uchain")]
pub(crate) struct Batched {
    /// The law itself.
    #[pyo3(get)]
    law: Py<PyAny>,
}

#[pymethods]
impl Batched {
    #[new]
    #[pyo3(signature = (law, /))]
    fn new(law: Bound<'_, PyAny>) -> PyResult<Self> {
        if !law.is_callable() {
            let shown = shown(&law);
            return Err(PyTypeError::new_err(format!(
                "law = {shown}: expected a callable of uchain.SeenArrays"
            )));
        }
        Ok(Self { law: law.unbind() })
    }

    /// Asks the law itself.
    #[pyo3(signature = (seen, /))]
    fn __call__<'py>(&self, seen: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        self.law.bind(seen.py()).call1((seen,))
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> (Bound<'py, PyAny>, (Py<PyAny>,)) {
        (slf.get_type().into_any(), (slf.get().law.clone_ref(slf.py()),))
    }

    fn __repr__(&self, py: Python<'_>) -> String {
        format!("uchain.batched({})", shown(self.law.bind(py)))
    }
}

thread_local! {
    /// The number that Python has for this thread: it is asked for once.
    static IDENT: Cell<Option<u64>> = const { Cell::new(None) };
}

/// How a law is asked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Way {
    /// Relay by relay.
    Each,
    /// Relay by relay, each with what the law's `start` makes for it.
    Started,
    /// For all relays at once.
    Together,
}

/// A law of one's own, in one call of the module, which may fly many runs.
#[derive(Debug)]
pub(crate) struct OwnLaw {
    way: Way,
    law: Py<PyAny>,
    /// Threads that are in the law, by the number that Python has for them.
    threads: Mutex<Vec<u64>>,
}

/// Why a law ended a run; looked at once it has ended.
#[derive(Debug, Default)]
pub(crate) struct Fault(Mutex<Option<PyErr>>);

impl Fault {
    fn set(&self, error: PyErr) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = Some(error);
    }

    /// The law's error, if it was the law that ended the run.
    pub(crate) fn take(&self) -> Option<PyErr> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).take()
    }
}

impl OwnLaw {
    /// Whatever was given as `law=`.
    ///
    /// # Errors
    /// `TypeError` of what is no law.
    pub(crate) fn of(law: &Bound<'_, PyAny>) -> PyResult<Arc<Self>> {
        let (way, law) = if let Ok(batched) = law.cast::<Batched>() {
            (Way::Together, batched.get().law.bind(law.py()))
        } else if law.hasattr("start")? {
            (Way::Started, law)
        } else if law.is_callable() {
            (Way::Each, law)
        } else {
            let shown = shown(law);
            return Err(PyTypeError::new_err(format!(
                "law = {shown}: expected a callable law(seen) -> forward_mps, an object with start(uav, params), which \
                 returns one for each relay, or uchain.batched(law)"
            )));
        };
        Ok(Arc::new(Self { way, law: law.clone().unbind(), threads: Mutex::default() }))
    }

    /// Asks the law, on whatever thread.
    fn ask<T>(&self, py: Python<'_>, ask: impl FnOnce(&Bound<'_, PyAny>) -> T) -> PyResult<T> {
        let thread = match IDENT.get() {
            Some(known) => known,
            None => py.import("threading")?.call_method0("get_ident")?.extract()?,
        };
        IDENT.set(Some(thread));
        let threads = || self.threads.lock().unwrap_or_else(PoisonError::into_inner);
        threads().push(thread);
        let answer = ask(self.law.bind(py));
        threads().retain(|other| *other != thread);
        Ok(answer)
    }

    /// Raises `KeyboardInterrupt` in every thread that is in the law: one that goes on for ever would be waited for as long.
    pub(crate) fn interrupt(&self, py: Python<'_>) {
        let threads = self.threads.lock().unwrap_or_else(PoisonError::into_inner).clone();
        let raise = |thread: u64| -> PyResult<()> {
            let ctypes = py.import("ctypes")?;
            let raise = ctypes.getattr("pythonapi")?.getattr("PyThreadState_SetAsyncExc")?;
            let interrupt = py.get_type::<PyKeyboardInterrupt>();
            let thread = ctypes.call_method1("c_ulong", (thread,))?;
            raise.call1((thread, ctypes.call_method1("py_object", (interrupt,))?)).map(drop)
        };
        for thread in threads {
            // Whoever has no ctypes waits.
            let _ = raise(thread);
        }
    }

    /// What a recording calls it: `chain.brain` of its scenario.
    fn name(&self, py: Python<'_>) -> String {
        let law = self.law.bind(py);
        let own = law.getattr("__name__").and_then(|name| name.extract::<String>());
        let name = own.or_else(|_| law.get_type().name().map(|name| name.to_string())).unwrap_or_default();
        let name: String = name.chars().filter(|letter| !letter.is_control()).take(60).collect();
        format!("python:{name}")
    }

    /// The same scene, its relays levelled by this law in one run; and where the law's error is found if it ends the run.
    ///
    /// # Errors
    /// `ValueError`: nothing is levelled in this scene.
    pub(crate) fn flying(
        self: &Arc<Self>,
        py: Python<'_>,
        scene: &dyn AnyScene,
    ) -> PyResult<(Arc<dyn AnyScene>, Arc<Fault>)> {
        let course = course(scene)?;
        let (law, fault, name) = (self.clone(), Arc::<Fault>::default(), self.name(py));
        let told = fault.clone();
        let course = match self.way {
            Way::Together => course.with_leveller(&name, move |course| {
                together::Together::new(law.clone(), told.clone(), &course.scenario.equalize)
            }),
            Way::Each | Way::Started => course.with_leveller(&name, move |course| {
                each::Each::new(law.clone(), told.clone(), &course.scenario.equalize)
            }),
        };
        Ok((<dyn AnyScene>::of(course), fault))
    }
}

/// The course of a scene whose relays can be levelled by a law of one's own.
///
/// # Errors
/// `ValueError`: it is no chain, or its UAVs do not fly by the built-in node.
pub(crate) fn course(scene: &dyn AnyScene) -> PyResult<&Arc<Course>> {
    let Some(course) = scene.get::<Course>() else {
        let (name, kind) = (scene.name(), scene.kind());
        return Err(PyValueError::new_err(format!(
            "scenario {name} is {kind}, which has no relays: expected the scenario of a chain"
        )));
    };
    if course.law.is_some() {
        let brain = course.scenario.chain.brain.as_deref().unwrap_or_default();
        return Err(PyValueError::new_err(format!(
            "chain.brain = \"{brain}\" flies by a law of its own already: expected \"node\""
        )));
    }
    Ok(course)
}

/// A scene whose law only Python has, such as that of a recording, is not flown without it.
///
/// # Errors
/// `ValueError` with the law's name.
pub(crate) fn lacks_no_law(scene: &dyn AnyScene) -> PyResult<()> {
    match scene.get::<Course>() {
        Some(course) if course.leveller.is_some() => {
            let brain = course.scenario.chain.brain.as_deref().unwrap_or_default();
            Err(PyValueError::new_err(format!(
                "it was flown by a law of somebody's own, \"{brain}\": expected law=, too, or with_(**{{\"chain.brain\": \
                 \"node\"}})"
            )))
        }
        _ => Ok(()),
    }
}

/// What is said of a law that gave no speed: `what` it did, at a tick, for whom.
fn words(what: &str, tick: u64, whom: &str) -> String {
    let time_s = time_s(tick);
    format!("the law {what}, at tick {tick} ({time_s:.2} s) for {whom}")
}

fn no_speed(py: Python<'_>, what: &str, tick: u64, whom: &str, cause: Option<PyErr>) -> PyErr {
    let error = LawError::new_err(words(what, tick, whom));
    error.set_cause(py, cause);
    error
}

/// What is said of an error of a law; `None` of what is none of the law's: Ctrl-C and the like.
fn what_raised(py: Python<'_>, error: &PyErr) -> Option<String> {
    const MOST: usize = 500;
    let mut what = error.is_instance_of::<PyException>(py).then(|| format!("raised {error}"))?;
    if let Some((end, _)) = what.char_indices().nth(MOST) {
        what.truncate(end);
        what.push('…');
    }
    Some(what)
}

/// An error of a law as the run's. Ctrl-C and the like go on as they are.
fn raised(py: Python<'_>, error: PyErr, tick: u64, whom: &str) -> PyErr {
    match what_raised(py, &error) {
        Some(what) => no_speed(py, &what, tick, whom, Some(error)),
        None => error,
    }
}

pub(crate) fn fill(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<seen::Seen>()?;
    module.add_class::<SeenArrays>()?;
    module.add_class::<LawParams>()?;
    module.add_class::<Batched>()
}
