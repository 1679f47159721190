//! `uchain run`: read, fly and record, draw, write, say.

mod explore;

use uchain_sim::{
    analyse::Summary,
    config::{Course, Mission, Source},
    draw,
    record::Recorder,
    run::{RunError, run, total_ticks},
};

use explore::explore;

use crate::{
    args::Run,
    exit::Failure,
    output::{Names, RUN},
    recording::{self, Tape},
    report::Report,
    watch::{Watch, interrupted, listen_for_interrupt},
};

pub(crate) fn fly(asked: &Run) -> Result<(), Failure> {
    let source = Source::find(&asked.scenario)?;
    match Mission::read(&source, &asked.sets.set)? {
        Mission::Chain(course) => chain(asked, &course),
        Mission::Explore(site) => explore(asked, &site),
    }
}

fn chain(asked: &Run, course: &Course) -> Result<(), Failure> {
    let folder = asked.folder(&course.scenario.name)?;
    listen_for_interrupt();
    let ticks = total_ticks(course.scenario.duration_s);
    let mut watch = Watch::new(course.spawns.len(), ticks, asked.say.progress());
    let names = Names { recording: RUN.recording.filter(|_| asked.recording.wanted()), ..RUN };
    let tape = names.recording.map(|name| Tape::of_chain(&folder, name, course, asked.seed));
    let mut tape = tape.transpose()?;
    let flown = timed(course, asked.seed, &mut (&mut watch, &mut tape));
    let (summary, wall_s) = recording::end(flown, tape)?;
    let picture = draw::run_png(course, &watch.into_history(), &summary)?;
    let report = Report::new(&summary, Some(wall_s), env!("CARGO_PKG_VERSION"));
    let json = report.json()?;
    if interrupted() {
        return Err(Failure::Interrupted);
    }
    folder.write(&names, json.as_bytes(), &picture, &[])?;
    asked.say.result(&json, || report.text(&folder.says(&names)))
}

/// Flies, and says how long that took (s).
#[expect(clippy::disallowed_methods, reason = "wall_s is the one number that is about this computer")]
fn timed(course: &Course, seed: u64, recorder: &mut impl Recorder) -> Result<(Summary, f64), RunError> {
    let start = std::time::Instant::now();
    let summary = run(course, seed, recorder)?;
    Ok((summary, start.elapsed().as_secs_f64()))
}
