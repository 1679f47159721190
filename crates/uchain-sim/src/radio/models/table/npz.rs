//! A table of losses as `numpy.savez` and `numpy.savez_compressed` write it: `x_m` (n), `y_m` (m), `loss_db` (m, n, m, n).

use super::{
    FARTHEST_M, LOSS_DB, PLACES_MAX, TableError,
    grid::{Grid, Places},
    zip::member,
};
use crate::config::shorten;

/// Reads the grid.
pub(super) fn read(bytes: &[u8]) -> Result<Grid, TableError> {
    let [x_m, y_m] = [Array::read(bytes, "x_m")?.line()?, Array::read(bytes, "y_m")?.line()?];
    let places = x_m.len().saturating_mul(y_m.len());
    if places > PLACES_MAX {
        return Err(TableError::TooManyPlaces);
    }
    let losses = Array::read(bytes, "loss_db")?;
    let shape = [y_m.len(), x_m.len(), y_m.len(), x_m.len()];
    if losses.shape != shape {
        return Err(
            losses.refuse(format!("shape {:?}: expected (m, n, m, n), which are {shape:?}", losses.shape))
        );
    }
    let place = |index: usize| [x_m[index % x_m.len()], y_m[index / x_m.len()]];
    let mut all = Places::default();
    for index in 0..places {
        all.add(place(index))?;
    }
    let mut grid = all.grid()?;
    for (index, loss_db) in losses.values.iter().map(|&loss_db| loss_db as f32).enumerate() {
        if loss_db.is_nan() {
            continue;
        }
        let (from, to) = (index / places, index % places);
        let here = || {
            let n = x_m.len();
            format!("[{}, {}, {}, {}]", from / n, from % n, to / n, to % n)
        };
        if !LOSS_DB.contains(&loss_db) {
            let why =
                format!("{} = {loss_db}: expected decibels from -50 to 2000, or NaN for no link", here());
            return Err(losses.refuse(why));
        }
        grid.put(place(from), place(to), loss_db).map_err(|other| {
            let why = format!(
                "{} = {loss_db}: the same two places have {other} elsewhere; expected the same both \
                               ways, within 0.001 dB",
                here()
            );
            losses.refuse(why)
        })?;
    }
    grid.whole()
}

/// An array, in the order of C.
struct Array {
    name: &'static str,
    shape: Vec<usize>,
    values: Vec<f64>,
}

impl Array {
    fn refuse(&self, why: String) -> TableError {
        TableError::Array { name: self.name, why }
    }

    /// The coordinates along an axis (m), each greater than the one before.
    fn line(self) -> Result<Vec<f64>, TableError> {
        if self.shape.len() != 1 || self.values.is_empty() {
            return Err(
                self.refuse(format!("shape {:?}: expected one dimension, and a value or more", self.shape))
            );
        }
        if let Some(far) = self.values.iter().find(|at_m| at_m.is_nan() || at_m.abs() > FARTHEST_M) {
            return Err(self.refuse(format!("{far}: expected metres, at most 1e9 from the origin")));
        }
        match self.values.windows(2).find(|pair| pair[1] <= pair[0]) {
            Some(pair) => Err(self.refuse(format!("{} after {}: expected them to grow", pair[1], pair[0]))),
            None => Ok(self.values),
        }
    }

    fn read(bytes: &[u8], name: &'static str) -> Result<Self, TableError> {
        let refuse = |why: String| TableError::Array { name, why };
        let bytes = member(bytes, &format!("{name}.npy"))?;
        let bytes = bytes.ok_or_else(|| refuse("missing: expected x_m, y_m and loss_db".to_owned()))?;
        let (header, data) = parts(&bytes).ok_or_else(|| refuse("not in numpy's format".to_owned()))?;
        let said = |key: &str| header.split_once(&format!("'{key}':")).map(|(_, rest)| rest.trim_start());
        let bytes_each = match said("descr") {
            Some(rest) if rest.starts_with("'<f8'") => 8,
            Some(rest) if rest.starts_with("'<f4'") => 4,
            rest => {
                let got = shorten(rest.unwrap_or("").split(',').next().unwrap_or(""));
                return Err(refuse(format!("type {got}: expected '<f4' or '<f8', float32 or float64")));
            }
        };
        if !said("fortran_order").is_some_and(|rest| rest.starts_with("False")) {
            return Err(refuse("in Fortran's order: expected numpy.ascontiguousarray of it".to_owned()));
        }
        let shape =
            said("shape").and_then(|rest| rest.strip_prefix('(')?.split_once(')')).map(|(shape, _)| shape);
        let sides = shape.unwrap_or("?").split(',').map(str::trim).filter(|side| !side.is_empty());
        let shape: Option<Vec<usize>> = sides.map(|side| side.parse().ok()).collect();
        let shape = shape.ok_or_else(|| refuse("its header has no shape".to_owned()))?;
        let count = shape.iter().try_fold(bytes_each, |bytes: usize, &side| bytes.checked_mul(side));
        if count != Some(data.len()) {
            return Err(refuse(format!("{} bytes: expected what a shape of {shape:?} takes", data.len())));
        }
        let values = data.chunks_exact(bytes_each).map(|bytes| match bytes.try_into() {
            Ok(eight) => f64::from_le_bytes(eight),
            Err(_) => bytes.try_into().map_or(f64::NAN, |four| f32::from_le_bytes(four).into()),
        });
        Ok(Self { name, shape, values: values.collect() })
    }
}

/// The header of an array in numpy's format, versions 1 to 3, and its data.
fn parts(bytes: &[u8]) -> Option<(&str, &[u8])> {
    let rest = bytes.strip_prefix(b"\x93NUMPY")?;
    let (&[version, _], rest) = rest.split_first_chunk::<2>()?;
    let (length, rest) = if version == 1 {
        let (length, rest) = rest.split_first_chunk::<2>()?;
        (usize::from(u16::from_le_bytes(*length)), rest)
    } else {
        let (length, rest) = rest.split_first_chunk::<4>()?;
        (u32::from_le_bytes(*length) as usize, rest)
    };
    let (header, data) = rest.split_at_checked(length)?;
    Some((std::str::from_utf8(header).ok()?, data))
}
