//! Kim 2021, Fig. 11: three strategies in corridors.

use super::comparison::{Claim, Comparison, DISTANCE, ITERATIONS, JUDGED};
use crate::paper::{Flights, Item, Outcome, PaperError};

pub(in crate::paper) const FIG11: Item =
    Item { id: "fig11", title: "three strategies in corridors (Kim 2021, Fig. 11)", run: regenerate };

const CLAIMS: [Claim; 6] = [
    Claim { pair: [0, 2], metric: ITERATIONS, range: Some([8.94, 11.05]) },
    Claim { pair: [0, 2], metric: DISTANCE, range: Some([12.23, 14.71]) },
    Claim { pair: [0, 1], metric: ITERATIONS, range: None },
    Claim { pair: [0, 1], metric: DISTANCE, range: None },
    Claim { pair: [1, 2], metric: ITERATIONS, range: None },
    Claim { pair: [1, 2], metric: DISTANCE, range: None },
];

fn regenerate(_: &Flights) -> Result<Outcome, PaperError> {
    let title = "Three strategies in corridors, means of 20 runs (Kim 2021, Fig. 11)";
    let mut outcome = Comparison::fly("corridors")?.outcome("fig11", title, &CLAIMS)?;
    outcome.notes = vec![
        JUDGED.to_owned(),
        "The map is ours; the published one's size, corridors and branches are not printed.".to_owned(),
        "Less distance is saved than published. Holding costs `srg` rounds but no way, so it is not what 12 to 15 % of \
         distance come from; what the published `srg` flew in vain cannot be told from the text."
            .to_owned(),
    ];
    Ok(outcome)
}
