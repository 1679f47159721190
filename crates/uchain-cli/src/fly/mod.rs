//! `uchain run`: read, fly and record, draw, write, say.

mod args;

use std::{io::BufWriter, path::PathBuf};

use uchain_sim::{
    config::Source,
    record::RecordError,
    registry::{AnyScene, Registry},
};

use crate::{
    exit::{Failure, OURS},
    flags::Say,
    monitor::{Progress, interrupted, listen_for_interrupt},
    output::{Folder, Names, RUN, inputs},
};

pub(crate) use args::Run;

pub(crate) fn fly(registry: Registry, asked: &Run) -> Result<(), Failure> {
    let source = Source::find(&asked.scenario)?;
    let scene = registry.read(&source, &asked.sets.set)?;
    let flight = KeptFlight {
        seed: asked.seed,
        folder: asked.folder()?.spares(&inputs(&asked.scenario))?,
        is_recorded: asked.recording.wanted(),
        say: &asked.say,
    };
    flight.fly(&*scene).map(drop)
}

/// One run whose results are kept.
pub(crate) struct KeptFlight<'a> {
    pub(crate) seed: u64,
    pub(crate) folder: Folder,
    /// Whether it leaves a recording.
    pub(crate) is_recorded: bool,
    pub(crate) say: &'a Say,
}

impl KeptFlight<'_> {
    /// Flies, writes and says; gives the digest.
    pub(crate) fn fly(&self, scene: &dyn AnyScene) -> Result<String, Failure> {
        let Self { seed, folder, is_recorded, say } = self;
        scene.notes().iter().for_each(|words| say.note(words));
        listen_for_interrupt();
        let names = Names { recording: RUN.recording.filter(|_| *is_recorded), others: scene.files(), ..RUN };
        let (mut flight, recording) = match names.recording {
            // It has its name from the first tick on, and every whole chunk is in the file at once: a run that is killed
            // leaves a recording of all but its last moments.
            Some(name) => folder
                .begin(name, |file| scene.prepare(*seed, Some(Box::new(BufWriter::new(file)))))
                .map(|(flight, file)| (flight, Some(file)))?,
            None => (scene.prepare(*seed, None)?, None),
        };
        let mut progress = Progress::new(scene, say.progress());
        let (flown, wall_s) = timed(|| flight.fly(&mut progress));
        progress.clear();
        ended(flown, flight.end_recording(), recording)?;
        let picture = flight.picture()?;
        let others = flight.files()?;
        let json = flight.json(wall_s, OURS)?;
        if interrupted() {
            return Err(Failure::Interrupted);
        }
        let others: Vec<&[u8]> = others.iter().map(Vec::as_slice).collect();
        folder.write(&names, json.as_bytes(), &picture, &others)?;
        say.result(&json, || flight.text(wall_s, &folder.says(&names)))?;
        Ok(flight.digest().to_owned())
    }
}

/// How a run and its recording, if there is one, have ended.
fn ended(
    flown: Result<(), RecordError>,
    recorded: Result<bool, RecordError>,
    recording: Option<PathBuf>,
) -> Result<(), Failure> {
    match (flown, recorded, recording) {
        (flown, _, None) => Ok(flown?),
        (Ok(()), Ok(_), Some(_)) => Ok(()),
        (Ok(()), Err(cause), Some(file)) => Err(Failure::WriteRecording { file, cause }),
        // Without its index the file is readable as well, and a disk that was full still is.
        (Err(error), _, Some(recording)) => Err(Failure::Cut { error, recording }),
    }
}

/// Works, and says how long that took (s).
#[expect(clippy::disallowed_methods, reason = "wall_s is the one number that is about this computer")]
pub(crate) fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let start = std::time::Instant::now();
    let done = work();
    (done, start.elapsed().as_secs_f64())
}
