//! `uchain run`: read, fly, draw, write, say.

use uchain_sim::{
    analyse::Summary,
    config::{Course, Mission, Source},
    draw,
    record::Recorder,
    run::{RunError, run, total_ticks},
};

use crate::{
    args::Run,
    exit::Failure,
    output::{Folder, RUN},
    print,
    report::Report,
    watch::{Watch, interrupted, listen_for_interrupt},
};

pub(crate) fn fly(asked: &Run) -> Result<(), Failure> {
    let source = Source::find(&asked.scenario)?;
    let course = match Mission::read(&source, &asked.set)? {
        Mission::Chain(course) => course,
        Mission::Explore(site) => return crate::explore::explore(asked, &site),
    };
    let folder = match &asked.out {
        Some(path) => Folder::chosen(path, asked.force)?,
        None => Folder::ours("runs", &format!("{}-s{}", course.scenario.name, asked.seed)),
    };

    listen_for_interrupt();
    let ticks = total_ticks(course.scenario.duration_s);
    let mut watch = Watch::new(course.spawns.len(), ticks, !(asked.quiet || asked.json));
    let (summary, wall_s) = timed(&course, asked.seed, &mut watch)?;
    let picture = draw::run_png(&course, &watch.into_history(), &summary)?;
    let report = Report::new(&summary, wall_s);
    let json = report.json()?;
    if interrupted() {
        return Err(Failure::Interrupted);
    }
    folder.write(&RUN, json.as_bytes(), &picture)?;

    if asked.json {
        print(&json)
    } else if asked.quiet {
        Ok(())
    } else {
        print(&report.text(&folder.says(&RUN)))
    }
}

/// Flies, and says how long that took (s).
#[expect(clippy::disallowed_methods, reason = "wall_s is the one number that is about this computer")]
fn timed(course: &Course, seed: u64, recorder: &mut impl Recorder) -> Result<(Summary, f64), RunError> {
    let start = std::time::Instant::now();
    let summary = run(course, seed, recorder)?;
    Ok((summary, start.elapsed().as_secs_f64()))
}
