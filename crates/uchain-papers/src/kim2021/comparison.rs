//! Comparison of three exploration strategies (Kim 2021, §7.2): 2 to 5 robots, 20 runs each, common random numbers.

use std::sync::Arc;

use uchain_sim::{
    analyse::{Estimate, saved_percent},
    draw::figure::{Axes, Figure, Mark},
    mission::explore::{ExploreSummary, Site},
    run::run,
};

use crate::{
    Outcome, PaperError, Row, Table,
    experiment::{Experiment, each_run, scenario},
    outcome::mean_with_interval,
};

/// From the one that holds positions to the one of the paper.
pub(super) const STRATEGIES: [&str; 3] = ["cssg", "cssg-random", "srg"];
const ROBOTS: [usize; 4] = [2, 3, 4, 5];
const REPLICATES: u64 = 20;

/// How rows are judged.
pub(super) const AGREEMENT_RULE: &str = "Agrees: the interval meets the published range for every number of robots, and the mean over them \
lies within. Intervals: bootstrap over the pairs of a replicate, which start from the same places.";

/// A metric of a run.
#[derive(Clone, Copy)]
pub(super) struct Metric {
    pub(super) name: &'static str,
    of: fn(&ExploreSummary) -> f64,
}

pub(super) const ITERATIONS: Metric = Metric { name: "iterations", of: |run| run.iterations.into() };
pub(super) const DISTANCE: Metric =
    Metric { name: "distance per robot", of: ExploreSummary::distance_mean_m };

const HOLDS: Metric =
    Metric { name: "rounds held", of: |run| run.holds.iter().map(|holds| f64::from(*holds)).sum() };
const OVERLAP: Metric = Metric { name: "overlap", of: |run| 100.0 * run.overlap };

/// What one strategy was published to save over another one (%).
pub(super) struct Claim {
    /// Places in [`STRATEGIES`].
    pub(super) pair: [usize; 2],
    pub(super) metric: Metric,
    /// The least and the most; `None` where nothing was published.
    pub(super) range: Option<[f64; 2]>,
}

/// All runs on one map.
pub(super) struct Comparison {
    map: &'static str,
    /// By strategy, then by number of robots, then by replicate.
    runs: Vec<Vec<ExploreSummary>>,
}

impl Comparison {
    pub(super) fn fly(map: &'static str) -> Result<Self, PaperError> {
        let vary = [
            format!("explore.strategy={}", STRATEGIES.map(|strategy| format!("\"{strategy}\"")).join(",")),
            format!("explore.robots={}", ROBOTS.map(|robots| robots.to_string()).join(",")),
        ];
        let experiment = Experiment { source: scenario(map), sets: &[], vary: &vary, replicates: REPLICATES };
        let runs = each_run(experiment, |site: &Arc<Site>, one| run(site, one.seed, &mut ()))?;
        Ok(Self { map, runs })
    }

    fn sample(&self, strategy: usize, robots: usize, metric: Metric) -> Vec<f64> {
        let runs = self.runs.get(strategy * ROBOTS.len() + robots).map_or(&[][..], Vec::as_slice);
        runs.iter().map(metric.of).collect()
    }

    /// Rows, picture and numbers.
    pub(super) fn outcome(&self, id: &str, title: &str, claims: &[Claim]) -> Result<Outcome, PaperError> {
        let mut outcome = Outcome {
            setup: format!(
                "Scenario `{}`, 2 to 5 robots, {REPLICATES} runs of each of three strategies; the runs of a replicate \
                 start from the same places.",
                self.map
            ),
            rows: claims.iter().map(|claim| self.row(claim)).collect(),
            ..Outcome::default()
        };
        let mut table = Table::for_report(&[
            "strategy",
            "robots",
            "iterations",
            "distance per robot (m)",
            "rounds held, all robots",
            "seen by more than one robot (%)",
        ]);
        for (s, strategy) in STRATEGIES.iter().enumerate() {
            for (n, robots) in ROBOTS.iter().enumerate() {
                let of = |metric, digits| mean_with_interval(&self.sample(s, n, metric), digits, "");
                let cells = [of(ITERATIONS, 1), of(DISTANCE, 1), of(HOLDS, 1), of(OVERLAP, 1)];
                table
                    .rows
                    .push([(*strategy).to_owned(), robots.to_string()].into_iter().chain(cells).collect());
            }
        }
        let mut single = Table::new(
            id,
            &["strategy", "robots", "replicate", "iterations", "distance_mean_m", "holds", "overlap_percent"],
        );
        for (variant, runs) in self.runs.iter().enumerate() {
            let (strategy, robots) = (STRATEGIES[variant / ROBOTS.len() % 3], ROBOTS[variant % ROBOTS.len()]);
            for (replicate, run) in runs.iter().enumerate() {
                let words = [strategy.to_owned(), robots.to_string(), replicate.to_string()];
                let numbers =
                    [ITERATIONS, DISTANCE, HOLDS, OVERLAP].map(|metric| format!("{:.3}", (metric.of)(run)));
                single.rows.push(words.into_iter().chain(numbers).collect());
            }
        }
        outcome.tables = vec![table, single];
        outcome.draw(id, &self.figure(title))?;
        Ok(outcome)
    }

    /// What one strategy saves over another one with 2, 3, 4 and 5 robots, each with its interval (%).
    fn saved(&self, [a, b]: [usize; 2], metric: Metric) -> Vec<[f64; 3]> {
        let of = |n| saved_percent(&self.sample(a, n, metric), &self.sample(b, n, metric));
        (0..ROBOTS.len()).map(of).collect()
    }

    /// What flight levels alone are worth: with how many robots they save or cost something that shows.
    pub(super) fn levels_alone(&self) -> String {
        let words = [ITERATIONS, DISTANCE].map(|metric| {
            let saved = self.saved([1, 2], metric);
            let with = |shows: fn(&[f64; 3]) -> bool| {
                let robots = ROBOTS.iter().zip(&saved).filter(|(_, saved)| shows(saved));
                let robots: Vec<String> = robots.map(|(robots, _)| robots.to_string()).collect();
                if robots.is_empty() { "no number of".to_owned() } else { robots.join(", ") }
            };
            let (saves, costs) = (with(|[_, low, _]| *low > 0.0), with(|[_, _, high]| *high < 0.0));
            format!("{} saved with {saves} robots, lost with {costs} robots", metric.name)
        });
        format!(
            "Flight levels alone (`{}` over `{}`), by intervals that leave out 0: {}.",
            STRATEGIES[1],
            STRATEGIES[2],
            words.join("; ")
        )
    }

    /// In which share of its robots' rounds the strategy that holds positions does so, with 2, 3, 4 and 5 robots.
    pub(super) fn holding(&self) -> String {
        let mean = |n, metric| Estimate::of(&self.sample(2, n, metric)).map_or(f64::NAN, |of| of.mean);
        let share = |(n, robots): (usize, &usize)| {
            let percent = 100.0 * mean(n, HOLDS) / (mean(n, ITERATIONS) * *robots as f64);
            format!("{percent:.1}")
        };
        let shares: Vec<String> = ROBOTS.iter().enumerate().map(share).collect();
        format!(
            "Robots of `{}` that hold wait one round, for another that moves: {} % of all rounds of a robot, with 2 to 5 \
             robots, and no way",
            STRATEGIES[2],
            shares.join(", ")
        )
    }

    /// Saved over the number of robots, in the mean (%).
    pub(super) fn saved_mean(&self, pair: [usize; 2], metric: Metric) -> f64 {
        self.saved(pair, metric).iter().map(|[saved, ..]| saved).sum::<f64>() / ROBOTS.len() as f64
    }

    /// Ours beside the published range.
    fn row(&self, claim: &Claim) -> Row {
        let ([a, b], saved) = (claim.pair, self.saved(claim.pair, claim.metric));
        let cells = ROBOTS.iter().zip(&saved);
        let cells =
            cells.map(|(robots, [saved, low, high])| format!("{robots}: {saved:.1} ({low:.1} … {high:.1})"));
        let ours = cells.collect::<Vec<_>>().join(", ");
        let what = format!("{} saves over {}: {} (%)", STRATEGIES[a], STRATEGIES[b], claim.metric.name);
        let Some([least, most]) = claim.range else { return Row::fact(&what, ours) };
        let mean = self.saved_mean(claim.pair, claim.metric);
        let within = saved.iter().filter(|[saved, ..]| (least..=most).contains(saved)).count();
        let meets = saved.iter().all(|[_, low, high]| *low <= most && *high >= least);
        let ours = format!("{ours}; mean {mean:.1}, {within} of {} within", saved.len());
        Row::claim(&what, &format!("{least} … {most}"), ours, meets && (least..=most).contains(&mean))
    }

    /// Whether a saving is larger with more robots, as published: by the slope over their number.
    pub(super) fn grows(&self, pair: [usize; 2], metric: Metric) -> Row {
        let saved = self.saved(pair, metric);
        let middle = (ROBOTS.iter().sum::<usize>() as f64) / ROBOTS.len() as f64;
        let weighed =
            ROBOTS.iter().zip(&saved).map(|(robots, [saved, ..])| (*robots as f64 - middle) * saved);
        let squares = ROBOTS.iter().map(|robots| (*robots as f64 - middle) * (*robots as f64 - middle));
        let slope = weighed.sum::<f64>() / squares.sum::<f64>();
        Row::claim(
            &format!(
                "{} saves over {}: {}, with more robots",
                STRATEGIES[pair[0]], STRATEGIES[pair[1]], metric.name
            ),
            "grows",
            format!("{slope:+.1} points per robot"),
            slope > 0.0,
        )
    }

    fn figure(&self, title: &str) -> Figure {
        let axes = |metric: Metric, y: &str| {
            let line = |strategy: usize| Mark::Estimates {
                name: STRATEGIES[strategy].to_owned(),
                colour: strategy,
                points: (0..ROBOTS.len())
                    .filter_map(|n| {
                        // Side by side, so that the intervals show.
                        let x = (n + 1) as f64 + 0.12 * (strategy as f64 - 1.0);
                        Some((x, Estimate::of_never_negative(&self.sample(strategy, n, metric))?))
                    })
                    .collect(),
            };
            Axes {
                x: "robots".to_owned(),
                y: y.to_owned(),
                words: ROBOTS.iter().map(ToString::to_string).collect(),
                height: 210.0,
                marks: (0..STRATEGIES.len()).map(line).collect(),
                ..Axes::default()
            }
        };
        let axes =
            vec![axes(ITERATIONS, "rounds until all is seen"), axes(DISTANCE, "distance per robot (m)")];
        Figure { title: title.to_owned(), axes }
    }
}
