//! A map as square cells: a ROS `map_server` map, which is a picture and a yaml file that says where it lies.

use std::fmt::Write as _;

use glam::{DVec2, Vec2};

use crate::map::{Map, MapError, Segment};

const FREE: u8 = 254;
const OCCUPIED: u8 = 0;

/// Most cells along a side, and in all, as [`read_ros`](crate::map::read_ros) takes them.
const MOST_SIDE: f64 = 16_384.0;
const MOST_CELLS: f64 = (1 << 26) as f64;
/// Where no size of cells is asked for: the first of these whose picture has no more than so many cells.
const USUAL_M: [f64; 8] = [0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0];
const USUAL_CELLS: f64 = (1 << 24) as f64;
/// Cells of rock around the map: beyond the picture all is unknown.
const RIM: f64 = 2.0;

/// A map in square cells.
#[derive(Debug, Clone, PartialEq)]
pub struct RosCells {
    cols: usize,
    rows: usize,
    cell_m: f64,
    low_m: DVec2,
    /// From the lowest row up.
    free: Vec<bool>,
    thickened: usize,
}

impl RosCells {
    /// The cells whose middles are free; walls lie within half a cell of where they were. Where rock is thinner than a
    /// cell, so that no middle may lie in it, it is drawn one cell thick, lest sight and ways go through.
    ///
    /// Cells are counted from the origin of the map file's own frame, so walls at whole cells stay where they are. Without
    /// `cell_m` they are 0.05 m, or larger on a map of more than about 200 m.
    ///
    /// # Errors
    /// Cells of no size, or so small that there are more than a reader takes; the least size that works is named.
    pub fn of(map: &Map, cell_m: Option<f64>) -> Result<Self, MapError> {
        let offset = DVec2::from(map.offset_m());
        let (low, high) = map.bounds();
        let (low, high) = (low.as_dvec2() + offset, high.as_dvec2() + offset);
        let size = |cell_m: f64| (high / cell_m).ceil() - (low / cell_m).floor() + 2.0 * RIM;
        let fits = |cell_m: f64, most: f64| {
            let size = size(cell_m);
            size.max_element() <= MOST_SIDE && size.x * size.y <= most
        };
        let usual = || USUAL_M.into_iter().find(|&cell_m| fits(cell_m, USUAL_CELLS)).unwrap_or(50.0);
        let cell_m = cell_m.unwrap_or_else(usual);
        if !(0.001..=1000.0).contains(&cell_m) || !fits(cell_m, MOST_CELLS) {
            let span = high - low;
            let least_m =
                (span.max_element() / (MOST_SIDE - 8.0)).max((span.x * span.y / MOST_CELLS).sqrt() * 1.01);
            let low = (least_m.max(0.001) * 1000.0).ceil() / 1000.0;
            return Err(MapError::Range { what: "cell_m", got: cell_m, low, high: 1000.0 });
        }
        let low_cell = (low / cell_m).floor() - RIM;
        let DVec2 { x: cols, y: rows } = size(cell_m);
        let (cols, rows) = (cols as usize, rows as usize);
        let mut cells = Self {
            cols,
            rows,
            cell_m,
            low_m: low_cell * cell_m,
            free: vec![false; cols * rows],
            thickened: 0,
        };
        cells.fill(map, offset);
        cells.thicken(map, offset);
        if cells.free.contains(&true) {
            Ok(cells)
        } else {
            let what = "cell_m (as large as the free space: no cell's middle is free)";
            Err(MapError::Range { what, got: cell_m, low: 0.001, high: cell_m / 2.0 })
        }
    }

    /// Side of a cell (m).
    pub fn cell_m(&self) -> f64 {
        self.cell_m
    }

    /// Columns and rows.
    pub fn size(&self) -> [usize; 2] {
        [self.cols, self.rows]
    }

    /// Cells that are rock though their middles are free, since rock is thinner than a cell there.
    pub fn thickened(&self) -> usize {
        self.thickened
    }

    /// Row by row: walls cross the line through the middles of its cells an odd number of times left of what is free.
    fn fill(&mut self, map: &Map, offset: DVec2) {
        let mut crossings: Vec<Vec<f64>> = vec![Vec::new(); self.rows];
        let place = |at: Vec2| (at.as_dvec2() + offset - self.low_m) / self.cell_m - 0.5;
        for wall in map.walls() {
            let (a, b) = (place(wall.a), place(wall.b));
            let (low, high) = if a.y < b.y { (a, b) } else { (b, a) };
            // Rows from its lower end up to, but without, its upper end.
            for row in low.y.ceil().max(0.0) as usize..high.y.ceil().max(0.0) as usize {
                let share = (row as f64 - low.y) / (high.y - low.y);
                if let Some(crossings) = crossings.get_mut(row) {
                    crossings.push(low.x + share * (high.x - low.x));
                }
            }
        }
        for (row, crossings) in crossings.iter_mut().enumerate() {
            crossings.sort_by(f64::total_cmp);
            for pair in crossings.chunks_exact(2) {
                let (from, to) = (pair[0].ceil().max(0.0) as usize, pair[1].ceil().max(0.0) as usize);
                let cells = row * self.cols;
                self.free[cells + from.min(self.cols)..cells + to.min(self.cols)].fill(true);
            }
        }
    }

    /// Makes rock of the cells along rock that is thinner than a cell.
    fn thicken(&mut self, map: &Map, offset: DVec2) {
        for wall in map.walls() {
            let Some(into_rock) = rock_side(map, wall) else { continue };
            let (a, b) = wall.ends();
            let count = (2.0 * a.distance(b) / self.cell_m).ceil().max(1.0);
            for step in 0..count as u64 {
                let at = a.lerp(b, (step as f64 + 0.5) / count);
                let is_beyond =
                    |quarters: &f64| !map.in_rock_f64(at + into_rock * (quarters / 4.0 * self.cell_m));
                let Some(quarters) = [1.0, 2.0, 3.0, 4.0].iter().find(|quarters| is_beyond(quarters)) else {
                    continue;
                };
                let middle = at + into_rock * (quarters / 8.0 * self.cell_m);
                let cell = ((middle + offset - self.low_m) / self.cell_m).floor();
                let (col, row) = (cell.x.max(0.0) as usize, cell.y.max(0.0) as usize);
                if col < self.cols
                    && let Some(free) = self.free.get_mut(row * self.cols + col)
                {
                    self.thickened += usize::from(std::mem::take(free));
                }
            }
        }
    }

    /// Grey values from the top row down.
    fn grey(&self) -> Vec<u8> {
        let rows = self.free.chunks(self.cols).rev();
        rows.flatten().map(|&free| if free { FREE } else { OCCUPIED }).collect()
    }

    /// The picture as binary PGM.
    pub fn pgm(&self) -> Vec<u8> {
        pgm([self.cols, self.rows], &self.grey())
    }

    /// The picture as PNG.
    #[cfg(feature = "maps")]
    pub fn png(&self) -> Vec<u8> {
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, self.cols as u32, self.rows as u32);
        encoder.set_color(png::ColorType::Grayscale);
        encoder.set_depth(png::BitDepth::Eight);
        // Writing to memory cannot fail, and the size of the picture is that of its cells.
        if let Ok(mut writer) = encoder.write_header() {
            let _ = writer.write_image_data(&self.grey());
        }
        file
    }

    /// The yaml file, which names the picture.
    pub fn yaml(&self, image: &str) -> String {
        yaml(image, &self.cell_m.to_string(), self.low_m.into())
    }
}

/// A picture of grey values, from the top row down, as binary PGM.
pub(crate) fn pgm([cols, rows]: [usize; 2], grey: &[u8]) -> Vec<u8> {
    let mut file = format!("P5\n{cols} {rows}\n255\n").into_bytes();
    file.extend_from_slice(grey);
    file
}

/// What says where a picture lies: side of a cell and lower left corner (m).
pub(crate) fn yaml(image: &str, cell_m: &str, [x, y]: [f64; 2]) -> String {
    let mut name = String::new();
    // What a plain word may hold in yaml stands as it is; anything else between quotes.
    if image.chars().all(|c| c.is_ascii_alphanumeric() || "._-/".contains(c))
        && image.starts_with(|c: char| c.is_ascii_alphabetic())
    {
        name.push_str(image);
    } else {
        let _ = write!(name, "{image:?}");
    }
    format!(
        "image: {name}\nmode: trinary\nresolution: {cell_m}\norigin: [{x}, {y}, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"
    )
}

/// The direction from the middle of a wall into the rock beside it.
fn rock_side(map: &Map, wall: &Segment) -> Option<DVec2> {
    let (a, b) = wall.ends();
    let across = (b - a).perp().normalize_or_zero();
    let step = across * (1e-3 * a.distance(b)).min(1e-4);
    let middle = (a + b) / 2.0;
    match (map.in_rock_f64(middle + step), map.in_rock_f64(middle - step)) {
        (true, false) => Some(across),
        (false, true) => Some(-across),
        _ => None,
    }
}
