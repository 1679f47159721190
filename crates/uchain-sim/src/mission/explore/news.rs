//! What a round has added to all that is known.

use uchain_core::explore::{Label, NodeId, Sector, Ssg};

use crate::record::LabelFrame;

/// The difference of a store before and after a round.
#[derive(Debug, Clone, Default)]
pub(crate) struct News {
    /// Slots of new nodes.
    pub(crate) nodes: std::ops::Range<usize>,
    /// Sectors of the new nodes as they were scanned.
    pub(crate) sectors: Vec<Sector>,
    /// Labels that changed.
    pub(crate) labels: Vec<LabelFrame>,
    /// New edges.
    pub(crate) edges: Vec<[NodeId; 2]>,
    /// All labels so far, node after node.
    known: Vec<Label>,
    /// Edges of every node so far.
    degrees: Vec<usize>,
}

impl News {
    pub(super) fn update(&mut self, ssg: &Ssg) {
        self.nodes = self.degrees.len()..ssg.len();
        self.sectors.clear();
        self.labels.clear();
        self.edges.clear();
        let count = ssg.cones().count();
        for slot in 0..ssg.len() {
            let Some(node) = ssg.id(slot) else { continue };
            if slot >= self.nodes.start {
                // As scanned: what has no return was a frontier.
                let scanned = |s: &Sector| match s.label {
                    Label::Obstacle => *s,
                    Label::Free | Label::Frontier => Sector { label: Label::Frontier, ..*s },
                };
                self.sectors.extend(ssg.sectors(slot).iter().map(scanned));
                self.known.extend(ssg.sectors(slot).iter().map(|s| scanned(s).label));
                self.degrees.push(0);
            }
            for (k, sector) in ssg.sectors(slot).iter().enumerate() {
                if let Some(known) =
                    self.known.get_mut(slot * count + k).filter(|known| **known != sector.label)
                {
                    *known = sector.label;
                    self.labels.push(LabelFrame { node, sector: k as u16, label: sector.label });
                }
            }
        }
        if ssg.graph().edges() * 2 == self.degrees.iter().sum::<usize>() {
            return;
        }
        for slot in 0..ssg.len() {
            let Some(node) = ssg.id(slot) else { continue };
            let degree = ssg.graph().neighbours(slot).count();
            // The last connected come first. Each edge is told once, from its later node.
            let new = ssg.graph().neighbours(slot).take(degree - self.degrees[slot]);
            let later = new.filter(|(other, _)| *other < slot).filter_map(|(other, _)| ssg.id(other));
            self.edges.extend(later.map(|other| [other, node]));
            self.degrees[slot] = degree;
        }
    }
}
