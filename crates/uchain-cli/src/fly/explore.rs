//! `uchain run` for an exploration: explore, write, say.

use indicatif::{ProgressBar, ProgressDrawTarget};
use uchain_sim::{
    mission::explore::{ExploreFrame, ExploreHistory, ExploreSummary, RosMap, Site, Survey},
    record::{RecordError, Recorder},
    run::{RunError, explore as run},
};

use super::Flight;
use crate::{
    exit::Failure,
    monitor::{interrupted, listen_for_interrupt},
    output::{EXPLORE, Names},
    recording::{self, FileRecorder},
    report::Report,
};

pub(crate) fn explore(flight: &Flight<'_>, site: &Site) -> Result<String, Failure> {
    let Flight { seed, folder, is_recorded, say } = flight;
    site.notes().iter().for_each(|words| say.note(words));
    listen_for_interrupt();
    let names = Names { recording: EXPLORE.recording.filter(|_| *is_recorded), ..EXPLORE };
    let recorder = names.recording.map(|name| FileRecorder::of_exploration(folder, name, site, *seed));
    let mut recorder = recorder.transpose()?;
    let mut history = ExploreHistory::default();
    let mut monitor = Monitor::new(site, say.progress());
    let flown = timed(site, *seed, &mut ((&mut history, &mut monitor), &mut recorder));
    monitor.end();
    let ((summary, survey), wall_s) = recording::end(flown, recorder)?;
    let picture = uchain_sim::mission::explore::explore_png(site, &history, &survey, &summary)?;
    let states = uchain_sim::mission::explore::states_png(site, &history, &summary)?;
    let map = RosMap::explored(&site.map, site.ground(), &history.nodes, site.scenario.params.r_s_m);
    let report = Report::new(&summary, Some(wall_s), env!("CARGO_PKG_VERSION"));
    let json = report.json()?;
    if interrupted() {
        return Err(Failure::Interrupted);
    }
    folder.write(&names, json.as_bytes(), &picture, &[&map.pgm, map.yaml.as_bytes(), &states])?;
    say.result(&json, || report.text(&folder.says(&names)))?;
    Ok(summary.digest)
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

/// Looks for Ctrl-C, and shows how much is known.
struct Monitor {
    bar: ProgressBar,
    nodes: usize,
}

impl Monitor {
    fn new(site: &Site, show_progress: bool) -> Self {
        let target = if show_progress { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
        // Nobody knows how long it takes.
        let bar = ProgressBar::with_draw_target(None, target);
        bar.set_message(format!("{} explores", site.scenario.name));
        Self { bar, nodes: 0 }
    }

    fn end(self) {
        self.bar.finish_and_clear();
    }
}

impl Recorder<ExploreFrame> for Monitor {
    fn frame(&mut self, frame: &ExploreFrame) -> Result<(), RecordError> {
        if interrupted() {
            self.bar.finish_and_clear();
            return Err(RecordError::Interrupted { time_s: frame.time_s() });
        }
        if frame.decision && !self.bar.is_hidden() {
            self.nodes += frame.nodes.len();
            let (time_s, rounds, nodes, hubs) = (frame.time_s(), frame.rounds, self.nodes, frame.hubs);
            let frontiers = format!("{nodes} nodes, {hubs} with a frontier");
            self.bar.set_message(format!("{time_s:.0} s, round {rounds}: {frontiers}"));
            self.bar.tick();
        }
        Ok(())
    }
}
