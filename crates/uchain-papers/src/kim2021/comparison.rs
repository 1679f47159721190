//! Comparison of three exploration strategies (Kim 2021, §7.2): 2 to 5 robots, common random numbers.

use std::sync::Arc;

use uchain_sim::{
    analyse::{Estimate, bootstrap, saved_percent},
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
pub(super) const ROBOTS: [usize; 4] = [2, 3, 4, 5];
/// As many as published.
const REPLICATES: u64 = 20;

/// What of the paper is read how, here and in all items of Kim 2021 but `cooperation`.
pub(super) const READING: &str = "Read as printed: in Eq. 7 the others count where they are (`explore.taken = \"ignored\"`), and a \
frontier is judged by the mid-point of its arc (`explore.arc_ends = false`). What the other readings give, with five times the runs, \
is in [cooperation.md](cooperation.md).";

/// How rows are judged.
pub(super) const AGREEMENT_RULE: &str = "Agrees: the interval meets the published range for every number of robots, and the mean over them \
lies within. *Grows*: the interval of the slope over their number lies above 0. Intervals: bootstrap over the pairs of a replicate, which start from \
the same places.";

/// A metric of a run.
#[derive(Clone, Copy)]
pub(super) struct Metric {
    pub(super) name: &'static str,
    of: fn(&ExploreSummary) -> f64,
}

pub(super) const ITERATIONS: Metric = Metric { name: "iterations", of: |run| run.iterations.into() };
pub(super) const DISTANCE: Metric =
    Metric { name: "distance per robot", of: ExploreSummary::distance_mean_m };

pub(super) const HOLDS: Metric =
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
    /// As published, read as printed.
    pub(super) fn published(map: &'static str) -> Result<Self, PaperError> {
        Self::fly(map, &[], REPLICATES)
    }

    pub(super) fn fly(map: &'static str, sets: &[&str], replicates: u64) -> Result<Self, PaperError> {
        let vary = [
            format!("explore.strategy={}", STRATEGIES.map(|strategy| format!("\"{strategy}\"")).join(",")),
            format!("explore.robots={}", ROBOTS.map(|robots| robots.to_string()).join(",")),
        ];
        let experiment = Experiment { source: scenario(map), sets, vary: &vary, replicates };
        let runs = each_run(experiment, |site: &Arc<Site>, one| run(site, one.seed, &mut ()))?;
        Ok(Self { map, runs })
    }

    /// Of one strategy with one number of robots, both by their places.
    pub(super) fn sample(&self, strategy: usize, robots: usize, metric: Metric) -> Vec<f64> {
        let runs = self.runs.get(strategy * ROBOTS.len() + robots).map_or(&[][..], Vec::as_slice);
        runs.iter().map(metric.of).collect()
    }

    /// Rows, picture and numbers.
    pub(super) fn outcome(&self, id: &str, title: &str, claims: &[Claim]) -> Result<Outcome, PaperError> {
        let mut outcome = Outcome {
            setup: format!(
                "Scenario `{}`, 2 to 5 robots, {REPLICATES} runs of each of three strategies; the runs of a replicate \
                 start from the same places. {READING}",
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
    pub(super) fn saved(&self, [a, b]: [usize; 2], metric: Metric) -> Vec<[f64; 3]> {
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

    /// In which share of its robots' rounds the strategy that holds positions does so, with 2, 3, 4 and 5 robots (%).
    pub(super) fn held_percent(&self) -> [f64; ROBOTS.len()] {
        let mean = |n, metric| Estimate::of(&self.sample(2, n, metric)).map_or(f64::NAN, |of| of.mean);
        std::array::from_fn(|n| 100.0 * mean(n, HOLDS) / (mean(n, ITERATIONS) * ROBOTS[n] as f64))
    }

    /// The same in words.
    pub(super) fn holding(&self) -> String {
        let shares = self.held_percent().map(|percent| format!("{percent:.1}"));
        format!(
            "Robots of `{}` that hold wait one round, for another that moves: {} % of all rounds of a robot, with 2 to 5 \
             robots, and no way",
            STRATEGIES[2],
            shares.join(", ")
        )
    }

    /// A statistic of what one strategy saves over another one with 2, 3, 4 and 5 robots (%), and its interval: by
    /// bootstrap over the replicates, which keep their runs with all numbers of robots together.
    fn of_saved(
        &self,
        pair: [usize; 2],
        metric: Metric,
        statistic: fn(&[f64; ROBOTS.len()]) -> f64,
    ) -> [f64; 3] {
        let samples: [[Vec<f64>; 2]; ROBOTS.len()] =
            std::array::from_fn(|n| pair.map(|strategy| self.sample(strategy, n, metric)));
        let replicates = samples.iter().flatten().map(Vec::len).min().unwrap_or(0);
        bootstrap(replicates, |drawn| {
            let sum = |sample: &Vec<f64>| drawn.iter().filter_map(|&i| sample.get(i)).sum::<f64>();
            statistic(&samples.each_ref().map(|[a, b]| 100.0 * (1.0 - sum(a) / sum(b))))
        })
    }

    /// Saved in the mean over the numbers of robots, and its interval (%).
    pub(super) fn saved_mean(&self, pair: [usize; 2], metric: Metric) -> [f64; 3] {
        self.of_saved(pair, metric, |saved| saved.iter().sum::<f64>() / saved.len() as f64)
    }

    /// How much more is saved per robot more: the slope over their number, and its interval (points).
    pub(super) fn slope(&self, pair: [usize; 2], metric: Metric) -> [f64; 3] {
        self.of_saved(pair, metric, |saved| {
            let middle = ROBOTS.iter().sum::<usize>() as f64 / ROBOTS.len() as f64;
            let aside = ROBOTS.map(|robots| robots as f64 - middle);
            let weighed: f64 = aside.iter().zip(saved).map(|(aside, saved)| aside * saved).sum();
            weighed / aside.iter().map(|aside| aside * aside).sum::<f64>()
        })
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
        let [mean, ..] = self.saved_mean(claim.pair, claim.metric);
        let within = saved.iter().filter(|[saved, ..]| (least..=most).contains(saved)).count();
        let meets = saved.iter().all(|[_, low, high]| *low <= most && *high >= least);
        let ours = format!("{ours}; mean {mean:.1}, {within} of {} within", saved.len());
        Row::claim(&what, &format!("{least} … {most}"), ours, meets && (least..=most).contains(&mean))
    }

    /// Whether a saving is larger with more robots, as published: by the slope over their number.
    pub(super) fn grows(&self, pair: [usize; 2], metric: Metric) -> Row {
        let [slope, low, high] = self.slope(pair, metric);
        Row::claim(
            &format!(
                "{} saves over {}: {}, with more robots",
                STRATEGIES[pair[0]], STRATEGIES[pair[1]], metric.name
            ),
            "grows",
            format!("{slope:+.1} points per robot ({low:+.1} … {high:+.1})"),
            low > 0.0,
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
