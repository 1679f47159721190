//! What there is to see: walls and base, the UAVs' bodies, links coloured by loss.

use foxglove::messages::{
    ArrowPrimitive, Color, CubePrimitive, CylinderPrimitive, LinePrimitive, Point3, Pose, SceneEntity,
    SceneUpdate, Vector3, line_primitive::Type,
};
use glam::Vec2;
use uchain_core::bounded;

use super::poses::{MAP, body, rotation, time};
use crate::{
    config::Course,
    map::{Map, Segment},
    record::Frame,
};

/// Height of a UAV's body (m).
const BODY_M: f64 = 0.04;
/// Side of the base station (m).
const BASE_M: f64 = 0.12;
/// A link this much better than `takeoff.s_min_db` is green, one this much worse red; at `s_min_db` it is yellow
/// (dB).
const SHADES_DB: f32 = 20.0;

const WALL: Color = Color { r: 0.55, g: 0.5, b: 0.45, a: 1.0 };
const BASE: Color = Color { r: 0.9, g: 0.9, b: 0.9, a: 1.0 };
const HEAD: Color = Color { r: 0.95, g: 0.55, b: 0.1, a: 1.0 };
const RELAY: Color = Color { r: 0.2, g: 0.55, b: 0.95, a: 1.0 };
const GROUNDED: Color = Color { r: 0.5, g: 0.5, b: 0.5, a: 0.6 };

pub(super) fn entity(id: &str, frame_id: String) -> SceneEntity {
    SceneEntity { timestamp: Some(time(0)), frame_id, id: id.to_owned(), ..SceneEntity::default() }
}

pub(super) fn pose(at: Vec2) -> Pose {
    let position = Some(Vector3 { x: at.x.into(), y: at.y.into(), z: 0.0 });
    Pose { position, orientation: Some(rotation(0.0)) }
}

pub(super) fn point(at: Vec2) -> Point3 {
    Point3 { x: at.x.into(), y: at.y.into(), z: 0.0 }
}

/// `/map`: the walls, and the base station if there is one.
pub(super) fn map(map: &Map, base: Option<Vec2>) -> SceneUpdate {
    let outline = |walls: &[Segment]| LinePrimitive {
        r#type: Type::LineLoop.into(),
        pose: Some(pose(Vec2::ZERO)),
        thickness: 2.0,
        scale_invariant: true,
        points: walls.iter().map(|wall| point(wall.a)).collect(),
        color: Some(WALL),
        ..LinePrimitive::default()
    };
    let walls = SceneEntity { lines: map.loops().map(outline).collect(), ..entity("walls", MAP.to_owned()) };
    let base = base.map(|at| CubePrimitive {
        pose: Some(pose(at)),
        size: Some(Vector3 { x: BASE_M, y: BASE_M, z: BASE_M }),
        color: Some(BASE),
    });
    let base = base.map(|cube| SceneEntity { cubes: vec![cube], ..entity("base", MAP.to_owned()) });
    SceneUpdate { deletions: Vec::new(), entities: std::iter::once(walls).chain(base).collect() }
}

/// `/uavs`: a disc and an arrow per UAV, in the UAV's own frame; `/tf` moves them.
pub(super) struct Bodies {
    all: SceneUpdate,
    changed: SceneUpdate,
    airborne: Vec<bool>,
}

impl Bodies {
    pub(super) fn new(course: &Course) -> Self {
        let uav = |uav: usize| disc_and_arrow(body(uav), course.scenario.motion.radius_m, GROUNDED);
        let uavs = course.spawns.len();
        let all = SceneUpdate { deletions: Vec::new(), entities: (0..uavs).map(uav).collect() };
        Self { all, changed: SceneUpdate::default(), airborne: vec![false; uavs] }
    }

    /// Everybody, on the ground.
    pub(super) fn all(&self) -> &SceneUpdate {
        &self.all
    }

    /// Those who took off or came down since the last call.
    pub(super) fn update(&mut self, frame: &Frame) -> Option<&SceneUpdate> {
        self.changed.entities.clear();
        let bodies = self.all.entities.iter_mut().zip(&mut self.airborne);
        for (index, ((body, was), uav)) in bodies.zip(&frame.uavs).enumerate() {
            if *was == uav.airborne {
                continue;
            }
            *was = uav.airborne;
            let color = Some(match (uav.airborne, index) {
                (false, _) => GROUNDED,
                (true, 0) => HEAD,
                (true, _) => RELAY,
            });
            body.timestamp = Some(time(frame.tick));
            body.cylinders.iter_mut().for_each(|disc| disc.color = color);
            body.arrows.iter_mut().for_each(|arrow| arrow.color = color);
            self.changed.entities.push(body.clone());
        }
        (!self.changed.entities.is_empty()).then_some(&self.changed)
    }
}

/// A body in its own frame.
pub(super) fn disc_and_arrow(frame_id: String, radius_m: f32, color: Color) -> SceneEntity {
    let radius_m = f64::from(radius_m);
    let disc = CylinderPrimitive {
        pose: Some(pose(Vec2::ZERO)),
        size: Some(Vector3 { x: 2.0 * radius_m, y: 2.0 * radius_m, z: BODY_M }),
        bottom_scale: 1.0,
        top_scale: 1.0,
        color: Some(color),
    };
    let arrow = ArrowPrimitive {
        pose: Some(pose(Vec2::ZERO)),
        shaft_length: 1.5 * radius_m,
        shaft_diameter: 0.2 * radius_m,
        head_length: 0.8 * radius_m,
        head_diameter: 0.6 * radius_m,
        color: Some(color),
    };
    let id = frame_id.clone();
    SceneEntity { frame_locked: true, cylinders: vec![disc], arrows: vec![arrow], ..entity(&id, frame_id) }
}

/// `/links`: a line per link of the flying chain.
pub(super) struct Links {
    scene: SceneUpdate,
    base: Vec2,
    s_min_db: f32,
}

impl Links {
    pub(super) fn new(course: &Course) -> Self {
        let lines = LinePrimitive {
            r#type: Type::LineList.into(),
            pose: Some(pose(Vec2::ZERO)),
            thickness: 3.0,
            scale_invariant: true,
            ..LinePrimitive::default()
        };
        let links = SceneEntity { lines: vec![lines], ..entity("links", MAP.to_owned()) };
        Self {
            scene: SceneUpdate { deletions: Vec::new(), entities: vec![links] },
            base: course.base,
            s_min_db: course.scenario.takeoff.s_min_db,
        }
    }

    /// The links as they stand; `None` as long as there are none, and were none before.
    pub(super) fn update(&mut self, frame: &Frame) -> Option<&SceneUpdate> {
        let entity = self.scene.entities.first_mut()?;
        entity.timestamp = Some(time(frame.tick));
        let lines = entity.lines.first_mut()?;
        if lines.points.is_empty() && frame.links.is_empty() {
            return None;
        }
        lines.points.clear();
        lines.colors.clear();
        let place = |uav: usize| frame.uavs.get(uav).map(|uav| Vec2::new(uav.x_m, uav.y_m));
        let behind = frame.links.iter().skip(1).map(|link| place(link.uav)).chain([Some(self.base)]);
        for (link, behind) in frame.links.iter().zip(behind) {
            let (Some(front), Some(behind)) = (place(link.uav), behind) else { continue };
            lines.points.extend([point(front), point(behind)]);
            lines.colors.extend([shade(link.true_db, self.s_min_db); 2]);
        }
        Some(&self.scene)
    }
}

/// Green, yellow, red.
fn shade(loss_db: f32, s_min_db: f32) -> Color {
    let worse = f64::from(bounded((loss_db - s_min_db) / SHADES_DB, -1.0, 1.0));
    Color { r: (1.0 + worse).min(1.0), g: (1.0 - worse).min(1.0), b: 0.1, a: 1.0 }
}
