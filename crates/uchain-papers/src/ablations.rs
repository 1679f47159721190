//! Ablation study: what every part is worth, one parameter varied at a time.

use std::sync::Arc;

use uchain_sim::{
    analyse::{Estimate, is_less_in_pairs},
    draw::figure::{Axes, Figure, Mark},
    mission::chain::{Course, Summary},
    registry::Registry,
    run::run,
    sweep::report::key_in_words,
};

use super::{
    Item, Outcome, PaperError, RunCache, Table,
    experiment::{Experiment, each_run, scenario},
    outcome::{cell, mean_with_interval, p_value},
};

pub(crate) const ABLATIONS: Item =
    Item { id: "ablations", title: "one thing varied at a time (this project's defaults)", run: regenerate };

const REPLICATES: u64 = 30;
/// Below this p a difference counts as shown: 5 % over about 50 comparisons (Bonferroni correction for multiple tests).
const SIGNIFICANCE_LEVEL: f64 = 0.001;
/// Length of a run (s). A run that never converges counts with it: its convergence takes that long at least (censored data).
const DURATION_S: f64 = 120.0;

/// One key, or two: then every value of the second one is a line.
struct Ablation {
    id: &'static str,
    title: &'static str,
    key: &'static str,
    values: &'static [&'static str],
    /// What is compared with, in every line.
    default: usize,
    lines: Option<(&'static str, &'static [&'static str])>,
}

const fn ablation(
    id: &'static str,
    title: &'static str,
    key: &'static str,
    values: &'static [&'static str],
    default: usize,
) -> Ablation {
    Ablation { id, title, key, values, default, lines: None }
}

const LIST: [Ablation; 10] = [
    ablation("flow", "without and with optic flow (A)", "kalman.flow_gain_db_per_m", &["0", "10.7"], 1),
    Ablation {
        lines: Some(("link.gap", &["\"hold\"", "\"predict\""])),
        ..ablation(
            "loss",
            "packets lost, held and predicted",
            "packets.drop_rate",
            &["0", "0.2", "0.4", "0.6"],
            1,
        )
    },
    ablation("sigma", "noise of the radio", "radio.sigma_db", &["0", "1", "2", "3", "5", "7", "10"], 3),
    ablation(
        "gain",
        "A times 0.2 to 5",
        "kalman.flow_gain_db_per_m",
        &["2.14", "5.35", "10.7", "21.4", "53.5"],
        2,
    ),
    ablation("k", "k of Eq. 12", "equalize.k_db_per_m", &["6", "10", "15", "25", "40", "64", "100"], 3),
    ablation(
        "rate",
        "decisions at 20, 10, 5, 2 and 1 Hz",
        "equalize.decision_s",
        &["0.05", "0.1", "0.2", "0.5", "1"],
        2,
    ),
    ablation("tof", "noise of the ToF sensors", "tof.noise_m", &["0", "0.01", "0.03", "0.1", "0.2"], 1),
    ablation(
        "law",
        "the three speed laws",
        "equalize.law",
        &["\"lipschitz\"", "\"inverse-model\"", "\"bang-bang\""],
        0,
    ),
    ablation(
        "hold",
        "how long s_min must be exceeded",
        "takeoff.launch_hold_s",
        &["0", "0.4", "1", "2", "4"],
        2,
    ),
    ablation("tolerance", "tolerance T", "equalize.tolerance_db", &["0", "2", "5", "8"], 0),
];

/// How a comparison begins that shows a faster convergence.
const FASTER: &str = "faster";

/// What is compared: name, digits, and how it is read from a summary.
type Metric = (&'static str, usize, fn(&Summary) -> Option<f64>);
const METRICS: [Metric; 8] = [
    ("convergence (s)", 1, |s| Some(s.converged_s.unwrap_or(DURATION_S))),
    ("never level (runs)", 0, |s| Some(if s.converged_s.is_none() { 1.0 } else { 0.0 })),
    ("spread at the end (dB)", 2, |s| s.spread_db.map(f64::from)),
    ("relays too many", 2, |s| Some(s.relays_used.saturating_sub(s.relays_needed?) as f64)),
    ("relays too few", 2, |s| Some(s.relays_needed?.saturating_sub(s.relays_used) as f64)),
    ("head reach (m)", 2, |s| Some(s.head_reach_m.into())),
    ("worst link (dB)", 1, |s| s.worst_link_db.map(f64::from)),
    ("wall contacts", 2, |s| Some(s.wall_contacts.into())),
];

/// Those that are drawn.
const DRAWN: [&str; 4] = ["convergence (s)", "spread at the end (dB)", "relays too many", "relays too few"];

fn sample(runs: &[Summary], metric: &Metric) -> Vec<f64> {
    runs.iter().filter_map(metric.2).collect()
}

fn regenerate(_: &RunCache) -> Result<Outcome, PaperError> {
    let mut outcome = Outcome {
        setup: format!(
            "Scenario `corner` with this project's defaults (not the authors' settings), {REPLICATES} runs of every value \
             with the same noise; a run that never converges counts as {DURATION_S} s. The last column compares \
             convergence with the default's, `predict` with `hold` at the same loss, in pairs (t test, p of both sides); \
             shown below p = {SIGNIFICANCE_LEVEL}, 5 % over some 50 comparisons."
        ),
        ..Outcome::default()
    };
    let (mut shorter, mut needless) = (Vec::new(), Vec::new());
    for ablation in &LIST {
        let lines: &[&str] = ablation.lines.map_or(&[""], |(_, values)| values);
        let mut vary = vec![format!("{}={}", ablation.key, ablation.values.join(","))];
        if let Some((key, values)) = ablation.lines {
            vary.push(format!("{key}={}", values.join(",")));
        }
        let experiment =
            Experiment { source: scenario("corner"), sets: &[], vary: &vary, replicates: REPLICATES };
        let flown = each_run(experiment, |course: &Arc<Course>, one| run(course, one.seed, &mut ()))?;
        let at =
            |value: usize, line: usize| flown.get(value * lines.len() + line).map_or(&[][..], Vec::as_slice);
        let keys = || std::iter::once(ablation.key).chain(ablation.lines.map(|(key, _)| key));
        let header: Vec<&str> =
            keys().chain(METRICS.iter().map(|metric| metric.0)).chain(["convergence compared"]).collect();
        let header_csv: Vec<&str> =
            keys().chain(["replicate"]).chain(METRICS.iter().map(|metric| metric.0)).collect();
        let mut table = Table::for_report(&header);
        let mut single = Table::new(&format!("ablations-{}", ablation.id), &header_csv);
        for (l, line) in lines.iter().enumerate() {
            for (v, value) in ablation.values.iter().enumerate() {
                let runs = at(v, l);
                let words = [Some(*value), ablation.lines.map(|_| *line)];
                let words: Vec<String> =
                    words.into_iter().flatten().map(|word| word.trim_matches('"').to_owned()).collect();
                let cells = METRICS.iter().map(|metric| match sample(runs, metric) {
                    never if metric.1 == 0 => format!("{:.0}", never.iter().sum::<f64>()),
                    sample => mean_with_interval(&sample, metric.1, ""),
                });
                // A second line with the first one at the same value; that one with the default.
                let other = if l > 0 {
                    Some((v, 0))
                } else {
                    (v != ablation.default).then_some((ablation.default, l))
                };
                let compared =
                    other.map_or_else(|| "–".to_owned(), |(v, l)| compared_in_pairs(runs, at(v, l)));
                if let Some((other_v, other_l)) = other
                    && compared.starts_with(FASTER)
                    && is_chain_shorter(runs, at(other_v, other_l))
                {
                    shorter.push(format!("`{}`", assignment(ablation, value, line)));
                }
                let too_many = runs
                    .iter()
                    .filter(|run| run.relays_needed.is_some_and(|needed| run.relays_used > needed))
                    .count();
                if too_many > 0 && 2 * too_many >= runs.len() {
                    let what = assignment(ablation, value, line);
                    needless.push(format!("`{what}` in {too_many} of {}", runs.len()));
                }
                table.rows.push(words.iter().cloned().chain(cells).chain([compared]).collect());
                for (replicate, run) in runs.iter().enumerate() {
                    let numbers = METRICS.iter().map(|metric| cell((metric.2)(run), 4));
                    let row = words.iter().cloned().chain([replicate.to_string()]).chain(numbers);
                    single.rows.push(row.collect());
                }
            }
        }
        outcome.draw(&format!("ablations-{}", ablation.id), &picture(ablation, lines, &at))?;
        outcome.tables.extend([table, single]);
    }
    let all = |found: &[String]| if found.is_empty() { "nowhere".to_owned() } else { found.join(", ") };
    outcome.notes = vec![
        format!(
            "Convergence counts from the start and begins anew with every launch. Where it is faster because the chain is \
             shorter, it is not better: the head is stopped on its way (*head reach*), or a relay too few is in the air \
             (*relays too few*). That is so with: {}.",
            all(&shorter)
        ),
        format!("A relay too many is in the air in half of the runs or more with: {}.", all(&needless)),
    ];
    Ok(outcome)
}

/// `key=value`, of one key or two.
fn assignment(ablation: &Ablation, value: &str, line: &str) -> String {
    let second = ablation.lines.map_or_else(String::new, |(key, _)| format!(" {key}={line}"));
    format!("{}={value}{second}", ablation.key).replace('"', "")
}

/// Whether the head comes less far, or fewer relays are in the air than are needed, than with others.
fn is_chain_shorter(runs: &[Summary], others: &[Summary]) -> bool {
    const LENGTHS: [fn(&Summary) -> Option<f64>; 2] =
        [|s| Some(s.relays_used as f64 - s.relays_needed? as f64), |s| Some(s.head_reach_m.into())];
    LENGTHS.iter().any(|length| {
        let of = |runs: &[Summary]| runs.iter().filter_map(length).collect::<Vec<f64>>();
        is_less_in_pairs(&of(runs), &of(others)).is_some_and(|p| p < SIGNIFICANCE_LEVEL)
    })
}

/// Whether convergence is faster or slower than that of others: paired t test, p of both sides.
fn compared_in_pairs(runs: &[Summary], others: &[Summary]) -> String {
    let [ours, theirs] = [runs, others].map(|runs| sample(runs, &METRICS[0]));
    let (faster, slower) = (is_less_in_pairs(&ours, &theirs), is_less_in_pairs(&theirs, &ours));
    let (Some(faster), Some(slower)) = (faster, slower) else { return "not known".to_owned() };
    let p = (2.0 * faster.min(slower)).min(1.0);
    let word = match p {
        p if p >= SIGNIFICANCE_LEVEL => "not shown",
        _ if faster < slower => FASTER,
        _ => "slower",
    };
    format!("{word}, {}", p_value(Some(p)))
}

fn picture<'a>(ablation: &Ablation, lines: &[&str], at: &impl Fn(usize, usize) -> &'a [Summary]) -> Figure {
    let axes = |metric: &Metric| {
        let line = |(l, line): (usize, &&str)| Mark::Estimates {
            name: line.trim_matches('"').to_owned(),
            colour: l,
            points: (0..ablation.values.len())
                .filter_map(|v| {
                    let aside = 0.08 * (l as f64 - 0.5 * (lines.len() - 1) as f64);
                    Some(((v + 1) as f64 + aside, Estimate::of_never_negative(&sample(at(v, l), metric))?))
                })
                .collect(),
        };
        Axes {
            x: key_in_words(Registry::default(), ablation.key),
            y: metric.0.to_owned(),
            words: ablation.values.iter().map(|value| value.trim_matches('"').to_owned()).collect(),
            height: 130.0,
            marks: lines.iter().enumerate().map(line).collect(),
            ..Axes::default()
        }
    };
    Figure {
        title: format!("{}: {REPLICATES} runs of each value", ablation.title),
        axes: METRICS.iter().filter(|metric| DRAWN.contains(&metric.0)).map(axes).collect(),
    }
}
