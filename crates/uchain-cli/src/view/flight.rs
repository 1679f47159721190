//! What a page is given to show: a scenario with all that it takes to fly it, or a recording.

use std::{
    fs::File,
    io::Read as _,
    path::{Path, PathBuf},
};

use base64::{Engine as _, prelude::BASE64_STANDARD};
use serde::Serialize;
use serde_json::Value;
use uchain_sim::{
    config::Source,
    map::FORMATS,
    record::mcap::{ReadError, walls_to_csv},
    registry::{AnyScene, Registry},
    sweep::folder::Folder,
};

use super::View;
use crate::{
    exit::Failure,
    output::{RUN, folder_name},
};

/// Largest recording that a page takes (bytes): it reads all of it into memory.
const RECORDING_MAX_BYTES: u64 = 64 << 20;
/// What tells the folder of a sweep.
const SWEEP: &str = "sweep.json";

/// A flight, and what the file of its page is called.
pub(super) struct Brought {
    pub(super) name: String,
    flight: Flight,
}

/// As the page reads it.
#[derive(Serialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
enum Flight {
    Scenario {
        /// What messages call it.
        label: String,
        text: String,
        /// A number, or its digits: a page rounds numbers beyond 2⁵³ − 1.
        seed: Value,
        /// The walls, where the scenario names a file for them; and where their origin lies in that file's frame (m).
        #[serde(flatten)]
        walls: Option<Walls>,
    },
    Recording {
        label: String,
        base64: String,
    },
}

#[derive(Serialize)]
struct Walls {
    walls_csv: String,
    map_offset_m: [f64; 2],
}

impl Brought {
    /// For a page: no `<` in it could end the element that holds it.
    pub(super) fn json(&self) -> Result<String, Failure> {
        Ok(serde_json::to_string(&self.flight)?.replace('<', "\\u003c"))
    }
}

/// What is to be shown; `None` if nobody said.
pub(super) fn flight(registry: Registry, asked: &View) -> Result<Option<Brought>, Failure> {
    let Some(what) = asked.what.as_deref() else { return Ok(None) };
    let path = Path::new(what);
    let is_recording = path.extension().is_some_and(|end| end.eq_ignore_ascii_case("mcap"));
    if let Some(run) = asked.run {
        return row(registry, path, run).map(Some);
    }
    if path.join(SWEEP).is_file() {
        return Err(Failure::Usage(format!("{what} is a sweep: add --run I, the row to look at")));
    }
    let recording = path.join(RUN.recording.unwrap_or_default());
    if path.is_dir() && !recording.is_file() {
        return Err(Failure::Map(format!(
            "{what} is a folder with neither run.mcap nor a sweep in it: expected one of them, a file or a scenario's name"
        )));
    }
    if is_recording || path.is_dir() {
        if asked.seed.is_some() || !asked.sets.set.is_empty() {
            return Err(Failure::Usage(format!(
                "{what} is a recording, flown as it is: leave out --seed and --set, or view its scenario"
            )));
        }
        return recorded(registry, if is_recording { path } else { &recording }).map(Some);
    }
    let source = Source::find(what)?;
    let scene = registry.read(&source, &asked.sets.set)?;
    let seed = asked.seed.unwrap_or(1);
    let name = format!("{}-s{seed}", folder_name(what));
    // What was written, comments and all, if nothing was written over it.
    let text = if asked.sets.set.is_empty() { source.text.clone() } else { whole(&*scene)? };
    let label = source.file_name().unwrap_or_else(|| format!("{what}.toml"));
    Ok(Some(Brought { name, flight: scenario(label, text, seed, &*scene)? }))
}

/// A scene with its walls, where they come from a file.
fn scenario(label: String, text: String, seed: u64, scene: &dyn AnyScene) -> Result<Flight, Failure> {
    let map = scene.map();
    let walls = is_a_file(&whole(scene)?)
        .then(|| Walls { walls_csv: walls_to_csv(map), map_offset_m: map.offset_m() });
    let seed = if seed < 1 << 53 { seed.into() } else { seed.to_string().into() };
    Ok(Flight::Scenario { label, text, seed, walls })
}

/// The scenario with every value written out.
fn whole(scene: &dyn AnyScene) -> Result<String, Failure> {
    scene.to_toml().map_err(|error| Failure::Map(error.to_string()))
}

/// Whether a whole scenario's map is a file.
fn is_a_file(whole: &str) -> bool {
    let table = whole.parse::<toml::Table>().ok();
    let map = table.as_ref().and_then(|table| table.get("map")?.as_table());
    let is_there = |word: &str| map.is_some_and(|map| map.contains_key(word));
    FORMATS.iter().any(|format| !format.ends.is_empty() && is_there(format.word()))
}

/// A row of a sweep.
fn row(registry: Registry, folder: &Path, run: u64) -> Result<Brought, Failure> {
    let folder = Folder::open(folder)?.with_missions(registry);
    let sweep = folder.sweep()?;
    // There is such a run.
    folder.known(&sweep, run)?;
    let run = sweep.run(run);
    let scene = sweep.lay(run.variant)?;
    let file = folder.manifest().file.as_deref();
    let of = file.map_or_else(|| sweep.about().name.clone(), folder_name);
    let (name, label) = (format!("{of}-run{}", run.index), format!("{of}.toml"));
    Ok(Brought { name, flight: scenario(label, whole(&*scene)?, run.seed, &*scene)? })
}

/// A recording, which this version can read.
fn recorded(registry: Registry, file: &Path) -> Result<Brought, Failure> {
    let failed = |cause| Failure::Recording { file: file.to_owned(), cause };
    let recording = registry.open(file).map_err(failed)?;
    let mut bytes = Vec::new();
    let read = File::open(file).and_then(|file| file.take(RECORDING_MAX_BYTES + 1).read_to_end(&mut bytes));
    read.map_err(|cause| failed(ReadError::from(cause)))?;
    if bytes.len() as u64 > RECORDING_MAX_BYTES {
        let seed = recording.about().seed;
        return Err(Failure::Map(format!(
            "{}: more than {} MiB are too much for a page; view its scenario with --seed {seed}, which flies again as it \
             was recorded, or a shorter flight (--set duration_s=600)",
            file.display(),
            RECORDING_MAX_BYTES >> 20
        )));
    }
    let label = file.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let flight = Flight::Recording { label, base64: BASE64_STANDARD.encode(&bytes) };
    Ok(Brought { name: format!("{}-recording", folder_name(&called(file))), flight })
}

/// A file that is called as all recordings are goes by its folder.
fn called(file: &Path) -> String {
    let is_usual = RUN.recording.is_some_and(|name| file.file_name().is_some_and(|file| file == name));
    let folder = file.parent().and_then(Path::file_name).filter(|_| is_usual);
    folder.map_or_else(|| file.to_owned(), PathBuf::from).display().to_string()
}
