//! Laclau 2021, Fig. 6: the circuit as flown, with the firmware's laws.

use std::sync::Arc;

use uchain_sim::{
    analyse::Estimate,
    draw::figure::{Axes, Figure},
    mission::chain::Course,
    record::RecordError,
    sweep::Run,
};

use super::trace::{Sample, Trace, loss_curves, record_trace, spread, threshold};
use crate::{
    Item, Outcome, PaperError, Row, RunCache, Table,
    experiment::{Experiment, RecordedRun, each_run, scenario},
    outcome::{cell, mean_with_interval},
};

pub(crate) const FIG6: Item = Item {
    id: "fig6",
    title: "the flight test: a head, two relays and a base (Laclau 2021, Fig. 6)",
    run: regenerate,
};

const REPLICATES: u64 = 30;
const RELAYS: usize = 2;
const S_MIN_DB: f64 = 60.0;
const DURATION_S: f64 = 180.0;
/// The end: the last seconds (s); nobody is to launch in thrice that time.
const END_S: f64 = 10.0;
const QUIET_S: f64 = 30.0;
/// Links this near to each other are equal (dB): the authors' simulator's measure of an exploration.
const EQUAL_DB: f64 = 7.0;
/// At the threshold: twice the deviation of the filtered signal, 1.2 dB with the firmware's Q, R and σ. A launch comes
/// early because the first sample of many that exceeds it decides.
const AT_LAUNCH_DB: f64 = 2.4;
/// Spacing is unequal where the longest gap exceeds the shortest one by so much.
const UNEQUAL: f64 = 1.1;

/// How the pilot drives is not printed: on along the circuit as far as three links of this radio reach, then hover.
const SETS: [&str; 4] = ["chain.uavs=3", "duration_s=180", "pilot.0.speed_mps=0.2", "pilot.1.start_s=58"];
/// When the pilot stops (s).
const STOP_S: f64 = 58.0;

/// One run.
struct Flown {
    samples: Vec<Sample>,
    launches_s: Vec<f64>,
    spread_db: Option<f64>,
    relays_needed: Option<usize>,
    /// Of the first run.
    recorded: Option<RecordedRun>,
}

impl Flown {
    /// All have launched, and none lately.
    fn is_whole(&self) -> bool {
        self.launches_s.len() == RELAYS + 1
            && self.launches_s.last().is_some_and(|at_s| *at_s < DURATION_S - QUIET_S)
    }

    /// True loss of the last link when each relay took off (dB).
    fn at_launch_db(&self) -> impl Iterator<Item = f64> {
        let pairs = self.samples.windows(2).filter_map(|pair| <&[Sample; 2]>::try_from(pair).ok());
        // In the tick of a launch the links are still those without the new UAV.
        pairs
            .filter(|[before, now]| before.airborne > 0 && now.airborne > before.airborne)
            .filter_map(|[_, now]| now.true_db().last())
    }

    /// For each relay that took off with the last link truly above the limit: for how long it had been there (s).
    fn lags_s(&self) -> Vec<f64> {
        let lag_s = |launch_s: &f64| {
            let before = self.samples.iter().rev().filter(|sample| sample.time_s < *launch_s);
            let above = before.take_while(|sample| sample.true_db().last().is_some_and(|db| db > S_MIN_DB));
            above.last().map(|first| launch_s - first.time_s)
        };
        self.launches_s.iter().skip(1).filter_map(lag_s).collect()
    }

    fn end(&self) -> impl Iterator<Item = &Sample> {
        self.samples.iter().filter(|sample| sample.time_s >= DURATION_S - END_S)
    }

    /// The worst link at the end, in the mean (dB).
    fn worst_db(&self) -> Option<f64> {
        let worst: Vec<f64> = self.end().map(|sample| sample.true_db().fold(0.0, f64::max)).collect();
        Some(Estimate::of(&worst)?.mean)
    }

    /// Distances of neighbours along the tunnel at the end, in the mean, the head's first (m).
    fn gaps_m(&self) -> Vec<f64> {
        let gap = |link: usize| {
            let of = |sample: &Sample| {
                let front_m = sample.depths_m.get(link)?;
                let back_m = if link == RELAYS { &0.0 } else { sample.depths_m.get(link + 1)? };
                Some(front_m - back_m)
            };
            let gaps: Vec<f64> = self.end().filter_map(of).collect();
            Estimate::of(&gaps).map(|gap| gap.mean)
        };
        (0..=RELAYS).filter_map(gap).collect()
    }

    fn longest_over_shortest(&self) -> f64 {
        let gaps = self.gaps_m();
        let shortest = gaps.iter().copied().fold(f64::INFINITY, f64::min);
        (shortest + spread(gaps.into_iter())) / shortest
    }
}

fn fly(course: &Arc<Course>, one: Run) -> Result<Flown, RecordError> {
    let Trace { samples, summary, recorded } = record_trace(course, one)?;
    Ok(Flown {
        samples,
        launches_s: summary.launches_s,
        spread_db: summary.spread_db.map(f64::from),
        relays_needed: summary.relays_needed,
        recorded,
    })
}

fn regenerate(_: &RunCache) -> Result<Outcome, PaperError> {
    let experiment =
        Experiment { source: scenario("circuit-cavemod"), sets: &SETS, vary: &[], replicates: REPLICATES };
    let runs: Vec<Flown> = each_run(experiment, fly)?.into_iter().flatten().collect();
    let mut table = Table::new(
        "fig6",
        &[
            "replicate",
            "launches",
            "launch_1_s",
            "launch_2_s",
            "relays_needed",
            "spread_db",
            "worst_db",
            "gap_0_m",
            "gap_1_m",
            "gap_2_m",
        ],
    );
    for (replicate, run) in runs.iter().enumerate() {
        let gaps_m = run.gaps_m();
        let gaps = (0..=RELAYS).map(|link| cell(gaps_m.get(link).copied(), 3));
        let words = [
            replicate.to_string(),
            run.launches_s.len().to_string(),
            cell(run.launches_s.get(1).copied(), 1),
            cell(run.launches_s.get(2).copied(), 1),
            run.relays_needed.map_or_else(String::new, |needed| needed.to_string()),
            cell(run.spread_db, 3),
            cell(run.worst_db(), 3),
        ];
        table.rows.push(words.into_iter().chain(gaps).collect());
    }
    let mut outcome = Outcome {
        setup: format!(
            "Scenario `circuit-cavemod` (the firmware's laws, paper walls that radio does not see), head, two relays and a \
             base; the pilot drives the head at 0.2 m/s until {STOP_S} s, then hovers; {DURATION_S} s, {REPLICATES} runs. The end \
             is the last {END_S} s."
        ),
        rows: rows(&runs),
        notes: vec![
            "How the pilot drove is not printed; ours goes as far as three links of this radio reach. The published losses \
             are of real antennas and are not held against ours. The firmware's limit is 50 dB and 10 dB more for an antenna \
             on the ground, as the base's and the waiting relay's are; when its relays took off is not printed."
                .to_owned(),
            format!(
                "At the limit: the mean within {AT_LAUNCH_DB} dB, twice the deviation of the filtered signal, whose first \
                 sample above the limit launches. Equal: within {EQUAL_DB} dB, in every run. Unequal: the interval of the \
                 ratio above {UNEQUAL}."
            ),
        ],
        tables: vec![table],
        ..Outcome::default()
    };
    outcome.draw("fig6", &picture(runs.first()))?;
    if let Some(recorded) = runs.first().and_then(|run| run.recorded.as_ref()) {
        outcome.pictures.push(("fig6-circuit".to_owned(), recorded.picture()?));
    }
    Ok(outcome)
}

fn rows(runs: &[Flown]) -> Vec<Row> {
    let whole: Vec<&Flown> = runs.iter().filter(|run| run.is_whole()).collect();
    let equal = whole.iter().filter(|run| run.spread_db.is_some_and(|spread| spread < EQUAL_DB)).count();
    let at_launch: Vec<f64> = runs.iter().flat_map(Flown::at_launch_db).collect();
    let launch_mean_db = at_launch.iter().sum::<f64>() / at_launch.len() as f64;
    let spreads: Vec<f64> = whole.iter().filter_map(|run| run.spread_db).collect();
    let worst: Vec<f64> = whole.iter().filter_map(|run| run.worst_db()).collect();
    let below = worst.iter().filter(|worst_db| **worst_db < S_MIN_DB).count();
    let ratios: Vec<f64> = whole.iter().map(|run| run.longest_over_shortest()).collect();
    let ratio_low = Estimate::of(&ratios).map_or(0.0, |ratio| ratio.interval().0);
    let launch_s = |relay: usize| -> Vec<f64> {
        runs.iter().filter_map(|run| run.launches_s.get(relay).copied()).collect()
    };
    let lags_s: Vec<f64> = runs.iter().flat_map(Flown::lags_s).collect();
    let launches: usize = runs.iter().map(|run| run.launches_s.len().saturating_sub(1)).sum();
    vec![
        Row::fact(
            "take-off of relay 1 and of relay 2",
            [1, 2].map(|relay| mean_with_interval(&launch_s(relay), 1, " s")).join("; "),
        ),
        Row::fact(
            "take-offs with the last link truly above the limit, and for how long it had been there",
            format!("{} of {launches}; {}", lags_s.len(), mean_with_interval(&lags_s, 1, " s")),
        ),
        Row::claim(
            &format!("runs in which all relays launch, none in the last {QUIET_S} s"),
            "all relays",
            format!("{} of {}", whole.len(), runs.len()),
            whole.len() == runs.len(),
        ),
        Row::claim(
            "true loss of the last link at a launch",
            "the limit (50 dB in the air, 60 dB on the ground)",
            mean_with_interval(&at_launch, 2, " dB"),
            (launch_mean_db - S_MIN_DB).abs() <= AT_LAUNCH_DB,
        ),
        Row::claim(
            "runs with three equal links at the end",
            "equal",
            format!("{equal} of {}, spread {}", whole.len(), mean_with_interval(&spreads, 2, " dB")),
            equal == whole.len(),
        ),
        Row::claim(
            "runs with all links below the limit at the end",
            "below",
            format!("{below} of {}, worst link {}", whole.len(), mean_with_interval(&worst, 2, " dB")),
            below == whole.len(),
        ),
        Row::claim(
            "spacing along the tunnel at the end, longest over shortest",
            "unequal",
            mean_with_interval(&ratios, 2, ""),
            ratio_low > UNEQUAL,
        ),
    ]
}

/// After Fig. 6B, a box for each link: the losses of all three are the same at the end.
fn picture(run: Option<&Flown>) -> Figure {
    const NAMES: [&str; RELAYS + 1] =
        ["from the head to relay 1", "from relay 1 to relay 2", "from relay 2 to the base"];
    let samples = run.map_or(&[][..], |run| run.samples.as_slice());
    let (low, high) = losses(samples);
    let axes = |(link, name): (usize, &&str)| Axes {
        title: format!("link {name}"),
        x: "time (s)".to_owned(),
        y: "loss (dB)".to_owned(),
        height: 150.0,
        shown: Some([(0.0, low), (DURATION_S, high)]),
        marks: std::iter::once(threshold(S_MIN_DB))
            .chain(loss_curves(samples, link..link + 1, true))
            .collect(),
        ..Axes::default()
    };
    Figure {
        title: "Losses of the three links, one run (Laclau 2021, Fig. 6B)".to_owned(),
        axes: NAMES.iter().enumerate().map(axes).collect(),
    }
}

/// The least and the largest loss of any link, as measured or true (dB).
fn losses(samples: &[Sample]) -> (f64, f64) {
    let links = samples.iter().flat_map(|sample| &sample.links);
    let values = links.flat_map(|link| [Some(link.true_db), link.raw_db, link.filtered_db]).flatten();
    values.map(f64::from).fold((S_MIN_DB, S_MIN_DB), |(low, high), db| (low.min(db), high.max(db)))
}
