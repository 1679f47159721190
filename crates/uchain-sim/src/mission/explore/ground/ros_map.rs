//! An explored map as a ROS `map_server` map.

use glam::Vec2;

use crate::mission::explore::Ground;
use crate::{
    map::{Map, write},
    mission::explore::NodeFrame,
};

const FREE: u8 = 254;
const OCCUPIED: u8 = 0;
const UNKNOWN: u8 = 205;

/// A picture in PGM, and the yaml that names it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RosMap {
    /// The picture, binary PGM.
    pub pgm: Vec<u8>,
    /// The yaml. It names the picture `map.pgm`.
    pub yaml: String,
}

impl RosMap {
    /// What a team has explored, in the cells of the ground, in the frame of the map's file or scenario. Free is what
    /// lies within `r_s_m` and in line of sight of a node, occupied is rock next to it, all else is unknown.
    pub fn explored(map: &Map, ground: &Ground, nodes: &[NodeFrame], r_s_m: f32) -> Self {
        let [cols, rows] = ground.cells().size();
        // A ring of unknown cells closes what reaches to the edge.
        let (width, height) = (cols + 2, rows + 2);
        let mut cells = vec![UNKNOWN; width * height];
        let at = |index: usize| (index / cols + 1) * width + index % cols + 1;
        for node in nodes {
            let from = Vec2::from(node.at_m);
            for index in ground.cells().near(from, r_s_m) {
                let to = ground.cells().middle_of(index);
                let cell = &mut cells[at(index)];
                if *cell != FREE && from.distance(to) <= r_s_m && !map.in_rock(to) && map.sees(from, to) {
                    *cell = FREE;
                }
            }
        }
        for cell in 0..cells.len() {
            let beside = |other: usize| cells.get(other) == Some(&FREE);
            let (up, down) = (cell + width, cell.wrapping_sub(width));
            let rows = [down, cell, up];
            let next_to_free = rows
                .into_iter()
                .any(|row| beside(row) || beside(row.wrapping_sub(1)) || beside(row.wrapping_add(1)));
            let middle = middle_of(ground, cell, width);
            if cells[cell] == UNKNOWN && next_to_free && map.in_rock(middle) {
                cells[cell] = OCCUPIED;
            }
        }
        // Pictures begin at the top.
        let grey: Vec<u8> = cells.chunks(width).rev().flatten().copied().collect();
        let low = ground.cells().low().as_dvec2() - f64::from(ground.cells().cell_m());
        let [east_m, north_m] = map.offset_m();
        let corner_m = [low.x + east_m, low.y + north_m];
        let yaml = write::yaml("map.pgm", &ground.cells().cell_m().to_string(), corner_m);
        Self { pgm: write::pgm([width, height], &grey), yaml }
    }
}

/// The middle of a cell of the picture (m).
fn middle_of(ground: &Ground, cell: usize, width: usize) -> Vec2 {
    let at = Vec2::new((cell % width) as f32, (cell / width) as f32);
    ground.cells().low() + (at - 0.5) * ground.cells().cell_m()
}
