//! So much a wall, by what it is made of (COST 231).

use std::sync::Arc;

use super::Slopes;
use crate::{
    map::{Map, Material},
    radio::{Antenna, NO_LINK_DB, RadioKind, RadioModel, RadioParams},
};

/// The model "multi-wall": free space, and for each wall on the straight line what it takes (COST 231, final report, 4.7.2,
/// without its floors: a map has one). A wall is a stretch of rock, however thick. It takes what its map says of the
/// material; otherwise what a light or a heavy wall does, by the material's name, and a heavy one's where it has none. Of a
/// stretch with two faces the worse counts.
#[derive(Debug, Clone)]
pub struct MultiWall {
    free: Slopes,
    light_db: f32,
    heavy_db: f32,
}

/// Words for what partitions are made of that bear nothing (COST 231, light: plasterboard, particle board, thin concrete under
/// 10 cm, which a name does not say).
const LIGHT: [&str; 14] = [
    "plaster",
    "gypsum",
    "drywall",
    "board",
    "wood",
    "glass",
    "door",
    "window",
    "curtain",
    "cloth",
    "light",
    "thin",
    "partition",
    "foam",
];

impl MultiWall {
    /// Its word in a scenario.
    pub const WORD: &'static str = "multi-wall";

    pub(in crate::radio) const KIND: RadioKind = RadioKind::new(
        Self::WORD,
        "Free space and so much for each wall in the way, by its material (COST 231).",
        |params, _| Ok(Arc::new(Self::new(params))),
    );

    fn new(params: &RadioParams) -> Self {
        Self {
            free: Slopes::free_space(params, Self::WORD),
            light_db: params.wall_light_db,
            heavy_db: params.wall_heavy_db,
        }
    }

    /// What a wall of this material takes (dB).
    fn wall_db(&self, material: Option<&Material>) -> f32 {
        let Some(Material { name, loss_db }) = material else { return self.heavy_db };
        if let Some(loss_db) = loss_db {
            return loss_db.max(0.0);
        }
        let has = |word: &&str| {
            name.as_bytes().windows(word.len()).any(|at| at.eq_ignore_ascii_case(word.as_bytes()))
        };
        if LIGHT.iter().any(|word| has(&word)) { self.light_db } else { self.heavy_db }
    }
}

impl RadioModel for MultiWall {
    fn loss_db(&self, map: &Map, from: &Antenna, to: &Antenna) -> f32 {
        let free_db = self.free.db(from.at.distance(to.at));
        if free_db >= NO_LINK_DB {
            return free_db;
        }
        let mut walls_db = 0.0;
        map.each_wall_between(from.at, to.at, |faces| {
            let faces = faces.map(|face| face.map(|face| self.wall_db(map.material_of_wall(face))));
            let worse_db = match faces {
                [Some(a), Some(b)] => a.max(b),
                [Some(one), None] | [None, Some(one)] => one,
                [None, None] => self.heavy_db,
            };
            walls_db += worse_db;
        });
        free_db + walls_db
    }

    fn least_loss_db(&self, apart_m: f32) -> f32 {
        self.free.db(apart_m)
    }

    fn key(&self) -> Option<String> {
        // Maps of equal walls may be made of other stuff, which is not known here.
        None
    }
}
