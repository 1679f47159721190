//! Laclau 2021, Fig. 4F: how much relays move once the chain has converged.

use uchain_core::chain::equalize;
use uchain_sim::{
    analyse::{Tendency, tends_to_be_less},
    draw::figure::{Axes, Figure, Mark},
    mission::chain::Scenario,
    sweep::DesignError,
};

use super::{
    exploration::{END_S, Exploration, Flight, PRINTED, RunsByTreatment, S_MIN_DB, TREATMENTS},
    fig4d::SETUP,
};
use crate::{
    Item, Outcome, PaperError, Row, RunCache, Table,
    experiment::scenario,
    outcome::{cell, is_significant, mann_whitney, mean_with_interval},
};

pub(crate) const FIG4F: Item = Item {
    id: "fig4f",
    title: "spread of positions after convergence (Laclau 2021, Fig. 4F)",
    run: regenerate,
};

/// Of a relay; runs that did not converge or in which it did not fly have none.
fn spreads(runs: &[Flight], relay: usize) -> Vec<f64> {
    runs.iter().filter_map(|run| run.spread_m(relay)).collect()
}

/// The same in windows of 10 s at the end.
fn end_spreads(runs: &[Flight], relay: usize) -> Vec<f64> {
    runs.iter().filter_map(|run| run.end_spread_m(relay)).collect()
}

fn regenerate(cache: &RunCache) -> Result<Outcome, PaperError> {
    let mut single =
        Table::new("fig4f", &["reading", "treatment", "relay", "replicate", "spread_m", "end_spread_m"]);
    let mut table =
        Table::for_report(&["reading", "treatment", "relay", "spread (m)", "in 10 s, at the end (m)"]);
    let (mut rows, mut axes) = (Vec::new(), Vec::new());
    let exploration = cache.exploration()?;
    for (how, treated) in exploration.readings() {
        for relay in [1, 2] {
            rows.extend(verdicts(how, relay, treated));
            let samples: Vec<Vec<f64>> = treated.iter().map(|runs| end_spreads(runs, relay)).collect();
            for ((treatment, runs), sample) in TREATMENTS.iter().zip(treated).zip(&samples) {
                let words = [how.to_owned(), (*treatment).to_owned(), relay.to_string()];
                let both = [&spreads(runs, relay), sample].map(|sample| counted(sample));
                table.rows.push(words.iter().cloned().chain(both).collect());
                let row = |(replicate, run): (usize, &Flight)| {
                    let spreads = [run.spread_m(relay), run.end_spread_m(relay)].map(|m| cell(m, 4));
                    words.iter().cloned().chain([replicate.to_string()]).chain(spreads).collect()
                };
                single.rows.extend(runs.iter().enumerate().map(row));
            }
            let box_of = |(i, values): (usize, &Vec<f64>)| Mark::Distribution {
                colour: i,
                at: (i + 1) as f64,
                values: values.clone(),
            };
            axes.push(Axes {
                title: format!("relay {relay}, {how}"),
                y: "spread (m)".to_owned(),
                words: TREATMENTS.map(str::to_owned).to_vec(),
                height: 150.0,
                marks: samples.iter().enumerate().map(box_of).collect(),
                ..Axes::default()
            });
        }
    }
    for relay in [1, 2] {
        rows.push(Row::fact(
            &format!("K without optic flow (A = 0), coded, relay {relay}, in 10 s, at the end"),
            counted(&end_spreads(&exploration.without_flow, relay)),
        ));
    }
    let notes = notes(exploration)?;
    let mut outcome = Outcome { setup: SETUP.to_owned(), rows, notes, ..Outcome::default() };
    outcome.tables = vec![table, single];
    let title = "Standard deviation of depths within 10 s at the end, 30 runs each (Laclau 2021, Fig. 4F)";
    outcome.draw("fig4f", &Figure { title: title.to_owned(), axes })?;
    Ok(outcome)
}

/// Mean, interval, and of how many.
fn counted(sample: &[f64]) -> String {
    match sample.len() {
        0 => "no run".to_owned(),
        1 => format!("{}, 1 run", mean_with_interval(sample, 3, "")),
        runs => format!("{}, {runs} runs", mean_with_interval(sample, 3, "")),
    }
}

fn notes(flown: &Exploration) -> Result<Vec<String>, PaperError> {
    let of_all = |relay: usize, has_fourth: bool| -> Vec<f64> {
        let all = flown.readings().flat_map(|(_, treated)| treated.iter().flatten());
        let chosen = all.filter(|run| run.fourth_s().is_some() == has_fourth);
        chosen.filter_map(|run| run.spread_m(relay)).collect()
    };
    let moved = [1, 2].map(|relay| {
        let [with, without] =
            [true, false].map(|has_fourth| mean_with_interval(&of_all(relay, has_fourth), 2, " m"));
        format!("relay {relay} {with} in runs with one and {without} in those without")
    });
    let of_readings = |(name, treated): (&str, &RunsByTreatment)| {
        let count =
            |runs: &Vec<Flight>| runs.iter().filter(|run| run.fourth_s().is_some()).count().to_string();
        format!("{} ({name})", treated.iter().map(count).collect::<Vec<_>>().join(", "))
    };
    let counts: Vec<String> = flown.readings().map(of_readings).collect();
    let still = |(_, treated): &(&str, &RunsByTreatment)| {
        let of = |i: usize| treated.get(i).map_or(Vec::new(), |runs| end_spreads(runs, 1));
        is_significant(tends_to_be_less(&of(2), &of(1)).map(|tendency| tendency.p))
    };
    let (still, readings) = (flown.readings().filter(still).count(), flown.readings().count());
    let [simulated_mm, printed_mm] = [&[][..], PRINTED].map(step_mm);
    Ok(vec![
        format!(
            "Judged and drawn is what noise does: the deviation of a depth (along the middle of the tunnel) within windows of \
             10 s, over the last {END_S} s, in runs in which nobody took off in them. The other measure is the deviation \
             from convergence or the head's stop, whichever is later, to the end, fourth launches and slow drift included."
        ),
        format!(
            "A fourth launch moves relays: by the second measure, over all runs, {}. So where treatments differ in fourth \
             launches that measure orders launches, not noise. Fourth launches under T0, T5 and K: {}.",
            moved.join(", "),
            counts.join("; ")
        ),
        format!(
            "1 dB of difference between two links at s_min becomes {:.1} mm a decision by the authors' speed law, and {:.1} mm \
             by Eq. 12 as printed. Once drift is left out, relay 1 moves less under K than under T5 by {still} of {readings} \
             readings (p < 0.05).",
            simulated_mm?, printed_mm?
        ),
    ])
}

/// How far a relay flies in one decision for 1 dB of difference between two links at the threshold of a launch (mm).
fn step_mm(sets: &[&str]) -> Result<f64, PaperError> {
    let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
    let read = Scenario::parse(&scenario("circuit-frontiers2021"), &sets).map_err(DesignError::from)?;
    let params = read.equalize;
    let speed_mps = equalize(S_MIN_DB as f32, S_MIN_DB as f32 - 1.0, &params);
    Ok(1000.0 * f64::from((speed_mps * params.decision_s).abs()))
}

fn verdicts(how: &str, relay: usize, treated: &RunsByTreatment) -> Vec<Row> {
    let order = |(large, small): (usize, usize)| {
        let (a, b) = (treated.get(small)?, treated.get(large)?);
        let whole = tends_to_be_less(&spreads(a, relay), &spreads(b, relay));
        let end = tends_to_be_less(&end_spreads(a, relay), &end_spreads(b, relay));
        let what = format!("{} above {}, relay {relay}, {how}", TREATMENTS[large], TREATMENTS[small]);
        let ours = format!("{}; since convergence {}", mann_whitney(end), mann_whitney(whole));
        Some(match end {
            Some(Tendency { p, .. }) => Row::claim(&what, "larger", ours, is_significant(Some(p))),
            None => Row::unjudged(&what, "larger", ours),
        })
    };
    [(0, 1), (1, 2)].into_iter().filter_map(order).collect()
}
