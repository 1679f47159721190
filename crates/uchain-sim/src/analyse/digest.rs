//! One number for all bits of a run.

use std::hash::Hasher;

use twox_hash::XxHash64;

use crate::record::{ExploreFrame, Frame, RecordError, Recorder};

/// `XxHash64` over every field of every frame, in order.
#[derive(Debug)]
pub struct Digest {
    hash: XxHash64,
    /// One frame's bytes: the hash takes its time over every call, however small.
    bytes: Vec<u8>,
}

impl Default for Digest {
    fn default() -> Self {
        Self { hash: XxHash64::with_seed(0), bytes: Vec::new() }
    }
}

impl Digest {
    /// What has been seen so far, as 16 hex digits.
    pub fn hex(&self) -> String {
        format!("{:016x}", self.hash.finish())
    }

    fn number(&mut self, value: f32) {
        self.bytes.extend_from_slice(&value.to_bits().to_le_bytes());
    }
}

impl Recorder for Digest {
    fn frame(&mut self, frame: &Frame) -> Result<(), RecordError> {
        self.bytes.clear();
        self.bytes.extend_from_slice(&frame.tick.to_le_bytes());
        for uav in &frame.uavs {
            for value in
                [uav.x_m, uav.y_m, uav.heading_rad, uav.forward_mps, uav.lateral_mps, uav.yaw_rate_radps]
            {
                self.number(value);
            }
            self.bytes.push(u8::from(uav.airborne));
            self.bytes.extend_from_slice(&uav.wall_contacts.to_le_bytes());
            self.bytes.extend_from_slice(&uav.uav_contacts.to_le_bytes());
        }
        if frame.decision {
            for link in &frame.links {
                self.number(link.true_db);
                self.number(link.filtered_db.unwrap_or(f32::NAN));
            }
            self.number(frame.head_reach_m);
        }
        self.hash.write(&self.bytes);
        Ok(())
    }
}

impl Recorder<ExploreFrame> for Digest {
    fn frame(&mut self, frame: &ExploreFrame) -> Result<(), RecordError> {
        self.bytes.clear();
        self.bytes.extend_from_slice(&frame.tick.to_le_bytes());
        self.bytes.extend_from_slice(&frame.rounds.to_le_bytes());
        for robot in &frame.robots {
            for value in [robot.x_m, robot.y_m, robot.z_m, robot.heading_rad] {
                self.number(value);
            }
            self.bytes.extend_from_slice(&robot.level.to_le_bytes());
            self.bytes.extend_from_slice(&[
                robot.purpose as u8,
                robot.moves.into(),
                robot.holds.into(),
                robot.mfl.into(),
            ]);
            self.bytes.extend_from_slice(&robot.wall_contacts.to_le_bytes());
            self.bytes.extend_from_slice(&robot.robot_contacts.to_le_bytes());
            self.bytes.extend_from_slice(&robot.level_passes.to_le_bytes());
        }
        for node in &frame.nodes {
            self.bytes.extend_from_slice(&node.id.robot.to_le_bytes());
            for value in node.believed_m {
                self.number(value);
            }
            for sector in &node.sectors {
                self.bytes.extend_from_slice(&[sector.label as u8]);
                self.number(sector.r_m);
            }
        }
        for change in &frame.labels {
            self.bytes.extend_from_slice(&change.node.robot.to_le_bytes());
            self.bytes.extend_from_slice(&change.node.number.to_le_bytes());
            self.bytes.extend_from_slice(&change.sector.to_le_bytes());
        }
        for end in frame.edges.iter().flatten() {
            self.bytes.extend_from_slice(&end.robot.to_le_bytes());
            self.bytes.extend_from_slice(&end.number.to_le_bytes());
        }
        self.bytes.extend_from_slice(&frame.hubs.to_le_bytes());
        self.bytes.extend_from_slice(&[frame.stopped.map_or(u8::MAX, |stopped| stopped as u8)]);
        self.hash.write(&self.bytes);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::UavFrame;

    #[test]
    fn one_bit_of_one_frame_changes_the_digest() {
        let uav = UavFrame {
            x_m: 1.0,
            y_m: 2.0,
            heading_rad: 0.0,
            forward_mps: 0.0,
            lateral_mps: 0.0,
            yaw_rate_radps: 0.0,
            airborne: true,
            wall_contacts: 0,
            uav_contacts: 0,
            tof: None,
        };
        let of = |x_m| {
            let mut digest = Digest::default();
            let frame = Frame { uavs: vec![UavFrame { x_m, ..uav }], ..Frame::default() };
            digest.frame(&frame).unwrap();
            digest.hex()
        };
        assert_eq!(of(1.0), of(1.0));
        assert_ne!(of(1.0), of(1.0_f32.next_up()));
    }
}
