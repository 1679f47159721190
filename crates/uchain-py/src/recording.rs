//! Recordings read back.

use std::{
    path::{Path, PathBuf},
    sync::{Arc, atomic::Ordering},
};

use pyo3::{prelude::*, types::PyType};
use uchain_sim::{
    config::Source,
    mathematics::Foreign,
    mission::Keep,
    record::mcap::{About, End, PlayError, ReadError},
    registry::AnyRecording,
};

use crate::{
    errors::{self, RecordingError},
    registry,
    run::{Frames, Run, Stopped},
    scenario::Scenario,
    work::off_the_lock,
};

/// This version.
const OURS: &str = env!("CARGO_PKG_VERSION");
/// Longest version that is shown: it is read from a file.
const VERSION_SHOWN: usize = 40;

/// A run that was recorded, read back: all that a `Run` is, and whose it was.
///
/// Its summary has no `wall_s`, for a recording does not say how long the computer flew. It pickles as the path of its
/// file, which has to be there where it arrives.
#[pyclass(frozen, extends = Run, module = "uchain")]
pub(crate) struct Recording {
    path: PathBuf,
    frames: Option<Keep>,
    /// The version of uchain that flew it.
    #[pyo3(get)]
    version: String,
    /// Ticks that were recorded, 20 per simulated second.
    #[pyo3(get)]
    ticks: u64,
    /// Whether the file ends as a recording does; one that was cut short is read up to its last whole chunk.
    #[pyo3(get)]
    whole: bool,
}

/// What comes of flying a recording again; true if no bit differs.
#[pyclass(frozen, get_all, module = "uchain")]
pub(crate) struct Verification {
    /// Whether all that was recorded is what this version flies, bit for bit.
    same: bool,
    /// Ticks that were compared.
    ticks: u64,
    /// Ticks of the whole run.
    of_ticks: u64,
    /// Whether the recording ends as a run does; None if a difference came first.
    whole: Option<bool>,
    /// The first field that differs, with both values; None if nothing does.
    difference: Option<String>,
    /// Why bits may differ without anybody's fault: another version, another mathematics.
    reasons: Vec<String>,
}

#[pymethods]
impl Verification {
    fn __bool__(&self) -> bool {
        self.same
    }

    #[expect(clippy::type_complexity, reason = "what pickle asks for: how to make it, and of what")]
    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> PyResult<(Bound<'py, PyAny>, (bool, u64, u64, Option<bool>, Option<String>, Vec<String>))> {
        let Self { same, ticks, of_ticks, whole, difference, reasons } = slf.get();
        let parts = (*same, *ticks, *of_ticks, *whole, difference.clone(), reasons.clone());
        Ok((slf.get_type().getattr("_unpickled")?, parts))
    }

    /// How pickle makes one.
    #[staticmethod]
    fn _unpickled(
        same: bool,
        ticks: u64,
        of_ticks: u64,
        whole: Option<bool>,
        difference: Option<String>,
        reasons: Vec<String>,
    ) -> Self {
        Self { same, ticks, of_ticks, whole, difference, reasons }
    }

    fn __repr__(&self) -> String {
        let Self { ticks, of_ticks, .. } = self;
        match &self.difference {
            Some(difference) => format!("<uchain.Verification: differs at {difference}>"),
            None => format!("<uchain.Verification: the same, {ticks} of {of_ticks} ticks>"),
        }
    }
}

fn open(path: &Path) -> PyResult<Box<dyn AnyRecording>> {
    let opened = errors::caught(|| registry().open(path))?;
    opened.map_err(|cause| RecordingError::new_err(format!("{}: {cause}", path.display())))
}

/// What the file of another version cannot be read for is its version.
fn refused(path: &Path, about: &About, cause: &ReadError) -> PyErr {
    let (file, theirs) = (path.display(), &about.version);
    RecordingError::new_err(if theirs == OURS {
        format!("{file}: {cause}")
    } else {
        let theirs: String = theirs.chars().take(VERSION_SHOWN).collect();
        format!("{file}: recorded by uchain {theirs}, this is {OURS}: {cause}")
    })
}

fn played(path: &Path, about: &About, cause: PlayError) -> PyErr {
    match cause {
        PlayError::Read(cause) => refused(path, about, &cause),
        PlayError::Record(cause) => errors::record(&cause),
    }
}

#[pymethods]
impl Recording {
    /// The path of its file, absolute.
    #[getter]
    fn path(&self) -> String {
        self.path.display().to_string()
    }

    /// Flies it again, in the walls that were recorded, up to the first tick that differs in a bit.
    ///
    /// Returns a `Verification`, which is true if nothing differs. Raises `RecordingError` if the file cannot be read any
    /// more, or is of a scenario that this version cannot fly.
    fn verify(&self, py: Python<'_>) -> PyResult<Verification> {
        let path = &self.path;
        off_the_lock(
            py,
            |stop| {
                let mut recording = open(path)?;
                let about = recording.about().clone();
                let mut go_on = || !stop.load(Ordering::Relaxed);
                let verdict = errors::caught(|| recording.verify_while(&mut go_on))?;
                let verdict = verdict.map_err(|cause| refused(path, &about, &cause))?;
                let say = |first: uchain_sim::record::Difference| {
                    format!("{}: {} recorded, {} flown", first.place(), first.here, first.there)
                };
                let version = (about.version != OURS).then(|| {
                    let theirs: String = about.version.chars().take(VERSION_SHOWN).collect();
                    format!("recorded by uchain {theirs}, flown by {OURS}")
                });
                let foreign = Foreign::of(about.mathematics.as_deref()).map(|foreign| foreign.to_string());
                Ok(Verification {
                    same: verdict.agrees(),
                    ticks: verdict.ticks,
                    of_ticks: verdict.of,
                    whole: verdict.end.map(|end| end == End::Whole),
                    difference: verdict.first.map(say),
                    reasons: version.into_iter().chain(foreign).collect(),
                })
            },
            |_| Ok(()),
        )?
    }

    /// Pickled as the path of its file.
    #[expect(clippy::type_complexity, reason = "what pickle asks for: how to make it, and of what")]
    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> PyResult<(Bound<'py, PyAny>, (PathBuf, Option<&'static str>))> {
        let frames = slf.get().frames.map(|keep| match keep {
            Keep::Ticks => "ticks",
            Keep::Decisions => "decisions",
        });
        Ok((slf.get_type().getattr("_unpickled")?, (slf.get().path.clone(), frames)))
    }

    /// How pickle makes one.
    #[classmethod]
    #[expect(clippy::needless_pass_by_value, reason = "an argument from Python")]
    fn _unpickled<'py>(
        cls: &Bound<'py, PyType>,
        path: PathBuf,
        frames: Frames,
    ) -> PyResult<Bound<'py, Self>> {
        read(cls.py(), &path, frames.0)
    }
}

/// Reads a recording (MCAP) of a chain or an exploration, by whatever door it was written: `uchain run`,
/// `uchain.run(record=…)`, a sweep.
///
/// Nothing in the file is believed unchecked, and memory is bounded. A file that was cut short is read up to its last
/// whole chunk (`Recording.whole`).
///
/// Parameters
/// ----------
/// path : str or os.PathLike
///     The file.
/// frames : "ticks", "decisions" or None
///     Which frames are kept, as in `run`.
///
/// Returns
/// -------
/// Recording
///
/// Raises
/// ------
/// RecordingError
///     It cannot be read, is none, is damaged, or is of a scenario that this version does not know; the text says where.
///
/// Examples
/// --------
/// >>> flown = uchain.run(uchain.Scenario.from_name("straight").with_(duration_s=5), record="run.mcap")
/// >>> read = uchain.read_recording("run.mcap")
/// >>> read.digest == flown.digest, read.whole, bool(read.verify())
/// (True, True, True)
#[pyfunction]
#[pyo3(signature = (path, *, frames=Frames(Some(Keep::Ticks))))]
#[pyo3(text_signature = "(path, *, frames='ticks')")]
#[expect(clippy::needless_pass_by_value, reason = "an argument from Python")]
fn read_recording(py: Python<'_>, path: PathBuf, frames: Frames) -> PyResult<Bound<'_, Recording>> {
    read(py, &path, frames.0)
}

fn read<'py>(py: Python<'py>, path: &Path, frames: Option<Keep>) -> PyResult<Bound<'py, Recording>> {
    // It may be read again from another working folder.
    let path = std::path::absolute(path)
        .map_err(|cause| RecordingError::new_err(format!("{}: {cause}", path.display())))?;
    let (kept, scene, about) = off_the_lock(
        py,
        |stop| {
            let mut recording = open(&path)?;
            let about = recording.about().clone();
            let kept = errors::caught(|| recording.keep(frames, &mut Stopped(stop)))?;
            let kept = kept.map_err(|cause| played(&path, &about, cause))?;
            let scene = recording.any_scene().map_err(|cause| refused(&path, &about, &cause))?;
            Ok::<_, PyErr>((kept, scene, about))
        },
        |_| Ok(()),
    )??;
    let json = kept.json(None, &about.version).map_err(|error| errors::flight(&error))?;
    let (ticks, whole) = (kept.ticks(), kept.is_whole());
    let folder = path.parent().unwrap_or(Path::new("")).to_owned();
    let source = Source { label: path.display().to_string(), text: about.scenario, folder };
    let scenario = Py::new(py, Scenario { source, sets: Vec::new(), scene: Arc::clone(&scene) })?;
    let run = Run::of(scenario, about.seed, kept, &json, py)?;
    let recording = Recording { path, frames, version: about.version, ticks, whole };
    Bound::new(py, PyClassInitializer::from(run).add_subclass(recording))
}

pub(crate) fn fill(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Recording>()?;
    module.add_class::<Verification>()?;
    module.add_function(wrap_pyfunction!(read_recording, module)?)
}
