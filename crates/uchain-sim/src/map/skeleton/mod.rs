//! The tunnel graph of a map: the middle of its passages, where they meet and where they end.
//!
//! The middle of free space is where the nearest walls are equally far on two sides or more: the medial axis (Blum 1967, "A
//! transformation for extracting new descriptors of shape"). It is found as the Voronoi diagram of places on the walls
//! (Brandt & Algazi 1992), in four steps:
//!
//! 1. Places on the walls, as dense as the walls are near to each other, in a Delaunay triangulation. Where a circle
//!    through three of them is cut by a wall, the wall's nearest point becomes one more.
//! 2. The middles of the circles in free space, and the steps between neighbours that see each other.
//! 3. What runs into a corner or a dent of a wall is taken away by a stated rule.
//! 4. What is left becomes nodes and lines; junctions that are one place are one; every place of a line moves to where
//!    the walls are farthest.
//!
//! Nothing depends on a cell size: a map of 10 m and one of 10 km are as exact. Passages narrower than 6 cm are none.

mod draft;
mod mesh;
mod near;
mod settle;
#[cfg(test)]
mod tests;
mod tree;
mod way;

use glam::Vec2;
use serde::Serialize;

use super::{Map, MapError};
use draft::Draft;

pub use tree::WayTree;

/// Passages narrower than this are none (m): half of what a UAV of 6 cm radius needs.
pub const NARROWEST_M: f64 = 0.06;

/// How far the tip of a dead end reaches, as a share of the distance to the walls (1): a line that runs into a right-angled
/// corner is √2 of it long.
const TIP_SHARE: f32 = 1.5;

/// The middle of all passages of a map.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct TunnelGraph {
    /// Junctions, dead ends and the like.
    pub nodes: Vec<GraphNode>,
    /// The passages between them.
    pub edges: Vec<GraphEdge>,
}

/// A place where passages meet or end.
#[derive(Debug, Clone, PartialEq)]
pub struct GraphNode {
    /// Place (m).
    pub at: Vec2,
    /// Width of free space there, twice the distance to the nearest wall (m).
    pub width_m: f32,
    /// What it is.
    pub kind: NodeKind,
    /// The edges that end here; one that comes back here stands twice.
    pub edges: Vec<usize>,
}

/// What a node of the graph is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum NodeKind {
    /// The end of a passage.
    DeadEnd,
    /// Three passages or more meet.
    Junction,
    /// Where a ring without junctions is taken to begin: its widest place.
    Ring,
    /// A room without passages: its widest place.
    Room,
}

/// A passage from node to node.
#[derive(Debug, Clone, PartialEq)]
pub struct GraphEdge {
    /// The nodes at its ends, which may be one.
    pub ends: [usize; 2],
    /// Its middle, both ends included (m). Each place sees the next, and lies no farther from it than about 0.7 times
    /// the distance to the walls.
    pub line: Vec<Vec2>,
    /// Distance to the nearest wall at each place of the line (m).
    pub clearance_m: Vec<f32>,
    /// Length of the line (m).
    pub length_m: f64,
    /// Least width along the line (m), without the tips of dead ends: what lies nearer to them than about one and a half
    /// times the distance to the walls, where the line runs into a corner.
    pub narrowest_m: f32,
}

impl GraphEdge {
    fn along(map: &Map, ends: [usize; 2], line: Vec<Vec2>) -> Self {
        let clearance_m: Vec<f32> = line.iter().map(|&at| map.clearance_m(at)).collect();
        let length_m = line.windows(2).map(|pair| f64::from(pair[0].distance(pair[1]))).sum();
        let narrowest_m = 2.0 * clearance_m.iter().copied().fold(f32::INFINITY, f32::min);
        Self { ends, line, clearance_m, length_m, narrowest_m }
    }

    /// Least width without the tips that are dead ends: a corner may be narrow into which nobody has to fly. In a corner
    /// no circle reaches the tip; there the distance to the walls in the middle of the passage is the measure.
    fn narrowest_without(&self, is_tip: [bool; 2]) -> f32 {
        let mut sorted_m = self.clearance_m.clone();
        sorted_m.sort_by(f32::total_cmp);
        let middle_m = sorted_m.get(sorted_m.len() / 2).copied().unwrap_or_default();
        let is_near = |tip: Option<&Vec2>, (at, clearance_m): (&Vec2, &f32)| {
            tip.is_some_and(|tip| tip.distance(*at) < TIP_SHARE * clearance_m.max(middle_m))
        };
        let places = || self.line.iter().zip(&self.clearance_m);
        let first = if is_tip[0] {
            places().take_while(|&place| is_near(self.line.first(), place)).count()
        } else {
            0
        };
        let last = if is_tip[1] {
            places().rev().take_while(|&place| is_near(self.line.last(), place)).count()
        } else {
            0
        };
        let inner =
            self.clearance_m.get(first..self.clearance_m.len().saturating_sub(last)).unwrap_or_default();
        let least_m = inner.iter().copied().reduce(f32::min);
        2.0 * least_m.unwrap_or_else(|| self.clearance_m.iter().copied().fold(0.0, f32::max))
    }
}

impl Map {
    /// The middle of all passages, where they meet and where they end.
    ///
    /// ```
    /// use uchain_libm as _; // the same bits on every system
    /// use uchain_sim::map::{NodeKind, Vertex, corridor};
    /// let corner = |x, y| Vertex { x, y, bend_radius_m: 0.0 };
    /// let (map, _) = corridor(&[corner(0.0, 0.0), corner(30.0, 0.0), corner(30.0, 20.0)], 2.0, false).unwrap();
    /// let graph = map.tunnel_graph().unwrap();
    /// assert_eq!((graph.nodes.len(), graph.edges.len()), (2, 1));
    /// assert!(graph.nodes.iter().all(|node| node.kind == NodeKind::DeadEnd));
    /// assert!((graph.edges[0].narrowest_m - 2.0).abs() < 0.1);
    /// ```
    ///
    /// Passages narrower than [`NARROWEST_M`] are none. A branch is a dead end only if it reaches farther beyond the
    /// widest circle at its root than it is wide where it leaves that circle; else it is a dent in a wall. Junctions
    /// that are nearer to each other than half the distance to the walls are one.
    ///
    /// # Errors
    /// A map that needs more than 1,000,000 places on its walls, or whose walls crowd at one place so much that looking at
    /// them would take minutes.
    pub fn tunnel_graph(&self) -> Result<TunnelGraph, MapError> {
        let draft = Draft::of(&mesh::ways(self)?);
        let mut graph = TunnelGraph::default();
        let mut node_of = vec![None; draft.nodes.len()];
        for (index, &(at, room_m)) in draft.nodes.iter().enumerate() {
            if !draft.is_part_of_another(index) {
                node_of[index] = Some(graph.nodes.len());
                let (at, width_m) = (at.as_vec2(), 2.0 * room_m as f32);
                graph.nodes.push(GraphNode { at, width_m, kind: NodeKind::Room, edges: Vec::new() });
            }
        }
        for line in draft.edges.iter().flatten() {
            let [Some(from), Some(to)] = line.ends.map(|end| node_of[end]) else { continue };
            let places = settle::settle(self, &line.places).iter().map(|at| at.as_vec2()).collect();
            for end in [from, to] {
                graph.nodes[end].edges.push(graph.edges.len());
            }
            graph.edges.push(GraphEdge::along(self, [from, to], places));
        }
        for node in &mut graph.nodes {
            node.kind = match node.edges[..] {
                [] => NodeKind::Room,
                [_] => NodeKind::DeadEnd,
                [_, _] => NodeKind::Ring,
                _ => NodeKind::Junction,
            };
        }
        for edge in &mut graph.edges {
            let is_tip = edge.ends.map(|end| graph.nodes[end].kind == NodeKind::DeadEnd);
            edge.narrowest_m = edge.narrowest_without(is_tip);
        }
        Ok(graph)
    }
}
