//! A table of losses as text, a pair of places a line.

use super::{
    FARTHEST_M, LOSS_DB, TableError,
    grid::{Grid, Places},
};
use crate::config::shorten;

const COLUMNS: [&str; 5] = ["x1_m", "y1_m", "x2_m", "y2_m", "loss_db"];

/// A pair of places, and what a link between them loses (dB), if there is one.
struct Row {
    line: usize,
    from: [f64; 2],
    to: [f64; 2],
    loss_db: Option<f32>,
}

/// Reads the grid. The text is gone through twice: its places are few, and its lines are many.
pub(super) fn read(bytes: &[u8]) -> Result<Grid, TableError> {
    let text = std::str::from_utf8(bytes)
        .map_err(|error| TableError::NotText { byte: error.valid_up_to() })?
        .trim_start_matches('\u{feff}');
    let (mut places, mut before) = (Places::default(), [[f64::NAN; 2]; 2]);
    for row in rows(text)? {
        let row = row?;
        // Tables go through the places of one end, and then of the other.
        if before[0] != row.from {
            places.add(row.from)?;
        }
        if before[1] != row.to {
            places.add(row.to)?;
        }
        before = [row.from, row.to];
    }
    let mut grid = places.grid()?;
    for row in rows(text)? {
        let Row { line, from, to, loss_db } = row?;
        if let Some(loss_db) = loss_db {
            let put = grid.put(from, to, loss_db);
            put.map_err(|other| TableError::TwoLosses { line, got: loss_db, other })?;
        }
    }
    grid.whole()
}

fn rows(text: &str) -> Result<impl Iterator<Item = Result<Row, TableError>>, TableError> {
    let mut lines = text.lines().enumerate();
    let header = lines.next().map_or("", |(_, header)| header);
    if !header.split(',').map(str::trim).eq(COLUMNS) {
        return Err(TableError::Header { got: shorten(header) });
    }
    Ok(lines.filter(|(_, text)| !text.trim().is_empty()).map(|(index, text)| row(index + 1, text)))
}

fn row(line: usize, text: &str) -> Result<Row, TableError> {
    let mut cells = [""; COLUMNS.len()];
    let mut got = 0;
    for cell in text.split(',') {
        if let Some(place) = cells.get_mut(got) {
            *place = cell.trim();
        }
        got += 1;
    }
    if got != cells.len() {
        return Err(TableError::Cells { line, got });
    }
    let refused = |column: usize, expected| TableError::Cell {
        line,
        column: COLUMNS[column],
        got: shorten(cells[column]),
        expected,
    };
    let at_m = |column: usize| {
        let at_m = cells[column].parse().ok().filter(|at_m: &f64| at_m.abs() <= FARTHEST_M);
        at_m.ok_or_else(|| refused(column, "a coordinate in metres, at most 1e9 from the origin"))
    };
    let from = [at_m(0)?, at_m(1)?];
    let to = [at_m(2)?, at_m(3)?];
    let loss_db = match cells[4] {
        "" => None,
        cell => {
            let loss_db = cell.parse().ok().filter(|loss_db| LOSS_DB.contains(loss_db));
            Some(loss_db.ok_or_else(|| refused(4, "decibels from -50 to 2000, or nothing for no link"))?)
        }
    };
    Ok(Row { line, from, to, loss_db })
}
