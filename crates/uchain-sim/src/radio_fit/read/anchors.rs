//! Where the fixed ends of links stand, in a table of its own.

use super::{LINKS_MAX, table};
use crate::{config::shorten, radio_fit::FitError};

/// Places of anchors by their names.
#[derive(Debug)]
pub(super) struct Anchors {
    pub(super) label: String,
    known: Vec<(String, [f64; 3])>,
    pub(super) has_height: bool,
}

impl Anchors {
    /// Reads `id,x,y` or `id,x,y,z`, in metres; `_m` behind a name is welcome.
    pub(super) fn of(text: &str, label: &str) -> Result<Self, FitError> {
        let mut lines = table::lines(text);
        let line_error = |line: usize, why: String| FitError::Line { label: label.to_owned(), line, why };
        let Some((at, header)) = lines.next() else {
            let why = "empty: expected a table with the columns id, x, y and perhaps z".to_owned();
            return Err(FitError::Whole { label: label.to_owned(), why });
        };
        let mut cells = Vec::new();
        let broken = || "a quotation that does not end".to_owned();
        table::cells(header, &mut cells).ok_or_else(|| line_error(at, broken()))?;
        let find = |names: [&str; 3]| cells.iter().position(|cell| names.contains(cell));
        let id = find(["id", "link", "anchor"]);
        let places = [["x", "x_m", "x2_m"], ["y", "y_m", "y2_m"], ["z", "z_m", "z2_m"]].map(find);
        let ([Some(x), Some(y), z], Some(id)) = (places, id) else {
            let why = "expected columns called id, x, y and perhaps z, in metres".to_owned();
            return Err(line_error(at, why));
        };
        let mut known: Vec<(String, [f64; 3])> = Vec::new();
        for (line, row) in lines {
            table::cells(row, &mut cells).ok_or_else(|| line_error(line, broken()))?;
            let number = |place: usize, column: &str| {
                let got = cells.get(place).copied().unwrap_or_default();
                let value = got.parse().ok().filter(|value: &f64| value.is_finite() && value.abs() <= 1e6);
                value.ok_or_else(|| FitError::Cell {
                    label: label.to_owned(),
                    line,
                    column: column.to_owned(),
                    got: shorten(got),
                    expected: "expected a number of metres".to_owned(),
                })
            };
            let at_m = [number(x, "x")?, number(y, "y")?, z.map_or(Ok(0.0), |z| number(z, "z"))?];
            let name = cells.get(id).copied().unwrap_or_default();
            if known.iter().any(|(other, _)| other == name) {
                return Err(line_error(
                    line,
                    format!("'{}' twice: expected each anchor once", shorten(name)),
                ));
            }
            if known.len() == LINKS_MAX {
                return Err(line_error(line, format!("more than {LINKS_MAX} anchors")));
            }
            known.push((name.to_owned(), at_m));
        }
        Ok(Self { label: label.to_owned(), known, has_height: z.is_some() })
    }

    /// Where an anchor stands.
    pub(super) fn at(&self, name: &str) -> Option<[f64; 3]> {
        self.known.iter().find(|(known, _)| known == name).map(|(_, at_m)| *at_m)
    }

    /// Their names, for messages.
    pub(super) fn names(&self) -> String {
        let names: Vec<String> = self.known.iter().take(12).map(|(name, _)| shorten(name)).collect();
        names.join(", ")
    }
}
