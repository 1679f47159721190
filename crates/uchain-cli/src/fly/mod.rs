//! `uchain run`: read, fly and record, write, say.

mod args;
mod explore;

use uchain_sim::{
    clock::total_ticks,
    config::Source,
    mission::{
        Mission,
        chain::{Course, Summary},
    },
    record::Recorder,
    run::{RunError, run},
};

pub(crate) use args::Run;
use explore::explore;

use crate::{
    exit::Failure,
    flags::Say,
    monitor::{Monitor, interrupted, listen_for_interrupt},
    output::{Folder, Names, RUN},
    recording::{self, FileRecorder},
    report::Report,
};

pub(crate) fn fly(asked: &Run) -> Result<(), Failure> {
    let source = Source::find(&asked.scenario)?;
    let mission = Mission::read(&source, &asked.sets.set)?;
    let flight = Flight {
        seed: asked.seed,
        folder: asked.folder()?,
        is_recorded: asked.recording.wanted(),
        say: &asked.say,
    };
    flight.fly(&mission).map(drop)
}

/// One run whose results are kept.
pub(crate) struct Flight<'a> {
    pub(crate) seed: u64,
    pub(crate) folder: Folder,
    /// Whether a chain is recorded.
    pub(crate) is_recorded: bool,
    pub(crate) say: &'a Say,
}

impl Flight<'_> {
    /// Flies, writes and says; gives the digest.
    pub(crate) fn fly(&self, mission: &Mission) -> Result<String, Failure> {
        match mission {
            Mission::Chain(course) => chain(self, course),
            Mission::Explore(site) => explore(self, site),
        }
    }
}

fn chain(flight: &Flight<'_>, course: &Course) -> Result<String, Failure> {
    let Flight { seed, folder, is_recorded, say } = flight;
    course.notes().iter().for_each(|words| say.note(words));
    listen_for_interrupt();
    let ticks = total_ticks(course.scenario.duration_s);
    let mut monitor = Monitor::new(course.spawns.len(), ticks, say.progress());
    let names = Names { recording: RUN.recording.filter(|_| *is_recorded), ..RUN };
    let recorder = names.recording.map(|name| FileRecorder::of_chain(folder, name, course, *seed));
    let mut recorder = recorder.transpose()?;
    let flown = timed(course, *seed, &mut (&mut monitor, &mut recorder));
    let (summary, wall_s) = recording::end(flown, recorder)?;
    let picture = uchain_sim::mission::chain::run_png(course, &monitor.into_history(), &summary)?;
    let report = Report::new(&summary, Some(wall_s), env!("CARGO_PKG_VERSION"));
    let json = report.json()?;
    if interrupted() {
        return Err(Failure::Interrupted);
    }
    folder.write(&names, json.as_bytes(), &picture, &[])?;
    say.result(&json, || report.text(&folder.says(&names)))?;
    Ok(summary.digest)
}

/// Flies, and says how long that took (s).
#[expect(clippy::disallowed_methods, reason = "wall_s is the one number that is about this computer")]
fn timed(
    course: &Course,
    seed: u64,
    recorder: &mut impl Recorder<uchain_sim::mission::chain::Frame>,
) -> Result<(Summary, f64), RunError> {
    let start = std::time::Instant::now();
    let summary = run(course, seed, recorder)?;
    Ok((summary, start.elapsed().as_secs_f64()))
}
