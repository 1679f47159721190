//! The edges between free cells and all others, traced into closed loops with free space on their left.

use glam::DVec2;

use super::cells::Cells;

/// Most corners of all loops together.
const MOST_CORNERS: usize = 4_000_000;
/// How far loops that would touch at a corner are drawn back into their own free cell, along x and y (cells).
const APART: f64 = 0.125;

/// East, north, west, south: a left turn is one on.
const STEPS: [(isize, isize); 4] = [(1, 0), (0, 1), (-1, 0), (0, -1)];

/// All loops, in cells from the lower-left corner of the picture. No two loops touch.
pub(super) fn loops(cells: &Cells) -> Result<Vec<Vec<DVec2>>, String> {
    let edges = Edges::new(cells);
    let mut traced = vec![0_u8; edges.leaving.len()];
    let mut loops = Vec::new();
    let mut corners = 0;
    for start in 0..edges.leaving.len() {
        for heading in 0..4 {
            if edges.leaving[start] & !traced[start] & (1 << heading) == 0 {
                continue;
            }
            let found = edges.trace(start, heading, &mut traced);
            corners += found.len();
            if corners > MOST_CORNERS {
                return Err(format!("its free cells have more than {MOST_CORNERS} corners"));
            }
            loops.push(found);
        }
    }
    Ok(loops)
}

/// For each lattice point, a bit for each heading in which an edge leaves it.
struct Edges {
    width: usize,
    leaving: Vec<u8>,
}

impl Edges {
    fn new(cells: &Cells) -> Self {
        let width = cells.cols() + 1;
        let mut leaving = Vec::with_capacity(width * (cells.rows() + 1));
        for y in 0..=cells.rows().cast_signed() {
            for x in 0..width.cast_signed() {
                let (south_west, south_east) = (cells.is_free(x - 1, y - 1), cells.is_free(x, y - 1));
                let (north_west, north_east) = (cells.is_free(x - 1, y), cells.is_free(x, y));
                // An edge leaves where the cell on its left is free and the one on its right is not.
                leaving.push(
                    u8::from(north_east && !south_east)
                        | u8::from(north_west && !north_east) << 1
                        | u8::from(south_west && !north_west) << 2
                        | u8::from(south_east && !south_west) << 3,
                );
            }
        }
        Self { width, leaving }
    }

    /// The loop that leaves `start` in a heading: the corners where it turns.
    fn trace(&self, start: usize, heading: usize, traced: &mut [u8]) -> Vec<DVec2> {
        let mut corners = Vec::new();
        let (mut at, mut ahead) = (start, heading);
        loop {
            traced[at] |= 1 << ahead;
            at = self.step(at, ahead);
            let leaving = self.leaving[at];
            // Where two free cells meet at a corner, a left turn stays with the same cell.
            let turn = [1, 0, 3].into_iter().find(|turn| leaving & (1 << ((ahead + turn) % 4)) != 0);
            let next = (ahead + turn.unwrap_or(0)) % 4;
            if next != ahead {
                corners.push(self.corner(at, ahead, leaving.count_ones() == 2));
            }
            ahead = next;
            if turn.is_none() || (at, ahead) == (start, heading) {
                return corners;
            }
        }
    }

    fn step(&self, at: usize, heading: usize) -> usize {
        let (dx, dy) = STEPS[heading];
        at.saturating_add_signed(dx + dy * self.width.cast_signed())
    }

    fn corner(&self, at: usize, heading: usize, shared: bool) -> DVec2 {
        let at = DVec2::new((at % self.width) as f64, (at / self.width) as f64);
        if !shared {
            return at;
        }
        let (dx, dy) = STEPS[heading];
        // Back the way it came, and to the left.
        at + APART * DVec2::new((-dx - dy) as f64, (dx - dy) as f64)
    }
}
