//! What a map is in numbers: size, free area, passages and their widths, and what is too narrow.

mod areas;
#[cfg(test)]
mod tests;

use serde::Serialize;

use super::{Map, NodeKind, TunnelGraph};

/// What a UAV keeps between itself and a wall on either side to get through a passage (m).
pub const UAV_MARGIN_M: f32 = 0.05;
/// Width that a star of the exploration needs (m), with 18 sectors and a sensing radius of 1 m (Kim 2021).
pub const STAR_WIDTH_M: f32 = 0.9;

/// What a map is in numbers. Places are in the frame of its file.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MapNumbers {
    /// Width and height of the box around all walls (m).
    pub size_m: [f64; 2],
    /// Area of free space (m²); exact.
    pub free_area_m2: f64,
    /// Separate pieces of free space.
    pub pieces: usize,
    /// The largest piece's share of the free area (1).
    pub largest_share: f64,
    /// Passages: edges of the tunnel graph.
    pub passages: usize,
    /// Ends of passages.
    pub dead_ends: usize,
    /// Those of them that a UAV cannot fly into from the other end of their passage.
    pub dead_ends_too_narrow: usize,
    /// Places where three passages or more meet.
    pub junctions: usize,
    /// Ways round: as many passages can be closed without cutting a place off.
    pub loops: usize,
    /// Length of all passages along their middle (m).
    pub length_m: f64,
    /// How wide the passages are (m); `None` without a passage.
    pub width_m: Option<Widths>,
    /// Width that a UAV needs, its margin included (m).
    pub uav_needs_m: f64,
    /// Length of passage narrower than that (m).
    pub too_narrow_m: f64,
    /// Width that a star of the exploration needs (m).
    pub star_needs_m: f64,
    /// Length of passage narrower than that (m).
    pub too_narrow_for_a_star_m: f64,
    /// The narrowest place of a passage.
    pub narrowest: Option<Narrowest>,
}

/// Widths of passages, by length (m): a tenth of all passages is narrower than `p10`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Widths {
    /// The least.
    pub min: f64,
    /// A tenth is narrower.
    pub p10: f64,
    /// Half is narrower.
    pub median: f64,
    /// Nine tenths are narrower.
    pub p90: f64,
    /// The greatest.
    pub max: f64,
}

/// Where a passage is narrowest.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Narrowest {
    /// Place in the frame of the map's file (m).
    pub at_m: [f64; 2],
    /// Width there (m).
    pub width_m: f64,
}

impl Map {
    /// What the map is in numbers. `graph` is its own; `uav_radius_m` is half of what a UAV is wide.
    pub fn numbers(&self, graph: &TunnelGraph, uav_radius_m: f32) -> MapNumbers {
        let (low, high) = self.bounds();
        let size = (high - low).as_dvec2();
        let areas_m2 = self.free_areas_m2();
        let free_area_m2: f64 = areas_m2.iter().sum();
        let largest_m2 = areas_m2.first().copied().unwrap_or(0.0);
        let of_kind = |kind| graph.nodes.iter().filter(|node| node.kind == kind).count();
        // Width and length of every step of every passage.
        let mut steps: Vec<(f64, f64)> = Vec::new();
        let mut narrowest: Option<Narrowest> = None;
        for edge in &graph.edges {
            for (pair, rooms_m) in edge.line.windows(2).zip(edge.clearance_m.windows(2)) {
                let width_m = f64::from(rooms_m[0]) + f64::from(rooms_m[1]);
                steps.push((width_m, f64::from(pair[0].distance(pair[1]))));
            }
            for (at, &room_m) in edge.line.iter().zip(&edge.clearance_m) {
                let width_m = 2.0 * f64::from(room_m);
                if narrowest.is_none_or(|narrowest| width_m < narrowest.width_m) {
                    let [x, y] = self.offset_m();
                    narrowest = Some(Narrowest { at_m: [f64::from(at.x) + x, f64::from(at.y) + y], width_m });
                }
            }
        }
        steps.sort_by(|p, q| p.0.total_cmp(&q.0));
        // From 0 on: the sum of nothing is −0.
        let length_m = steps.iter().fold(0.0, |sum_m, step| sum_m + step.1);
        let narrower_m = |than_m: f64| {
            steps.iter().take_while(|step| step.0 < than_m).fold(0.0, |sum_m, step| sum_m + step.1)
        };
        let uav_needs_m = 2.0 * f64::from(uav_radius_m + UAV_MARGIN_M);
        let star_needs_m = f64::from(STAR_WIDTH_M);
        let dead_ends = graph.nodes.iter().filter(|node| node.kind == NodeKind::DeadEnd);
        let tight = dead_ends.filter(|node| {
            node.edges.iter().any(|&edge| f64::from(graph.edges[edge].narrowest_m) < uav_needs_m)
        });
        MapNumbers {
            size_m: size.into(),
            free_area_m2,
            pieces: areas_m2.len(),
            largest_share: if free_area_m2 > 0.0 { largest_m2 / free_area_m2 } else { 0.0 },
            passages: graph.edges.len(),
            dead_ends: of_kind(NodeKind::DeadEnd),
            dead_ends_too_narrow: tight.count(),
            junctions: of_kind(NodeKind::Junction),
            loops: (graph.edges.len() + graph.pieces()).saturating_sub(graph.nodes.len()),
            length_m,
            width_m: Widths::of(&steps, length_m),
            uav_needs_m,
            too_narrow_m: narrower_m(uav_needs_m),
            star_needs_m,
            too_narrow_for_a_star_m: narrower_m(star_needs_m),
            narrowest,
        }
    }
}

impl Widths {
    /// Of widths and lengths, the narrowest first, and the sum of the lengths.
    fn of(steps: &[(f64, f64)], length_m: f64) -> Option<Self> {
        let at = |share: f64| {
            let mut left_m = share * length_m;
            let found = steps.iter().find(|step| {
                left_m -= step.1;
                left_m <= 0.0
            });
            found.or(steps.last()).map(|step| step.0)
        };
        let (min, max) = (steps.first()?.0, steps.last()?.0);
        Some(Self { min, p10: at(0.1)?, median: at(0.5)?, p90: at(0.9)?, max })
    }
}

impl TunnelGraph {
    /// How many pieces of the graph there are that no passage joins.
    pub fn pieces(&self) -> usize {
        let mut piece_of: Vec<Option<usize>> = vec![None; self.nodes.len()];
        let mut pieces = 0;
        for first in 0..self.nodes.len() {
            if piece_of[first].is_some() {
                continue;
            }
            let mut open = vec![first];
            while let Some(node) = open.pop() {
                if piece_of[node].replace(pieces).is_none() {
                    open.extend(self.nodes[node].edges.iter().flat_map(|&edge| self.edges[edge].ends));
                }
            }
            pieces += 1;
        }
        pieces
    }
}
