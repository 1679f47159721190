//! What there is to see of an exploration: stars with their frontiers, the roadmap, the ways flown (Kim 2021, Fig. 9).

use core::f32::consts::TAU;
use std::collections::BTreeMap;

use foxglove::messages::{Color, LinePrimitive, Point3, SceneEntity, SceneUpdate, line_primitive::Type};
use glam::Vec2;
use uchain_core::explore::{Label, NodeId};

use crate::mission::explore::{ExploreFrame, NodeFrame};
use crate::record::mcap::scene::{MAP, color, crew, entity, point, pose, time};

/// Points of an arc, but for its last.
const POINTS: usize = 4;
/// Least distance of two places of a way (m).
const STEP_M: f32 = 0.05;

const STAR: Color = Color { r: 0.6, g: 0.7, b: 0.8, a: 0.5 };
const FRONTIER: Color = Color { r: 0.88, g: 0.0, b: 0.61, a: 1.0 };
const EDGE: Color = Color { r: 0.35, g: 0.35, b: 0.35, a: 1.0 };

fn lines(kind: Type, thickness: f64, color: Color, points: Vec<Point3>) -> LinePrimitive {
    LinePrimitive {
        r#type: kind.into(),
        pose: Some(pose(Vec2::ZERO)),
        thickness,
        scale_invariant: true,
        points,
        color: Some(color),
        ..LinePrimitive::default()
    }
}

fn update(tick: u64, entities: Vec<SceneEntity>) -> Option<SceneUpdate> {
    let stamped = |entity| SceneEntity { timestamp: Some(time(tick)), ..entity };
    let entities: Vec<SceneEntity> = entities.into_iter().map(stamped).collect();
    (!entities.is_empty()).then(|| SceneUpdate { deletions: Vec::new(), entities })
}

/// `/stars`: an entity per node, sent anew when a label changes.
#[derive(Debug, Default)]
pub(super) struct Stars(BTreeMap<NodeId, NodeFrame>);

impl Stars {
    pub(super) fn update(&mut self, frame: &ExploreFrame) -> Option<SceneUpdate> {
        let mut changed: Vec<NodeId> = frame.nodes.iter().map(|node| node.id).collect();
        self.0.extend(frame.nodes.iter().map(|node| (node.id, node.clone())));
        for change in &frame.labels {
            let Some(node) = self.0.get_mut(&change.node) else { continue };
            if let Some(sector) = node.sectors.get_mut(usize::from(change.sector)) {
                sector.label = change.label;
                changed.push(change.node);
            }
        }
        changed.sort_unstable();
        changed.dedup();
        update(frame.tick, changed.iter().filter_map(|id| self.0.get(id)).map(star).collect())
    }
}

fn star(node: &NodeFrame) -> SceneEntity {
    let sectors = || node.sectors.iter().enumerate();
    let outline = sectors().flat_map(|(k, _)| arc(node, k)).collect();
    let mut shapes = vec![lines(Type::LineLoop, 1.0, STAR, outline)];
    let frontiers = sectors().filter(|(_, sector)| sector.label == Label::Frontier);
    shapes.extend(frontiers.map(|(k, _)| lines(Type::LineStrip, 3.0, FRONTIER, arc(node, k).collect())));
    let NodeId { robot, number } = node.id;
    SceneEntity { lines: shapes, ..entity(&format!("star {robot}.{number}"), MAP.to_owned()) }
}

/// The arc that bounds a sector, around where the robot believed to be.
fn arc(node: &NodeFrame, k: usize) -> impl Iterator<Item = Point3> + use<> {
    let (count, from) = (node.sectors.len() as f32, Vec2::from(node.believed_m));
    let r_m = node.sectors.get(k).map_or(0.0, |sector| sector.r_m);
    (0..=POINTS).map(move |i| {
        let (sin, cos) = libm::sincosf(TAU * (k as f32 + i as f32 / POINTS as f32) / count);
        point(from + r_m * Vec2::new(cos, sin))
    })
}

/// `/graph`: an entity per round with new edges.
#[derive(Debug, Default)]
pub(super) struct Graph(BTreeMap<NodeId, [f32; 2]>);

impl Graph {
    pub(super) fn update(&mut self, frame: &ExploreFrame) -> Option<SceneUpdate> {
        self.0.extend(frame.nodes.iter().map(|node| (node.id, node.believed_m)));
        let place = |id: &NodeId| self.0.get(id).map(|&at| point(at.into()));
        let ends: Vec<Point3> = frame.edges.iter().flatten().filter_map(place).collect();
        if ends.is_empty() {
            return None;
        }
        let edges = lines(Type::LineList, 1.5, EDGE, ends);
        let id = format!("edges of round {}", frame.rounds);
        update(frame.tick, vec![SceneEntity { lines: vec![edges], ..entity(&id, MAP.to_owned()) }])
    }
}

/// `/ways`: at the end of a round, what each robot has flown in it.
#[derive(Debug, Default)]
pub(super) struct Ways(Vec<Vec<[f32; 2]>>);

impl Ways {
    pub(super) fn fly(&mut self, frame: &ExploreFrame) {
        self.0.resize(frame.robots.len(), Vec::new());
        for (way, robot) in self.0.iter_mut().zip(&frame.robots) {
            let at = Vec2::new(robot.x_m, robot.y_m);
            if way.last().is_none_or(|&last| Vec2::from(last).distance(at) >= STEP_M) {
                way.push(at.into());
            }
        }
    }

    /// The round before this frame's is over, or the whole exploration is.
    pub(super) fn end_of_round(&mut self, frame: &ExploreFrame) -> Option<SceneUpdate> {
        let round = frame.rounds;
        let mut flown = Vec::new();
        for (i, (way, robot)) in self.0.iter_mut().zip(&frame.robots).enumerate() {
            if way.len() > 1 {
                let points = way.iter().map(|&at| point(at.into())).collect();
                let strip = lines(Type::LineStrip, 2.0, color(crew(i)), points);
                let id = format!("way of robot {i} before round {round}");
                flown.push(SceneEntity { lines: vec![strip], ..entity(&id, MAP.to_owned()) });
            }
            // The next one begins where this one ends.
            let end = way.last().copied().unwrap_or([robot.x_m, robot.y_m]);
            way.clear();
            way.push(end);
        }
        update(frame.tick, flown)
    }
}
