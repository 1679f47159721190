//! `sweep.json`: what is flown, so that it can be resumed, merged and flown again.

use std::{
    fs::File,
    io::{self, Read as _, Write as _},
    ops::Range,
    path::{Path, PathBuf},
};

use serde::{Deserialize, Serialize};
use twox_hash::XxHash64;

use super::{FolderError, MANIFEST, chunk, durable, table::Seal};
use crate::{
    config::Source,
    registry::Registry,
    sweep::{Design, DesignError, DesignText, Sweep},
};

/// This version.
const VERSION: &str = env!("CARGO_PKG_VERSION");
/// Longest file (bytes): a table and a scenario, with room for their escapes.
const MAX_BYTES: u64 = 128 << 20;

/// What a sweep is: rows are a function of this and nothing else.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Manifest {
    /// Version of uchain that flies.
    pub version: String,
    /// The scenario's name.
    pub name: String,
    /// Name of the file it was read from, without folders; a built-in scenario has none. What is flown again is called
    /// by it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// The scenario's text.
    pub scenario: String,
    /// What was written over it for all variants (`--set`).
    pub set: Vec<String>,
    /// What is varied.
    pub design: DesignText,
    /// Runs of each variant.
    pub replicates: u64,
    /// Root seed.
    pub seed: u64,
    /// Number of runs.
    pub runs: u64,
    /// Rows of a chunk.
    pub chunk_rows: u64,
    /// Hash of the walls of the first variant that can be laid out: a map's file lies elsewhere and may change.
    pub walls: String,
}

/// The file.
#[derive(Debug, Serialize, Deserialize)]
pub(in crate::sweep) struct OnDisk {
    #[serde(flatten)]
    pub(super) manifest: Manifest,
    /// Where relative paths in the scenario start; where, not what is flown.
    pub(super) folder: PathBuf,
    /// Of the table, from a moment before it has its name.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) table: Option<Seal>,
}

impl OnDisk {
    /// Without a table yet.
    pub(in crate::sweep) fn new(manifest: Manifest, folder: PathBuf) -> Self {
        Self { manifest, folder, table: None }
    }

    /// What is flown, and where relative paths in its scenario start.
    pub(in crate::sweep) fn into_parts(self) -> (Manifest, PathBuf) {
        (self.manifest, self.folder)
    }

    /// In this folder.
    pub(super) fn read(folder: &Path) -> Result<Self, FolderError> {
        let file = folder.join(MANIFEST);
        let mut text = Vec::new();
        match File::open(&file).and_then(|file| file.take(MAX_BYTES).read_to_end(&mut text)) {
            Ok(_) => {}
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                return Err(FolderError::NoSweep { folder: folder.to_owned() });
            }
            Err(error) => return Err(FolderError::io(&file, "read")(error)),
        }
        serde_json::from_slice(&text).map_err(|error| FolderError::Damaged {
            file,
            why: error.to_string(),
            remedy: "fly the sweep again, in another folder",
        })
    }

    /// Into this folder, whole or not at all.
    pub(super) fn write(&self, folder: &Path) -> Result<(), FolderError> {
        let file = folder.join(MANIFEST);
        let text =
            serde_json::to_vec_pretty(self).map_err(|error| FolderError::io(&file, "write")(error.into()))?;
        durable::write(&file, |out| out.write_all(&text).map_err(FolderError::io(&file, "write")))
    }
}

impl Manifest {
    /// Of a sweep that was checked; `walls` is what that gave.
    pub fn of(sweep: &Sweep, walls: String) -> Self {
        Self {
            version: VERSION.to_owned(),
            name: sweep.about.name.clone(),
            file: sweep.source.file_name(),
            scenario: sweep.source.text.clone(),
            set: sweep.sets.clone(),
            design: sweep.design.text().clone(),
            replicates: sweep.replicates,
            seed: sweep.seed,
            runs: sweep.runs(),
            chunk_rows: chunk::rows(sweep.runs()),
            walls,
        }
    }

    /// The sweep, ready to be flown by this version.
    ///
    /// # Errors
    /// Those of [`Design::parse`] and [`Sweep::new`]: this version does not know the scenario any more.
    pub fn sweep(&self, registry: Registry, folder: &Path) -> Result<Sweep, DesignError> {
        let source = Source {
            label: format!("<scenario {}>", self.name),
            text: self.scenario.clone(),
            folder: folder.to_owned(),
        };
        let design = Design::parse(&self.design, "<design>")?;
        Sweep::of(registry, source, self.set.clone(), design, self.replicates, self.seed)
    }

    /// Number of chunks.
    pub(in crate::sweep) fn chunks(&self) -> u64 {
        self.runs.div_ceil(self.chunk_rows.max(1))
    }

    /// Runs of a chunk.
    pub(in crate::sweep) fn runs_of(&self, chunk: u64) -> Range<u64> {
        let first = chunk.saturating_mul(self.chunk_rows).min(self.runs);
        first..first.saturating_add(self.chunk_rows).min(self.runs)
    }

    /// What is flown, for the table: the table alone says what it is about. `file` is what messages are about.
    pub(in crate::sweep) fn metadata(&self, file: &Path) -> Result<Vec<(&'static str, String)>, FolderError> {
        let json = |value: serde_json::Result<String>| {
            value.map_err(|error| FolderError::io(file, "read")(error.into()))
        };
        Ok(vec![
            ("uchain.version", self.version.clone()),
            ("uchain.name", self.name.clone()),
            ("uchain.scenario", self.scenario.clone()),
            ("uchain.set", json(serde_json::to_string(&self.set))?),
            ("uchain.design", json(serde_json::to_string(&self.design))?),
            ("uchain.replicates", self.replicates.to_string()),
            ("uchain.seed", self.seed.to_string()),
            ("uchain.walls", self.walls.clone()),
        ])
    }

    /// Names the sweep in its chunks.
    pub(super) fn hash(&self) -> String {
        // Strings and numbers become JSON without fail.
        let text = serde_json::to_string(self).unwrap_or_default();
        format!("{:016x}", XxHash64::oneshot(0, text.as_bytes()))
    }

    /// What differs from another one, which was asked for; `None` if nothing does.
    pub(in crate::sweep) fn differs(&self, asked: &Self) -> Option<String> {
        let (one, other) = (serde_json::to_value(self).ok()?, serde_json::to_value(asked).ok()?);
        let (one, other) = (one.as_object()?, other.as_object()?);
        let told = |key: &str| {
            let (there, here) = (one.get(key)?, other.get(key)?);
            (there != here).then(|| match key {
                "scenario" => "the scenario's text is another one".to_owned(),
                "walls" => "the walls of its map are other ones".to_owned(),
                "design" => {
                    let (there, here) = (self.design.says(), asked.design.says());
                    if there == here {
                        "what is varied is another design".to_owned()
                    } else {
                        format!("{there} there, {here} asked for")
                    }
                }
                _ => format!("{key} = {there} there, {here} asked for"),
            })
        };
        ["version", "name", "set", "design", "replicates", "seed", "scenario", "walls", "runs", "chunk_rows"]
            .into_iter()
            .find_map(told)
    }
}
