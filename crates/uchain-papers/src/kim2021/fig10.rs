//! Kim 2021, Fig. 10: three strategies in an apartment.

use super::comparison::{AGREEMENT_RULE, Claim, Comparison, DISTANCE, ITERATIONS};
use crate::{Item, Outcome, PaperError, RunCache};

pub(crate) const FIG10: Item =
    Item { id: "fig10", title: "three strategies in an apartment (Kim 2021, Fig. 10)", run: regenerate };

pub(super) const CLAIMS: [Claim; 4] = [
    Claim { pair: [0, 1], metric: ITERATIONS, range: Some([5.41, 11.71]) },
    Claim { pair: [0, 1], metric: DISTANCE, range: Some([4.16, 13.65]) },
    Claim { pair: [1, 2], metric: ITERATIONS, range: Some([1.42, 6.36]) },
    Claim { pair: [1, 2], metric: DISTANCE, range: Some([2.55, 5.92]) },
];

fn regenerate(_: &RunCache) -> Result<Outcome, PaperError> {
    let title = "Three strategies in the apartment, means of 20 runs (Kim 2021, Fig. 10)";
    let comparison = Comparison::published("apartment")?;
    let mut outcome = comparison.outcome("fig10", title, &CLAIMS)?;
    outcome.rows.extend([ITERATIONS, DISTANCE].map(|metric| comparison.grows([1, 2], metric)));
    outcome.notes = vec![
        AGREEMENT_RULE.to_owned(),
        comparison.levels_alone(),
        format!(
            "{}; one that is parked or holds is passed on another level, without which the strategy deadlocks. How often and \
             for how long robots of the published `srg` held is not printed.",
            comparison.holding()
        ),
    ];
    Ok(outcome)
}
