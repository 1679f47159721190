//! Reads a recording back: frame by frame, for the same code that watches a live run.

mod bytes;
mod error;
mod frames;
mod records;

use std::{
    fs::File,
    io::{BufReader, Read},
    path::{Path, PathBuf},
};

pub use error::ReadError;
pub use frames::Frames;
pub use records::End;

use super::{
    Recordable,
    about::{self, About},
};
use crate::{
    config::Source,
    map::Map,
    record::{RecordError, Recorder},
};
use records::{Item, Records};

/// A recording of which the beginning has been read: what it is of. Its frames come with [`Opened::frames`].
pub struct Opened<R> {
    /// What it is of.
    pub about: About,
    /// The walls that were recorded.
    pub walls: Map,
    records: Records<R>,
    label: String,
}

impl<R> std::fmt::Debug for Opened<R> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Opened").field("about", &self.about).finish_non_exhaustive()
    }
}

impl Opened<BufReader<File>> {
    /// Opens a file; messages call it by its path.
    ///
    /// # Errors
    /// [`ReadError`]: no MCAP file, not ours, or damaged where it begins.
    pub fn open(path: &Path) -> Result<Self, ReadError> {
        Self::read(BufReader::new(File::open(path)?), &path.display().to_string())
    }
}

impl<R: Read> Opened<R> {
    /// Begins to read; `label` names the recording in messages about its scenario.
    ///
    /// # Errors
    /// [`ReadError`]: no MCAP file, not ours, or damaged where it begins.
    pub fn read(input: R, label: &str) -> Result<Self, ReadError> {
        let mut records = Records::new(input);
        let (about, walls) = beginning(&mut records)?;
        Ok(Self { about, walls, records, label: label.to_owned() })
    }

    /// The scenario that was flown, as a text; map files that it names are not read again.
    pub fn source(&self) -> Source {
        let label = format!("{}, scenario", self.label);
        Source { label, text: self.about.scenario.clone(), folder: PathBuf::new() }
    }

    /// The walls that were recorded, where the scenario has them.
    pub fn map(&self) -> Map {
        self.walls.clone().with_offset_m(self.about.map_offset_m)
    }

    /// The frames, in order.
    pub fn frames<F: Recordable>(self) -> Frames<R, F> {
        Frames::new(self.records)
    }
}

/// Why a recording was not played to its end.
#[derive(Debug, thiserror::Error)]
pub enum PlayError {
    /// The file.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// Whoever was shown the frames.
    #[error(transparent)]
    Record(#[from] RecordError),
}

impl<R: Read, F: Recordable> Frames<R, F> {
    /// Shows a recorder what is left of the run, as the run itself did.
    ///
    /// # Errors
    /// [`PlayError`].
    pub fn play(&mut self, recorder: &mut impl Recorder<F>) -> Result<(), PlayError> {
        let mut frame = F::default();
        while self.read(&mut frame)? {
            recorder.frame(&frame)?;
        }
        Ok(())
    }
}

/// What stands before the first chunk.
fn beginning<R: Read>(records: &mut Records<R>) -> Result<(About, Map), ReadError> {
    let not_ours = |why: String| ReadError::NotOurs { why };
    let mut about = None;
    loop {
        let next = match records.next()? {
            Item::Metadata { name: about::METADATA, entries } => {
                let by = entries.get("version").filter(|version| *version != about::OURS).cloned();
                match About::from_entries(entries) {
                    Ok(found) => about = Some(found),
                    Err(why) => {
                        let by = by.map(|by| format!("recorded by uchain {by:.40}, "));
                        let by = by.unwrap_or_default();
                        let error = not_ours(format!("{by}the metadata record {:?}: {why}", about::METADATA));
                        records.unless_cut(error)?;
                    }
                }
                records.are_ours();
                continue;
            }
            Item::Attachment { name: about::WALLS, data } => match about.take() {
                Some(about) => Some((about, about::walls_from_csv(data))),
                None => return Err(not_ours(format!("no metadata record {:?}", about::METADATA))),
            },
            Item::End(End::Whole) => {
                return Err(not_ours(format!("it has no metadata record {:?}", about::METADATA)));
            }
            Item::End(End::CutShort) => return Err(ReadError::Empty { bytes: records.length() }),
            _ => None,
        };
        return match next {
            Some((found, Ok(map))) => Ok((found, map)),
            Some((_, Err(why))) => Err(not_ours(format!("the attachment {:?}: {why}", about::WALLS))),
            None => {
                let missing = if about.is_none() { about::METADATA } else { about::WALLS };
                records.unless_cut(not_ours(format!("it does not begin with the record {missing:?}")))?;
                continue;
            }
        };
    }
}
