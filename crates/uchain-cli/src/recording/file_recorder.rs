//! Records a mission to a file while it flies (MCAP), crash-safe.

use std::{fs::File, io::BufWriter, path::PathBuf};

use uchain_sim::{
    mission::{
        chain::{Course, McapRecorder},
        explore::{ExploreRecorder, Site},
    },
    record::{RecordError, Recorder},
    run::RunError,
};

use crate::{exit::Failure, output::Folder};

/// `run.mcap` under way. It has its name from the first tick on, and every whole chunk is in the file at once: a run
/// that is killed leaves a recording of all but its last moments.
pub(crate) struct FileRecorder<T> {
    recorder: T,
    file: PathBuf,
}

type Out = BufWriter<File>;

impl FileRecorder<McapRecorder<Out>> {
    pub(crate) fn of_chain(folder: &Folder, name: &str, course: &Course, seed: u64) -> Result<Self, Failure> {
        let start = |file| McapRecorder::start(Out::new(file), course, seed);
        folder.begin(name, start).map(|(recorder, file)| Self { recorder, file })
    }
}

impl FileRecorder<ExploreRecorder<Out>> {
    pub(crate) fn of_exploration(
        folder: &Folder,
        name: &str,
        site: &Site,
        seed: u64,
    ) -> Result<Self, Failure> {
        let start = |file| ExploreRecorder::start(Out::new(file), site, seed);
        folder.begin(name, start).map(|(recorder, file)| Self { recorder, file })
    }
}

/// A recording that has an end.
pub(crate) trait Finish {
    fn finish(self) -> Result<(), RecordError>;
}

impl Finish for McapRecorder<Out> {
    fn finish(self) -> Result<(), RecordError> {
        self.finish().map(drop)
    }
}

impl Finish for ExploreRecorder<Out> {
    fn finish(self) -> Result<(), RecordError> {
        self.finish().map(drop)
    }
}

/// Ends a recording, if there is one, as its run has ended.
pub(crate) fn end<T, R: Finish>(
    flown: Result<T, RunError>,
    recorder: Option<FileRecorder<R>>,
) -> Result<T, Failure> {
    let Some(FileRecorder { recorder, file }) = recorder else { return Ok(flown?) };
    match (flown, recorder.finish()) {
        (Ok(flown), Ok(())) => Ok(flown),
        (Ok(_), Err(cause)) => Err(Failure::WriteRecording { file, cause }),
        // Without its index the file is readable as well, and a disk that was full still is.
        (Err(error), _) => Err(Failure::Cut { error, recording: file }),
    }
}

impl<F, R: Recorder<F>> Recorder<F> for FileRecorder<R> {
    fn frame(&mut self, frame: &F) -> Result<(), RecordError> {
        self.recorder.frame(frame)
    }
}
