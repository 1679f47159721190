//! What the ToF sensors read: beams per UAV, and where they ended in the map.

use core::f32::consts::FRAC_PI_4;

use foxglove::messages::{
    LaserScan, PackedElementField, PointCloud, Pose, Quaternion, Vector3, packed_element_field::NumericType,
};
use glam::Vec2;
use uchain_core::chain::Tof;

use super::poses::body;
use crate::mission::chain::{Course, Frame};
use crate::record::mcap::{
    Channel,
    scene::{MAP, time},
};

/// Bearings of the beams, clockwise last: rear right, front right, front left, rear left (rad).
const BEARINGS_RAD: [f32; 4] = [-3.0 * FRAC_PI_4, -FRAC_PI_4, FRAC_PI_4, 3.0 * FRAC_PI_4];

/// Readings in the order of [`BEARINGS_RAD`].
fn ranges_m(tof: Tof) -> [f32; 4] {
    [tof.se_m, tof.ne_m, tof.nw_m, tof.sw_m]
}

/// `/tof/uav_0`, … and `/hits`.
pub(super) struct Scans {
    uavs: Vec<Scan>,
    range_m: f32,
    fields: Vec<PackedElementField>,
    points: Vec<u8>,
}

struct Scan {
    channel: Channel,
    message: LaserScan,
    read: bool,
    /// Where the UAV stood at the end of the last tick, and its heading (rad).
    at: Vec2,
    heading_rad: f32,
}

impl Scans {
    pub(super) fn new(course: &Course, channels: Vec<Channel>) -> Self {
        let scan = |(uav, (channel, spawn)): (usize, (Channel, &crate::mission::chain::Spawn))| Scan {
            channel,
            message: LaserScan {
                timestamp: None,
                frame_id: body(uav),
                pose: Some(identity()),
                start_angle: BEARINGS_RAD[0].into(),
                end_angle: BEARINGS_RAD[3].into(),
                ranges: Vec::with_capacity(4),
                intensities: Vec::new(),
            },
            read: false,
            at: spawn.at,
            heading_rad: spawn.heading_rad,
        };
        let field = |(name, offset, kind): (&str, u32, NumericType)| PackedElementField {
            name: name.to_owned(),
            offset,
            r#type: kind.into(),
        };
        let (number, count) = (NumericType::Float32, NumericType::Uint32);
        let fields = [("x", 0, number), ("y", 4, number), ("z", 8, number), ("uav", 12, count)];
        Self {
            uavs: channels.into_iter().zip(&course.spawns).enumerate().map(scan).collect(),
            range_m: course.scenario.tof.range_m,
            fields: fields.map(field).to_vec(),
            points: Vec::new(),
        }
    }

    /// Takes the readings of a frame; whether there are any.
    pub(super) fn update(&mut self, frame: &Frame) -> bool {
        let timestamp = Some(time(frame.tick.saturating_sub(1)));
        self.points.clear();
        let mut any = false;
        for (uav, (scan, now)) in self.uavs.iter_mut().zip(&frame.uavs).enumerate() {
            scan.read = now.tof.is_some();
            let Some(tof) = now.tof else { continue };
            any = true;
            scan.message.timestamp = timestamp;
            scan.message.ranges.clear();
            let (sin, cos) = libm::sincosf(scan.heading_rad);
            let forward = Vec2::new(cos, sin);
            for (range_m, bearing_rad) in ranges_m(tof).into_iter().zip(BEARINGS_RAD) {
                scan.message.ranges.push(range_m.into());
                if range_m < self.range_m {
                    let (sin, cos) = libm::sincosf(bearing_rad);
                    let hit = scan.at + range_m * (forward * cos + forward.perp() * sin);
                    for number in [hit.x, hit.y, 0.0] {
                        self.points.extend(number.to_le_bytes());
                    }
                    self.points.extend((uav as u32).to_le_bytes());
                }
            }
        }
        any
    }

    /// The scans of those who read.
    pub(super) fn seen(&self) -> impl Iterator<Item = (Channel, &LaserScan)> {
        self.uavs.iter().filter(|scan| scan.read).map(|scan| (scan.channel, &scan.message))
    }

    /// Where beams ended at this tick; those that met nothing have no end.
    pub(super) fn hits(&self, tick: u64) -> PointCloud {
        PointCloud {
            timestamp: Some(time(tick)),
            frame_id: MAP.to_owned(),
            pose: Some(identity()),
            point_stride: 16,
            fields: self.fields.clone(),
            data: foxglove::bytes::Bytes::copy_from_slice(&self.points),
        }
    }

    /// Keeps where everybody stands: from there the next tick's beams go out.
    pub(super) fn stand(&mut self, frame: &Frame) {
        for (scan, uav) in self.uavs.iter_mut().zip(&frame.uavs) {
            (scan.at, scan.heading_rad) = (Vec2::new(uav.x_m, uav.y_m), uav.heading_rad);
        }
    }
}

fn identity() -> Pose {
    Pose {
        position: Some(Vector3::default()),
        orientation: Some(Quaternion { w: 1.0, ..Quaternion::default() }),
    }
}
