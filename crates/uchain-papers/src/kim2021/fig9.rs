//! Kim 2021, Fig. 9: three robots explore an apartment.

use std::sync::Arc;

use uchain_sim::{
    draw::Picture,
    mission::{
        Mission as _,
        explore::{Exploration, ExploreFrame, ExploreHistory, ExploreMetrics, Site, explore_picture},
    },
    record::{RecordError, Recorder},
    run::run,
    sweep::DesignError,
};

use super::comparison::READING;
use crate::{
    Item, Outcome, PaperError, Row, RunCache, SEED, Table,
    experiment::{Experiment, each_run, scenario},
    outcome::mean_with_interval,
};

pub(crate) const FIG9: Item =
    Item { id: "fig9", title: "three robots explore an apartment (Kim 2021, Fig. 9)", run: regenerate };

/// Iterations after which the paper shows the map; the last picture is the end.
const SHOWN: [u32; 2] = [20, 40];
const REPLICATES: u64 = 20;

/// Counts the rounds begun so far.
struct RoundCounter(u32);

impl Recorder<ExploreFrame> for RoundCounter {
    fn frame(&mut self, frame: &ExploreFrame) -> Result<(), RecordError> {
        self.0 = frame.rounds;
        Ok(())
    }
}

/// The map after so many rounds, or at the end.
fn after(site: &Arc<Site>, seed: u64, rounds: u32) -> Result<Picture, PaperError> {
    let mut exploration = Exploration::start(site.clone(), seed);
    let (mut metrics, mut history) = (ExploreMetrics::new(site.clone()), ExploreHistory::default());
    let (mut last, mut begun) = (None, RoundCounter(0));
    while last.is_none() && begun.0 <= rounds {
        last = exploration.step(&mut ((&mut metrics, &mut history), &mut begun))?;
    }
    let (mut summary, survey) = (metrics.summary(seed, String::new()), metrics.survey());
    if last.is_none() {
        summary.iterations = rounds;
        for share in [&mut summary.coverage_t50_s, &mut summary.coverage_t90_s, &mut summary.coverage_t100_s]
        {
            *share = None;
        }
    }
    Ok(explore_picture(site, &history, &survey, &summary)?)
}

fn regenerate(_: &RunCache) -> Result<Outcome, PaperError> {
    let source = scenario("apartment");
    let experiment = Experiment { source: source.clone(), sets: &[], vary: &[], replicates: REPLICATES };
    let flown: Vec<_> = each_run(experiment, |site: &Arc<Site>, one| run(site, one.seed, &mut ()))?
        .into_iter()
        .flatten()
        .collect();
    let rounds: Vec<f64> = flown.iter().map(|run| run.iterations.into()).collect();
    let home = flown.iter().filter(|run| run.verdict.outcome().is_success()).count();
    let (low, high) = rounds.iter().fold((f64::INFINITY, 0.0_f64), |(l, h), r| (l.min(*r), h.max(*r)));
    let mut table = Table::new("fig9", &["replicate", "iterations", "distance_mean_m", "coverage"]);
    for (replicate, run) in flown.iter().enumerate() {
        let numbers = [format!("{:.3}", run.distance_mean_m()), format!("{:.5}", run.coverage)];
        let words = [replicate.to_string(), run.iterations.to_string()];
        table.rows.push(words.into_iter().chain(numbers).collect());
    }
    let site = Site::read(&source, &[]).map_err(DesignError::from)?;
    let mut pictures = Vec::new();
    // Of the first replicate.
    let seed = flown.first().map_or(SEED, |run| run.seed);
    for rounds in SHOWN {
        pictures.push((format!("fig9-{rounds}"), after(&site, seed, rounds)?));
    }
    pictures.push(("fig9-end".to_owned(), after(&site, seed, u32::MAX)?));
    Ok(Outcome {
        setup: format!(
            "Scenario `apartment`, three robots, strategy `cssg`, {REPLICATES} runs; the pictures are of one run after 20 \
             and 40 iterations and at its end, as published. {READING}"
        ),
        rows: vec![
            Row::unjudged(
                "iterations until all are home",
                "79 (one run)",
                format!("{}; from {low:.0} to {high:.0}", mean_with_interval(&rounds, 1, "")),
            ),
            Row::claim(
                "explored, and all home",
                "yes",
                format!("{home} of {REPLICATES} runs"),
                home == flown.len(),
            ),
        ],
        notes: vec![
            "The published map's size is not printed; ours has nine rooms on 10 m x 10 m, chosen to fit the \
             iteration counts of Fig. 9 and 10: whether they agree is no evidence, and is not counted. The pictures are of \
             replicate 0."
                .to_owned(),
        ],
        pictures,
        tables: vec![table],
        ..Outcome::default()
    })
}
