//! The two ends of passages that are farthest from each other along the way: a base and a goal to begin with.

use std::collections::BTreeSet;

use serde::Serialize;
use uchain_sim::map::{GraphEdge, Map, NodeKind, TunnelGraph};

/// A base and a goal.
#[expect(clippy::struct_field_names, reason = "the unit is in every name")]
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub(super) struct Ends {
    /// In the map file's own frame (m), as all places here.
    pub(super) base_m: [f64; 2],
    pub(super) goal_m: [f64; 2],
    /// Between them, along the middle of the passages (m).
    pub(super) way_m: f64,
}

impl Ends {
    /// In the largest part of the map that something so wide fits through: the two dead ends that are farthest from each
    /// other (exact without rings, by two sweeps), else any two places where passages meet; in a single ring, its two
    /// sides.
    pub(super) fn of(map: &Map, graph: &TunnelGraph, needs_m: f64) -> Option<Self> {
        let is_wide = |width_m: f32| f64::from(width_m) >= needs_m;
        let edges: Vec<usize> =
            (0..graph.edges.len()).filter(|&edge| is_wide(graph.edges[edge].narrowest_m)).collect();
        let part = largest_part(graph, &edges)?;
        let of_part: Vec<usize> =
            edges.iter().copied().filter(|&edge| part.contains(&graph.edges[edge].ends[0])).collect();
        let dead: Vec<usize> =
            part.iter().copied().filter(|&node| graph.nodes[node].kind == NodeKind::DeadEnd).collect();
        let places = if dead.len() > 1 { dead } else { part.into_iter().collect() };
        let place = |at| map.to_file(at).map(|m: f64| (m * 100.0).round() / 100.0);
        if let [only] = places[..] {
            // Out and back on the longest ring.
            let longest = of_part
                .iter()
                .max_by(|&&a, &&b| graph.edges[a].length_m.total_cmp(&graph.edges[b].length_m))?;
            let ring = &graph.edges[*longest];
            let goal_m = place(*ring.line.get(ring.line.len() / 2)?);
            return Some(Self { base_m: place(graph.nodes[only].at), goal_m, way_m: 0.5 * ring.length_m });
        }
        let (base, _) = farthest(graph, &of_part, places[0], &places)?;
        let (goal, way_m) = farthest(graph, &of_part, base, &places)?;
        let [base, goal] = [base, goal].map(|node| {
            let at = with_room(graph, &of_part, node, needs_m).map(|(edge, index)| edge.line[index]);
            place(at.unwrap_or(graph.nodes[node].at))
        });
        Some(Self { base_m: base, goal_m: goal, way_m })
    }
}

/// The place nearest to the end of a passage, along it, that something so wide fits at.
fn with_room<'g>(
    graph: &'g TunnelGraph,
    edges: &[usize],
    node: usize,
    needs_m: f64,
) -> Option<(&'g GraphEdge, usize)> {
    let edge = edges.iter().map(|&edge| &graph.edges[edge]).find(|edge| edge.ends.contains(&node))?;
    let has_room = |index: &usize| 2.0 * f64::from(edge.clearance_m[*index]) >= needs_m;
    let found = if edge.ends[0] == node {
        (0..edge.line.len()).find(has_room)
    } else {
        (0..edge.line.len()).rev().find(has_room)
    };
    found.map(|index| (edge, index))
}

/// The nodes that hang together by these edges, of the part that is longest in all.
fn largest_part(graph: &TunnelGraph, edges: &[usize]) -> Option<BTreeSet<usize>> {
    let mut part_of: Vec<usize> = (0..graph.nodes.len()).collect();
    for &edge in edges {
        let [a, b] = graph.edges[edge].ends.map(|node| root(&mut part_of, node));
        part_of[a.max(b)] = a.min(b);
    }
    let mut lengths_m = vec![0.0; graph.nodes.len()];
    for &edge in edges {
        lengths_m[root(&mut part_of, graph.edges[edge].ends[0])] += graph.edges[edge].length_m;
    }
    let longest = (0..lengths_m.len()).filter(|&node| lengths_m[node] > 0.0);
    let longest = longest.max_by(|&a, &b| lengths_m[a].total_cmp(&lengths_m[b]))?;
    Some((0..graph.nodes.len()).filter(|&node| root(&mut part_of, node) == longest).collect())
}

/// The first node of a part (union by the lower number, paths halved).
fn root(part_of: &mut [usize], mut node: usize) -> usize {
    while part_of[node] != node {
        part_of[node] = part_of[part_of[node]];
        node = part_of[node];
    }
    node
}

/// Which of the places is farthest from one along the edges, and how far (m), by Dijkstra.
fn farthest(graph: &TunnelGraph, edges: &[usize], from: usize, places: &[usize]) -> Option<(usize, f64)> {
    let mut beside = vec![Vec::new(); graph.nodes.len()];
    for &edge in edges {
        let edge = &graph.edges[edge];
        let [a, b] = edge.ends;
        beside[a].push((b, edge.length_m));
        beside[b].push((a, edge.length_m));
    }
    let mut lengths_m = vec![f64::INFINITY; graph.nodes.len()];
    // Bits of numbers that are not negative are ordered as the numbers are.
    let mut open = BTreeSet::from([(0_u64, from)]);
    lengths_m[from] = 0.0;
    while let Some((bits, node)) = open.pop_first() {
        for &(next, edge_m) in &beside[node] {
            let length_m = f64::from_bits(bits) + edge_m;
            if length_m < lengths_m[next] {
                open.remove(&(lengths_m[next].to_bits(), next));
                open.insert((length_m.to_bits(), next));
                lengths_m[next] = length_m;
            }
        }
    }
    let reached = places.iter().map(|&place| (place, lengths_m[place])).filter(|(_, m)| m.is_finite());
    reached.max_by(|a, b| a.1.total_cmp(&b.1))
}
