//! How far a sweep has come: as a line for people, or told to a function.

use std::{
    sync::{
        Mutex, PoisonError,
        atomic::{AtomicBool, AtomicU64, Ordering},
    },
    time::Instant,
};

use pyo3::{
    Borrowed,
    exceptions::{PyException, PyTypeError, PyUserWarning},
    prelude::*,
    types::{PyBool, PyType},
};
use uchain_sim::sweep::folder::{FolderError, Watch};

use crate::run::shown;

/// How often a line is written anew (s).
const LINE_S: f64 = 0.5;

/// How far a sweep has come.
///
/// >>> print(uchain.Progress(120, 3, 400, 1.5, 3.5))
/// 120 of 400 runs, 3 failed, 4 s left
#[pyclass(frozen, eq, get_all, module = "uchain")]
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Progress {
    /// Runs that are done.
    done: u64,
    /// How many of them failed.
    failed: u64,
    /// Runs in all.
    total: u64,
    /// How long it has taken (s).
    elapsed_s: f64,
    /// How long it will take from here on (s); None if that cannot be told yet.
    left_s: Option<f64>,
}

#[pymethods]
impl Progress {
    #[new]
    #[pyo3(signature = (done, failed, total, elapsed_s, left_s=None))]
    fn new(done: u64, failed: u64, total: u64, elapsed_s: f64, left_s: Option<f64>) -> Self {
        Self { done, failed, total, elapsed_s, left_s }
    }

    #[expect(clippy::type_complexity, reason = "what pickle asks for: how to make it, and of what")]
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> (Bound<'py, PyType>, (u64, u64, u64, f64, Option<f64>)) {
        let Self { done, failed, total, elapsed_s, left_s } = *slf.get();
        (slf.get_type(), (done, failed, total, elapsed_s, left_s))
    }

    fn __str__(&self) -> String {
        let Self { done, failed, total, left_s, .. } = self;
        let failed = if *failed > 0 { format!(", {failed} failed") } else { String::new() };
        let left = left_s.map_or_else(String::new, |left_s| format!(", {} left", span(left_s)));
        format!("{done} of {total} runs{failed}{left}")
    }

    fn __repr__(&self) -> String {
        format!("<uchain.Progress {}>", self.__str__())
    }
}

/// A time span for people.
fn span(seconds: f64) -> String {
    let seconds = seconds.ceil().max(0.0);
    if seconds < 100.0 {
        format!("{seconds} s")
    } else if seconds < 6000.0 {
        format!("{} min", (seconds / 60.0).ceil())
    } else {
        format!("{:.1} h", seconds / 3600.0)
    }
}

/// Who is told.
#[derive(Debug)]
pub(super) enum Told {
    Nobody,
    /// A line on the standard error output.
    People,
    Function(Py<PyAny>),
}

impl<'a, 'py> FromPyObject<'a, 'py> for Told {
    type Error = PyErr;

    fn extract(value: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(shown) = value.cast::<PyBool>() {
            return Ok(if shown.is_true() { Self::People } else { Self::Nobody });
        }
        if value.is_none() {
            return Ok(Self::Nobody);
        }
        if value.is_callable() {
            return Ok(Self::Function(value.to_owned().unbind()));
        }
        let got = shown(&value);
        let expected = "expected True, False, or a function that is given a uchain.Progress";
        Err(PyTypeError::new_err(format!("progress = {got}: {expected}")))
    }
}

/// Counts runs as they are done, on whatever threads.
#[derive(Debug, Default)]
pub(super) struct Counts {
    done: AtomicU64,
    failed: AtomicU64,
    /// Runs that were there before: they took no time.
    before: AtomicU64,
    total: AtomicU64,
    warnings: Mutex<Vec<String>>,
}

impl Counts {
    pub(super) fn expect(&self, total: u64) {
        self.total.store(total, Ordering::Relaxed);
    }
}

/// Counts runs, and stops when it is told to.
pub(super) struct Counting<'a> {
    pub(super) counts: &'a Counts,
    pub(super) stop: &'a AtomicBool,
}

impl Watch for Counting<'_> {
    fn stop(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    fn done(&self, runs: u64, failed: u64, now: bool) {
        self.counts.failed.fetch_add(failed, Ordering::Relaxed);
        self.counts.done.fetch_add(runs, Ordering::Relaxed);
        if !now {
            self.counts.before.fetch_add(runs, Ordering::Relaxed);
        }
    }

    fn again(&self, why: &FolderError) {
        let mut warnings = self.counts.warnings.lock().unwrap_or_else(PoisonError::into_inner);
        warnings.push(why.to_string().replace("--resume flies its runs again", "its runs are flown again"));
    }
}

/// Tells, on the thread of the caller.
pub(super) struct Teller<'a> {
    counts: &'a Counts,
    told: Told,
    start: Instant,
    /// When a line was written last (s), and how many letters it had.
    line: Option<(f64, usize)>,
    /// What a function was told last.
    last: Option<u64>,
}

impl<'a> Teller<'a> {
    #[expect(clippy::disallowed_methods, reason = "the time left is about this computer")]
    pub(super) fn new(counts: &'a Counts, told: Told) -> Self {
        Self { counts, told, start: Instant::now(), line: None, last: None }
    }

    fn progress(&self) -> Progress {
        let get = |count: &AtomicU64| count.load(Ordering::Relaxed);
        // Failures first: there are never more of them than runs.
        let failed = get(&self.counts.failed);
        let (done, before, total) =
            (get(&self.counts.done), get(&self.counts.before), get(&self.counts.total));
        let elapsed_s = self.start.elapsed().as_secs_f64();
        let flown = done.saturating_sub(before);
        let left = total.saturating_sub(done) as f64;
        let left_s = (flown > 0).then(|| elapsed_s / flown as f64 * left);
        Progress { done, failed: failed.min(done), total, elapsed_s, left_s }
    }

    /// Tells what is new.
    ///
    /// # Errors
    /// What the function raises; a warning that is an error.
    pub(super) fn tell(&mut self, py: Python<'_>) -> PyResult<()> {
        for warning in self.counts.warnings.lock().unwrap_or_else(PoisonError::into_inner).drain(..) {
            let text = std::ffi::CString::new(warning).unwrap_or_default();
            PyErr::warn(py, &py.get_type::<PyUserWarning>(), &text, 1)?;
        }
        let now = self.progress();
        match &self.told {
            Told::Nobody => Ok(()),
            Told::People => {
                let is_due = self.line.is_none_or(|(last_s, _)| now.elapsed_s - last_s >= LINE_S);
                if is_due && now.elapsed_s >= LINE_S { self.write_line(py, &now) } else { Ok(()) }
            }
            Told::Function(_) if now.total == 0 || self.last == Some(now.done) => Ok(()),
            Told::Function(function) => {
                let done = now.done;
                function.call1(py, (now,))?;
                self.last = Some(done);
                Ok(())
            }
        }
    }

    /// Tells how it ended: a last line, wherever it goes.
    pub(super) fn end(&self, py: Python<'_>) -> PyResult<()> {
        if !matches!(self.told, Told::People) {
            return Ok(());
        }
        let now = self.progress();
        let failed = if now.failed > 0 { format!(", {} failed", now.failed) } else { String::new() };
        let text = format!("{} runs{failed}, {:.1} s", now.done, now.elapsed_s);
        let letters = self.line.map_or(0, |(_, letters)| letters);
        let back = if self.line.is_some() { "\r" } else { "" };
        spoken(py, &format!("{back}{text:letters$}\n"))
    }

    /// Leaves the line as it is, and goes to the next: an exception follows.
    pub(super) fn give_up(&self, py: Python<'_>) {
        if self.line.is_some() {
            let _ = spoken(py, "\n");
        }
    }

    /// Over the last one, where that can be done: on terminals and in notebooks.
    fn write_line(&mut self, py: Python<'_>, now: &Progress) -> PyResult<()> {
        if !is_live(py) {
            return Ok(());
        }
        let (text, letters) = (now.__str__(), self.line.map_or(0, |(_, letters)| letters));
        self.line = Some((now.elapsed_s, text.chars().count()));
        spoken(py, &format!("\r{text:letters$}"))
    }
}

/// Whether a line on the standard error output can be written over.
fn is_live(py: Python<'_>) -> bool {
    let ask = || -> PyResult<bool> {
        let stderr = py.import("sys")?.getattr("stderr")?;
        let module: String = stderr.get_type().getattr("__module__")?.extract()?;
        Ok(module.starts_with("ipykernel") || stderr.call_method0("isatty")?.is_truthy()?)
    };
    ask().unwrap_or(false)
}

/// Writes to Python's standard error output, if there is one. That it cannot be written ends no sweep; an interrupt does.
fn spoken(py: Python<'_>, text: &str) -> PyResult<()> {
    let write = || -> PyResult<()> {
        let stderr = py.import("sys")?.getattr("stderr")?;
        if !stderr.is_none() {
            stderr.call_method1("write", (text,))?;
            stderr.call_method0("flush")?;
        }
        Ok(())
    };
    write().or_else(|error| if error.is_instance_of::<PyException>(py) { Ok(()) } else { Err(error) })
}
