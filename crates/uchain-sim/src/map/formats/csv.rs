//! Wall loops as a table of their corners, as recordings hold them (`walls.csv`) and spreadsheets write them:
//!
//! ```text
//! loop,x_m,y_m
//! 0,0,0
//! 0,4,0
//! 0,4,3
//! 1,1,1
//! ```
//!
//! A row per corner, loop by loop; loops are numbered from 0, the last corner of a loop joins its first. Loop 0 surrounds
//! the free space, the others are solid pieces that stand in it.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::{FRAME_MAX_M, Fault, Format, MapFormat, drawn};
use crate::map::{CentreLine, MOST_WALLS, Map, MapError, raster::read};

/// Most bytes of a file: 64 for each of the most walls.
const MOST_BYTES: u64 = 64 * MOST_WALLS as u64;
/// The first line.
const COLUMNS: &str = "loop,x_m,y_m";

pub(super) const FORMAT: Format = Format {
    table: "map.csv",
    name: "table of wall corners",
    keys: CsvConfig::KEYS,
    ends: &["csv"],
    sniff: |bytes| bytes.starts_with(COLUMNS.as_bytes()),
};

uchain_core::params! {
    /// Wall loops as a table of their corners, with the columns `loop,x_m,y_m`, as recordings hold them. Loop 0 surrounds the
    /// free space, the others stand in it. Loops neither cross nor touch.
    #[derive(Serialize, Deserialize)]
    #[serde(deny_unknown_fields)]
    pub struct CsvConfig {
        /// Path of the table, from the folder of the scenario file (from the working folder for a compiled-in scenario).
        pub file: PathBuf;
    }
}

impl MapFormat for CsvConfig {
    fn legal(&self) -> Result<(), Fault> {
        Ok(self.check()?)
    }

    fn lay(&self, folder: &Path, _: [f64; 2]) -> Result<(Map, Option<CentreLine>), MapError> {
        let file = folder.join(&self.file);
        let wrong = |why: String| MapError::Read { file: file.clone(), why };
        let loops = read(&file, MOST_BYTES).and_then(|bytes| parse(&bytes)).map_err(wrong)?;
        drawn(&loops).map(|map| (map, None))
    }
}

/// The loops, or what is wrong with which line.
fn parse(bytes: &[u8]) -> Result<Vec<Vec<[f64; 2]>>, String> {
    let text = std::str::from_utf8(bytes)
        .map_err(|error| format!("no text from byte {} on; expected a table", error.valid_up_to()))?;
    let mut lines = text.lines().map(str::trim_end).enumerate();
    if lines.next().is_none_or(|(_, line)| line.trim_start_matches('\u{feff}') != COLUMNS) {
        return Err(format!("line 1: expected the columns {COLUMNS}"));
    }
    let mut loops: Vec<Vec<[f64; 2]>> = Vec::new();
    for (index, line) in lines.filter(|(_, line)| !line.is_empty()) {
        let wrong = |expected: String| {
            let shown: String = line.chars().take(60).collect();
            format!("line {}: {shown:?}: expected {expected}", index + 1)
        };
        let (number, at_m) = corner(line)
            .ok_or_else(|| wrong(format!("a loop's number, x and y, both within ±{FRAME_MAX_M} m")))?;
        let next = loops.len();
        if number != next && Some(number) != next.checked_sub(1) {
            let last = next.checked_sub(1).map(|last| format!("loop {last} or ")).unwrap_or_default();
            return Err(wrong(format!("{last}loop {next}")));
        }
        if number == next {
            loops.push(Vec::new());
        }
        if let Some(corners) = loops.last_mut() {
            corners.push(at_m);
        }
    }
    if loops.is_empty() { Err(format!("no corner follows the columns {COLUMNS}")) } else { Ok(loops) }
}

fn corner(line: &str) -> Option<(usize, [f64; 2])> {
    let mut columns = line.split(',').map(str::trim);
    let number = columns.next()?.parse().ok()?;
    let mut metres = || columns.next()?.parse().ok().filter(|at_m: &f64| at_m.abs() <= FRAME_MAX_M);
    let at_m = [metres()?, metres()?];
    columns.next().is_none().then_some((number, at_m))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn read_text(text: &str) -> Result<Map, MapError> {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("room.csv"), text).unwrap();
        CsvConfig { file: "room.csv".into() }.lay(folder.path(), [0.0; 2]).map(|(map, _)| map)
    }

    #[test]
    fn a_room_with_a_pillar_stands_where_its_corners_are() {
        let room = "loop,x_m,y_m\r\n0,10,0\r\n0, 14, 0\r\n0,14,4\r\n0,10,4\r\n\r\n1,11,1\r\n1,11,2\r\n1,12,2\r\n1,12,1\r\n";
        let map = read_text(room).unwrap();
        assert_eq!((map.walls().len(), map.offset_m()), (8, [12.0, 2.0]));
        assert!(map.in_rock(map.to_local([11.5, 1.5])) && !map.in_rock(map.to_local([13.0, 3.0])));
        assert!(map.in_rock(map.to_local([15.0, 3.0])), "the control: beyond the outer wall");
    }

    #[test]
    fn what_is_wrong_is_said_with_its_line() {
        let cases = [
            ("", "line 1: expected the columns loop,x_m,y_m"),
            ("x,y\n", "line 1: expected the columns loop,x_m,y_m"),
            ("loop,x_m,y_m\n", "no corner follows the columns loop,x_m,y_m"),
            ("loop,x_m,y_m\n1,0,0\n", "line 2: \"1,0,0\": expected loop 0"),
            ("loop,x_m,y_m\n0,0,0\n2,0,0\n", "line 3: \"2,0,0\": expected loop 0 or loop 1"),
            ("loop,x_m,y_m\n0,0,0\n1,5,0\n0,0,1\n", "line 4: \"0,0,1\": expected loop 1 or loop 2"),
            ("loop,x_m,y_m\n0,0\n", "line 2: \"0,0\": expected a loop's number, x and y"),
            ("loop,x_m,y_m\n0,0,0,0\n", "line 2: \"0,0,0,0\": expected a loop's number"),
            ("loop,x_m,y_m\n0,nan,0\n", "line 2: \"0,nan,0\": expected a loop's number"),
            ("loop,x_m,y_m\n0,2e9,0\n", "both within ±1000000000 m"),
            ("loop,x_m,y_m\n0,0,0\n0,1,0\n", "must be 3 to"),
            ("loop,x_m,y_m\n0,0,0\n0,2,2\n0,2,0\n0,0,2\n", "walls cross or touch"),
        ];
        for (text, expected) in cases {
            let said = read_text(text).unwrap_err().to_string();
            assert!(said.contains(expected), "{text:?}: {said}");
        }
        let absent = CsvConfig { file: "absent.csv".into() }.lay("nowhere".as_ref(), [0.0; 2]).unwrap_err();
        assert!(absent.to_string().starts_with("nowhere/absent.csv: No such file"), "{absent}");
    }

    proptest! {
        #[test]
        fn rubbish_is_refused_in_words_or_read(
            head in prop::option::of(Just("loop,x_m,y_m\n")), rows in "([0-3],-?[0-9.e]{1,4},[0-9]{1,3}\n){0,12}",
            rest in prop::collection::vec(any::<u8>(), 0..40),
        ) {
            let mut bytes = head.unwrap_or_default().as_bytes().to_vec();
            bytes.extend(rows.bytes().chain(rest));
            if let Ok(loops) = parse(&bytes) {
                let _ = drawn(&loops);
            }
        }
    }
}
