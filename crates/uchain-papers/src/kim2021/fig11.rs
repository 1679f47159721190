//! Kim 2021, Fig. 11: three strategies in corridors.

use super::comparison::{AGREEMENT_RULE, Claim, Comparison, DISTANCE, ITERATIONS};
use crate::{Item, Outcome, PaperError, RunCache};

pub(crate) const FIG11: Item =
    Item { id: "fig11", title: "three strategies in corridors (Kim 2021, Fig. 11)", run: regenerate };

/// Distance saved over `srg`, as published (%).
const DISTANCE_SAVED: [f64; 2] = [12.23, 14.71];

pub(super) const CLAIMS: [Claim; 6] = [
    Claim { pair: [0, 2], metric: ITERATIONS, range: Some([8.94, 11.05]) },
    Claim { pair: [0, 2], metric: DISTANCE, range: Some(DISTANCE_SAVED) },
    Claim { pair: [0, 1], metric: ITERATIONS, range: None },
    Claim { pair: [0, 1], metric: DISTANCE, range: None },
    Claim { pair: [1, 2], metric: ITERATIONS, range: None },
    Claim { pair: [1, 2], metric: DISTANCE, range: None },
];

fn regenerate(_: &RunCache) -> Result<Outcome, PaperError> {
    let title = "Three strategies in corridors, means of 20 runs (Kim 2021, Fig. 11)";
    let comparison = Comparison::published("corridors")?;
    let mut outcome = comparison.outcome("fig11", title, &CLAIMS)?;
    let [least, most] = DISTANCE_SAVED;
    let [saved, ..] = comparison.saved_mean([0, 2], DISTANCE);
    let beside = match saved {
        saved if saved < least => "less than",
        saved if saved > most => "more than",
        _ => "within",
    };
    outcome.notes = vec![
        AGREEMENT_RULE.to_owned(),
        "The map is ours; the published one's size, corridors and branches are not printed.".to_owned(),
        format!(
            "Of distance {saved:.1} % is saved in the mean over 2 to 5 robots, {beside} the published {least} to {most} %. {}. \
             What the published `srg` flew in vain cannot be told from the text.",
            comparison.holding()
        ),
    ];
    Ok(outcome)
}
