//! A page on the exploration of Laclau 2021, Fig. 4D to F: what each reading of it comes to, in words and one table.

use std::fmt::Write as _;

use super::exploration::{Exploration, Flight, REPLICATES, RunsByTreatment, TREATMENTS};
use crate::outcome::mean_with_interval;

/// Its name in the folder of the docs.
pub(super) const NAME: &str = "fig4d-readings.md";

/// What each reading is.
const READINGS: &str = "\
* **Coded** is the authors' simulator: a relay flies a third of the distance that a path-loss model reads out of its two
  losses, at most 0.375 m/s; every take-off waits for the *filtered* loss of the base link, whatever the relays level by;
  take-offs take no time, and the head is at its final depth by 40 s. Radio loses 40 dB for every metre by which two
  UAVs' *odometers* differ from the straight line between them, and odometers drift.
* **Logged** is what their published run of T0 shows and their text says: under T0 and T5 a single raw value launches.
  All else is as coded.
* **Printed** is the text of the paper: raw launches under T0 and T5, Eq. 12, at most 0.3 m/s, Eq. 22 and nothing of a
  detour, a head at 0.2 m/s for 50 s.
";

const ENDING: &str = "\
## Where the numbers are from

Every cell is of 30 runs with the same noise under each treatment. The items `fig4d`, `fig4e` and `fig4f` of
[reproduction.md](reproduction.md) say how each claim is judged and give tests and intervals; `uchain paper fig4d fig4e
fig4f --out DIR` writes them again, with every run as CSV and pictures. T0 levels the raw signal, T5 the raw signal with a
tolerance of 5 dB, K the Kalman filter's. Moves are deviations of a relay's depth within windows of 10 s at the end, in
runs without a late launch. No value was set to bring a number nearer to a published one.
";

fn fourths(runs: &[Flight]) -> usize {
    runs.iter().filter(|run| run.fourth_s().is_some()).count()
}

fn times(runs: &[Flight]) -> Vec<f64> {
    runs.iter().filter_map(Flight::converged_s).collect()
}

fn of(treated: &RunsByTreatment, treatment: usize) -> &[Flight] {
    treated.get(treatment).map_or(&[], Vec::as_slice)
}

/// The page in Markdown. Its first paragraph stands in README word for word.
pub(super) fn page(flown: &Exploration) -> String {
    let mut text = format!("# Laclau 2021, Fig. 4D to F: three readings\n\n{}\n\n", in_short(flown));
    text += "| | published | ";
    let names: Vec<&str> = flown.readings().map(|(name, _)| name).collect();
    text += &names.join(" | ");
    text += " |\n|---|---|---|---|---|\n";
    for (treatment, name) in TREATMENTS.iter().enumerate() {
        let published = ["happen, unneeded", "–", "fewer than T0"].get(treatment).copied().unwrap_or("–");
        row(&mut text, flown, &format!("runs with a fourth launch, {name}"), published, |treated| {
            format!("{} of {REPLICATES}", fourths(of(treated, treatment)))
        });
    }
    for (treatment, name) in TREATMENTS.iter().enumerate() {
        let published = ["–", "slower than T0", "as T0, or faster"].get(treatment).copied().unwrap_or("–");
        row(&mut text, flown, &format!("level after, {name}"), published, |treated| {
            let runs = of(treated, treatment);
            let of_all = format!("{} of {}", times(runs).len(), runs.len());
            format!("{} ({of_all})", mean_with_interval(&times(runs), 1, " s"))
        });
    }
    for relay in [1, 2] {
        row(&mut text, flown, &format!("relay {relay} moves, T0, T5, K (cm)"), "falls", |treated| {
            let mean_cm = |runs: &Vec<Flight>| {
                let all: Vec<f64> = runs.iter().filter_map(|run| run.end_spread_m(relay)).collect();
                if all.is_empty() {
                    "–".to_owned()
                } else {
                    format!("{:.1}", 100.0 * all.iter().sum::<f64>() / all.len() as f64)
                }
            };
            treated.iter().map(mean_cm).collect::<Vec<_>>().join(", ")
        });
    }
    format!("{text}\n## The readings\n\n{READINGS}\n{ENDING}")
}

fn row(
    text: &mut String,
    flown: &Exploration,
    what: &str,
    published: &str,
    cell: impl Fn(&RunsByTreatment) -> String,
) {
    let cells: Vec<String> = flown.readings().map(|(_, treated)| cell(treated)).collect();
    // Writing to a String cannot fail.
    let _ = writeln!(text, "| {what} | {published} | {} |", cells.join(" | "));
}

/// Two sentences: what the figure shows, and by which reading.
fn in_short(flown: &Exploration) -> String {
    let of_readings = |count: fn(&[Flight]) -> usize, treatment: usize| {
        let counts: Vec<String> =
            flown.readings().map(|(_, treated)| count(of(treated, treatment)).to_string()).collect();
        counts.join(", ")
    };
    let names: Vec<&str> = flown.readings().map(|(name, _)| name).collect();
    let level: fn(&[Flight]) -> usize = |runs| times(runs).len();
    format!(
        "Laclau 2021, Fig. 4D to F, flown again by three readings ({}): of {REPLICATES} runs each a fourth UAV takes off in {} \
         without a filter (T0) and in {} with the Kalman filter (K), where the paper shows one of T0. Three links level in \
         {} runs of T0 and in {} of K, and in {} of K where the way between UAVs is the shortest one instead of the difference \
         of two odometers that drift.",
        names.join(", "),
        of_readings(fourths, 0),
        of_readings(fourths, 2),
        of_readings(level, 0),
        of_readings(level, 2),
        level(&flown.shortest_way)
    )
}
