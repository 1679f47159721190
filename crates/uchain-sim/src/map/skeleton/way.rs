//! The way between two places, in the middle of the passages.

use glam::Vec2;

use super::{
    TunnelGraph,
    near::{Near, is_clear},
};
use crate::map::{CentreLine, Map};

/// A way so many times as long as the straight one is left for it, if that keeps as far from the walls.
const DETOUR: f32 = 1.1;

impl TunnelGraph {
    /// The shortest way in the middle between two places of free space, as a centre line. They join the graph where they
    /// see it. `None` if one is in rock, or no way leads there.
    pub fn way(&self, map: &Map, from: Vec2, to: Vec2) -> Option<CentreLine> {
        self.way_for(map, from, to, 0.0)
    }

    /// [`TunnelGraph::way`] for somebody who needs so much room on all sides (m).
    pub fn way_for(&self, map: &Map, from: Vec2, to: Vec2, radius_m: f32) -> Option<CentreLine> {
        if map.in_rock(to) {
            return None;
        }
        let tree = self.tree_for(map, from, radius_m);
        let (climb, joined) = Near::new(&tree.at).way_from(map, to, radius_m)?;
        let mut way = tree.way_to(joined);
        way.extend(climb.iter().rev());
        without_turning_back(map, &mut way);
        way.reverse();
        without_turning_back(map, &mut way);
        way.reverse();
        let length_m: f32 = way.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
        let least_m = way.iter().map(|&at| map.clearance_m(at)).fold(f32::INFINITY, f32::min);
        if length_m > DETOUR * from.distance(to) && is_clear(map, from, to, least_m) {
            way = vec![from, to];
        }
        let places: Vec<_> = way.iter().map(|at| at.as_dvec2()).collect();
        Some(CentreLine::through(&places))
    }
}

/// Leaves out the places after the first that the way only goes to in order to come back.
fn without_turning_back(map: &Map, way: &mut Vec<Vec2>) {
    let Some(&first) = way.first() else { return };
    let back = |pair: &[Vec2]| (pair[0] - first).dot(pair[1] - pair[0]) < 0.0;
    let turns = way.windows(2).skip(1).take_while(|pair| back(pair)).count();
    if let Some(&next) = way.get(1 + turns)
        && map.sees(first, next)
    {
        way.drain(1..=turns);
    }
}
