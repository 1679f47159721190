//! `uchain inspect`: read, sum up, say.

mod explore;

use std::{fmt::Write as _, io::Read};

use serde::Serialize;
use uchain_sim::{
    clock::total_ticks,
    mission::chain::{Moment, Summary, Timeline},
    record::mcap::{AnyRecording, End, Recording},
};

use super::{Inspect, open};
use crate::{exit::Failure, monitor::Monitor, output::INSPECT, report::Report};

/// Moments in JSON, at most twice as many.
const MOMENTS: usize = 500;
/// Rows of the table, at most twice as many.
const ROWS: usize = 12;

/// `inspect.json`, and what `--json` prints.
#[derive(Serialize)]
struct Inspected<'a> {
    #[serde(flatten)]
    report: Report<'a, Summary>,
    /// Ticks that were recorded, and those of a whole run.
    ticks: u64,
    of_ticks: u64,
    /// Whether the file ends as a recording does.
    whole: bool,
    moments: &'a [Moment],
}

pub(crate) fn inspect(asked: &Inspect) -> Result<(), Failure> {
    match open(&asked.file)? {
        AnyRecording::Chain(recording) => chain(asked, *recording),
        AnyRecording::Explore(recording) => explore::inspect(asked, *recording),
    }
}

fn chain(asked: &Inspect, mut recording: Recording<impl Read>) -> Result<(), Failure> {
    let folder = asked.folder()?;
    let course = recording.course();
    let course = course.map_err(|cause| Failure::refused(&asked.file, &recording.about, cause))?;
    let of_ticks = total_ticks(course.scenario.duration_s);
    let lost_s = course.scenario.link.lost_s;
    let mut monitor = Monitor::new(course.spawns.len(), of_ticks, false);
    let mut timeline = Timeline::new(MOMENTS, lost_s);
    let summary = recording.summary(&course, &mut (&mut monitor, &mut timeline));
    let summary = summary.map_err(|cause| Failure::played(&asked.file, &recording.about, cause))?;
    let ticks = recording.frames.tick();

    let moments = timeline.into_moments();
    let whole = recording.frames.end() == Some(End::Whole);
    let version = &recording.about.version;
    let report = || Report::new(&summary, None, version);
    let inspected = Inspected { report: report(), ticks, of_ticks, whole, moments: &moments };
    let json = serde_json::to_string_pretty(&inspected)? + "\n";
    let mut files = asked.file.display().to_string();
    if let Some(folder) = folder {
        let picture = uchain_sim::mission::chain::run_png(&course, &monitor.into_history(), &summary)?;
        folder.write(&INSPECT, json.as_bytes(), &picture, &[])?;
        files = folder.says(&INSPECT);
    }
    asked.say.result(&json, || {
        format!("flown by uchain {version}{}\n{}{}", cut(whole), report().text(&files), table(&moments))
    })
}

fn cut(whole: bool) -> &'static str {
    if whole { "" } else { "; the file is cut short, and read up to its last whole chunk" }
}

fn table(moments: &[Moment]) -> String {
    let mut text =
        "\n  time (s)  UAVs  reach (m)  worst link (dB)  spread (dB)  wall, UAV contacts\n".to_owned();
    let number =
        |value: Option<f32>| value.map_or_else(|| "-".to_owned(), |value_db| format!("{value_db:.1}"));
    for moment in thinned(moments) {
        // Writing to a String cannot fail.
        let _ = writeln!(
            text,
            "  {:8.1}  {:4}  {:9.2}  {:>15}  {:>11}  {:>13}, {}{}",
            moment.time_s,
            moment.uavs,
            moment.head_reach_m,
            number(moment.worst_link_db),
            number(moment.spread_db),
            moment.wall_contacts,
            moment.uav_contacts,
            if moment.connected == Some(false) && moment.worst_link_db.is_some() {
                "  not connected"
            } else {
                ""
            },
        );
    }
    text
}

/// Evenly spaced, the last one included.
fn thinned<M>(moments: &[M]) -> Vec<&M> {
    let step = moments.len().div_ceil(ROWS).max(1);
    let mut rows: Vec<&M> = moments.iter().rev().step_by(step).collect();
    rows.reverse();
    rows
}
