//! How hard it is to be heard from tile to tile, as the SubT simulator has it.

use std::{
    collections::{BTreeMap, VecDeque},
    sync::Arc,
};

use super::Slopes;
use crate::{
    map::{HeardAcross, Map, MapError},
    radio::{Antenna, NO_LINK_DB, RadioError, RadioKind, RadioModel, RadioParams},
};

/// Most tiles: of each pair of them a cost is kept.
const MOST_TILES: usize = 3_000;

/// The model "visibility" (the SubT simulator's `VisibilityRfModel` without breadcrumbs): by distance, with an exponent that
/// grows by `radio.exponent_per_cost` for each unit of what the map's graph says it costs to be heard from tile to tile, along
/// the cheapest way; no link beyond `radio.cost_max`.
#[derive(Debug, Clone)]
pub struct Visibility {
    line: Slopes,
    per_cost: f32,
    /// Side of a tile (m), and the map's own numbers of tiles by column and row.
    tile_m: f64,
    tiles: BTreeMap<[i32; 2], usize>,
    /// Of each tile to each, those beyond the most as [`u8::MAX`].
    costs: Vec<u8>,
}

impl Visibility {
    /// Its word in a scenario.
    pub const WORD: &'static str = "visibility";

    pub(in crate::radio) const KIND: RadioKind = RadioKind::new(
        Self::WORD,
        "By distance and what the graph of a SubT layout says it costs to be heard across its tiles (SubT simulator).",
        |params, map| Ok(Arc::new(Self::new(params, map)?)),
    );

    fn new(params: &RadioParams, map: &Map) -> Result<Self, RadioError> {
        let passages = map.heard_across();
        let Some(tile_m) = passages.first().map(|passage| passage.tile_m) else {
            return Err(RadioError::Value {
                key: "model",
                got: format!("\"{}\"", Self::WORD),
                expected: "a map.subt with a graph beside it (.dot), which says what it costs to be heard"
                    .to_owned(),
            });
        };
        let mut tiles = BTreeMap::new();
        let mut joined: Vec<Vec<(usize, u32)>> = Vec::new();
        for HeardAcross { tiles: [a, b], cost, .. } in passages {
            let [a, b] = [a, b].map(|tile| {
                let next = tiles.len();
                *tiles.entry(*tile).or_insert(next)
            });
            joined.resize_with(tiles.len(), Vec::new);
            joined[a].push((b, *cost));
            joined[b].push((a, *cost));
        }
        if tiles.len() > MOST_TILES {
            let cause = MapError::Count { what: "tiles", got: tiles.len(), least: 1, most: MOST_TILES };
            return Err(RadioError::Map { key: "model", cause });
        }
        let costs = (0..tiles.len()).flat_map(|from| cheapest(&joined, from, params.cost_max)).collect();
        let line = Slopes::log_distance(params, Self::WORD);
        Ok(Self { line, per_cost: params.exponent_per_cost, tile_m, tiles, costs })
    }

    fn tile(&self, map: &Map, antenna: &Antenna) -> Option<usize> {
        let at = map.to_file(antenna.at).map(|at_m| (at_m / self.tile_m).round() as i32);
        self.tiles.get(&at).copied()
    }

    /// What it costs to be heard; `None` where nobody is.
    fn cost(&self, map: &Map, from: &Antenna, to: &Antenna) -> Option<u8> {
        let (from, to) = (self.tile(map, from)?, self.tile(map, to)?);
        self.costs.get(from * self.tiles.len() + to).copied().filter(|&cost| cost < u8::MAX)
    }
}

/// What the cheapest way from a tile to each costs.
fn cheapest(joined: &[Vec<(usize, u32)>], from: usize, most: u32) -> Vec<u8> {
    let mut costs = vec![u8::MAX; joined.len()];
    costs[from] = 0;
    // Costs are few and small: who is reached more cheaply is looked at again.
    let mut open = VecDeque::from([from]);
    while let Some(tile) = open.pop_front() {
        for &(next, cost) in &joined[tile] {
            let there = u32::from(costs[tile]).saturating_add(cost);
            if there <= most && there < u32::from(costs[next]) {
                costs[next] = there as u8;
                open.push_back(next);
            }
        }
    }
    costs
}

impl RadioModel for Visibility {
    fn loss_db(&self, map: &Map, from: &Antenna, to: &Antenna) -> f32 {
        let apart_m = from.at.distance(to.at);
        let line_db = self.line.db(apart_m);
        match self.cost(map, from, to) {
            Some(cost) if line_db < NO_LINK_DB => {
                line_db + self.line.more_db(apart_m, self.per_cost * f32::from(cost))
            }
            _ => NO_LINK_DB,
        }
    }

    fn least_loss_db(&self, apart_m: f32) -> f32 {
        self.line.db(apart_m)
    }

    fn key(&self) -> Option<String> {
        // Of equal walls there may be other graphs, which are not known here.
        None
    }
}
