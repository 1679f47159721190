//! Laclau 2021, Fig. 4A to C: convergence from random initial positions in three corridors.

use std::sync::Arc;

use glam::Vec2;
use uchain_sim::{
    draw::figure::{Axes, Figure},
    mission::chain::{Course, Spawn},
    record::RecordError,
    seed::{Seed, Source as Draws},
    sweep::Run,
};

use super::trace::{Sample, Trace, loss_curves, record_trace, spread};
use crate::{
    Item, Outcome, PaperError, Row, RunCache, Table,
    experiment::{Experiment, RecordedRun, each_run, inline_scenario},
    outcome::{cell, mean_with_interval},
};

pub(crate) const FIG4ABC: Item = Item {
    id: "fig4abc",
    title: "convergence from random places (Laclau 2021, Fig. 4A to C)",
    run: regenerate,
};

/// Where the head stays (m).
const HEAD_M: f64 = 6.25;
/// Relays.
const RELAYS: usize = 3;
/// Random starts of each corridor, as published.
const REPLICATES: usize = 30;
/// And more of them, for what is rare; the first ones are those.
const STARTS: u64 = 1000;
/// Losses this near to each other are level (dB): the authors' simulator.
const LEVEL_DB: f64 = 4.0;
/// Level is looked for from a tenth of the run on (s).
const FROM_S: f64 = 3.0;
/// Most draws of a start.
const DRAWS: usize = 1000;
/// Depth of the sharp corner (m).
const CORNER_M: f64 = 3.1;
/// Least distance between UAVs at the start (m): more than their diameter.
const APART_M: f64 = 0.15;

/// Width of the corridors (m).
const WIDTH_M: f64 = 0.78;

/// Corridors, their base, and where along them the head is 6.25 m deep.
const CORRIDORS: [(&str, &str); 3] = [
    ("straight", "centre_line_m = [[-1.0, 0.0], [8.0, 0.0]]"),
    ("corner", "centre_line_m = [[-1.0, 0.0], [3.1, 0.0], [3.1, -5.0]]"),
    ("bend", "centre_line_m = [[-1.0, 0.0], [2.55, 0.0, 1.0], [2.55, 2.0, 1.0], [-1.0, 2.0]]"),
];

/// One run.
struct ConvergenceRun {
    /// Where relays start, head first (m).
    starts_m: Vec<f64>,
    /// Of the first run.
    recorded: Option<RecordedRun>,
    converged_s: Option<f64>,
    end_spread_db: Option<f64>,
    samples: Vec<Sample>,
}

fn corridor_scenario(name: &str, centre_line: &str) -> String {
    format!(
        "name = \"fig4abc-{name}\"\npreset = \"frontiers2021\"\nduration_s = 30.0\n\
         [map.corridor]\n{centre_line}\nwidth_m = {WIDTH_M}\n\
         [chain]\nuavs = {}\nbase_m = [0.0, 0.0]\nspawns_m = [[0.9, 0.0], [0.7, 0.0], [0.5, 0.0], [0.3, 0.0]]\n\
         [radio]\nalpha_free = 2.5\nalpha_wall = 4.0\n\
         [takeoff]\ns_min_db = -50.0\nafter_previous_s = 0.0\nrise_s = 0.0\nhover_s = 0.0\n\
         [[pilot]]\nstart_s = 0.0\nspeed_mps = 0.0\n",
        RELAYS + 1
    )
}

/// Heading of a UAV that starts in a corner.
#[derive(Clone, Copy)]
enum Heading {
    /// As one does that flies round it: from a corridor's width behind to a width ahead.
    Across,
    /// Along the leg of the middle line it is on.
    Along,
}

/// Initial positions drawn at random (rejection sampling): the head where it stays, relays anywhere behind it, in order.
fn with_random_starts(course: &Arc<Course>, seed: u64, heading: Heading) -> Arc<Course> {
    let mut course = Course::clone(course);
    let Some(tunnel) = course.tunnel.clone() else { return Arc::new(course) };
    let mut draws = Seed(seed).stream(0, Draws::Start);
    let mut drawn = || {
        let mut depths_m: Vec<f64> =
            (0..RELAYS).map(|_| f64::from(draws.uniform()) * HEAD_M).chain([HEAD_M]).collect();
        depths_m.sort_by(|a, b| b.total_cmp(a));
        depths_m
    };
    let are_apart = |depths_m: &Vec<f64>| depths_m.windows(2).all(|pair| pair[0] - pair[1] > APART_M);
    // Four of five draws are far enough apart.
    let Some(depths_m) = (0..DRAWS).map(|_| drawn()).find(are_apart) else { return Arc::new(course) };
    let place = |depth_m: f64| {
        let [behind, (at, along_rad), ahead] =
            [-WIDTH_M, 0.0, WIDTH_M].map(|aside_m: f64| -> (Vec2, f32) { tunnel.at(depth_m + aside_m) });
        let across = ahead.0 - behind.0;
        let heading_rad = match heading {
            Heading::Across => libm::atan2f(across.y, across.x),
            Heading::Along => along_rad,
        };
        Spawn { at, heading_rad }
    };
    course.spawns = depths_m.into_iter().map(place).collect();
    Arc::new(course)
}

fn fly(course: &Arc<Course>, one: Run, heading: Heading) -> Result<ConvergenceRun, RecordError> {
    let course = with_random_starts(course, one.seed, heading);
    let relays = course.spawns.iter().skip(1);
    let starts_m = relays.filter_map(|spawn| course.depth_m(spawn.at)).map(f64::from).collect();
    let Trace { mut samples, summary, recorded } = record_trace(&course, one)?;
    samples.retain(|sample| sample.links.len() == RELAYS + 1);
    let is_level = |sample: &&Sample| sample.time_s >= FROM_S && spread(sample.true_db()) < LEVEL_DB;
    let converged_s = samples.iter().find(is_level).map(|sample| sample.time_s);
    let end_spread_db = summary.spread_db.map(f64::from);
    if recorded.is_none() {
        samples.clear();
    }
    Ok(ConvergenceRun { starts_m, recorded, converged_s, end_spread_db, samples })
}

fn regenerate(_: &RunCache) -> Result<Outcome, PaperError> {
    let mut outcome = Outcome {
        setup: format!(
            "4 links over {HEAD_M} m: the head stays, {RELAYS} relays start at random places of a corridor {WIDTH_M} m wide, \
             all in the air from the first second on. {REPLICATES} starts for each of three corridors, 30 s each. Preset \
             `frontiers2021`, radio exponents 2.5 and 4.0. Converged: the true losses of all links within \
             {LEVEL_DB} dB of each other, looked for from {FROM_S} s on."
        ),
        ..Outcome::default()
    };
    let mut table = Table::new(
        "fig4abc",
        &["corridor", "replicate", "start_1_m", "start_2_m", "start_3_m", "converged_s", "end_spread_db"],
    );
    let (mut axes, mut in_the_corner) = (Vec::new(), None);
    for (panel, (name, centre_line)) in ["A", "B", "C"].iter().zip(CORRIDORS) {
        let source = inline_scenario(name, corridor_scenario(name, centre_line));
        let experiment = Experiment { source, sets: &[], vary: &[], replicates: STARTS };
        let all: Vec<ConvergenceRun> = each_run(experiment, |course, run| fly(course, run, Heading::Across))?
            .into_iter()
            .flatten()
            .collect();
        let runs = all.get(..REPLICATES).unwrap_or(&all);
        let times: Vec<f64> = runs.iter().filter_map(|run| run.converged_s).collect();
        let spreads: Vec<f64> = runs.iter().filter_map(|run| run.end_spread_db).collect();
        outcome.rows.push(Row::claim(
            &format!("{name}: runs that converge"),
            "30 of 30",
            format!("{} of {}, after {}", times.len(), runs.len(), mean_with_interval(&times, 1, " s")),
            times.len() == runs.len(),
        ));
        outcome.rows.push(Row::fact(
            &format!("{name}: spread of the links at the end"),
            mean_with_interval(&spreads, 2, " dB"),
        ));
        let converged = all.iter().filter(|run| run.converged_s.is_some()).count();
        outcome.rows.push(Row::fact(
            &format!("{name}: of {STARTS} starts, runs that converge"),
            format!("{converged} of {}", all.len()),
        ));
        if name == "corner" {
            outcome.rows.extend(corner(&all, centre_line)?);
            in_the_corner = Some(note_on_failures(&all));
        }
        for (replicate, run) in all.iter().enumerate() {
            let words = [name.to_owned(), replicate.to_string()];
            let relays = run.starts_m.iter().map(|depth_m| format!("{depth_m:.3}"));
            let came = [cell(run.converged_s, 1), cell(run.end_spread_db, 3)];
            table.rows.push(words.into_iter().chain(relays).chain(came).collect());
        }
        if let Some(run) = runs.first() {
            axes.push(panel_of(&format!("{panel}. {name}"), run));
        }
        if let Some(recorded) = runs.first().and_then(|run| run.recorded.as_ref()) {
            outcome.pictures.push((format!("fig4abc-{name}"), recorded.picture()?));
        }
    }
    outcome.notes = vec![
        "How UAVs stand at the start is not printed. Here they are in the order of the chain (UAVs cannot pass one another), \
         and in a corner each looks across it, as one does that flies round it; the last row has the other choice."
            .to_owned(),
        format!(
            "How starts are drawn is not printed either. Here: {RELAYS} depths, each evenly between the base and the head, in \
             falling order, all of them again while two are within {APART_M} m of one another. So drawn, gaps of one start are \
             more unequal than in the authors' runs, and a chain has farther to go."
        ),
    ];
    outcome.notes.extend(in_the_corner);
    let title = "Losses of four links, one of 30 random starts each (Laclau 2021, Fig. 4A to C)".to_owned();
    outcome.draw("fig4abc", &Figure { title, axes })?;
    outcome.tables.push(table);
    Ok(outcome)
}

/// The last relay starts beyond the sharp corner.
fn is_beyond(run: &ConvergenceRun) -> bool {
    run.starts_m.last().is_some_and(|depth_m| *depth_m > CORNER_M)
}

/// A note on the runs of the corner that never converge: where their relays start.
fn note_on_failures(all: &[ConvergenceRun]) -> String {
    let never = |runs: &[ConvergenceRun]| runs.iter().filter(|run| run.converged_s.is_none()).count();
    let beyond = all.iter().filter(|run| run.converged_s.is_none() && is_beyond(run)).count();
    format!(
        "Of the {} starts of the corner that do not converge, {beyond} have the last relay beyond it, which then has to fly \
         backward round it. Among the first {REPLICATES}, as many as were published, {} do not converge.",
        never(all),
        never(all.get(..REPLICATES).unwrap_or(all))
    )
}

/// What matters at the sharp corner: who starts beyond it, and how it looks.
fn corner(all: &[ConvergenceRun], centre_line: &str) -> Result<[Row; 2], PaperError> {
    let beyond: Vec<&ConvergenceRun> = all.iter().filter(|run| is_beyond(run)).collect();
    let converged = beyond.iter().filter(|run| run.converged_s.is_some()).count();
    let source = inline_scenario("corner", corridor_scenario("corner", centre_line));
    let experiment = Experiment { source, sets: &[], vary: &[], replicates: REPLICATES as u64 };
    let along = each_run(experiment, |course, run| fly(course, run, Heading::Along))?;
    let straight = along.iter().flatten().filter(|run| run.converged_s.is_some()).count();
    Ok([
        Row::fact(
            "corner: of those with the last relay beyond it at the start, runs that converge",
            format!("{converged} of {}", beyond.len()),
        ),
        Row::fact(
            "corner: runs that converge if UAVs in it look along a leg",
            format!("{straight} of {REPLICATES}"),
        ),
    ])
}

fn panel_of(title: &str, run: &ConvergenceRun) -> Axes {
    Axes {
        title: title.to_owned(),
        x: "time (s)".to_owned(),
        y: "loss of the link (dB)".to_owned(),
        height: 180.0,
        marks: loss_curves(&run.samples, 0..usize::MAX, true),
        ..Axes::default()
    }
}
