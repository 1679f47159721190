//! How the graph of an exploration has grown, for a page to show it at any time.

use std::collections::BTreeMap;

use serde::Serialize;
use serde_json::{Value, json};
use uchain_core::explore::{Label, NodeId};
use uchain_sim::{
    mission::explore::ExploreFrame,
    record::{RecordError, Recorder},
};

use crate::told::Since;

/// Most nodes, label changes or edges that are told of at once.
const MOST: usize = 200_000;

#[derive(Debug, Serialize)]
struct Node {
    tick: u64,
    robot: u16,
    at_m: [f32; 2],
    believed_m: [f32; 2],
    /// Radius of every sector (m).
    r_m: Vec<f32>,
}

/// A label that changed: tick, node by its number, sector, label.
type Change = (u64, usize, u16, &'static str);

/// All that happened to the graph, and where robots stood when rounds began.
#[derive(Debug, Default)]
pub(crate) struct Graph {
    nodes: Vec<Node>,
    numbers: BTreeMap<NodeId, usize>,
    labels: Vec<Change>,
    /// Tick, and the two nodes by their numbers.
    edges: Vec<(u64, usize, usize)>,
    /// Tick at which each round began.
    began: Vec<u64>,
    /// Where the robots stood then, round by round (m).
    stood_m: Vec<Vec<[f32; 2]>>,
    last_m: Vec<[f32; 2]>,
}

impl Recorder<ExploreFrame> for Graph {
    fn frame(&mut self, frame: &ExploreFrame) -> Result<(), RecordError> {
        let tick = frame.tick;
        if frame.decision {
            for node in &frame.nodes {
                self.numbers.insert(node.id, self.nodes.len());
                self.nodes.push(Node {
                    tick,
                    robot: node.id.robot,
                    at_m: node.at_m,
                    believed_m: node.believed_m,
                    r_m: node.sectors.iter().map(|sector| sector.r_m).collect(),
                });
            }
            let numbers = &self.numbers;
            let number = |id: &NodeId| numbers.get(id).copied();
            let change = |change: &uchain_sim::mission::explore::LabelFrame| {
                Some((tick, number(&change.node)?, change.sector, word(change.label)))
            };
            self.labels.extend(frame.labels.iter().filter_map(change));
            self.edges.extend(frame.edges.iter().filter_map(|[a, b]| Some((tick, number(a)?, number(b)?))));
            if !self.last_m.is_empty() {
                self.began.push(tick);
                self.stood_m.push(self.last_m.clone());
            }
        }
        self.last_m.clear();
        self.last_m.extend(frame.robots.iter().map(|robot| [robot.x_m, robot.y_m]));
        Ok(())
    }
}

impl Graph {
    /// Where a robot stands when the next round begins: what it flies to now (m). `None` if that is not known yet.
    pub(super) fn next_m(&self, tick: u64, robot: usize) -> Option<[f32; 2]> {
        let next = self.began.partition_point(|began| *began <= tick);
        self.stood_m.get(next)?.get(robot).copied()
    }

    /// What came after what a page knows.
    pub(super) fn since(&self, from: Since) -> Value {
        fn rest<T>(all: &[T], from: usize) -> &[T] {
            let rest = all.get(from..).unwrap_or_default();
            &rest[..rest.len().min(MOST)]
        }
        json!({
            "nodes": rest(&self.nodes, from.nodes),
            "labels": rest(&self.labels, from.labels),
            "edges": rest(&self.edges, from.edges),
        })
    }
}

fn word(label: Label) -> &'static str {
    match label {
        Label::Obstacle => "obstacle",
        Label::Free => "free",
        Label::Frontier => "frontier",
    }
}
