//! Reads a recording back: frame by frame, for the same code that watches a live run.

mod bytes;
mod error;
mod frames;
mod records;

use std::{
    fs::File,
    io::{BufReader, Read},
    path::Path,
};

pub use error::ReadError;
pub use frames::Frames;
pub use records::End;

use super::about::{self, About};
use crate::{
    analyse::Digest,
    map::Map,
    mission::{
        chain::{Course, Frame, Metrics, Summary},
        explore::{ExploreFrame, ExploreMetrics, ExploreSummary, Site, Survey},
    },
    record::{RecordError, Recorder, mcap::Recordable},
};
use records::{Item, Records};

/// A recording, read from front to back. Memory: one record of the file, mostly a chunk of 64 KiB and never more than
/// 64 MiB, and the walls.
///
/// Nothing is believed unchecked: a damaged file is refused at the damage, and the frames before it are those that
/// were written. A file that was cut short, or that ends in zeros where it was not on the disk yet when the power went, is
/// read to its last whole chunk; [`Frames::end`] tells.
#[derive(Debug)]
pub struct Recording<R, F: Recordable = Frame> {
    /// What it is of.
    pub about: About,
    /// The walls that were recorded.
    pub walls: Map,
    /// The frames that have not been read yet.
    pub frames: Frames<R, F>,
    label: String,
}

/// A recording of either kind.
#[derive(Debug)]
pub enum AnyRecording<R> {
    /// Of a chain.
    Chain(Box<Recording<R>>),
    /// Of an exploration.
    Explore(Box<Recording<R, ExploreFrame>>),
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

impl AnyRecording<BufReader<File>> {
    /// Opens a file; messages call it by its path.
    ///
    /// # Errors
    /// [`ReadError`].
    pub fn open(path: &Path) -> Result<Self, ReadError> {
        Self::read(BufReader::new(File::open(path)?), &path.display().to_string())
    }
}

impl<R: Read> AnyRecording<R> {
    /// Begins to read; `label` names the recording in messages about its scenario.
    ///
    /// # Errors
    /// [`ReadError`]: no MCAP file, not ours, or damaged where it begins.
    pub fn read(input: R, label: &str) -> Result<Self, ReadError> {
        let mut records = Records::new(input);
        let (about, walls) = beginning(&mut records)?;
        Ok(if about.is_exploration() {
            Self::Explore(Box::new(Recording::new(about, walls, records, label)))
        } else {
            Self::Chain(Box::new(Recording::new(about, walls, records, label)))
        })
    }
}

impl Recording<BufReader<File>> {
    /// Opens a recording of a chain; messages call it by its path.
    ///
    /// # Errors
    /// [`ReadError`].
    pub fn open(path: &Path) -> Result<Self, ReadError> {
        Self::read(BufReader::new(File::open(path)?), &path.display().to_string())
    }
}

impl<R: Read, F: Recordable> Recording<R, F> {
    fn new(about: About, walls: Map, records: Records<R>, label: &str) -> Self {
        Self { about, walls, frames: Frames::new(records), label: label.to_owned() }
    }
}

impl<R: Read> Recording<R> {
    /// Begins to read a recording of a chain; `label` names it in messages about its scenario.
    ///
    /// # Errors
    /// [`ReadError`]: no MCAP file, not ours, damaged where it begins, or of an exploration.
    pub fn read(input: R, label: &str) -> Result<Self, ReadError> {
        match AnyRecording::read(input, label)? {
            AnyRecording::Chain(recording) => Ok(*recording),
            AnyRecording::Explore(_) => {
                Err(ReadError::OtherKind { expected: "a chain", found: "an exploration" })
            }
        }
    }

    /// The course that was flown, in the walls that were recorded; map files are not read. Frames with another number
    /// of UAVs are refused from here on.
    ///
    /// # Errors
    /// [`ReadError::Scenario`]: a scenario that this version cannot fly.
    pub fn course(&mut self) -> Result<Course, ReadError> {
        let course = self.about.course(&self.label, self.walls.clone()).map_err(Box::new)?;
        self.frames.expect_crew(course.spawns.len());
        Ok(course)
    }

    /// Plays what is left of the run and sums it up; `course` is its own. Of a whole run that is the summary the run
    /// itself came to.
    ///
    /// # Errors
    /// [`PlayError`].
    pub fn summary(
        &mut self,
        course: &Course,
        recorder: &mut impl Recorder<Frame>,
    ) -> Result<Summary, PlayError> {
        let (mut metrics, mut digest) = (Metrics::new(course), Digest::default());
        self.frames.play(&mut ((&mut metrics, &mut digest), recorder))?;
        Ok(metrics.summary(self.about.seed, digest.hex()))
    }
}

impl<R: Read> Recording<R, ExploreFrame> {
    /// Begins to read a recording of an exploration; `label` names it in messages about its scenario.
    ///
    /// # Errors
    /// [`ReadError`]: no MCAP file, not ours, damaged where it begins, or of a chain.
    pub fn read_exploration(input: R, label: &str) -> Result<Self, ReadError> {
        match AnyRecording::read(input, label)? {
            AnyRecording::Explore(recording) => Ok(*recording),
            AnyRecording::Chain(_) => {
                Err(ReadError::OtherKind { expected: "an exploration", found: "a chain" })
            }
        }
    }

    /// The site that was explored, in the walls that were recorded; map files are not read. Frames with another number
    /// of robots are refused from here on.
    ///
    /// # Errors
    /// [`ReadError::Scenario`]: a scenario that this version cannot fly.
    pub fn site(&mut self) -> Result<Site, ReadError> {
        let site = self.about.site(&self.label, self.walls.clone()).map_err(Box::new)?;
        self.frames.expect_crew(site.spawns.len());
        Ok(site)
    }

    /// Plays what is left of the exploration and sums it up; `site` is its own. Of a whole one that is the summary the
    /// run itself came to.
    ///
    /// # Errors
    /// [`PlayError`].
    pub fn summary(
        &mut self,
        site: &Site,
        recorder: &mut impl Recorder<ExploreFrame>,
    ) -> Result<(ExploreSummary, Survey), PlayError> {
        let (mut metrics, mut digest) = (ExploreMetrics::new(site), Digest::default());
        self.frames.play(&mut ((&mut metrics, &mut digest), recorder))?;
        Ok(metrics.finish(self.about.seed, digest.hex()))
    }
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
