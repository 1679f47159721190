//! The formal part of Laclau 2021 (§4.1) checked numerically: does Eq. 12 converge to the optimum, how does the time to
//! converge scale with the length of the chain, and where do the conditions of the proof fail?

mod growth;
mod limits;
mod optimality;

use uchain_core::bounded;

use crate::{Item, Outcome, PaperError, RunCache};

pub(super) const FORMAL: Item = Item {
    id: "formal",
    title: "what is proved, and where the proof ends (Laclau 2021, Eq. 1, 2 and 9 to 12)",
    run: regenerate,
};

fn regenerate(_: &RunCache) -> Result<Outcome, PaperError> {
    let mut outcome = Outcome {
        setup: "The law of Eq. 12 without noise, decision by decision: every relay moves at the same time by a third of its \
                imbalance over k. No bodies, no sensors, no walls but for the radio."
            .to_owned(),
        ..Outcome::default()
    };
    optimality::add(&mut outcome);
    growth::add(&mut outcome)?;
    limits::add(&mut outcome)?;
    Ok(outcome)
}

/// One decision of all relays at once, the equalization law (Laclau 2021, Eq. 12): depths from the base (0, which stays)
/// to the head (which stays). A step is at most `step_max_m`.
fn equalize_all(
    depths_m: &mut [f64],
    links_db: &mut Vec<f64>,
    k_db_per_m: f64,
    step_max_m: f64,
    loss_db: &impl Fn(f64, f64) -> f64,
) {
    measure_links(depths_m, links_db, loss_db);
    let relays = depths_m.iter_mut().skip(1);
    for (relay, pair) in relays.zip(links_db.windows(2)) {
        // Toward the head if the link to it is the worse one.
        let step_m = (pair[1] - pair[0]) / (3.0 * k_db_per_m);
        *relay += bounded(step_m, -step_max_m, step_max_m);
    }
}

/// Losses of all links, that of the base first.
fn measure_links(depths_m: &[f64], links_db: &mut Vec<f64>, loss_db: &impl Fn(f64, f64) -> f64) {
    links_db.clear();
    links_db.extend(depths_m.windows(2).map(|pair| loss_db(pair[0], pair[1])));
}

/// The worst of some links (dB).
fn worst_db(links_db: &[f64]) -> f64 {
    links_db.iter().copied().fold(f64::NEG_INFINITY, f64::max)
}
