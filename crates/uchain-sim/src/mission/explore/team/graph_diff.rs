//! What a round has added to all that is known.

#[cfg(test)]
mod tests;

use std::ops::Range;

use uchain_core::explore::{Label, NodeId, Sector, Ssg};

use crate::mission::explore::LabelFrame;

/// The difference of a store before and after a round. To find it costs what is new, however much is known.
#[derive(Debug, Clone, Default)]
pub(crate) struct GraphDiff {
    /// Slots of new nodes.
    pub(crate) nodes: Range<usize>,
    /// Sectors of the new nodes as they were scanned.
    pub(crate) sectors: Vec<Sector>,
    /// Labels that changed, by slot and sector.
    pub(crate) labels: Vec<LabelFrame>,
    /// New edges, by the later of their two nodes; of one node the last connected first.
    pub(crate) edges: Vec<[NodeId; 2]>,
    /// Edges so far.
    edges_known: usize,
}

impl GraphDiff {
    /// What is new in a store since the last time. It is a store that notes what becomes free.
    pub(super) fn update(&mut self, ssg: &mut Ssg) {
        let mut freed = ssg.take_freed();
        self.nodes = self.nodes.end..ssg.len();
        self.sectors.clear();
        self.labels.clear();
        self.edges.clear();
        for slot in self.nodes.clone() {
            // As scanned: what has no return was a frontier.
            self.sectors.extend(ssg.sectors(slot).iter().map(|sector| match sector.label {
                Label::Obstacle => *sector,
                Label::Free | Label::Frontier => Sector { label: Label::Frontier, ..*sector },
            }));
            // A node that was told by others may have come with free arcs.
            let free = ssg.sectors(slot).iter().enumerate().filter(|(_, s)| s.label == Label::Free);
            freed.extend(free.map(|(k, _)| (slot as u32, k as u16)));
        }
        freed.sort_unstable();
        freed.dedup();
        let label = |(slot, sector): (u32, u16)| {
            let node = ssg.id(slot as usize)?;
            let label = ssg.sectors(slot as usize).get(usize::from(sector))?.label;
            Some(LabelFrame { node, sector, label })
        };
        self.labels.extend(freed.into_iter().filter_map(label));
        let mut edges: Vec<[usize; 2]> =
            ssg.graph().edges_after(self.edges_known).map(|[a, b]| [a.min(b), a.max(b)]).collect();
        self.edges_known += edges.len();
        edges.reverse();
        // The sort is stable: of one node the last connected stays first.
        edges.sort_by_key(|[_, later]| *later);
        self.edges.extend(edges.into_iter().filter_map(|[a, b]| Some([ssg.id(a)?, ssg.id(b)?])));
    }
}
