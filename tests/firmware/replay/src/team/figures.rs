//! What a store holds in a few numbers, and a robot's row of a round.

use uchain_core::explore::{Command, Label, NodeId, Purpose, Ssg, Target};

use crate::rows::{EXPLORED, Explored, NONE, fill};

/// What a store holds: equal for all that have heard the same, in whatever order.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Figures {
    /// Nodes.
    pub nodes: u32,
    /// Connections.
    pub edges: u32,
    /// Nodes with frontiers.
    pub hubs: u32,
    /// Of all nodes, their places, sectors and connections: the sum of a hash of each.
    pub hash: u64,
}

/// Fowler, Noll and Vo's hash (FNV-1a) over words.
struct Hash(u64);

impl Hash {
    fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    fn take(&mut self, words: &[u32]) {
        for byte in words.iter().flat_map(|word| word.to_le_bytes()) {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }

    fn node(&mut self, NodeId { robot, number }: NodeId) {
        self.take(&[u32::from(robot), number]);
    }
}

impl Figures {
    /// Of a store as it is now.
    pub fn of(store: &Ssg) -> Self {
        let mut hash = 0_u64;
        for slot in 0..store.len() {
            let (Some(id), Some(at)) = (store.id(slot), store.at(slot)) else { continue };
            let mut node = Hash::new();
            node.node(id);
            node.take(&[at.x_m.to_bits(), at.y_m.to_bits()]);
            for sector in store.sectors(slot) {
                let label = match sector.label {
                    Label::Obstacle => 0,
                    Label::Free => 1,
                    Label::Frontier => 2,
                };
                node.take(&[label, sector.r_m.to_bits()]);
            }
            hash = hash.wrapping_add(node.0);
            for (to, length_m) in store.graph().neighbours(slot) {
                let mut edge = Hash::new();
                edge.node(id);
                if let Some(to) = store.id(to) {
                    edge.node(to);
                }
                edge.take(&[length_m.to_bits()]);
                hash = hash.wrapping_add(edge.0);
            }
        }
        Self {
            nodes: store.len() as u32,
            edges: store.graph().edges() as u32,
            hubs: store.hub_count() as u32,
            hash,
        }
    }
}

/// What one robot asks for after a round, why, and what its store holds then.
pub fn explored(round: u32, robot: u16, asks: &Command, target: &Target, store: &Figures) -> Explored {
    let mut row = [NONE; EXPLORED.len()];
    let command = [
        asks.to.x_m.to_bits(),
        asks.to.y_m.to_bits(),
        asks.heading_rad.to_bits(),
        u32::from(asks.level),
        asks.z_m.to_bits(),
        u32::from(asks.scan),
        u32::from(asks.mfl),
        u32::from(asks.hold),
    ];
    let purpose = match target.purpose {
        Purpose::Explore => 0,
        Purpose::Backtrack => 1,
        Purpose::Home => 2,
        Purpose::Park => 3,
        Purpose::Wait => 4,
    };
    let (from, to) = (target.from, target.to);
    let target = [
        purpose,
        from.x_m.to_bits(),
        from.y_m.to_bits(),
        to.x_m.to_bits(),
        to.y_m.to_bits(),
        target.hub.map_or(NONE, |hub| u32::from(hub.robot)),
        target.hub.map_or(NONE, |hub| hub.number),
        u32::from(target.level),
    ];
    let [low, high] = [store.hash as u32, (store.hash >> 32) as u32];
    let store = [store.nodes, store.edges, store.hubs, low, high];
    fill(&mut row, &[&[round, u32::from(robot)], &command, &target, &store]);
    row
}
