//! Grids whose lines are walls: spaces lie in odd rows and columns, walls in even ones, and what is opened is free.

mod maze;
mod pillars;
mod rooms;

use glam::DVec2;

use super::{Kind, Made, MakeError, farthest, way_lengths_m};
use crate::{
    map::{
        MapError,
        raster::{self, cells::Cells},
    },
    seed::Stream,
};

/// Thickness of walls between corridors, and between rooms (widths of a passage).
const THICK: f64 = 0.5;
const THIN: f64 = 0.2;

/// Rows and columns of cells of different sizes.
struct Lattice {
    /// Where the columns' borders lie (m).
    xs: Vec<f64>,
    /// Where the rows' borders lie (m).
    ys: Vec<f64>,
    free: Vec<bool>,
}

/// A maze, rooms, or rooms and pillars.
pub(super) fn grid(
    kind: Kind,
    size_m: [f64; 2],
    width_m: f64,
    stream: &mut Stream,
) -> Result<Made, MakeError> {
    let lattice = match kind {
        Kind::Rooms => rooms::open(Lattice::even(size_m, width_m, THIN * width_m), stream),
        Kind::RoomAndPillar => pillars::open(size_m, width_m, stream),
        _ => maze::open(Lattice::even(size_m, width_m, THICK * width_m), stream),
    };
    Ok(lattice.walled(width_m)?)
}

impl Lattice {
    /// All rock, with as many spaces and walls as fit into a size.
    fn even(size_m: [f64; 2], space_m: f64, wall_m: f64) -> Self {
        let [xs, ys] = size_m.map(|side_m| {
            let count = (((side_m - wall_m) / (space_m + wall_m)) as usize).max(2);
            borders(count, |_| space_m, |_| wall_m)
        });
        Self::new(xs, ys)
    }

    fn new(xs: Vec<f64>, ys: Vec<f64>) -> Self {
        let free = vec![false; (xs.len() - 1) * (ys.len() - 1)];
        Self { xs, ys, free }
    }

    /// Columns and rows of cells.
    fn size(&self) -> [usize; 2] {
        [self.xs.len() - 1, self.ys.len() - 1]
    }

    /// Columns and rows of spaces.
    fn spaces(&self) -> [usize; 2] {
        self.size().map(|count| count / 2)
    }

    fn open(&mut self, col: usize, row: usize, is_free: bool) {
        let cell = row * self.size()[0] + col;
        self.free[cell] = is_free;
    }

    /// Opens the wall between two spaces beside each other, counted in spaces.
    fn join(&mut self, a: [usize; 2], b: [usize; 2]) {
        self.open(a[0] + b[0] + 1, a[1] + b[1] + 1, true);
    }

    /// A tree of ways through all spaces, dug from the lower left one: on to a neighbour where nobody was yet, back where
    /// there is none.
    fn dig_tree(&mut self, stream: &mut Stream) {
        let [cols, rows] = self.spaces();
        let mut is_dug = vec![false; cols * rows];
        let mut way = vec![[0, 0]];
        while let Some(&[col, row]) = way.last() {
            self.open(2 * col + 1, 2 * row + 1, true);
            is_dug[row * cols + col] = true;
            let around =
                [[col + 1, row], [col, row + 1], [col.wrapping_sub(1), row], [col, row.wrapping_sub(1)]];
            let is_new = |at: &[usize; 2]| at[0] < cols && at[1] < rows && !is_dug[at[1] * cols + at[0]];
            let new: Vec<[usize; 2]> = around.into_iter().filter(is_new).collect();
            if new.is_empty() {
                way.pop();
            } else {
                let next = new[super::below(stream, new.len())];
                self.join([col, row], next);
                way.push(next);
            }
        }
    }

    /// The middle of a cell (m).
    fn middle(&self, cell: usize) -> DVec2 {
        let [cols, _] = self.size();
        let middle = |borders: &[f64], index: usize| f64::midpoint(borders[index], borders[index + 1]);
        DVec2::new(middle(&self.xs, cell % cols), middle(&self.ys, cell / cols))
    }

    /// The walls, the lower left space, and the space that is farthest from there.
    fn walled(self, width_m: f64) -> Result<Made, MapError> {
        let [cols, rows] = self.size();
        let cells = Cells::new(cols, self.free.clone());
        let refused = |why: String| MapError::Read { file: "the map to be made".into(), why };
        let place = |corner: DVec2| DVec2::new(border(&self.xs, corner.x), border(&self.ys, corner.y));
        let map = raster::to_map(&cells, 1.0, 0.0, place, refused)?;

        let mut edges = vec![Vec::new(); cols * rows];
        for cell in 0..cols * rows {
            let beside = [(cell % cols + 1 < cols).then_some(cell + 1), Some(cell + cols)];
            for next in beside.into_iter().flatten().filter(|next| *next < cols * rows) {
                if self.free[cell] && self.free[next] {
                    let apart_m = self.middle(cell).distance(self.middle(next));
                    edges[cell].push((next, apart_m));
                    edges[next].push((cell, apart_m));
                }
            }
        }
        let base = cols + 1;
        let is_space = |cell: usize| cell % cols % 2 == 1 && cell / cols % 2 == 1;
        let (goal, way_m) = farthest(&way_lengths_m(base, &edges), is_space);
        let length_m = edges.iter().flatten().map(|(_, edge_m)| edge_m).sum::<f64>() / 2.0;
        let (base_m, goal_m) = (self.middle(base).into(), self.middle(goal).into());
        Ok(Made { map, base_m, goal_m, way_m, length_m, width_m, roughness: 0.0 })
    }
}

/// Borders of so many spaces with a wall before, between and behind them (m).
fn borders(
    spaces: usize,
    mut space_m: impl FnMut(usize) -> f64,
    mut wall_m: impl FnMut(usize) -> f64,
) -> Vec<f64> {
    let mut borders = vec![0.0];
    let mut at_m = 0.0;
    for index in 0..=2 * spaces {
        at_m += if index % 2 == 0 { wall_m(index / 2) } else { space_m(index / 2) };
        borders.push(at_m);
    }
    borders
}

/// The place of a border, or between two of them (m).
fn border(borders: &[f64], at: f64) -> f64 {
    let index = (at as usize).min(borders.len() - 2);
    borders[index] + (at - index as f64) * (borders[index + 1] - borders[index])
}
