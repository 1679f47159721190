//! Where everybody is: the tree of frames, and the poses in the map.

use foxglove::messages::{FrameTransform, FrameTransforms, Pose, PosesInFrame, Vector3};
use prost::encoding::message;

use crate::{
    mission::chain::{Course, Frame},
    record::mcap::scene::{MAP, rotation, time, transform},
};

/// The frame of a UAV's body: x forward, y left.
pub(super) fn body(uav: usize) -> String {
    format!("uav_{uav}")
}

fn waiting(course: &Course) -> impl Iterator<Item = FrameTransform> {
    course.spawns.iter().enumerate().map(|(uav, spawn)| {
        transform(MAP, body(uav), [spawn.at.x.into(), spawn.at.y.into()], spawn.heading_rad)
    })
}

/// Every frame there is: the map in the scenario's own frame, and the UAVs as they wait in the map.
pub(super) fn at_start(course: &Course) -> FrameTransforms {
    let map = transform("scenario", MAP.to_owned(), course.map.offset_m(), 0.0);
    FrameTransforms { transforms: std::iter::once(map).chain(waiting(course)).collect() }
}

/// `/tf`: the UAVs that fly. The others stand where they stood.
pub(super) struct Transforms {
    bodies: Vec<FrameTransform>,
    flew: Vec<bool>,
}

impl Transforms {
    pub(super) fn new(course: &Course) -> Self {
        Self { bodies: waiting(course).collect(), flew: vec![false; course.spawns.len()] }
    }

    /// Writes a `FrameTransforms` (field 1: transforms) of the UAVs that fly or have just come down.
    pub(super) fn encode(&mut self, frame: &Frame, buffer: &mut Vec<u8>) {
        let timestamp = Some(time(frame.tick));
        for ((body, uav), flew) in self.bodies.iter_mut().zip(&frame.uavs).zip(&mut self.flew) {
            if uav.airborne || *flew {
                body.timestamp = timestamp;
                body.translation = Some(Vector3 { x: uav.x_m.into(), y: uav.y_m.into(), z: 0.0 });
                body.rotation = Some(rotation(uav.heading_rad));
                message::encode(1, &*body, buffer);
            }
            *flew = uav.airborne;
        }
    }
}

/// `/poses`.
pub(super) struct Poses(PosesInFrame);

impl Poses {
    pub(super) fn new(uavs: usize) -> Self {
        Self(PosesInFrame { timestamp: None, frame_id: MAP.to_owned(), poses: Vec::with_capacity(uavs) })
    }

    pub(super) fn update(&mut self, frame: &Frame) -> &PosesInFrame {
        self.0.timestamp = Some(time(frame.tick));
        self.0.poses.clear();
        self.0.poses.extend(frame.uavs.iter().map(|uav| Pose {
            position: Some(Vector3 { x: uav.x_m.into(), y: uav.y_m.into(), z: 0.0 }),
            orientation: Some(rotation(uav.heading_rad)),
        }));
        &self.0
    }
}
