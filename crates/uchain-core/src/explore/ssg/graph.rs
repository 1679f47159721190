//! The roadmap: which nodes are connected, and how far apart they are (Kim 2021, §6.3).

use alloc::vec::Vec;

/// Which nodes are connected, beside those flown between.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum EdgeRule {
    /// Each is nearer than the other's facing radius, whatever the labels.
    #[default]
    Visible,
    /// And both facing arcs are free: Kim 2021, Eq. 8 and Algorithm 3 as printed. It may leave the robots' parts of
    /// the graph unconnected, so that one robot explores what others have found only where it has flown.
    Eq8,
}

/// Ends a chain of arcs.
const NONE: u32 = u32::MAX;

/// An undirected graph with lengths, in flat lists: each node's arcs are a chain.
#[derive(Debug, Clone, Default)]
pub struct Graph {
    /// Name of each node.
    names: Vec<u64>,
    /// Last arc of each node.
    last: Vec<u32>,
    /// Arc of the same node before, by arc.
    before: Vec<u32>,
    /// Where each arc leads.
    to: Vec<u32>,
    length_m: Vec<f32>,
}

impl Graph {
    /// One more node, unconnected. Of ways that are equally good the one by lower names is found, whatever the order
    /// in which the nodes came.
    pub fn push(&mut self, name: u64) {
        self.names.push(name);
        self.last.push(NONE);
    }

    /// Name of a node.
    pub fn name(&self, node: usize) -> Option<u64> {
        self.names.get(node).copied()
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.last.len()
    }

    /// Number of edges.
    pub fn edges(&self) -> usize {
        self.to.len() / 2
    }

    /// The ends of the edges after the first so many, in the order in which they came.
    pub fn edges_after(&self, count: usize) -> impl Iterator<Item = [usize; 2]> + '_ {
        let arcs = self.to.get(2 * count.min(self.edges())..).unwrap_or_default();
        // An edge is two arcs, there and back.
        arcs.chunks_exact(2).filter_map(|arcs| match *arcs {
            [there, back] => Some([back as usize, there as usize]),
            _ => None,
        })
    }

    /// Connects two nodes; nothing happens if they are one, unknown, connected already or apart by no length.
    pub fn link(&mut self, a: usize, b: usize, length_m: f32) {
        let known = a < self.nodes() && b < self.nodes();
        if a == b || !known || !(0.0..f32::INFINITY).contains(&length_m) || self.linked(a, b) {
            return;
        }
        for (from, to) in [(a, b), (b, a)] {
            let arc = self.to.len() as u32;
            if let Some(last) = self.last.get_mut(from) {
                self.before.push(*last);
                *last = arc;
                self.to.push(to as u32);
                self.length_m.push(length_m);
            }
        }
    }

    /// Whether two nodes are connected.
    pub fn linked(&self, a: usize, b: usize) -> bool {
        self.neighbours(a).any(|(to, _)| to == b)
    }

    /// Nodes connected with a node, and how far they are (m); the last connected first.
    pub fn neighbours(&self, node: usize) -> impl Iterator<Item = (usize, f32)> + '_ {
        let real = |arc: &u32| *arc != NONE;
        let first = self.last.get(node).copied().filter(real);
        core::iter::successors(first, move |&arc| self.before.get(arc as usize).copied().filter(real))
            .filter_map(|arc| {
                let arc = arc as usize;
                Some((*self.to.get(arc)? as usize, *self.length_m.get(arc)?))
            })
    }
}
