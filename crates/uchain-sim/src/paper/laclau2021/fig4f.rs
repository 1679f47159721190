//! Laclau 2021, Fig. 4F: how much relays move once the chain has converged.

use super::{
    exploration::{END_S, Flight, TREATMENTS, Treated},
    fig4d::SETUP,
};
use crate::{
    analyse::{Tendency, tends_to_be_less},
    draw::figure::{Axes, Figure, Mark},
    paper::{
        Flights, Item, Outcome, PaperError, Row, Table,
        outcome::{cell, is_significant, shown, tendency},
    },
};

pub(in crate::paper) const FIG4F: Item = Item {
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

fn regenerate(flights: &Flights) -> Result<Outcome, PaperError> {
    let mut single =
        Table::new("fig4f", &["reading", "treatment", "relay", "replicate", "spread_m", "end_spread_m"]);
    let mut table = Table::shown(&["reading", "treatment", "relay", "spread (m)", "in 10 s, at the end (m)"]);
    let (mut rows, mut axes) = (Vec::new(), Vec::new());
    let exploration = flights.exploration()?;
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
            &format!("K without optic flow (A = 0), authors' simulator, relay {relay}, in 10 s, at the end"),
            counted(&end_spreads(&exploration.without_flow, relay)),
        ));
    }
    let mut outcome = Outcome { setup: SETUP.to_owned(), rows, notes: notes(), ..Outcome::default() };
    outcome.tables = vec![table, single];
    let title = "Standard deviation of depths within 10 s at the end, 30 runs each (Laclau 2021, Fig. 4F)";
    outcome.draw("fig4f", &Figure { title: title.to_owned(), axes })?;
    Ok(outcome)
}

/// Mean, interval, and of how many.
fn counted(sample: &[f64]) -> String {
    match sample.len() {
        0 => "no run".to_owned(),
        1 => format!("{}, 1 run", shown(sample, 3, "")),
        runs => format!("{}, {runs} runs", shown(sample, 3, "")),
    }
}

fn notes() -> Vec<String> {
    vec![
        format!(
            "Judged and drawn is what noise does: the deviation of a depth (along the middle of the tunnel) within windows of \
             10 s, over the last {END_S} s, in runs in which nobody took off in them. The other measure is the deviation \
             from convergence or the head's stop, whichever is later, to the end, fourth launches and slow drift included."
        ),
        "A fourth launch moves all relays, the last one (relay 2) most. So with raw launches relay 2 shows the published \
         order by the second measure because T0 and T5 always launch a fourth UAV and K seldom: an order of launches, not \
         of noise."
            .to_owned(),
        "The authors' speed law turns 1 dB of difference into about 5 mm a decision, so a raw sample moves a relay little, \
         and successive errors cancel along its way; Eq. 12 as printed turns 1 dB into 13 mm (k = 25 dB/m). That relay 1 \
         moves least under K shows by every reading once drift is left out."
            .to_owned(),
    ]
}

fn verdicts(how: &str, relay: usize, treated: &Treated) -> Vec<Row> {
    let order = |(large, small): (usize, usize)| {
        let (a, b) = (treated.get(small)?, treated.get(large)?);
        let whole = tends_to_be_less(&spreads(a, relay), &spreads(b, relay));
        let end = tends_to_be_less(&end_spreads(a, relay), &end_spreads(b, relay));
        let what = format!("{} above {}, relay {relay}, {how}", TREATMENTS[large], TREATMENTS[small]);
        let ours = format!("{}; since convergence {}", tendency(end), tendency(whole));
        Some(match end {
            Some(Tendency { p, .. }) => Row::claim(&what, "larger", ours, is_significant(Some(p))),
            None => Row::unjudged(&what, "larger", ours),
        })
    };
    [(0, 1), (1, 2)].into_iter().filter_map(order).collect()
}
