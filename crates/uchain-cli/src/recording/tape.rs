//! The recording of a flight, while it flies.

use std::{fs::File, io::BufWriter, path::PathBuf};

use uchain_sim::{
    config::Course,
    record::{Frame, RecordError, Recorder, mcap::McapRecorder},
    run::RunError,
};

use crate::{exit::Failure, output::Folder};

/// `run.mcap` under way. It has its name from the first tick on, and every whole chunk is in the file at once: a run
/// that is killed leaves a recording of all but its last moments.
pub(crate) struct Tape {
    recorder: McapRecorder<BufWriter<File>>,
    file: PathBuf,
}

impl Tape {
    pub(crate) fn begin(folder: &Folder, name: &str, course: &Course, seed: u64) -> Result<Self, Failure> {
        let start = |file| McapRecorder::start(BufWriter::new(file), course, seed);
        let (recorder, file) = folder.begin(name, start)?;
        Ok(Self { recorder, file })
    }

    /// The run is over.
    pub(crate) fn end(self) -> Result<(), Failure> {
        let Self { recorder, file } = self;
        recorder.finish().map(drop).map_err(|cause| Failure::Tape { file, cause })
    }

    /// The run ended before its time.
    pub(crate) fn cut(self, error: RunError) -> Failure {
        let Self { recorder, file } = self;
        // Without its index the file is readable as well, and a disk that was full still is.
        let _ = recorder.finish();
        Failure::Cut { error, recording: file }
    }
}

impl Recorder for Tape {
    fn frame(&mut self, frame: &Frame) -> Result<(), RecordError> {
        self.recorder.frame(frame)
    }
}
