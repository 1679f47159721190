//! What there is to see of a chain: the UAVs' bodies, links coloured by loss.

use foxglove::messages::{Color, LinePrimitive, SceneEntity, SceneUpdate, line_primitive::Type};
use glam::Vec2;
use uchain_core::bounded;

use super::poses::body;
use crate::{
    mission::chain::{Course, Frame},
    record::mcap::scene::{MAP, disc_and_arrow, entity, point, pose, time},
};

/// A link this much better than `takeoff.s_min_db` is green, one this much worse red; at `s_min_db` it is yellow
/// (dB).
const SHADES_DB: f32 = 20.0;

const HEAD: Color = Color { r: 0.95, g: 0.55, b: 0.1, a: 1.0 };
const RELAY: Color = Color { r: 0.2, g: 0.55, b: 0.95, a: 1.0 };
const GROUNDED: Color = Color { r: 0.5, g: 0.5, b: 0.5, a: 0.6 };

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
