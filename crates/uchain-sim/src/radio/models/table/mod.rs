//! Losses that somebody else worked out or measured, as a table between the places of a grid.

mod axis;
mod csv;
mod error;
mod grid;
#[cfg(feature = "maps")]
mod npz;
#[cfg(test)]
mod tests;
#[cfg(feature = "maps")]
mod zip;

use std::{fmt, fs::File, io::Read as _, ops::RangeInclusive, path::Path, sync::Arc};

use twox_hash::XxHash64;

use crate::{
    map::Map,
    radio::{Antenna, NO_LINK_DB, RadioError, RadioKind, RadioModel, RadioParams},
};

pub use error::TableError;
use grid::Grid;

/// Longest file (bytes).
const BYTES_MAX: u64 = 64 << 20;
/// Most places: of each pair of them a loss is kept, 4 million in all.
const PLACES_MAX: usize = 2048;
/// Losses there may be (dB).
const LOSS_DB: RangeInclusive<f32> = -50.0..=NO_LINK_DB;
/// Farthest place (m).
const FARTHEST_M: f64 = 1e9;

/// The model "table": losses between the places of a regular grid, read from `radio.table_file`, and the mean by distance
/// between them, in all four coordinates.
///
/// - What is not in the table has no link, but for a place to itself: that loses the least of what the table has from there.
/// - A place up to half a step beyond the grid counts as one at its edge; farther out there is no link.
/// - Where some of the 16 pairs around a link have no loss, it is the mean of the others, if these weigh half or more.
pub struct LossTable {
    grid: Grid,
    /// Where the map frame's origin lies in the table's frame, the scenario's own (m).
    offset_m: [f64; 2],
    /// How far a link reaches (m).
    range_m: f32,
    /// Of all that the file holds.
    hash: u64,
}

impl LossTable {
    /// Its word in a scenario.
    pub const WORD: &'static str = "table";

    pub(in crate::radio) const KIND: RadioKind = RadioKind::new(
        Self::WORD,
        "What radio.table_file says of pairs of places on a grid, such as those of a ray tracer.",
        |params, map| Ok(Arc::new(Self::make(params, map)?)),
    );

    fn make(params: &RadioParams, map: &Map) -> Result<Self, RadioError> {
        let Some(file) = &params.table_file else {
            return Err(RadioError::Value {
                key: "table_file",
                got: "nothing".to_owned(),
                expected: format!("the model \"{}\" needs a file, such as \"losses.csv\"", Self::WORD),
            });
        };
        let refused = |cause| RadioError::Table { file: file.clone(), cause };
        let bytes = bytes(Path::new(file)).map_err(refused)?;
        let grid = if is_npz(&bytes) { read_npz(&bytes) } else { csv::read(&bytes) };
        Ok(Self {
            grid: grid.map_err(refused)?,
            offset_m: map.offset_m(),
            range_m: params.range_m.unwrap_or(f32::INFINITY),
            hash: XxHash64::oneshot(0, &bytes),
        })
    }

    fn own(&self, antenna: &Antenna) -> [f64; 2] {
        let [x_m, y_m] = self.offset_m;
        [f64::from(antenna.at.x) + x_m, f64::from(antenna.at.y) + y_m]
    }
}

fn bytes(file: &Path) -> Result<Vec<u8>, TableError> {
    let mut bytes = Vec::new();
    let read = File::open(file).and_then(|file| file.take(BYTES_MAX + 1).read_to_end(&mut bytes));
    match read {
        Err(cause) => Err(TableError::Read { why: cause.to_string() }),
        Ok(_) if bytes.len() as u64 > BYTES_MAX => Err(TableError::TooLong),
        Ok(_) => Ok(bytes),
    }
}

/// Whether a file begins as an archive does; no text does.
fn is_npz(bytes: &[u8]) -> bool {
    bytes.starts_with(b"PK\x03\x04")
}

#[cfg(feature = "maps")]
use npz::read as read_npz;

#[cfg(not(feature = "maps"))]
fn read_npz(_: &[u8]) -> Result<Grid, TableError> {
    Err(TableError::NoNpz)
}

impl fmt::Debug for LossTable {
    /// Without millions of losses.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("LossTable").field("hash", &self.hash).finish_non_exhaustive()
    }
}

impl RadioModel for LossTable {
    fn loss_db(&self, _: &Map, from: &Antenna, to: &Antenna) -> f32 {
        // What is no distance is none that reaches.
        let apart_m = from.at.distance(to.at);
        if apart_m.is_nan() || apart_m > self.range_m {
            return NO_LINK_DB;
        }
        self.grid.loss_db(self.own(from), self.own(to))
    }

    fn least_loss_db(&self, apart_m: f32) -> f32 {
        if apart_m > self.range_m { NO_LINK_DB } else { self.grid.least_loss_db(apart_m.into()) }
    }

    fn key(&self) -> Option<String> {
        let Self { offset_m, range_m, hash, .. } = self;
        Some(format!("{} {hash:016x} {offset_m:?} {range_m:?}", Self::WORD))
    }
}
