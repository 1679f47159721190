//! What people see of a ring.

use std::sync::Arc;

use serde::Serialize;
use uchain_sim::{
    analyse::{Cell, Field, Kind, Thinned},
    clock::time_s,
    draw::{
        DrawError,
        figure::{Axes, Figure, Mark, Stroke, figure},
    },
    mission::{History, Shown, Timeline, thinned},
    record::{RecordError, Recorder},
};

use super::{Ring, RingFrame, RingScene, RingSummary, metrics::RingMetrics};

/// Places of a robot in a picture.
const PLACES: usize = 500;

const COLUMNS: [Field<RingSummary>; 7] = [
    ("sim_s", Kind::Number, |s| s.sim_s.into()),
    ("distance_m", Kind::Numbers, |s| Cell::list(s.distance_m.iter().copied())),
    ("rounds", Kind::Number, |s| s.rounds.into()),
    ("contacts", Kind::Count, |s| s.contacts.into()),
    ("outcome", Kind::Text, |s| s.verdict.outcome().word().into()),
    ("verdict", Kind::Text, |s| s.verdict.to_string().as_str().into()),
    ("digest", Kind::Text, |s| s.digest.as_str().into()),
];

impl Shown for Ring {
    type History = RingHistory;
    type Timeline = RingTimeline;
    const RUNS_TO_THE_END: bool = true;

    fn text(summary: &RingSummary, wall_s: Option<f64>, files: &str) -> String {
        let wall = wall_s.map(|wall_s| format!(" in {wall_s:.2} s")).unwrap_or_default();
        format!(
            "{}, seed {}: {:.1} s simulated{wall}\n  outcome  {}\n  digest   {}\n  files    {files}\n",
            summary.scenario,
            summary.seed,
            summary.sim_s,
            summary.verdict.words(),
            summary.digest
        )
    }

    fn columns() -> &'static [Field<RingSummary>] {
        &COLUMNS
    }

    fn picture(
        _: &Arc<RingScene>,
        history: &mut RingHistory,
        _: &RingMetrics,
        summary: &RingSummary,
    ) -> Result<Vec<u8>, DrawError> {
        let marks = history.0.iter().enumerate().map(|(i, places)| Mark::Line {
            name: format!("robot {i}"),
            colour: i,
            stroke: Stroke::Solid,
            points: places.clone().into_all(),
        });
        let axes = Axes {
            x: "x (m)".to_owned(),
            y: "y (m)".to_owned(),
            height: 534.0,
            marks: marks.collect(),
            ..Axes::default()
        };
        let title = format!("{}, seed {}: {}", summary.scenario, summary.seed, summary.verdict.words());
        figure(&Figure { title, axes: vec![axes] }).map(|picture| picture.png)
    }
}

/// Where every robot was.
pub(crate) struct RingHistory(Vec<Thinned<(f64, f64)>>);

impl Recorder<RingFrame> for RingHistory {
    fn frame(&mut self, frame: &RingFrame) -> Result<(), RecordError> {
        for (places, robot) in self.0.iter_mut().zip(&frame.robots) {
            places.push((robot.x_m.into(), robot.y_m.into()));
        }
        Ok(())
    }
}

impl History for RingHistory {
    type Mission = Ring;

    fn of(scene: &RingScene) -> Self {
        Self(vec![Thinned::new(PLACES); scene.ring.robots.into()])
    }

    fn progress(&self, frame: &RingFrame) -> String {
        format!("{:.0} s", time_s(frame.tick))
    }
}

/// Contacts over time.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub(crate) struct Moment {
    time_s: f64,
    contacts: u32,
}

/// Moments of a ring.
#[derive(Debug, Serialize)]
pub(crate) struct Moments {
    moments: Vec<Moment>,
}

/// Keeps moments of a ring.
pub(crate) struct RingTimeline(Thinned<Moment>);

impl Recorder<RingFrame> for RingTimeline {
    fn frame(&mut self, frame: &RingFrame) -> Result<(), RecordError> {
        let contacts = frame.robots.iter().map(|robot| robot.contacts).sum();
        self.0.push(Moment { time_s: time_s(frame.tick), contacts });
        Ok(())
    }
}

impl Timeline for RingTimeline {
    type Mission = Ring;
    type Kept = Moments;

    fn of(_: &RingScene, wanted: usize) -> Self {
        Self(Thinned::new(wanted))
    }

    fn kept(self) -> Moments {
        Moments { moments: self.0.into_all() }
    }

    fn table(kept: &Moments, rows: usize) -> String {
        let row = |moment: &Moment| format!("  {:8.1}  {:8}\n", moment.time_s, moment.contacts);
        thinned(&kept.moments, rows).into_iter().map(row).collect()
    }
}
