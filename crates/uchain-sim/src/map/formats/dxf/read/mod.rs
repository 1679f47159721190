//! A DXF drawing as walls, rock and free space, read by a small reader of its own: the crate `dxf` panics at some dates in a
//! header, and takes 340 MB for a file of 2 MB.

mod counts;
mod curves;
mod draw;
mod entity;
mod file;
mod join;
#[cfg(test)]
mod tests;

use std::path::Path;

use glam::DAffine2;

use self::{
    counts::Counts,
    draw::{Inserted, Pen},
    file::File,
};
use super::DxfConfig;
use crate::map::{Import, Map, MapError, RemarkKind, drawing::Drawing, raster};

/// Most bytes of a file.
const MOST_BYTES: u64 = 32 << 20;
/// From so many units on, a drawing that does not say its unit is taken to be in millimetres.
const LARGE_UNITS: f64 = 2000.0;

/// The map of a file.
pub(super) fn of_file(file: &Path, config: &DxfConfig) -> Result<Map, MapError> {
    let bytes =
        raster::read(file, MOST_BYTES).map_err(|why| MapError::Read { file: file.to_owned(), why })?;
    dxf_in_memory(file, &bytes, config)
}

/// A DXF drawing in memory as a map; `file` is what messages call it, whatever the file of `config` is.
///
/// # Errors
/// What is no DXF in text, or too much of it, with the line, what was expected and what helps; nothing is drawn that leaves free
/// space.
pub fn dxf_in_memory(file: &Path, bytes: &[u8], config: &DxfConfig) -> Result<Map, MapError> {
    let drawing = read(bytes, config).map_err(|why| MapError::Read { file: file.to_owned(), why })?;
    drawing.into_map()
}

fn read(bytes: &[u8], config: &DxfConfig) -> Result<Drawing, String> {
    if bytes.starts_with(b"AutoCAD Binary DXF") {
        return Err("it is a binary DXF; expected the text form: save it as ASCII DXF".into());
    }
    // Old files are in some code page: only names and texts are outside of ASCII.
    let text = String::from_utf8_lossy(bytes);
    let file = File::of(text.trim_start_matches('\u{feff}'))?;
    let mut import = Import::of(super::FORMAT.name);
    let unit_m = unit_m(&file, config, &mut import);
    let drawing = Drawing { outside: config.outside, snap_m: config.snap_m, import, ..Drawing::default() };
    let mut pen = Pen {
        file: &file,
        drawing,
        config,
        pieces: Vec::new(),
        counts: Counts::default(),
        visits: 0,
        corners: 0,
    };
    let whole =
        Inserted { to_metres: DAffine2::from_scale(glam::DVec2::splat(unit_m)), layer: None, depth: 0 };
    pen.all(&file.entities, &whole)?;
    pen.finished()
}

/// Metres of one unit, by the key, by the file, or else by how large it is.
fn unit_m(file: &File, config: &DxfConfig, import: &mut Import) -> f64 {
    if let Some(unit_m) = config.unit_m {
        import.say(RemarkKind::Read, 1, format!("unit: {unit_m} m, by unit_m"));
        return unit_m;
    }
    if let Some((name, unit_m)) = file.unit {
        import.say(RemarkKind::Read, 1, format!("unit: {name}, by $INSUNITS"));
        return unit_m;
    }
    let size = file.size();
    let (name, unit_m) = if size > LARGE_UNITS { ("millimetres", 1e-3) } else { ("metres", 1.0) };
    let what = format!(
        "unit: {name}, for the file names none and is {size:.0} units large; the key unit_m says another"
    );
    import.say(RemarkKind::Guessed, 1, what);
    unit_m
}
