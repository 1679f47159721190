//! How much of the map is in reach.

use serde::Serialize;

use crate::mission::chain::Everywhere;

/// Most numbers of relays that are listed.
const LISTED: u32 = 1_000;

/// The share of the map's free area that is in reach, by relays.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Reach {
    /// Free area, what no way joins with the base included (m²).
    pub free_area_m2: f64,
    /// Share of it that a way joins with the base (1).
    pub share_joined: f64,
    /// The most relays that any place needs which is in reach at all; `None` if none is.
    pub relays_most: Option<u32>,
    /// Share in reach with 0, 1, 2, … relays (1).
    pub share_within: Vec<f64>,
    /// Side of the cells that were looked at (m).
    pub cell_m: f64,
}

impl Reach {
    /// Of all places.
    pub fn of(everywhere: &Everywhere) -> Self {
        let relays_most = everywhere.relays_most();
        let listed = relays_most.map_or(0, |most| most.min(LISTED) + 1);
        Self {
            free_area_m2: everywhere.free_area_m2,
            share_joined: everywhere.share_joined(),
            relays_most,
            share_within: (0..listed).map(|relays| everywhere.share_within(relays)).collect(),
            cell_m: everywhere.cell_m.into(),
        }
    }
}
