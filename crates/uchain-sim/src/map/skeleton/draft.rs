//! Junctions, dead ends and the lines between them, as they come out of the mesh; junctions that are one place are one.

use std::{cmp::Reverse, collections::BinaryHeap};

use glam::DVec2;

use super::mesh::Middle;

/// Junctions that are nearer to each other than this share of the wider one's distance to the walls are one.
const NEAR: f64 = 0.5;

/// A graph whose lines still hold every place of the mesh.
#[derive(Debug, Default)]
pub(super) struct Draft {
    /// Place and room of every node (m); no line ends at one that has become part of another.
    pub(super) nodes: Vec<(DVec2, f64)>,
    /// Lines; `None` where the nodes at its ends have become one.
    pub(super) edges: Vec<Option<Line>>,
    /// The edges at each node; an edge that comes back to it twice.
    edges_at: Vec<Vec<usize>>,
    /// Nodes that have become part of another.
    merged: Vec<bool>,
}

/// A line between two nodes, both included.
#[derive(Debug, Clone)]
pub(super) struct Line {
    pub(super) ends: [usize; 2],
    pub(super) places: Vec<DVec2>,
}

impl Line {
    fn length_m(&self) -> f64 {
        self.places.iter().zip(self.places.iter().skip(1)).map(|(a, b)| a.distance(*b)).sum()
    }

    /// Lets the line begin (end 0) or stop (end 1) at another node, `way` away.
    fn lengthen(&mut self, end: usize, node: usize, room_m: f64, way: &[DVec2]) {
        if end == 1 {
            self.places.reverse();
        }
        let Some(&at) = way.first() else { return };
        let mut places: Vec<DVec2> = way.iter().chain(self.places.iter().skip(1)).copied().collect();
        // Within the circle around the node every way is free: the straight one will do.
        let leaves = places.iter().position(|place| place.distance(at) > room_m).unwrap_or(0);
        places.drain(1..leaves.saturating_sub(1).max(1));
        self.places = places;
        self.ends[end] = node;
        if end == 1 {
            self.places.reverse();
        }
    }
}

impl Draft {
    pub(super) fn of(middle: &Middle) -> Self {
        let mut draft = Self::default();
        let mut node_of = vec![None; middle.at.len()];
        let mut drawn = vec![false; middle.steps.len()];
        let (nodes, rings): (Vec<u32>, Vec<u32>) = (0..middle.at.len() as u32)
            .filter(|&place| !middle.gone[place as usize])
            .partition(|&place| middle.degree(place) != 2);
        for &place in &nodes {
            node_of[place as usize] = Some(draft.node(middle, place));
        }
        for place in nodes {
            draft.lines_from(middle, place, &node_of, &mut drawn);
        }
        // What is left are rings without a junction: they begin at their widest place.
        for place in rings {
            let step = middle.steps_at[place as usize][0];
            if drawn[step as usize] {
                continue;
            }
            let room_m = |&place: &u32| middle.room_m[place as usize];
            let (ring, _) = middle.run(place, step);
            let Some(widest) = ring.into_iter().max_by(|p, q| room_m(p).total_cmp(&room_m(q))) else {
                continue;
            };
            node_of[widest as usize] = Some(draft.node(middle, widest));
            draft.lines_from(middle, widest, &node_of, &mut drawn);
        }
        draft.merge();
        draft
    }

    fn node(&mut self, middle: &Middle, place: u32) -> usize {
        self.nodes.push((middle.at[place as usize], middle.room_m[place as usize]));
        self.edges_at.push(Vec::new());
        self.merged.push(false);
        self.nodes.len() - 1
    }

    /// The lines from a place on that have not been drawn yet.
    fn lines_from(&mut self, middle: &Middle, place: u32, node_of: &[Option<usize>], drawn: &mut [bool]) {
        for &step in &middle.steps_at[place as usize] {
            if drawn[step as usize] {
                continue;
            }
            let (run, steps) = middle.run(place, step);
            for step in steps {
                drawn[step as usize] = true;
            }
            let node = |place: Option<&u32>| place.and_then(|&place| node_of[place as usize]);
            let (Some(from), Some(to)) = (node(run.first()), node(run.last())) else { continue };
            let places = run.iter().map(|&place| middle.at[place as usize]).collect();
            let index = self.edges.len();
            self.edges.push(Some(Line { ends: [from, to], places }));
            self.edges_at[from].push(index);
            self.edges_at[to].push(index);
        }
    }

    pub(super) fn is_part_of_another(&self, node: usize) -> bool {
        self.merged[node]
    }

    /// How many lines end at a node.
    fn degree(&self, node: usize) -> usize {
        self.edges_at[node].len()
    }

    /// Of two junctions that are one place the narrower becomes part of the wider.
    fn merge(&mut self) {
        let mut open: BinaryHeap<Reverse<(u64, usize)>> = BinaryHeap::new();
        for index in 0..self.edges.len() {
            open.extend(self.short(index).map(|length| Reverse((length, index))));
        }
        while let Some(Reverse((length, index))) = open.pop() {
            if self.short(index) != Some(length) {
                continue;
            }
            let Some(mut line) = self.edges[index].take() else { continue };
            if self.nodes[line.ends[0]].1 < self.nodes[line.ends[1]].1 {
                line.ends.reverse();
                line.places.reverse();
            }
            let [kept, lost] = line.ends;
            self.merged[lost] = true;
            self.edges_at[kept].retain(|&edge| edge != index);
            let moved = std::mem::take(&mut self.edges_at[lost]);
            for edge in moved.into_iter().filter(|&edge| edge != index) {
                let Some(moved) = &mut self.edges[edge] else { continue };
                let Some(end) = (0..2).find(|&end| moved.ends[end] == lost) else { continue };
                moved.lengthen(end, kept, self.nodes[kept].1, &line.places);
                self.edges_at[kept].push(edge);
            }
            for &edge in &self.edges_at[kept] {
                open.extend(self.short(edge).map(|length| Reverse((length, edge))));
            }
        }
    }

    /// Length of a line between two junctions that are one place, as bits, which sort as it does.
    fn short(&self, index: usize) -> Option<u64> {
        let line = self.edges.get(index)?.as_ref()?;
        let [a, b] = line.ends;
        let junctions = a != b && self.degree(a) > 2 && self.degree(b) > 2;
        let length_m = line.length_m();
        (junctions && length_m < NEAR * self.nodes[a].1.max(self.nodes[b].1)).then_some(length_m.to_bits())
    }
}
