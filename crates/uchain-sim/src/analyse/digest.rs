//! One number for all bits of a run.

use std::hash::Hasher;

use twox_hash::XxHash64;

use crate::record::{Frame, RecordError, Recorder};

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
