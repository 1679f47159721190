//! The numbers of an exploration over time and its graph, for programs.

use std::{collections::BTreeMap, sync::Arc};

use uchain_core::explore::{NodeId, Purpose};

use super::{
    Exploration, ExploreFrame, ExploreHistory, ExploreMetrics, NodeFrame, Odometer, Progress, RobotFrame,
    Site, events::Events,
};
use crate::{
    clock::total_ticks,
    mission::{Graph, Keep, Log, Logbook},
    record::{
        RecordError, Recorder,
        table::{Column, Read, Rows, Series, Table, Values},
    },
};

/// Why a robot flies, in the order of [`Purpose`].
const PURPOSES: &[&str] = &["explore", "backtrack", "home", "park", "wait"];

/// A row per frame.
const FRAMES: &[Series<ExploreFrame>] = &[
    ("time_s", Read::Number(ExploreFrame::time_s)),
    ("decision", Read::Flag(|frame| frame.decision)),
    ("round", Read::Count(|frame| frame.rounds)),
    ("x_m", Read::Singles(|frame, to| singles(frame, to, |robot| robot.x_m))),
    ("y_m", Read::Singles(|frame, to| singles(frame, to, |robot| robot.y_m))),
    ("z_m", Read::Singles(|frame, to| singles(frame, to, |robot| robot.z_m))),
    ("heading_rad", Read::Singles(|frame, to| singles(frame, to, |robot| robot.heading_rad))),
    ("level", Read::Counts(|frame, to| counts(frame, to, |robot| robot.level.into()))),
    (
        "purpose",
        Read::Words(PURPOSES, |frame, to| to.extend(frame.robots.iter().map(|robot| purpose(robot.purpose)))),
    ),
    ("moves", Read::Flags(|frame, to| flags(frame, to, |robot| robot.moves))),
    ("holds", Read::Flags(|frame, to| flags(frame, to, |robot| robot.holds))),
    ("mfl", Read::Flags(|frame, to| flags(frame, to, |robot| robot.mfl))),
    ("wall_contacts", Read::Counts(|frame, to| counts(frame, to, |robot| robot.wall_contacts))),
    ("robot_contacts", Read::Counts(|frame, to| counts(frame, to, |robot| robot.robot_contacts))),
    ("level_passes", Read::Counts(|frame, to| counts(frame, to, |robot| robot.level_passes))),
];

/// How far it has come when robots decide.
struct Round {
    decided_s: f64,
    progress: Progress,
}

/// A row per round, and one for the end.
const ROUNDS: &[Series<Round>] = &[
    ("time_s", Read::Number(|round| round.progress.time_s)),
    ("decided_s", Read::Number(|round| round.decided_s)),
    ("round", Read::Count(|round| round.progress.rounds)),
    ("nodes", Read::Count(|round| round.progress.nodes)),
    ("edges", Read::Count(|round| round.progress.edges)),
    ("hubs", Read::Count(|round| round.progress.hubs)),
    ("moving", Read::Count(|round| round.progress.moving)),
    ("distance_m", Read::Number(|round| round.progress.distance_m)),
    ("wall_contacts", Read::Count(|round| round.progress.wall_contacts)),
    ("robot_contacts", Read::Count(|round| round.progress.robot_contacts)),
];

fn singles(frame: &ExploreFrame, to: &mut Vec<f32>, of: fn(&RobotFrame) -> f32) {
    to.extend(frame.robots.iter().map(of));
}

fn counts(frame: &ExploreFrame, to: &mut Vec<u32>, of: fn(&RobotFrame) -> u32) {
    to.extend(frame.robots.iter().map(of));
}

fn flags(frame: &ExploreFrame, to: &mut Vec<bool>, of: fn(&RobotFrame) -> bool) {
    to.extend(frame.robots.iter().map(of));
}

fn purpose(purpose: Purpose) -> u8 {
    match purpose {
        Purpose::Explore => 0,
        Purpose::Backtrack => 1,
        Purpose::Home => 2,
        Purpose::Park => 3,
        Purpose::Wait => 4,
    }
}

/// Keeps the numbers of an exploration over time.
struct ExploreLog {
    keep: Keep,
    frames: Option<Rows<ExploreFrame>>,
    rounds: Option<Rows<Round>>,
    odometer: Odometer,
    events: Events,
    log: Log,
}

impl Recorder<ExploreFrame> for ExploreLog {
    fn frame(&mut self, frame: &ExploreFrame) -> Result<(), RecordError> {
        if let Some(frames) = self.frames.as_mut().filter(|_| frame.decision || self.keep == Keep::Ticks) {
            frames.push(frame)?;
        }
        if let Some(rounds) = &mut self.rounds {
            let progress = self.odometer.add(frame);
            if frame.decision || frame.stopped.is_some() {
                rounds.push(&Round { decided_s: frame.decided_s(), progress })?;
            }
        }
        self.log.note(self.events.update(frame));
        Ok(())
    }
}

impl Logbook<Exploration> for ExploreLog {
    fn log(&self) -> &Log {
        &self.log
    }

    fn close(self: Box<Self>, metrics: &ExploreMetrics) -> Log {
        let mut rounds = self.rounds.map(Rows::table);
        if let Some(rounds) = &mut rounds {
            rounds.columns.push(coverage(rounds, &metrics.survey().curve));
        }
        let tables = self.frames.map(Rows::table).into_iter().chain(rounds).collect();
        Log { tables, ..self.log }
    }
}

/// The share of the ground that had been seen when each round began.
fn coverage(rounds: &Table, curve: &[(f64, f64)]) -> Column {
    let decided_s = rounds.columns.iter().find(|column| column.name == "decided_s");
    let decided_s = match decided_s.map(|column| &column.values) {
        Some(Values::Numbers(decided_s)) => decided_s.as_slice(),
        _ => &[],
    };
    let (mut next, mut seen) = (curve.iter().peekable(), 0.0);
    let shares = decided_s.iter().map(|decided_s| {
        while let Some((_, share)) = next.next_if(|(time_s, _)| time_s <= decided_s) {
            seen = *share;
        }
        seen
    });
    Column { name: "coverage", is_per_robot: false, values: Values::Numbers(shares.collect()) }
}

/// A logbook of a site.
pub(super) fn logbook(
    site: &Arc<Site>,
    frames: Option<Keep>,
) -> Result<Option<Box<dyn Logbook<Exploration>>>, RecordError> {
    let (crew, ticks) = (site.spawns.len(), total_ticks(site.scenario.duration_s));
    // Nobody knows how many rounds there are: far fewer than ticks.
    let most = |keep| if keep == Keep::Ticks { ticks } else { 0 };
    Ok(Some(Box::new(ExploreLog {
        keep: frames.unwrap_or(Keep::Decisions),
        frames: frames.map(|keep| Rows::new("frames", FRAMES, crew, most(keep))).transpose()?,
        rounds: frames.map(|_| Rows::new("rounds", ROUNDS, crew, 0)).transpose()?,
        odometer: Odometer::default(),
        events: Events::default(),
        log: Log::default(),
    })))
}

/// The sensor-based graph as it is in the end.
pub(super) fn graph(history: &ExploreHistory) -> Graph {
    let nodes = &history.nodes;
    let frontiers = |node: &NodeFrame| ExploreHistory::frontiers(node).count() as u32;
    let singles =
        |name, of: fn(&NodeFrame) -> f32| column(name, Values::Singles(nodes.iter().map(of).collect()));
    let counts =
        |name, of: fn(&NodeFrame) -> u32| column(name, Values::Counts(nodes.iter().map(of).collect()));
    let columns = vec![
        counts("robot", |node| node.id.robot.into()),
        counts("number", |node| node.id.number),
        singles("x_m", |node| node.at_m[0]),
        singles("y_m", |node| node.at_m[1]),
        singles("believed_x_m", |node| node.believed_m[0]),
        singles("believed_y_m", |node| node.believed_m[1]),
        counts("frontiers", frontiers),
    ];
    let rows: BTreeMap<NodeId, u32> = nodes.iter().map(|node| node.id).zip(0..).collect();
    let mut edges = Vec::with_capacity(history.edges.len());
    let mut lengths_m = Vec::with_capacity(history.edges.len());
    for [a, b] in &history.edges {
        let ends = [rows.get(a), rows.get(b)];
        let [Some(&from), Some(&to)] = ends else { continue };
        let at = |row: u32| nodes.get(row as usize).map_or([f32::NAN; 2], |node| node.at_m);
        let ([x_m, y_m], [to_x_m, to_y_m]) = (at(from), at(to));
        edges.push([from, to]);
        lengths_m.push(libm::hypotf(to_x_m - x_m, to_y_m - y_m));
    }
    Graph { nodes: Table { name: "nodes", rows: nodes.len(), crew: 0, columns }, edges, lengths_m }
}

fn column(name: &'static str, values: Values) -> Column {
    Column { name, is_per_robot: false, values }
}
