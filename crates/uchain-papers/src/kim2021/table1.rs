//! Kim 2021, Table 1: two quadrotors in the laboratory.

use std::sync::Arc;

use uchain_sim::{
    draw::figure::{Axes, Figure, Mark, Stroke},
    mission::explore::{ExploreHistory, ExploreSummary, Site, Survey, explore_picture},
    run,
    sweep::DesignError,
};

use super::comparison::READING;
use crate::{Item, Outcome, PaperError, Row, RunCache, SEED, Table, experiment::scenario};

pub(crate) const TABLE1: Item = Item {
    id: "table1",
    title: "two quadrotors in the laboratory (Kim 2021, Table 1, Fig. 13, 14 and 17)",
    run: regenerate,
};

/// Near enough (1): where walls stood is not printed.
const NEAR: f64 = 0.1;
/// Nodes each quadrotor visited, and how long it took (s), as published.
const PUBLISHED_NODES: f64 = 21.0;
const PUBLISHED_S: f64 = 101.66;

/// One run, with what its pictures need.
struct Flown {
    site: Arc<Site>,
    summary: ExploreSummary,
    survey: Survey,
    history: ExploreHistory,
}

fn fly(sets: &[String]) -> Result<Flown, PaperError> {
    let site = Site::read(&scenario("lab"), sets).map_err(DesignError::from)?;
    let mut history = ExploreHistory::default();
    let (summary, metrics) = run::fly(&site, SEED, &mut history)?;
    Ok(Flown { site, summary, survey: metrics.survey(), history })
}

fn regenerate(_: &RunCache) -> Result<Outcome, PaperError> {
    let flown = fly(&[])?;
    let point = fly(&["explore.vehicle=\"point-mass\"".to_owned()])?.summary;
    let summary = &flown.summary;
    let is_near = |ours: f64, published: f64| (ours / published - 1.0).abs() <= NEAR;
    let mut table = Table::new("table1", &["quantity", "robot", "published", "ours"]);
    let mut rows = Vec::new();
    let mut compare = |what: &str, robot: &str, published: f64, ours: f64, digits: usize| {
        let (published_text, ours_text) = (format!("{published:.digits$}"), format!("{ours:.digits$}"));
        table.rows.push(vec![what.to_owned(), robot.to_owned(), published_text.clone(), ours_text.clone()]);
        let what = if robot.is_empty() { what.to_owned() } else { format!("{what}, quadrotor {robot}") };
        rows.push(Row::claim(&what, &published_text, ours_text, is_near(ours, published)));
    };
    // A node is visited by each move, and at the start.
    for (robot, (moves, published)) in
        ["1", "2"].into_iter().zip(summary.moves.iter().zip([PUBLISHED_NODES; 2]))
    {
        compare("nodes visited", robot, published, f64::from(moves + 1), 0);
    }
    for (robot, (metres, published)) in
        ["1", "2"].into_iter().zip(summary.distance_m.iter().zip([10.454, 9.936]))
    {
        compare("distance (m)", robot, published, *metres, 3);
    }
    compare("exploration time (s)", "", PUBLISHED_S, summary.sim_s, 2);
    compare("time on other levels (s)", "", 25.10, summary.mfl_s, 2);
    let nodes: Vec<String> = summary.nodes.iter().map(ToString::to_string).collect();
    rows.push(Row::fact("nodes of the graph, by quadrotor", nodes.join(" and ")));
    rows.push(Row::fact(
        "exploration time (s) of point masses on the same rounds",
        format!("{:.2} ({} rounds; quadrotors {})", point.sim_s, point.iterations, summary.iterations),
    ));
    let mut outcome = Outcome {
        setup: format!(
            "Scenario `lab`: 2 m x 2 m, three rooms and halls, R_s = 0.5 m, two quadrotors of 38 g, starts as published. \
             One run: nothing in it is random. Within {:.0} % agrees. A node is visited by each move, homing included, and \
             at the start. {READING}",
            100.0 * NEAR
        ),
        rows,
        notes: vec![
            format!(
                "Where walls stood is not printed: ours were drawn once after the text. On them robots are on other levels \
                 for {:.2} s (published: at about 27 to 35 s and 82 to 100 s, Fig. 17).",
                summary.mfl_s
            ),
            format!(
                "Published are {:.1} s per node, here {:.1} s a round. The same rounds take point masses {:.0} % of the time; the \
                 rest is the quadrotor's settling at its node, to 2 cm and 5 cm/s. How long the published quadrotors stayed \
                 is not printed.",
                PUBLISHED_S / PUBLISHED_NODES,
                summary.sim_s / f64::from(summary.iterations),
                100.0 * point.sim_s / summary.sim_s
            ),
        ],
        tables: vec![table],
        ..Outcome::default()
    };
    let paths = explore_picture(&flown.site, &flown.history, &flown.survey, summary)?;
    outcome.pictures.push(("table1-paths".to_owned(), paths));
    outcome.draw("table1-heights", &heights(&flown.history))?;
    Ok(outcome)
}

/// After Fig. 17.
fn heights(history: &ExploreHistory) -> Figure {
    let line = |robot: usize, stroke| Mark::Line {
        name: format!("quadrotor {}", robot + 1),
        colour: robot,
        stroke,
        points: history
            .states
            .moments
            .iter()
            .filter_map(|moment| Some((moment.time_s, f64::from(moment.at_m.get(robot)?[2]))))
            .collect(),
    };
    Figure {
        title: "Heights of two quadrotors (Kim 2021, Fig. 17)".to_owned(),
        axes: vec![Axes {
            x: "time (s)".to_owned(),
            y: "height (m)".to_owned(),
            height: 180.0,
            marks: vec![line(0, Stroke::Solid), line(1, Stroke::Dashed)],
            ..Axes::default()
        }],
    }
}
