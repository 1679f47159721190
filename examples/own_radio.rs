//! A radio of one's own: how much a link loses between two places in a map. The run, the optimum it is measured by and
//! plans ask the same model.
//!
//! `cargo run --release --example own_radio`
//!
//! ```text
//! path-loss: 8.1 of 8.8 m flown; 3 links within 60 dB, the worst 56.5 dB; its link held the head back for 4.8 s, 1.0 m
//! guide: 7.7 of 8.8 m flown; 2 links within 60 dB, the worst 43.7 dB; its link held the head back for 3.6 s, 1.3 m
//! ```

use std::{error::Error, sync::Arc};

use uchain_libm as _; // the same bits on every system
use uchain_sim::{
    config::builtin,
    map::Map,
    mission::{
        Scene as _,
        chain::{ChainExtensions, Course, Summary},
    },
    radio::{Antenna, RadioKind, RadioModel},
    registry::{AnyMission, Of, Registry},
};

/// A tunnel that guides waves: little is lost along it, and much at every wall in between.
#[derive(Debug)]
struct Guide {
    /// Loss along a metre of air (dB/m).
    air_db_per_m: f32,
    /// Loss through a metre of rock (dB/m).
    rock_db_per_m: f32,
}

impl RadioModel for Guide {
    /// In dB, bigger is worse. It knows no seed and no time: noise, fading and lost packets come after it.
    fn loss_db(&self, map: &Map, from: &Antenna, to: &Antenna) -> f32 {
        let length_m = from.at.distance(to.at);
        let rock_m = length_m * map.rock_fraction(from.at, to.at);
        35.0 + self.air_db_per_m * (length_m - rock_m) + self.rock_db_per_m * rock_m
    }

    /// Models of equal keys lose the same in equal maps: runs of a sweep then share the table of the optimum.
    fn key(&self) -> Option<String> {
        Some(format!("guide {:?} {:?}", self.air_db_per_m, self.rock_db_per_m))
    }
}

/// Its word in scenarios, `radio.model = "guide"`, what `uchain explain` says of it, and how it is made of the table
/// `[radio]`.
const GUIDE: RadioKind =
    RadioKind::new("guide", "Little loss along a tunnel, much through rock.", |table, _| {
        Ok(Arc::new(Guide { air_db_per_m: table.alpha_free, rock_db_per_m: 10.0 * table.alpha_wall }))
    });

/// The missions of this program: chains that know the word.
static MISSIONS: [&dyn AnyMission; 1] =
    [&Of::<Course>::with(ChainExtensions { radios: &[GUIDE], ..Course::BUILTIN })];

fn main() -> Result<(), Box<dyn Error>> {
    let registry = Registry::new(&MISSIONS);
    let corner = builtin("corner").ok_or("corner comes along")?;
    for model in ["path-loss", "guide"] {
        let scene = registry.read(&corner, &[format!("radio.model={model}")])?;
        let flown = scene.fly(1, &mut ())?;
        let summary = flown.summary::<Summary>().ok_or("a chain")?;
        println!("{model}: {}", summary.verdict);
    }
    Ok(())
}
