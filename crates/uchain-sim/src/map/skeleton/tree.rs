//! The shortest ways from one place to all others, along the middle of the passages.

use std::{cmp::Reverse, collections::BinaryHeap};

use glam::Vec2;

use super::{TunnelGraph, near::Near};
use crate::map::Map;

/// Spacing of a tree's samples at most (m), and the number of samples from which on they are farther apart.
const SPACING_M: f64 = 0.25;
const MOST_SAMPLES: f64 = 200_000.0;

/// Shortest ways from one place to all: samples along the middle, each with the one before it on the way.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct WayTree {
    /// Places (m); the first is where all ways begin.
    pub at: Vec<Vec2>,
    /// The sample before each on its way: always one of less index. None before the first.
    pub parent: Vec<Option<u32>>,
    /// Length of the way there (m).
    pub depth_m: Vec<f64>,
    /// Distance to the nearest wall (m).
    pub clearance_m: Vec<f32>,
    /// The edge of the graph that each lies on; before the way has joined the graph the edge that it joins, and as many as
    /// there are edges where it joins none.
    pub edge: Vec<u32>,
}

impl WayTree {
    fn add(&mut self, map: &Map, at: Vec2, parent: Option<u32>, edge: u32) -> u32 {
        let before = parent.map(|parent| parent as usize);
        let step_m = before.map_or(0.0, |before| f64::from(self.at[before].distance(at)));
        self.depth_m.push(before.map_or(0.0, |before| self.depth_m[before]) + step_m);
        self.at.push(at);
        self.parent.push(parent);
        self.clearance_m.push(map.clearance_m(at));
        self.edge.push(edge);
        self.at.len() as u32 - 1
    }

    /// Adds samples up to a place and that place; the last one.
    fn go(&mut self, map: &Map, from: u32, to: Vec2, edge: u32, spacing_m: f64) -> u32 {
        let start = self.at[from as usize];
        let pieces = (f64::from(start.distance(to)) / spacing_m).ceil();
        let mut last = from;
        for piece in 1..=pieces as u32 {
            let share = piece as f32 / pieces as f32;
            let at = if f64::from(piece) == pieces { to } else { start.lerp(to, share) };
            last = self.add(map, at, Some(last), edge);
        }
        last
    }

    /// The sample farthest from the first by way; `None` if there is none.
    pub fn deepest(&self) -> Option<usize> {
        (0..self.at.len()).max_by(|&p, &q| self.depth_m[p].total_cmp(&self.depth_m[q]).then(q.cmp(&p)))
    }

    /// For those who ask which sample is the nearest in sight.
    pub(crate) fn near(&self) -> Near<'_> {
        Near::new(&self.at)
    }

    /// The places from the first sample to one of them, both included.
    pub fn way_to(&self, sample: usize) -> Vec<Vec2> {
        let mut way = Vec::new();
        let mut here = Some(sample as u32);
        while let Some(index) = here {
            let Some(&at) = self.at.get(index as usize) else { break };
            way.push(at);
            here = self.parent[index as usize];
        }
        way.reverse();
        way
    }
}

/// An edge, or a part of one, that can be passed from end to end.
struct Piece<'g> {
    ends: [usize; 2],
    line: &'g [Vec2],
    edge: u32,
    length_m: f64,
}

impl TunnelGraph {
    /// Shortest ways from one place to all, along the middle: a tree of samples, parents before children, about 0.25 m
    /// apart. Empty if the place is in rock, or sees nothing of the graph. Places that the ways do not reach are not in it.
    pub fn tree(&self, map: &Map, from: Vec2) -> WayTree {
        self.tree_for(map, from, 0.0)
    }

    /// [`TunnelGraph::tree`] for somebody who needs so much room on all sides (m).
    pub fn tree_for(&self, map: &Map, from: Vec2, radius_m: f32) -> WayTree {
        self.tree_every(map, from, radius_m, SPACING_M)
    }

    /// [`TunnelGraph::tree_for`] with samples no farther apart than this (m), where 200,000 of them are enough for that.
    pub(crate) fn tree_every(&self, map: &Map, from: Vec2, radius_m: f32, spacing_m: f64) -> WayTree {
        let mut tree = WayTree::default();
        if map.in_rock(from) {
            return tree;
        }
        // The places of all edges, then the nodes without any.
        let (mut places, mut origins) = (Vec::new(), Vec::new());
        for (index, edge) in self.edges.iter().enumerate() {
            let fits = edge.line.iter().zip(&edge.clearance_m).enumerate();
            for (at, (&place, _)) in fits.filter(|(_, (_, clearance_m))| **clearance_m >= radius_m) {
                places.push(place);
                origins.push((index, at));
            }
        }
        for (index, node) in self.nodes.iter().enumerate().filter(|(_, node)| node.edges.is_empty()) {
            places.push(node.at);
            origins.push((self.edges.len(), index));
        }
        let Some((way, joined)) = Near::new(&places).way_from(map, from, radius_m) else { return tree };
        let (edge, index) = origins[joined];
        let (pieces, root) = self.passable(radius_m, edge, index);
        let total_m: f64 = pieces.iter().map(|piece| piece.length_m).sum();
        let spacing_m = spacing_m.max(total_m / MOST_SAMPLES);
        let mut last = tree.add(map, from, None, edge as u32);
        for &at in way.iter().skip(1).chain([&places[joined]]) {
            last = tree.go(map, last, at, edge as u32, spacing_m);
        }
        Search::new(&pieces, root).grow(map, &mut tree, last, spacing_m);
        tree
    }

    /// The edges, cut where they are too narrow and at one place of one edge; and the node at that place. Ends at cuts are
    /// new nodes.
    fn passable(&self, radius_m: f32, edge: usize, index: usize) -> (Vec<Piece<'_>>, usize) {
        let mut nodes = self.nodes.len();
        let mut root = if edge == self.edges.len() { index } else { nodes };
        let mut fresh = || {
            nodes += 1;
            nodes
        };
        let mut pieces = Vec::new();
        for (number, of) in self.edges.iter().enumerate() {
            let last = of.line.len().saturating_sub(1);
            if number == edge && (index == 0 || index == last) {
                root = of.ends[usize::from(index != 0)];
            }
            let mut start: Option<(usize, usize)> = None;
            for (at, &clearance_m) in of.clearance_m.iter().enumerate() {
                let mut add = |from: usize, until: usize, ends: [usize; 2]| {
                    if let Some(line) = of.line.get(from..=until).filter(|line| line.len() > 1) {
                        pieces.push(Piece::new(ends, line, number as u32));
                    }
                };
                if clearance_m < radius_m {
                    if let Some((from, node)) = start.take() {
                        add(from, at - 1, [node, fresh()]);
                    }
                    continue;
                }
                let node = match at {
                    0 => Some(of.ends[0]),
                    _ if at == last => Some(of.ends[1]),
                    _ if number == edge && at == index => Some(root),
                    _ => None,
                };
                match (start, node) {
                    (None, node) => start = Some((at, node.unwrap_or_else(&mut fresh))),
                    (Some((from, before)), Some(node)) => {
                        add(from, at, [before, node]);
                        start = Some((at, node));
                    }
                    _ => {}
                }
            }
        }
        (pieces, root)
    }
}

impl<'g> Piece<'g> {
    fn new(ends: [usize; 2], line: &'g [Vec2], edge: u32) -> Self {
        let length_m = line.windows(2).map(|pair| f64::from(pair[0].distance(pair[1]))).sum();
        Self { ends, line, edge, length_m }
    }
}

/// Dijkstra over the nodes, then the samples of each piece from the ends that they are nearer to.
struct Search<'p, 'g> {
    pieces: &'p [Piece<'g>],
    /// The pieces at each node, and with which end.
    pieces_at: Vec<Vec<(usize, usize)>>,
    distance_m: Vec<f64>,
    /// The piece and the end of it that the shortest way to a node comes in by.
    by: Vec<Option<(usize, usize)>>,
    order: Vec<usize>,
}

impl<'p, 'g> Search<'p, 'g> {
    fn new(pieces: &'p [Piece<'g>], root: usize) -> Self {
        let nodes = pieces.iter().flat_map(|piece| piece.ends).fold(root, usize::max) + 1;
        let mut pieces_at = vec![Vec::new(); nodes];
        for (index, piece) in pieces.iter().enumerate() {
            pieces_at[piece.ends[0]].push((index, 0));
            pieces_at[piece.ends[1]].push((index, 1));
        }
        let mut search = Self {
            pieces,
            pieces_at,
            distance_m: vec![f64::INFINITY; nodes],
            by: vec![None; nodes],
            order: Vec::new(),
        };
        search.distance_m[root] = 0.0;
        // Distances are positive, so their bits sort as they do.
        let mut open = BinaryHeap::from([(Reverse(0_u64), root)]);
        let mut settled = vec![false; nodes];
        while let Some((Reverse(bits), here)) = open.pop() {
            if std::mem::replace(&mut settled[here], true) {
                continue;
            }
            search.order.push(here);
            for &(index, end) in &search.pieces_at[here] {
                let piece = &pieces[index];
                let there = piece.ends[1 - end];
                let total_m = f64::from_bits(bits) + piece.length_m;
                if total_m < search.distance_m[there] {
                    search.distance_m[there] = total_m;
                    search.by[there] = Some((index, 1 - end));
                    open.push((Reverse(total_m.to_bits()), there));
                }
            }
        }
        search
    }

    /// Adds all samples to a tree whose sample `root` stands for the first node.
    fn grow(&self, map: &Map, tree: &mut WayTree, root: u32, spacing_m: f64) {
        let mut sample_of = vec![root; self.distance_m.len()];
        for &here in &self.order {
            for &(index, end) in &self.pieces_at[here] {
                let piece = &self.pieces[index];
                let there = piece.ends[1 - end];
                if self.by[here] == Some((index, end)) {
                    continue;
                }
                let whole = self.by[there] == Some((index, 1 - end));
                let turned = |at: usize| if end == 0 { at } else { piece.line.len() - 1 - at };
                let (mut last, mut along_m) = (sample_of[here], 0.0);
                for at in 1..piece.line.len() {
                    let (before, to) = (piece.line[turned(at - 1)], piece.line[turned(at)]);
                    along_m += f64::from(before.distance(to));
                    let other_m = self.distance_m[there] + piece.length_m - along_m;
                    let nearer = self.distance_m[here] + along_m;
                    let is_ours = nearer < other_m || (nearer == other_m && end == 0);
                    if !whole && (!is_ours || at + 1 == piece.line.len()) {
                        break;
                    }
                    last = tree.go(map, last, to, piece.edge, spacing_m);
                }
                if whole {
                    sample_of[there] = last;
                }
            }
        }
    }
}
