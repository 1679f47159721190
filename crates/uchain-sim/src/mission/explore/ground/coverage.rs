//! What of the reachable ground has been seen, by whom, and what has not.

use std::f32::consts::TAU;

use glam::Vec2;
use serde::Serialize;

use crate::mission::explore::Ground;
use crate::{map::Map, mission::explore::NodeFrame};

/// Nodes of several robots see a cell.
const SEVERAL: u16 = u16::MAX;

/// Cells seen so far: those within `r_s_m` and in line of sight of a node.
#[derive(Debug, Clone)]
pub struct Coverage {
    r_s_m: f32,
    /// Per cell of the ground, whose nodes see it: nobody's, one robot's (its number and 1), or several robots'.
    seen_by: Vec<u16>,
    seen: usize,
    shared: usize,
}

/// A piece of the reachable ground that no node has seen.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Unseen {
    /// Its middle, in the frame of the map's file or scenario (m); it may lie outside of a bent piece.
    pub x_m: f64,
    /// Its middle (m).
    pub y_m: f64,
    /// Its area (m²).
    pub area_m2: f64,
    /// Of its area, what lies in or behind passages narrower than stars surely look through (m²).
    pub behind_m2: f64,
    /// How wide the widest way to that is at its narrowest (m); `None` if there is nothing.
    pub passage_m: Option<f64>,
}

impl Coverage {
    /// Nothing is seen yet.
    pub fn new(ground: &Ground, r_s_m: f32) -> Self {
        Self { r_s_m, seen_by: vec![0; ground.cells().count()], seen: 0, shared: 0 }
    }

    /// A node looks around, from where its robot truly was.
    pub fn look(&mut self, map: &Map, ground: &Ground, node: &NodeFrame) {
        let (from, own) = (Vec2::from(node.at_m), node.id.robot.saturating_add(1).min(SEVERAL - 1));
        for index in ground.cells().near(from, self.r_s_m) {
            let before = self.seen_by[index];
            if before == own || before == SEVERAL || !ground.is_reachable(index) {
                continue;
            }
            let to = ground.cells().middle_of(index);
            let far_m = from.distance(to);
            if far_m > self.r_s_m || !(in_star(node, to - from, far_m) || map.sees(from, to)) {
                continue;
            }
            self.seen_by[index] = if before == 0 { own } else { SEVERAL };
            self.seen += usize::from(before == 0);
            self.shared += usize::from(before != 0);
        }
    }

    /// Whether a node has seen a cell.
    pub fn has_seen(&self, index: usize) -> bool {
        self.seen_by.get(index).is_some_and(|by| *by != 0)
    }

    /// Share of the reachable ground that has been seen (1).
    pub fn share(&self, ground: &Ground) -> f64 {
        self.seen as f64 / ground.count().max(1) as f64
    }

    /// Share of what has been seen that more than one robot has seen (1).
    pub fn overlap(&self) -> f64 {
        self.shared as f64 / self.seen.max(1) as f64
    }

    /// What has not been seen, in connected pieces, the largest first.
    pub fn unseen(&self, map: &Map, ground: &Ground) -> Vec<Unseen> {
        let mut left: Vec<bool> = (0..self.seen_by.len())
            .map(|index| ground.is_reachable(index) && !self.has_seen(index))
            .collect();
        let cell_m2 = ground.cells().cell_m2();
        let mut pieces = Vec::new();
        for first in 0..left.len() {
            let piece = ground.cells().take_connected(first, &mut left);
            let (mut sum, count) = (glam::DVec2::ZERO, piece.len() as u32);
            let (mut behind, mut passage_m) = (0_u32, None::<f32>);
            for index in piece {
                sum += ground.cells().middle_of(index).as_dvec2();
                if let Some(width_m) = ground.passages().width_m(index) {
                    behind += 1;
                    passage_m = Some(passage_m.map_or(width_m, |widest_m| widest_m.max(width_m)));
                }
            }
            if count > 0 {
                let middle = sum / f64::from(count);
                let [east_m, north_m] = map.offset_m();
                let (x_m, y_m) = (middle.x + east_m, middle.y + north_m);
                let [area_m2, behind_m2] = [count, behind].map(|cells| f64::from(cells) * cell_m2);
                pieces.push(Unseen { x_m, y_m, area_m2, behind_m2, passage_m: passage_m.map(f64::from) });
            }
        }
        // The sort is stable: of equal ones the lower comes first.
        pieces.sort_by(|a, b| b.area_m2.total_cmp(&a.area_m2));
        pieces
    }
}

/// Whether a place lies in a node's star, which no wall enters: sight need not be tested.
fn in_star(node: &NodeFrame, to: Vec2, far_m: f32) -> bool {
    let count = node.sectors.len();
    let turn = libm::atan2f(to.y, to.x) / TAU;
    let facing = ((turn - turn.floor()) * count as f32) as usize;
    // At the edge of two sectors rounding may face either.
    let margin_m = 1e-3;
    let facing = node.sectors.get(facing.min(count.saturating_sub(1)));
    facing.is_some_and(|sector| far_m < sector.r_m - margin_m)
}
