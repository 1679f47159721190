//! The tiles of a layout: a table with a tile in each cell, as `tile_tsv.py` of <https://github.com/osrf/subt> reads it.
//!
//! A cell is `type,yaw in degrees,level` and, behind a third comma, what stands in the tile: `Phone@2 0 0 0 0 0;…`, with places (m)
//! along the world's axes from the tile's middle. Columns lie 20 m apart along x, rows along −y, levels 5 m along z.

/// Side of a tile (m).
pub(super) const TILE_M: f64 = 20.0;
/// Between two levels (m).
pub(super) const LEVEL_M: f64 = 5.0;
/// Most cells of a layout, empty ones too, and most tiles.
const MOST_CELLS: usize = 1_000_000;
pub(super) const MOST_TILES: usize = 20_000;
/// Farthest level.
const FARTHEST_LEVEL: i32 = 1000;

/// Names whose things are numbered on in worlds.
const COUNTED: [&str; 3] = ["tunnel_tile_", "Urban", "Tunnel Tile"];
/// The cell that stands for the staging area.
const BASE: &str = "base_station";

/// Right, up, left, down: along x, along y and back.
pub(super) const SIDES: [[i32; 2]; 4] = [[1, 0], [0, 1], [-1, 0], [0, -1]];

/// What a tile is like, without its turn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// Where the swarm starts.
    Base,
    Flat,
    /// Lower by a few decimetres or narrower than the others.
    Constrained,
    /// Climbs by one level.
    Ramp,
    /// Climbs by one level straight up.
    Shaft,
    /// All rock.
    Blocker,
}

/// A tile where it lies.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Tile {
    pub(super) column: i32,
    pub(super) row: i32,
    /// As the layout calls its type.
    pub(super) word: String,
    /// As worlds made of the layout number it, and the graph beside it: the base is 0; tiles and blockers count.
    pub(super) number: u32,
    pub(super) kind: Kind,
    /// By [`SIDES`]: at which level it opens there.
    pub(super) opens: [Option<i32>; 4],
    /// By [`SIDES`]: how far from the middle a blocker stands (m).
    pub(super) blocked_m: [Option<f64>; 4],
    /// Least level.
    pub(super) level: i32,
}

/// What a layout comes to.
#[derive(Debug, Default)]
pub(super) struct Layout {
    pub(super) tiles: Vec<Tile>,
    /// Types that are not known, each once, and how many tiles are such.
    pub(super) unknown: Vec<String>,
    pub(super) unknown_count: usize,
    /// Things that stand in tiles.
    pub(super) things: usize,
}

/// An opening of a tile without a turn: where, and how many levels above the tile's own.
type Opening = ([i32; 2], i32);

/// A kind and its openings.
fn known(word: &str) -> Option<(Kind, &'static [Opening])> {
    const STRAIGHT: &[Opening] = &[([0, -1], 0), ([0, 1], 0)];
    const TURN: &[Opening] = &[([1, 0], 0), ([0, -1], 0)];
    const CROSS: &[Opening] = &[([1, 0], 0), ([0, 1], 0), ([-1, 0], 0), ([0, -1], 0)];
    const CLIMB: &[Opening] = &[([0, -1], 0), ([0, 1], 1)];
    let word = word.to_lowercase().replace('_', " ");
    Some(match word.strip_suffix(" lights").unwrap_or(&word) {
        "base station" => (Kind::Base, &[([1, 0], 0)]),
        "tunnel tile 1" | "tunnel tile 3" | "tunnel tile 4" | "rough tunnel tile 4-way intersection" => {
            (Kind::Flat, CROSS)
        }
        "tunnel tile 2" | "rough tunnel tile 90-degree turn" => (Kind::Flat, TURN),
        "tunnel tile 5" | "rough tunnel tile straight" => (Kind::Flat, STRAIGHT),
        "constrained tunnel tile short" | "constrained tunnel tile tall" => (Kind::Constrained, STRAIGHT),
        "tunnel tile 6" | "rough tunnel tile ramp" => (Kind::Ramp, CLIMB),
        "tunnel tile 7" | "rough tunnel tile vertical shaft" => (Kind::Shaft, CLIMB),
        "tunnel tile blocker" => (Kind::Blocker, &[]),
        _ => return None,
    })
}

/// The tiles of a layout, or what is wrong with which cell.
pub(super) fn layout(text: &str) -> Result<Layout, String> {
    let mut layout = Layout::default();
    let mut cells = 0;
    let mut numbers = 0;
    for (row, line) in text.lines().enumerate() {
        for (column, cell) in line.split('\t').enumerate() {
            cells += 1;
            if cells > MOST_CELLS {
                return Err(format!("more than {MOST_CELLS} cells"));
            }
            let cell = cell.trim().trim_matches('"');
            if cell.is_empty() {
                continue;
            }
            let wrong = |expected: &str| {
                let shown: String = cell.chars().take(60).collect();
                format!("row {}, column {}: {shown:?}: expected {expected}", row + 1, column + 1)
            };
            let mut parts = cell.splitn(4, ',').map(str::trim);
            let word = parts.next().unwrap_or_default();
            let mut number = || parts.next()?.parse::<f64>().ok();
            let both = number().zip(number());
            let (yaw_deg, level) =
                both.ok_or_else(|| wrong("a tile: its type, its yaw in degrees and its level"))?;
            if level.fract() != 0.0 || level.abs() > f64::from(FARTHEST_LEVEL) {
                return Err(wrong(&format!("a whole level within ±{FARTHEST_LEVEL}, not {level}")));
            }
            let turns = yaw_deg / 90.0;
            if !(turns.abs() <= 1000.0 && turns.fract() == 0.0) {
                return Err(wrong(&format!("a yaw in quarter turns, not {yaw_deg} degrees")));
            }
            let things = parts.next().unwrap_or_default();
            let number = if word == BASE { 0 } else { numbers + 1 };
            let counts = |thing: &&str| COUNTED.iter().any(|counted| thing.contains(counted));
            numbers += std::iter::once(word).chain(things.split(';')).filter(counts).count() as u32;
            let Some((kind, opens)) = known(word) else {
                layout.unknown_count += 1;
                if layout.unknown.len() < 8 && !layout.unknown.iter().any(|known| known == word) {
                    layout.unknown.push(word.chars().take(60).collect());
                }
                continue;
            };
            if layout.tiles.len() >= MOST_TILES {
                return Err(format!("more than {MOST_TILES} tiles"));
            }
            let at = |index: usize| i32::try_from(index).unwrap_or(i32::MAX);
            let (column, row, level) = (at(column), at(row), level as i32);
            let mut tile = Tile {
                column,
                row,
                word: word.to_owned(),
                number,
                kind,
                opens: [None; 4],
                blocked_m: [None; 4],
                level,
            };
            for &(side, up) in opens {
                let quarters = (turns as i32).rem_euclid(4) as usize;
                let turned = side_of(side).map(|side| (side + quarters) % 4);
                if let Some(open) = turned.and_then(|side| tile.opens.get_mut(side)) {
                    *open = Some(level + up);
                }
            }
            for thing in things.split(';').filter(|thing| !thing.trim().is_empty()) {
                match blocker(thing) {
                    Some((side, at_m)) => {
                        let nearest_m = tile.blocked_m[side].map_or(at_m, |known_m: f64| known_m.min(at_m));
                        tile.blocked_m[side] = Some(nearest_m);
                    }
                    None => layout.things += 1,
                }
            }
            layout.tiles.push(tile);
        }
    }
    Ok(layout)
}

/// By [`SIDES`].
pub(super) fn side_of(step: [i32; 2]) -> Option<usize> {
    SIDES.iter().position(|side| *side == step)
}

/// A blocker's side and how far it stands from the middle (m), if the thing is one.
fn blocker(thing: &str) -> Option<(usize, f64)> {
    let (word, pose) = thing.split_once('@')?;
    if known(word.trim())?.0 != Kind::Blocker {
        return None;
    }
    let mut numbers =
        pose.split_whitespace().map(|number| number.parse::<f64>().ok().filter(|m| m.abs() <= TILE_M));
    let (x_m, y_m) = (numbers.next()??, numbers.next()??);
    let step = if x_m.abs() > y_m.abs() { [x_m.signum() as i32, 0] } else { [0, y_m.signum() as i32] };
    Some((side_of(step)?, x_m.abs().max(y_m.abs())))
}
