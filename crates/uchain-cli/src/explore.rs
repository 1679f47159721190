//! `uchain run` for an exploration: explore, draw, write, say.

use std::fmt::Write as _;

use serde::Serialize;
use uchain_sim::{
    analyse::explore::{ExploreHistory, ExploreSummary, RosMap, Survey},
    config::Site,
    draw,
    record::{ExploreFrame, RecordError, Recorder},
    run::{RunError, explore as run},
};

use crate::{
    args::Run,
    exit::Failure,
    output::EXPLORE,
    watch::{interrupted, listen_for_interrupt},
};

/// `summary.json`, and what `--json` prints.
#[derive(Debug, Serialize)]
struct Report<'a> {
    #[serde(flatten)]
    summary: &'a ExploreSummary,
    /// How long the computer explored (s); the only number here that differs from run to run.
    wall_s: f64,
    /// Version of uchain.
    version: &'static str,
}

pub(crate) fn explore(asked: &Run, site: &Site) -> Result<(), Failure> {
    let folder = asked.folder(&site.scenario.name)?;
    listen_for_interrupt();
    let mut history = ExploreHistory::default();
    let ((summary, survey), wall_s) = timed(site, asked.seed, &mut (&mut history, Watch))?;
    let picture = draw::explore_png(site, &history, &survey, &summary)?;
    let map = RosMap::explored(&site.map, site.ground(), &history.nodes, site.scenario.params.r_s_m);
    let report = Report { summary: &summary, wall_s, version: env!("CARGO_PKG_VERSION") };
    let json = serde_json::to_string_pretty(&report)? + "\n";
    if interrupted() {
        return Err(Failure::Interrupted);
    }
    folder.write(&EXPLORE, json.as_bytes(), &picture, &[&map.pgm, map.yaml.as_bytes()])?;
    asked.say.result(&json, || text(&summary, wall_s, &folder.says(&EXPLORE)))
}

/// Explores, and says how long that took (s).
#[expect(clippy::disallowed_methods, reason = "wall_s is the one number that is about this computer")]
fn timed(
    site: &Site,
    seed: u64,
    recorder: &mut impl Recorder<ExploreFrame>,
) -> Result<((ExploreSummary, Survey), f64), RunError> {
    let start = std::time::Instant::now();
    let explored = run(site, seed, recorder)?;
    Ok((explored, start.elapsed().as_secs_f64()))
}

/// Looks for Ctrl-C.
struct Watch;

impl Recorder<ExploreFrame> for Watch {
    fn frame(&mut self, frame: &ExploreFrame) -> Result<(), RecordError> {
        if interrupted() { Err(RecordError::Interrupted { time_s: frame.time_s() }) } else { Ok(()) }
    }
}

/// A few aligned lines.
fn text(summary: &ExploreSummary, wall_s: f64, files: &str) -> String {
    let mut text = format!(
        "{}, seed {}: {:.1} s simulated in {wall_s:.2} s\n",
        summary.scenario, summary.seed, summary.sim_s
    );
    let mut line = |name: &str, value: &str| {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "  {name:<10} {value}");
    };
    let list = |numbers: &mut dyn Iterator<Item = String>| numbers.collect::<Vec<_>>().join(", ");
    let metres = |m: &[f64]| list(&mut m.iter().map(|m| format!("{m:.1}")));
    let counts = |n: &[u32]| list(&mut n.iter().map(u32::to_string));
    line("outcome", &summary.outcome);
    line(
        "iterations",
        &format!(
            "{} rounds; moves {}; holds {}",
            summary.iterations,
            counts(&summary.moves),
            counts(&summary.holds)
        ),
    );
    let balance = format!("shortest {:.0} % of longest", 100.0 * summary.balance);
    line("distance", &format!("{} m over ground, {balance}", metres(&summary.distance_m)));
    line("", &format!("{} m with climbs", metres(&summary.distance_3d_m)));
    line("levels", &format!("{:.1} s on other levels", summary.mfl_s));
    let [t50, t90, t100] = [summary.coverage_t50_s, summary.coverage_t90_s, summary.coverage_t100_s];
    line(
        "seen",
        &format!(
            "{:.2} %; half of it by {t50:.0} s, 90 % by {t90:.0} s, all by {t100:.0} s",
            100.0 * summary.coverage
        ),
    );
    line("overlap", &format!("{:.1} % seen by more than one robot", 100.0 * summary.overlap));
    for piece in summary.unseen.iter().take(UNSEEN_SHOWN) {
        line("unseen", &format!("{:.3} m2 around ({:.2}, {:.2}) m", piece.area_m2, piece.x_m, piece.y_m));
    }
    if summary.unseen.len() > UNSEEN_SHOWN {
        line("", &format!("… {:.3} m2 in all", summary.unseen_m2));
    }
    line(
        "map",
        &format!(
            "{} nodes, {} edges, {} with a frontier left",
            counts(&summary.nodes),
            summary.edges,
            summary.hubs_left
        ),
    );
    line(
        "contacts",
        &format!(
            "{} wall, {} robot; {} near passes between levels",
            summary.wall_contacts, summary.robot_contacts, summary.level_passes
        ),
    );
    line("digest", &summary.digest);
    line("files", files);
    text
}

/// Most unseen pieces listed to people.
const UNSEEN_SHOWN: usize = 5;
