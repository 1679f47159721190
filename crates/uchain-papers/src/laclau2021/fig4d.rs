//! Laclau 2021, Fig. 4D: losses over time under three treatments of the signal, and who launches.

use uchain_sim::{
    analyse::is_rarer_in_pairs,
    draw::figure::{Axes, Figure},
};

use super::{
    exploration::{
        DURATION_S, END_S, Exploration, Flight, REPLICATES, RunsByTreatment, S_MIN_DB, TREATMENTS,
    },
    page,
    trace::{loss_curves, threshold},
};
use crate::{
    Item, Outcome, Page, PaperError, Row, RunCache, Table,
    outcome::{cell, is_significant, mean_with_interval, p_value},
};

pub(crate) const FIG4D: Item = Item {
    id: "fig4d",
    title: "an exploration under three treatments of the signal (Laclau 2021, Fig. 4D)",
    run: regenerate,
};

/// On the right side of the threshold: above it for less than this share of the time, in the mean (%).
const ABOVE_PERCENT: f64 = 1.0;

pub(super) const SETUP: &str = "\
Scenario `circuit-frontiers2021`: all UAVs at the entrance, 0.13 m apart, three relays at hand, 120 s, 30 runs with the same \
noise under each treatment. T0: raw signal. T5: raw, tolerance 5 dB. K: Kalman filter. Three readings. *Coded*: the authors' \
simulator; launches on the filtered signal under every treatment; the head is at its final depth by 40 s (0.235 m/s), as in \
their runs. *Logged*: the same, but T0 and T5 launch on the raw signal, as the text has it and the published run of T0 shows. \
*Printed*: that, Eq. 12 with at most 0.3 m/s in place of the coded speed law, Eq. 22 without the coded detour by odometers, \
and a head that flies 0.2 m/s for 50 s.";

fn regenerate(cache: &RunCache) -> Result<Outcome, PaperError> {
    let flown = cache.exploration()?;
    let mut outcome = Outcome { setup: SETUP.to_owned(), notes: notes(flown), ..Outcome::default() };
    for (how, treated) in flown.readings() {
        outcome.rows.extend(launches(treated, how));
    }
    let mut table = Table::new(
        "fig4d",
        &[
            "reading",
            "treatment",
            "replicate",
            "launches",
            "fourth_s",
            "relays_needed",
            "share_above_after_stop",
        ],
    );
    for (how, treated) in flown.readings() {
        for (treatment, runs) in TREATMENTS.iter().zip(treated) {
            for (replicate, run) in runs.iter().enumerate() {
                table.rows.push(vec![
                    how.to_owned(),
                    (*treatment).to_owned(),
                    replicate.to_string(),
                    run.launches_s.len().to_string(),
                    cell(run.fourth_s(), 1),
                    run.relays_needed.map_or_else(String::new, |needed| needed.to_string()),
                    format!("{:.4}", run.share_above(run.stop_s)),
                ]);
            }
        }
    }
    outcome.tables.push(table);
    outcome.pages.push(Page { name: page::NAME.to_owned(), text: page::page(flown) });
    let axes =
        TREATMENTS.iter().zip(flown.logged()).filter_map(|(name, runs)| Some(loss_axes(name, runs.first()?)));
    let title = "Losses in an exploration, three treatments, one run each (Laclau 2021, Fig. 4D)".to_owned();
    outcome.draw("fig4d", &Figure { title, axes: axes.collect() })?;
    for (treatment, runs) in TREATMENTS.iter().zip(flown.logged()) {
        if let Some(recorded) = runs.first().and_then(|run| run.recorded.as_ref()) {
            outcome.pictures.push((format!("fig4d-{treatment}"), recorded.picture()?));
        }
    }
    Ok(outcome)
}

fn fourth_launches(runs: &[Flight]) -> usize {
    runs.iter().filter(|run| run.fourth_s().is_some()).count()
}

/// Fourth launches under each treatment, their order, and on which side of the threshold the chain is.
fn launches(treated: &RunsByTreatment, how: &str) -> Vec<Row> {
    let [t0, t5, k] = [0, 1, 2].map(|i| treated.get(i).map_or(&[][..], Vec::as_slice));
    let words = |runs: &[Flight]| {
        let late = runs.iter().filter(|run| run.is_late_fourth()).count();
        let wasteful = runs.iter().filter(|run| run.is_wasteful()).count();
        format!("{} of {} ({late} after the stop, {wasteful} unneeded)", fourth_launches(runs), runs.len())
    };
    let launched = |runs: &[Flight]| runs.iter().map(|run| run.fourth_s().is_some()).collect::<Vec<_>>();
    let p = is_rarer_in_pairs(&launched(k), &launched(t0));
    let is_seen = t0.iter().any(|run| run.fourth_s().is_some() && run.is_wasteful());
    let above = |runs: &[Flight]| -> Vec<f64> {
        runs.iter().map(|run| 100.0 * run.share_above(run.stop_s)).collect()
    };
    let late = |runs: &[Flight]| runs.iter().filter(|run| run.share_above(DURATION_S - END_S) > 0.0).count();
    let share = above(k).iter().sum::<f64>() / k.len() as f64;
    vec![
        Row::claim(&format!("fourth launches, {how}: T0"), "happen, unneeded", words(t0), is_seen),
        Row::fact(&format!("fourth launches, {how}: T5"), words(t5)),
        Row::claim(
            &format!("fourth launches, {how}: K, fewer than T0"),
            "fewer",
            format!("{}, McNemar {}", words(k), p_value(p)),
            is_significant(p),
        ),
        Row::claim(
            &format!("true losses on the right side of s_min, {how}: K"),
            "kept there",
            format!(
                "after the stop above it for {} of the time (T0 {}); in the last {END_S} s in {} of {} runs (T0 {})",
                mean_with_interval(&above(k), 1, " %"),
                mean_with_interval(&above(t0), 1, " %"),
                late(k),
                k.len(),
                late(t0)
            ),
            share < ABOVE_PERCENT,
        ),
    ]
}

/// Relays the best chain needs, over these runs.
fn needed(runs: &[Flight]) -> String {
    let needed = || runs.iter().filter_map(|run| run.relays_needed);
    match (needed().min(), needed().max()) {
        (Some(least), Some(most)) if least == most => least.to_string(),
        (Some(least), Some(most)) => format!("{least} to {most}"),
        _ => "a number not known of".to_owned(),
    }
}

fn notes(flown: &Exploration) -> Vec<String> {
    let reach = |runs: &[Flight]| {
        mean_with_interval(&runs.iter().map(|run| run.head_reach_m).collect::<Vec<_>>(), 1, " m")
    };
    let counts = |(name, treated): (&str, &RunsByTreatment)| {
        let counts: Vec<String> = treated.iter().map(|runs| fourth_launches(runs).to_string()).collect();
        format!("{} ({name})", counts.join(", "))
    };
    let counts: Vec<String> = flown.readings().map(counts).collect();
    vec![
        format!(
            "The head flies {} forward by its odometer (published: 10 m) and ends {} from the base by the shortest way, where \
             the best chain needs {} relays. With this project's default slowing near walls it would come {}, where the best \
             chain needs {}; the preset slows only nearer to a wall than the middle of this corridor.",
            mean_with_interval(&flown.coded().iter().map(|run| run.head_flown_m).collect::<Vec<_>>(), 1, " m"),
            reach(flown.coded()),
            needed(flown.coded()),
            reach(&flown.default_slowing),
            needed(&flown.default_slowing)
        ),
        note_on_stretching(flown.logged()),
        format!(
            "The grounded next UAV measures the last link. In the authors' code it filters it whatever the relays do; the \
             text speaks of a single raw value that launches. Fourth launches of {REPLICATES} runs each under T0, T5 and \
             K: {} (published: one run of T0, at 80 s).",
            counts.join("; ")
        ),
        note_on_optic_flow(flown.coded(), &flown.without_flow),
        "Pictures are of the second reading. Dots are raw samples at a link's front end, which relays go by under T0 and T5; \
         solid lines what the filter makes of them under K."
            .to_owned(),
    ]
}

/// Whether the chain levels faster than the head stretches it.
fn note_on_stretching(treated: &[Vec<Flight>]) -> String {
    let stop_s = treated.first().and_then(|runs| runs.first()).map_or(0.0, |run| run.stop_s);
    let times = |runs: &Vec<Flight>| runs.iter().filter_map(Flight::head_within_s).collect::<Vec<f64>>();
    let of = |(treatment, runs): (&&str, &Vec<Flight>)| {
        format!("{} under {treatment}", mean_with_interval(&times(runs), 1, " s"))
    };
    let words: Vec<String> = TREATMENTS.iter().zip(treated).map(of).collect();
    let is_late = treated.iter().all(|runs| times(runs).iter().all(|within_s| *within_s > stop_s));
    let verdict = if is_late {
        "is stretched faster than it levels in every run: the assumption of §4.3 does not hold there"
    } else {
        "is within s_min at the stop in some runs: there the assumption of §4.3 holds"
    };
    format!(
        "By the second reading the head's link is not above s_min any more, from the stop at {stop_s} s on, after {}. The chain \
         {verdict}.",
        words.join(", ")
    )
}

/// What optic flow has to do with fourth launches of K.
fn note_on_optic_flow(with: &[Flight], without: &[Flight]) -> String {
    let launched = |runs: &[Flight]| runs.iter().map(|run| run.fourth_s().is_some()).collect::<Vec<_>>();
    let [fewer, more] =
        [(without, with), (with, without)].map(|(a, b)| is_rarer_in_pairs(&launched(a), &launched(b)));
    let (p, verdict) = if is_significant(fewer) {
        (
            fewer,
            "optic flow launches them: it drives the links between UAVs and not that to the base \
             (`link.base_flow = false`, the authors' setting), so a relay that advances overshoots, and the loss of its base \
             link passes s_min for a moment",
        )
    } else if is_significant(more) {
        (more, "optic flow prevents them: it shows a relay the loss before it is there")
    } else {
        (fewer, "optic flow makes no difference that shows")
    };
    format!(
        "Fourth launches of K as coded: {} of {} runs with optic flow, {} of {} without (A = 0), McNemar \
         {}: {verdict}.",
        fourth_launches(with),
        with.len(),
        fourth_launches(without),
        without.len(),
        p_value(p)
    )
}

fn loss_axes(name: &str, run: &Flight) -> Axes {
    let launches: Vec<String> = run.launches_s.iter().map(|at_s| format!("{at_s:.1}")).collect();
    let is_filtered = name == "K";
    Axes {
        title: format!("{name}, launches at {} s", launches.join(", ")),
        x: "time (s)".to_owned(),
        y: "loss of the link toward the base (dB)".to_owned(),
        height: 210.0,
        marks: std::iter::once(threshold(S_MIN_DB))
            .chain(loss_curves(&run.samples, 0..usize::MAX, is_filtered))
            .collect(),
        ..Axes::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Runs of which so many launch a fourth UAV.
    fn runs(fourth: usize) -> Vec<Flight> {
        let run = |i: usize| Flight {
            samples: Vec::new(),
            recorded: None,
            stop_s: 40.0,
            launches_s: if i < fourth { vec![0.0, 14.0, 48.0, 70.0] } else { vec![0.0, 14.0, 48.0] },
            relays_used: if i < fourth { 3 } else { 2 },
            relays_needed: Some(2),
            head_reach_m: 9.7,
            head_flown_m: 10.0,
        };
        (0..30).map(run).collect()
    }

    #[test]
    fn what_is_said_of_optic_flow_follows_the_launches() {
        assert!(
            note_on_optic_flow(&runs(8), &runs(0)).contains("8 of 30 runs with optic flow, 0 of 30 without")
        );
        assert!(note_on_optic_flow(&runs(8), &runs(0)).contains("optic flow launches them"));
        assert!(note_on_optic_flow(&runs(0), &runs(8)).contains("optic flow prevents them"));
        assert!(note_on_optic_flow(&runs(0), &runs(0)).contains("no difference that shows"));
        assert!(
            note_on_optic_flow(&runs(2), &runs(0)).contains("no difference that shows"),
            "two runs are chance"
        );
    }
}
