//! Grid maps of the MovingAI benchmarks (Sturtevant 2012): four lines of head, then a letter per cell, the top row
//! first. `.`, `G` and `S` are free; `@`, `O`, `T` and `W` are not.

use std::path::Path;

use crate::map::{
    Import, Map, MapError, RemarkKind,
    raster::{cells::Cells, read, to_map},
};

/// Most bytes of a file: 8192 cells a side, and its head.
const MOST_BYTES: u64 = (1 << 26) + (1 << 14);
/// Most cells along a side.
const MOST_SIDE: usize = 8192;

/// Reads a MovingAI map with cells so wide (m), which the file does not say. The file's own frame has its origin at the
/// lower left corner of the lowest row. Free cells that meet only at a corner are kept apart there, by an eighth of a
/// cell.
///
/// # Errors
/// A file that is absent, too large, not of `type octile`, or whose rows are not what its head says; a map without a
/// free cell; `cell_m` that is not positive.
pub fn read_moving_ai(file: &Path, cell_m: f64) -> Result<Map, MapError> {
    if !(0.001..=1000.0).contains(&cell_m) {
        return Err(MapError::Range { what: "cell_m", got: cell_m, low: 0.001, high: 1000.0 });
    }
    let wrong = |why: String| MapError::Read { file: file.to_owned(), why };
    let bytes = read(file, MOST_BYTES).map_err(wrong)?;
    let cells = parse(&bytes).map_err(wrong)?;
    let map = to_map(&cells, cell_m, 0.0, |corner| corner * cell_m, wrong)?;
    let mut import = Import::of("MovingAI grid");
    let count = cells.cols() * cells.rows();
    import.say(RemarkKind::Read, count, format!("cells of {cell_m} m: cell_m says so, the file does not"));
    Ok(map.with_import(import))
}

/// The cells, or what is wrong with which line.
fn parse(bytes: &[u8]) -> Result<Cells, String> {
    let mut lines = bytes.split(|&byte| byte == b'\n').map(|line| line.strip_suffix(b"\r").unwrap_or(line));
    let mut head = |number: usize, expected: &str| {
        let line = lines.next().unwrap_or_default();
        if line.is_empty() && lines.clone().all(<[u8]>::is_empty) {
            return Err(format!("the file ends before its line {number}: expected {expected:?}"));
        }
        let text = std::str::from_utf8(line).unwrap_or_default().trim();
        let value = text.strip_prefix(expected).map(str::trim);
        value.ok_or_else(|| format!("line {number}: {}: expected {expected:?}", shown(line)))
    };
    let kind = head(1, "type")?;
    if kind != "octile" {
        let shown: String = kind.chars().take(60).collect();
        return Err(format!("line 1: type {shown:?}: expected \"octile\""));
    }
    let mut side = |number: usize, name: &str| {
        let text = head(number, name)?;
        let cells = text.parse().ok().filter(|cells| (1..=MOST_SIDE).contains(cells));
        cells.ok_or_else(|| format!("line {number}: {name} {text:?}: expected 1 to {MOST_SIDE} cells"))
    };
    let (rows, cols) = (side(2, "height")?, side(3, "width")?);
    head(4, "map")?;
    let mut free = vec![false; rows * cols];
    for (row, cells) in free.rchunks_mut(cols).enumerate() {
        let (line, number) = (lines.next().unwrap_or_default(), row + 5);
        if line.is_empty() && lines.clone().all(<[u8]>::is_empty) {
            return Err(format!("the file ends after {row} rows: expected {rows}, the height in its line 2"));
        }
        if line.len() != cols {
            return Err(format!("line {number}: {} cells: expected {cols}, the width", line.len()));
        }
        for (col, (cell, letter)) in cells.iter_mut().zip(line).enumerate() {
            *cell = match letter {
                b'.' | b'G' | b'S' => true,
                b'@' | b'O' | b'T' | b'W' => false,
                _ => {
                    let letter = shown(&[*letter]);
                    return Err(format!("line {number}, cell {}: {letter}: expected . G S @ O T W", col + 1));
                }
            };
        }
    }
    let more = lines.find(|line| !line.is_empty());
    more.map_or(Ok(()), |line| Err(format!("{} after the last of {rows} rows", shown(line))))?;
    Ok(Cells::new(cols, free))
}

/// A line for a message.
fn shown(line: &[u8]) -> String {
    format!("{:?}", String::from_utf8_lossy(line.get(..line.len().min(30)).unwrap_or_default()))
}

#[cfg(test)]
mod tests {
    use glam::vec2;

    use super::*;

    fn read_text(text: &str) -> Result<Map, MapError> {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("room.map");
        std::fs::write(&file, text).unwrap();
        read_moving_ai(&file, 0.5)
    }

    #[test]
    fn a_map_has_its_first_row_on_top_and_its_origin_at_the_lower_left() {
        let map = read_text("type octile\nheight 2\nwidth 3\nmap\n.G@\nSTW\n").unwrap();
        assert_eq!(map.bounds(), (vec2(-0.5, -0.5), vec2(0.5, 0.5)));
        let free = |at| !map.in_rock(map.to_local(at));
        assert!(free([0.25, 0.75]) && free([0.75, 0.75]) && free([0.25, 0.25]));
        assert!(!free([0.75, 0.25]) && !free([1.25, 0.75]));
    }

    #[test]
    fn what_is_wrong_is_said_with_its_line() {
        let cases = [
            ("", "the file ends before its line 1: expected \"type\""),
            ("type octile\n", "the file ends before its line 2: expected \"height\""),
            ("\ntype octile\n", "line 1: \"\": expected \"type\""),
            ("type tile\n", "line 1: type \"tile\": expected \"octile\""),
            ("type octile\nheight 0\n", "line 2: height \"0\": expected 1 to 8192 cells"),
            ("type octile\nheight 2\nwidth x\n", "line 3: width \"x\""),
            ("type octile\nheight 2\nwidth 2\n..\n", "line 4: \"..\": expected \"map\""),
            (
                "type octile\nheight 2\nwidth 2\nmap\n..\n",
                "the file ends after 1 rows: expected 2, the height in its line 2",
            ),
            ("type octile\nheight 2\nwidth 2\nmap\n\n..\n", "line 5: 0 cells: expected 2, the width"),
            ("type octile\nheight 1\nwidth 2\nmap\n.x\n", "line 5, cell 2: \"x\": expected"),
            ("type octile\nheight 1\nwidth 2\nmap\n..\n..\n", "\"..\" after the last of 1 rows"),
            ("type octile\nheight 1\nwidth 2\nmap\n@@\n", "it has no free cell"),
        ];
        for (text, expected) in cases {
            let said = read_text(text).unwrap_err().to_string();
            assert!(said.contains(expected), "{text:?}: {said}");
        }
    }
}
