//! Shortest ways through the roadmap, by Dijkstra's algorithm (Kim 2021, §6.3).

use alloc::{collections::BinaryHeap, vec::Vec};
use core::cmp::Reverse;

use super::Graph;

/// Ways from one node. Its buffers are kept from search to search, and a search touches only what it reaches.
#[derive(Debug, Clone, Default)]
pub struct Dijkstra {
    /// Number of the search; what another one left behind is not looked at.
    search: u32,
    /// Where the search began, and the nodes and edges there were: a graph only grows.
    searched: Option<[usize; 3]>,
    reached: Vec<Reached>,
    /// Nodes by distance (bits: lengths are not negative), hops and name; then the slot.
    queue: BinaryHeap<Reverse<(u32, u32, u64, u32)>>,
}

/// What is known of a node.
#[derive(Debug, Clone, Copy, Default)]
struct Reached {
    search: u32,
    settled: bool,
    distance_m: f32,
    hops: u32,
    before: u32,
}

impl Dijkstra {
    /// Searches from a node, nearest first, and shows each node with its distance (m) to `enough`, until that says
    /// so. Of equally long ways the one of fewest edges counts: the next step along it is always nearer the end.
    pub fn search(&mut self, graph: &Graph, from: usize, mut enough: impl FnMut(usize, f32) -> bool) {
        self.search = self.search.wrapping_add(1);
        if self.search == 0 {
            // After 2³² searches a number comes again.
            self.reached.clear();
            self.search = 1;
        }
        self.searched = Some([from, graph.nodes(), graph.edges()]);
        self.reached.resize(graph.nodes(), Reached::default());
        self.queue.clear();
        self.reach(graph, from, from, 0.0, 0);
        while let Some(Reverse((.., slot))) = self.queue.pop() {
            let node = slot as usize;
            let Some(here) = self.reached.get_mut(node).filter(|r| !r.settled) else { continue };
            here.settled = true;
            let (distance_m, hops) = (here.distance_m, here.hops);
            if enough(node, distance_m) {
                return;
            }
            for (to, length_m) in graph.neighbours(node) {
                self.reach(graph, to, node, distance_m + length_m, hops.saturating_add(1));
            }
        }
    }

    /// A way to a node is found; it is kept if it is the best so far.
    fn reach(&mut self, graph: &Graph, node: usize, before: usize, distance_m: f32, hops: u32) {
        let search = self.search;
        let (Some(known), Some(name)) = (self.reached.get_mut(node), graph.name(node)) else { return };
        let better = known.search != search || (distance_m, hops) < (known.distance_m, known.hops);
        if better {
            *known = Reached { search, settled: false, distance_m, hops, before: before as u32 };
            self.queue.push(Reverse((distance_m.to_bits(), hops, name, node as u32)));
        }
    }

    /// Whether the last search was from this node in this very graph, and came to a node.
    pub fn knows(&self, graph: &Graph, from: usize, to: usize) -> bool {
        self.searched == Some([from, graph.nodes(), graph.edges()]) && self.settled(to).is_some()
    }

    fn settled(&self, node: usize) -> Option<&Reached> {
        self.reached.get(node).filter(|r| r.search == self.search && r.settled)
    }

    /// Length of the way to a node (m); `None` if the last search has not come there.
    pub fn distance_m(&self, node: usize) -> Option<f32> {
        self.settled(node).map(|r| r.distance_m)
    }

    /// The node after the first edge of the way to a node: itself, if one edge leads there or none is needed.
    pub fn first_step(&self, node: usize) -> Option<usize> {
        let mut at = node;
        // A way has no more edges than there are nodes.
        for _ in 0..=self.reached.len() {
            let here = self.settled(at)?;
            if here.hops <= 1 {
                return Some(at);
            }
            at = here.before as usize;
        }
        None
    }
}
