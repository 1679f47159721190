//! What a picture of an exploration needs.

use std::collections::BTreeMap;

use uchain_core::explore::{Label, NodeId};

use crate::mission::explore::States;
use crate::{
    mission::explore::{ExploreFrame, NodeFrame},
    record::{RecordError, Recorder},
};

/// Least distance between two kept places of a way (m), at first.
const STEP_M: f32 = 0.05;
/// Most kept places of all ways.
const PLACES_MAX: usize = 1_000_000;

/// Keeps nodes with their labels of now, edges, and the ways and states of all robots, in bounded memory: long ways are kept
/// coarser.
#[derive(Debug, Clone, Default)]
pub struct ExploreHistory {
    /// Nodes in order, each with its labels as they are now.
    pub nodes: Vec<NodeFrame>,
    /// Edges of the roadmap.
    pub edges: Vec<[NodeId; 2]>,
    /// Per robot, the places it flew through, in the map's frame (m).
    pub ways_m: Vec<Vec<[f32; 2]>>,
    /// Places and headings over time.
    pub states: States,
    slots: BTreeMap<NodeId, usize>,
    step_m: f32,
    places: usize,
}

impl ExploreHistory {
    /// A node by its name.
    pub fn node(&self, id: NodeId) -> Option<&NodeFrame> {
        self.nodes.get(*self.slots.get(&id)?)
    }

    fn decision(&mut self, frame: &ExploreFrame) {
        for node in &frame.nodes {
            self.slots.insert(node.id, self.nodes.len());
            self.nodes.push(node.clone());
        }
        for change in &frame.labels {
            let node = self.slots.get(&change.node).and_then(|&slot| self.nodes.get_mut(slot));
            if let Some(sector) = node.and_then(|node| node.sectors.get_mut(usize::from(change.sector))) {
                sector.label = change.label;
            }
        }
        self.edges.extend_from_slice(&frame.edges);
    }

    /// Every second place goes, and fewer come.
    fn thin(&mut self) {
        self.step_m *= 2.0;
        for way in &mut self.ways_m {
            let mut index = 0_u32;
            way.retain(|_| {
                index += 1;
                index % 2 == 1
            });
        }
        self.places = self.ways_m.iter().map(Vec::len).sum();
    }

    /// Arcs of a node that are frontiers still.
    pub fn frontiers(node: &NodeFrame) -> impl Iterator<Item = usize> + '_ {
        node.sectors.iter().enumerate().filter(|(_, sector)| sector.label == Label::Frontier).map(|(k, _)| k)
    }
}

impl Recorder<ExploreFrame> for ExploreHistory {
    fn frame(&mut self, frame: &ExploreFrame) -> Result<(), RecordError> {
        if frame.decision {
            self.decision(frame);
        }
        self.states.look(frame);
        self.step_m = self.step_m.max(STEP_M);
        self.ways_m.resize(frame.robots.len(), Vec::new());
        for (way, robot) in self.ways_m.iter_mut().zip(&frame.robots) {
            let at = [robot.x_m, robot.y_m];
            let is_far =
                |last: &[f32; 2]| (last[0] - at[0]).abs().max((last[1] - at[1]).abs()) >= self.step_m;
            // Corners count: a round begins at one.
            if way.last().is_none_or(|last| is_far(last) || frame.decision && *last != at) {
                way.push(at);
                self.places += 1;
            }
        }
        if self.places > PLACES_MAX {
            self.thin();
        }
        Ok(())
    }
}
