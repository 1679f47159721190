//! The chain as points, for viewers that draw no lines.

use foxglove::messages::PointCloud;
use glam::Vec2;

use super::scene::ends;
use crate::{
    mission::chain::{Course, Frame},
    record::mcap::scene::{Cloud, GROUNDED, crew, link},
};

/// Points of a link, its ends left out.
const LINK_POINTS: u32 = 8;

/// `/points/uavs` and `/points/links`.
pub(super) struct Points {
    uavs: Cloud,
    links: Cloud,
    radius_m: f32,
    base: Vec2,
    s_min_db: f32,
    lost_s: f32,
}

impl Points {
    pub(super) fn new(course: &Course) -> Self {
        let scenario = &course.scenario;
        Self {
            uavs: Cloud::default(),
            links: Cloud::default(),
            radius_m: scenario.motion.radius_m,
            base: course.base,
            s_min_db: scenario.takeoff.s_min_db,
            lost_s: scenario.link.lost_s,
        }
    }

    /// Every UAV, those on the ground in grey.
    pub(super) fn uavs(&mut self, frame: &Frame) -> PointCloud {
        self.uavs.clear();
        for (id, uav) in frame.uavs.iter().enumerate() {
            let colour = if uav.airborne { crew(id) } else { GROUNDED };
            self.uavs.push_body([uav.x_m, uav.y_m, 0.0], uav.heading_rad, self.radius_m, colour);
        }
        self.uavs.message(frame.tick)
    }

    /// The links as they stand, every other pair of points left out of one that is lost; `None` as long as there are none,
    /// and were none before.
    pub(super) fn links(&mut self, frame: &Frame) -> Option<PointCloud> {
        if self.links.is_empty() && frame.links.is_empty() {
            return None;
        }
        self.links.clear();
        for (of, front, behind) in ends(frame, self.base) {
            let is_lost = of.is_heard(self.lost_s) == Some(false);
            let colour = link(of.true_db, self.s_min_db);
            for i in (1..=LINK_POINTS).filter(|i| !is_lost || i % 4 < 2) {
                let at = front.lerp(behind, i as f32 / (LINK_POINTS + 1) as f32);
                self.links.push([at.x, at.y, 0.0], colour);
            }
        }
        Some(self.links.message(frame.tick))
    }
}
