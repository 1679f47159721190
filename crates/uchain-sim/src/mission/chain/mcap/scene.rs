//! What there is to see of a chain: the UAVs' bodies, links coloured by loss.

use foxglove::messages::{LinePrimitive, SceneEntity, SceneUpdate, line_primitive::Type};
use glam::Vec2;

use super::poses::body;
use crate::{
    mission::chain::{Course, Frame, LinkFrame},
    record::mcap::scene::{GROUNDED, MAP, color, crew, disc_and_arrow, entity, link, point, pose, time},
};

/// Dashes of a link that is lost.
const DASHES: u32 = 8;

/// `/uavs`: a disc, an arrow and a number per UAV, in the UAV's own frame; `/tf` moves them.
pub(super) struct Bodies {
    all: SceneUpdate,
    changed: SceneUpdate,
    airborne: Vec<bool>,
}

impl Bodies {
    pub(super) fn new(course: &Course) -> Self {
        let uav =
            |uav: usize| disc_and_arrow(body(uav), uav, course.scenario.motion.radius_m, color(GROUNDED));
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
            let color = Some(color(if uav.airborne { crew(index) } else { GROUNDED }));
            body.timestamp = Some(time(frame.tick));
            body.cylinders.iter_mut().for_each(|disc| disc.color = color);
            body.arrows.iter_mut().for_each(|arrow| arrow.color = color);
            body.texts.iter_mut().for_each(|text| text.color = color);
            self.changed.entities.push(body.clone());
        }
        (!self.changed.entities.is_empty()).then_some(&self.changed)
    }
}

/// Links of the flying chain, each from its front end to its rear end, which may be the base.
pub(super) fn ends(frame: &Frame, base: Vec2) -> impl Iterator<Item = (&LinkFrame, Vec2, Vec2)> {
    let place = |uav: usize| frame.uavs.get(uav).map(|uav| Vec2::new(uav.x_m, uav.y_m));
    let behind = frame.links.iter().skip(1).map(move |link| place(link.uav)).chain([Some(base)]);
    frame.links.iter().zip(behind).filter_map(move |(link, behind)| Some((link, place(link.uav)?, behind?)))
}

/// `/links`: a line per link of the flying chain, dashed where an end has heard nothing for too long.
pub(super) struct Links {
    scene: SceneUpdate,
    base: Vec2,
    s_min_db: f32,
    lost_s: f32,
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
            lost_s: course.scenario.link.lost_s,
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
        for (of, front, behind) in ends(frame, self.base) {
            let color = color(link(of.true_db, self.s_min_db));
            let is_lost = of.is_heard(self.lost_s) == Some(false);
            let (pieces, shown) = if is_lost { (2 * DASHES, DASHES) } else { (1, 1) };
            for piece in (0..shown).map(|dash| 2 * dash) {
                let at = |piece: u32| point(front.lerp(behind, piece as f32 / pieces as f32));
                lines.points.extend([at(piece), at(piece + 1)]);
                lines.colors.extend([color; 2]);
            }
        }
        Some(&self.scene)
    }
}
