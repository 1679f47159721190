//! `uchain inspect` of an exploration.

use std::{fmt::Write as _, io::Read};

use serde::Serialize;
use uchain_sim::{
    mission::explore::{ExploreFrame, ExploreHistory, ExploreSummary, ExploreTimeline, Progress},
    record::mcap::{End, Recording},
};

use super::{MOMENTS, cut, thinned};
use crate::{exit::Failure, output::INSPECT, recording::Inspect, report::Report};

/// `inspect.json`, and what `--json` prints.
#[derive(Serialize)]
struct Inspected<'a> {
    #[serde(flatten)]
    report: Report<'a, ExploreSummary>,
    /// Ticks that were recorded.
    ticks: u64,
    /// Whether the file ends as a recording does.
    whole: bool,
    /// How far it had come at the begin of rounds, and in the end.
    progress: &'a [Progress],
}

pub(super) fn inspect(
    asked: &Inspect,
    mut recording: Recording<impl Read, ExploreFrame>,
) -> Result<(), Failure> {
    let folder = asked.folder()?;
    let site = recording.site();
    let site = site.map_err(|cause| Failure::refused(&asked.file, &recording.about, cause))?;
    let (mut history, mut timeline) = (ExploreHistory::default(), ExploreTimeline::new(MOMENTS));
    let summary = recording.summary(&site, &mut (&mut history, &mut timeline));
    let (summary, survey) = summary.map_err(|cause| Failure::played(&asked.file, &recording.about, cause))?;
    let progress = timeline.into_rounds();
    let whole = recording.frames.end() == Some(End::Whole);
    let version = &recording.about.version;
    let report = || Report::new(&summary, None, version);
    let inspected =
        Inspected { report: report(), ticks: recording.frames.tick(), whole, progress: &progress };
    let json = serde_json::to_string_pretty(&inspected)? + "\n";
    let mut files = asked.file.display().to_string();
    if let Some(folder) = folder {
        let picture = uchain_sim::mission::explore::explore_png(&site, &history, &survey, &summary)?;
        folder.write(&INSPECT, json.as_bytes(), &picture, &[])?;
        files = folder.says(&INSPECT);
    }
    asked.say.result(&json, || {
        format!("flown by uchain {version}{}\n{}{}", cut(whole), report().text(&files), table(&progress))
    })
}

fn table(progress: &[Progress]) -> String {
    let mut text =
        "\n  time (s)  rounds  nodes  edges  with a frontier  moving  flown (m)  wall, robot contacts\n"
            .to_owned();
    for now in thinned(progress) {
        // Writing to a String cannot fail.
        let _ = writeln!(
            text,
            "  {:8.1}  {:6}  {:5}  {:5}  {:15}  {:6}  {:9.1}  {:>13}, {}",
            now.time_s,
            now.rounds,
            now.nodes,
            now.edges,
            now.hubs,
            now.moving,
            now.distance_m,
            now.wall_contacts,
            now.robot_contacts,
        );
    }
    text
}
