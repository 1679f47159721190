//! The Sensor-based Selective Graph: all that is known of the place (Kim 2021, §4.2).

mod dijkstra;
mod graph;
mod grid;
mod labels;
mod merge;
mod refusal;
mod star;
#[cfg(test)]
pub(super) mod tests;

pub use dijkstra::Dijkstra;
pub use graph::{EdgeRule, Graph};
pub(super) use merge::middle_sectors;
pub use merge::{Run, runs};
pub use refusal::Refusal;
pub use star::{Cones, Label, Sector, Star};

use alloc::{collections::BTreeMap, vec, vec::Vec};

use grid::Grid;
use labels::Open;

use super::{ExploreParams, Message, NodeId, NodeReport, Point, SpentReport};
use crate::params::OutOfRange;

/// Connections per node on average at which a store counts as full.
const EDGES_PER_NODE: usize = 64;

/// The nodes, labels and connections of a whole team, as far as its holder has heard.
///
/// It grows only by [`Ssg::apply`], and until it is full, what was applied twice, late or in another order makes no
/// difference: nodes and connections are only added, labels only go from 1 to 0, and which do is a matter of what is
/// known, not of when it came. So every robot may keep a copy of its own, and copies that have heard the same make
/// their robots decide alike; or robots that hear everything may share one.
///
/// A node is known by its *slot*, its place in the store, and by its [`NodeId`], the same in every copy.
#[derive(Debug, Clone)]
pub struct Ssg {
    params: ExploreParams,
    cones: Cones,
    nodes: Vec<Node>,
    /// Of all nodes, one after the other.
    sectors: Vec<Sector>,
    /// Test points of each sector that no other star covers.
    open: Vec<Open>,
    slots: BTreeMap<NodeId, u32>,
    grid: Grid,
    graph: Graph,
    /// Per robot, how many of its nodes are hubs.
    hubs: Vec<u32>,
    /// Nodes whose predecessor has not been heard of yet.
    orphans: Vec<(u32, NodeId)>,
    /// Arcs of nodes that have not been heard of yet.
    early: Vec<SpentReport>,
    /// Nodes near the one that is added; kept for its memory.
    near: Vec<u32>,
    /// Frontier arcs that have become free, by slot and sector, until somebody takes them; `None` if nobody asks.
    freed: Option<Vec<(u32, u16)>>,
}

/// A node, without its sectors.
#[derive(Debug, Clone, Copy)]
struct Node {
    id: NodeId,
    at: Point,
    flown_from: Option<NodeId>,
    /// Sectors that are frontiers.
    frontiers: u16,
}

/// An entry of the hub node data, H in Kim 2021, §4.2.2.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Hub {
    /// The node.
    pub node: NodeId,
    /// Its frontier sectors.
    pub frontiers: usize,
    /// Its frontier sectors, merged (Kim 2021, §6.1.1).
    pub merged: usize,
}

impl Ssg {
    /// An empty store for a team of so many robots.
    ///
    /// # Errors
    /// The first of `params` outside its range.
    pub fn new(params: ExploreParams, robots: u16) -> Result<Self, OutOfRange> {
        params.check()?;
        Ok(Self {
            cones: Cones::new(params.sectors),
            nodes: Vec::new(),
            sectors: Vec::new(),
            open: Vec::new(),
            slots: BTreeMap::new(),
            grid: Grid::new(params.r_s_m),
            graph: Graph::default(),
            hubs: vec![0; usize::from(robots)],
            orphans: Vec::new(),
            early: Vec::new(),
            near: Vec::new(),
            freed: None,
            params,
        })
    }

    /// What the team flies by.
    pub fn params(&self) -> &ExploreParams {
        &self.params
    }

    /// The directions of its stars.
    pub fn cones(&self) -> &Cones {
        &self.cones
    }

    /// The roadmap, by slot.
    pub fn graph(&self) -> &Graph {
        &self.graph
    }

    /// Number of nodes: slots are the numbers below.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether nothing is known.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// Whether there might be no room for one more node of every robot: then no frontier is flown to any more.
    pub fn is_full(&self) -> bool {
        let nodes_max = self.params.nodes_max as usize;
        self.len() + self.hubs.len() > nodes_max || self.graph.edges() >= EDGES_PER_NODE * nodes_max
    }

    /// Slot of a node.
    pub fn slot(&self, id: NodeId) -> Option<usize> {
        self.slots.get(&id).map(|&slot| slot as usize)
    }

    /// Name of the node in a slot.
    pub fn id(&self, slot: usize) -> Option<NodeId> {
        self.nodes.get(slot).map(|node| node.id)
    }

    /// Place of the node in a slot.
    pub fn at(&self, slot: usize) -> Option<Point> {
        self.nodes.get(slot).map(|node| node.at)
    }

    /// The sectors of the node in a slot (Kim 2021, Eq. 1); none for an unknown one.
    pub fn sectors(&self, slot: usize) -> &[Sector] {
        if slot >= self.len() {
            return &[];
        }
        let n = self.cones.count();
        self.sectors.get(slot * n..(slot + 1) * n).unwrap_or(&[])
    }

    /// The star of the node in a slot.
    pub fn star(&self, slot: usize) -> Option<Star<'_>> {
        let at = self.at(slot)?;
        Some(Star { at, sectors: self.sectors(slot), cones: &self.cones, r_s_m: self.params.r_s_m })
    }

    /// Whether the node in a slot has a frontier (Kim 2021, Eq. 6).
    pub fn is_hub(&self, slot: usize) -> bool {
        self.nodes.get(slot).is_some_and(|node| node.frontiers > 0)
    }

    /// How many hubs a robot has scanned.
    pub fn hubs_of(&self, robot: u16) -> usize {
        self.hubs.get(usize::from(robot)).map_or(0, |&hubs| hubs as usize)
    }

    /// Whether any node has a frontier.
    pub fn has_hubs(&self) -> bool {
        self.hubs.iter().any(|&hubs| hubs > 0)
    }

    /// How many nodes have a frontier: as many as [`Ssg::hubs`] shows, without a look at the others.
    pub fn hub_count(&self) -> usize {
        self.hubs.iter().map(|&hubs| hubs as usize).sum()
    }

    /// From now on it notes every frontier arc that becomes free, for [`Ssg::take_freed`].
    pub fn note_freed(&mut self) {
        self.freed.get_or_insert_default();
    }

    /// Slots and sectors of the frontier arcs that have become free since it was last asked, in the order in which they
    /// did: each arc once. Nothing without [`Ssg::note_freed`].
    pub fn take_freed(&mut self) -> Vec<(u32, u16)> {
        self.freed.as_mut().map_or_else(Vec::new, core::mem::take)
    }

    /// The hub node data of all robots: a robot's hubs by number, robot after robot.
    pub fn hubs(&self) -> impl Iterator<Item = Hub> + '_ {
        let hub = |(&node, &slot): (&NodeId, &u32)| {
            let frontiers = usize::from(self.nodes.get(slot as usize)?.frontiers);
            (frontiers > 0).then(|| Hub {
                node,
                frontiers,
                merged: runs(self.sectors(slot as usize)).count(),
            })
        };
        self.slots.iter().filter_map(hub)
    }

    /// Whether a place is nearer than `d_min` to a node whose star contains it: nothing new is to be seen there.
    pub fn is_crowded(&self, place: Point) -> bool {
        let d_min_m = self.params.d_min_share * self.params.r_s_m;
        self.grid.within(place, d_min_m).any(|slot| self.star(slot).is_some_and(|star| star.contains(place)))
    }

    /// The node in a slot as it would be told to a robot that has not heard of it.
    pub fn report(&self, slot: usize) -> Option<NodeReport> {
        let node = self.nodes.get(slot)?;
        Some(NodeReport {
            id: node.id,
            at: node.at,
            flown_from: node.flown_from,
            sectors: self.sectors(slot).to_vec(),
        })
    }

    /// Takes in what a robot says. Poses and targets are no concern of the store.
    ///
    /// # Errors
    /// A node that cannot be: the store is then as before.
    pub fn apply(&mut self, message: &Message) -> Result<(), Refusal> {
        match message {
            Message::Node(report) => self.add(report)?,
            Message::Spent(spent) => match self.slot(spent.node) {
                Some(slot) => self.spend_all(slot, spent.sectors),
                None if self.early.len() < self.params.nodes_max as usize => self.early.push(*spent),
                None => {}
            },
            Message::Pose { .. } | Message::Target(_) => {}
        }
        Ok(())
    }

    fn add(&mut self, report: &NodeReport) -> Result<(), Refusal> {
        self.check(report)?;
        if let Some(slot) = self.slot(report.id) {
            for (k, sector) in report.sectors.iter().enumerate() {
                if sector.label == Label::Free {
                    self.spend(slot, k);
                }
            }
            self.connect_freed(slot);
            return Ok(());
        }
        let slot = self.insert(report);
        let changed = self.retest(slot);
        self.connect(slot, report.flown_from);
        for slot in changed {
            self.connect_freed(slot);
        }
        let early: Vec<SpentReport> = self.early.extract_if(.., |spent| spent.node == report.id).collect();
        for spent in early {
            self.spend_all(slot, spent.sectors);
        }
        Ok(())
    }

    fn check(&self, report: &NodeReport) -> Result<(), Refusal> {
        let (got, want) = (report.sectors.len(), self.cones.count());
        if usize::from(report.id.robot) >= self.hubs.len() {
            return Err(Refusal::Stranger { robot: report.id.robot, robots: self.hubs.len() });
        }
        if got != want {
            return Err(Refusal::Sectors { got, want });
        }
        if !report.at.is_sound() {
            return Err(Refusal::Place);
        }
        let nodes_max = self.params.nodes_max as usize;
        let full = self.len() >= nodes_max || self.graph.edges() >= EDGES_PER_NODE * nodes_max;
        if full && self.slot(report.id).is_none() {
            return Err(Refusal::Full { nodes: self.len() });
        }
        Ok(())
    }
}
