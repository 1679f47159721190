//! Maps of square cells, made into walls.

pub(super) mod cells;
mod contour;
#[cfg(feature = "maps")]
mod picture;
mod simplify;
#[cfg(all(test, feature = "maps"))]
mod tests;
#[cfg(feature = "maps")]
pub(super) mod words;

use std::{
    fs::{self, File},
    io::Read as _,
    path::Path,
};

use glam::DVec2;

use super::{Map, MapError};
use cells::Cells;

/// The edges between free cells and all others as walls, each within `simplify_m` of the cells' own edge. `place` takes
/// a corner, in cells from the lower left, to the file's own frame (m).
pub(super) fn to_map(
    cells: &Cells,
    cell_m: f64,
    simplify_m: f64,
    place: impl Fn(DVec2) -> DVec2,
    wrong: impl Fn(String) -> MapError,
) -> Result<Map, MapError> {
    let loops = contour::loops(cells).map_err(&wrong)?;
    loops_to_map(&loops, cell_m, simplify_m, place, wrong)
}

/// The same for loops that are there already, in cells from the lower left, with free space on their left. No two touch.
pub(super) fn loops_to_map(
    loops: &[Vec<DVec2>],
    cell_m: f64,
    simplify_m: f64,
    place: impl Fn(DVec2) -> DVec2,
    wrong: impl Fn(String) -> MapError,
) -> Result<Map, MapError> {
    let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    for &corner in loops.iter().flatten() {
        let at = place(corner);
        (low, high) = (low.min(at), high.max(at));
    }
    if !low.is_finite() {
        return Err(wrong("it has no free cell".to_owned()));
    }
    let middle = (low + high) / 2.0;
    let place = |corner: DVec2| (place(corner) - middle).as_vec2();
    let mut map = simplify::simplify(loops, simplify_m / cell_m, cell_m, place)?;
    map.offset_m = middle.into();
    Ok(map)
}

/// A whole file of at most `most` bytes. What is no plain file is not opened: a pipe may never begin.
pub(super) fn read(path: &Path, most: u64) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    let about = fs::metadata(path).map_err(|error| error.to_string())?;
    if !about.is_file() {
        return Err("not a file; expected a map".to_owned());
    }
    let file = File::open(path).map_err(|error| error.to_string())?;
    file.take(most + 1).read_to_end(&mut bytes).map_err(|error| error.to_string())?;
    if bytes.len() as u64 > most { Err(format!("more than {most} bytes")) } else { Ok(bytes) }
}
