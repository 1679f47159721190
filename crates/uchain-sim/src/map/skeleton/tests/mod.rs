//! The graph on tunnels that can be worked out by hand, against a slow search over cells, and on real buildings.

#[cfg(feature = "maps")]
mod buildings;
mod oracle;
mod shapes;
mod ways;

use glam::{Vec2, vec2};

use super::{NodeKind, TunnelGraph};
use crate::map::Map;

fn rectangle(x0: f32, y0: f32, x1: f32, y1: f32) -> Vec<Vec2> {
    vec![vec2(x0, y0), vec2(x1, y0), vec2(x1, y1), vec2(x0, y1)]
}

fn map_of(corners: &[(f32, f32)]) -> Map {
    Map::from_loops(vec![corners.iter().map(|&(x, y)| vec2(x, y)).collect()]).unwrap()
}

fn kinds(graph: &TunnelGraph) -> [usize; 4] {
    [NodeKind::DeadEnd, NodeKind::Junction, NodeKind::Ring, NodeKind::Room]
        .map(|kind| graph.nodes.iter().filter(|node| node.kind == kind).count())
}

/// What holds for every graph: its samples lie in free space, with the room they say, and each sees the next; nodes and
/// edges name each other.
fn check(map: &Map, graph: &TunnelGraph) {
    for (index, edge) in graph.edges.iter().enumerate() {
        assert_eq!(edge.line.len(), edge.clearance_m.len());
        for (&at, &clearance_m) in edge.line.iter().zip(&edge.clearance_m) {
            assert!(!map.in_rock(at), "edge {index}: {at} is in rock");
            assert!((map.clearance_m(at) - clearance_m).abs() < 1e-5);
        }
        for (pair, rooms_m) in edge.line.windows(2).zip(edge.clearance_m.windows(2)) {
            assert!(map.sees(pair[0], pair[1]), "edge {index}: {} does not see {}", pair[0], pair[1]);
            let most_m = rooms_m[0].max(rooms_m[1]);
            assert!(pair[0].distance(pair[1]) <= 1.01 * most_m, "edge {index}: {pair:?} {rooms_m:?}");
        }
        let ends = edge.ends.map(|end| graph.nodes[end].at);
        assert_eq!([edge.line.first(), edge.line.last()], [Some(&ends[0]), Some(&ends[1])]);
        assert!(edge.ends.iter().all(|&end| graph.nodes[end].edges.contains(&index)));
    }
    for node in &graph.nodes {
        assert!(!map.in_rock(node.at) && (node.width_m / 2.0 - map.clearance_m(node.at)).abs() < 1e-4);
    }
}
