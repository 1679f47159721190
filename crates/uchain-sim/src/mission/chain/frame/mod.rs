//! What one instant of a chain leaves behind.

mod compare;
mod moment;

use uchain_core::chain::{Doing, PilotInput, Tof};

use crate::{
    clock,
    record::{Difference, RecordError, Recorder, Snapshot},
};

pub use moment::Moment;
pub(crate) use moment::spread_db;

/// One UAV at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UavFrame {
    /// Position in the map's frame (m).
    pub x_m: f32,
    /// Position in the map's frame (m).
    pub y_m: f32,
    /// Direction of the body's x axis, counter-clockwise from the map's x axis (rad).
    pub heading_rad: f32,
    /// Forward speed over ground (m/s).
    pub forward_mps: f32,
    /// Leftward speed over ground (m/s).
    pub lateral_mps: f32,
    /// Yaw rate, counter-clockwise (rad/s).
    pub yaw_rate_radps: f32,
    /// In the air; a UAV on the ground has no body and blocks nobody.
    pub airborne: bool,
    /// Wall contacts begun so far.
    pub wall_contacts: u32,
    /// Contacts with other UAVs begun so far.
    pub uav_contacts: u32,
    /// What its ToF sensors read at the start of the tick; `None` at ticks between two readings and on the ground.
    /// Not part of the digest: it shows in what the UAV does.
    pub tof: Option<Tof>,
    /// What it is about after its decision: overrides, walls, a launch. `None` between decisions, of a law that does not say
    /// and of a UAV that has failed, and in recordings of versions that did not write it. Not part of the digest: it shows
    /// in what the UAV does.
    pub doing: Option<Doing>,
}

/// One link of the flying chain, from a UAV to the next one in the air toward the base, or to the base.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinkFrame {
    /// The UAV at the link's front end.
    pub uav: usize,
    /// Loss without noise (dB).
    pub true_db: f32,
    /// The front end's filtered estimate (dB); `None` before its first packet.
    pub filtered_db: Option<f32>,
    /// The front end's last sample, as measured (dB); `None` before its first packet.
    pub raw_db: Option<f32>,
    /// How long its ends have heard nothing; `None` in recordings of versions that did not write it. Not part of the
    /// digest.
    pub silence: Option<Silence>,
}

/// How long the two ends of a link have heard nothing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Silence {
    /// The end toward the head (s); `None` before its first packet.
    pub front_s: Option<f32>,
    /// The end toward the base, which may be the base itself (s); `None` before its first packet.
    pub rear_s: Option<f32>,
}

impl LinkFrame {
    /// Whether both ends have heard something within `lost_s`; `None` if nobody knows.
    pub fn is_heard(&self, lost_s: f32) -> Option<bool> {
        let within = |silent_s: Option<f32>| silent_s.is_some_and(|silent_s| silent_s <= lost_s);
        self.silence.map(|silence| within(silence.front_s) && within(silence.rear_s))
    }
}

/// What became of the pilot's wish in a tick in which the head could fly freely: it was in the air, and had risen and
/// hovered. Not part of the digest: it shows in what the head does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeadFrame {
    /// Forward speed its pilot asked for (m/s).
    pub pilot_mps: f32,
    /// What its link allowed of it, or made of it (m/s).
    pub allowed_mps: f32,
    /// What its body was asked for: that, slowed down near walls (m/s).
    pub asked_mps: f32,
}

/// One instant of a run.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Frame {
    /// Ticks since the start; one tick is [`TICK_S`](crate::clock::TICK_S). A frame shows the world at the end of its tick; what was
    /// decided in it was decided at its start, [`Frame::decided_s`].
    pub tick: u64,
    /// Whether radio and laws ran at this tick (positioning rate).
    pub decision: bool,
    /// All UAVs by id, those on the ground included.
    pub uavs: Vec<UavFrame>,
    /// Id of the UAV that leads the chain, its head. Not part of the digest: it shows in what the UAVs do.
    pub leader: usize,
    /// Links of the flying chain, head first; as of the last decision. Empty before the first one.
    pub links: Vec<LinkFrame>,
    /// Tunnel distance from the base to the head (m).
    pub head_reach_m: f32,
    /// What became of the pilot's wish; `None` while the head cannot fly freely, and in recordings of versions that did not
    /// write it.
    pub head: Option<HeadFrame>,
    /// What the pilot asked for anew at the start of the tick, in a flight by hand; what a script asks for is nothing new.
    /// Not part of the digest: it shows in what the head does.
    pub input: Option<PilotInput>,
}

impl Frame {
    /// Whether the head was in the chain at the last exchange, and every link was heard within `lost_s`, both ways; `None`
    /// if nobody knows. An empty chain connects nobody.
    pub fn is_connected(&self, lost_s: f32) -> Option<bool> {
        if self.links.first().is_none_or(|link| link.uav != self.leader) {
            return Some(false);
        }
        self.links.iter().map(|link| link.is_heard(lost_s)).try_fold(true, |all, heard| Some(all && heard?))
    }
}

impl Frame {
    /// Simulated time at the end of the tick (s).
    pub fn time_s(&self) -> f64 {
        clock::time_s(self.tick)
    }

    /// Simulated time at the start of the tick (s): when its decisions were taken and its losses measured.
    pub fn decided_s(&self) -> f64 {
        clock::start_s(self.tick)
    }
}

impl Snapshot for Frame {
    const CREW: &'static str = "UAVs";

    fn tick(&self) -> u64 {
        self.tick
    }

    fn crew(&self) -> usize {
        self.uavs.len()
    }

    fn is_decision(&self) -> bool {
        self.decision
    }

    fn hash(&self, bytes: &mut Vec<u8>) {
        bytes.extend_from_slice(&self.tick.to_le_bytes());
        for uav in &self.uavs {
            for value in
                [uav.x_m, uav.y_m, uav.heading_rad, uav.forward_mps, uav.lateral_mps, uav.yaw_rate_radps]
            {
                number(bytes, value);
            }
            bytes.push(u8::from(uav.airborne));
            bytes.extend_from_slice(&uav.wall_contacts.to_le_bytes());
            bytes.extend_from_slice(&uav.uav_contacts.to_le_bytes());
        }
        if self.decision {
            for link in &self.links {
                number(bytes, link.true_db);
                number(bytes, link.filtered_db.unwrap_or(f32::NAN));
            }
            number(bytes, self.head_reach_m);
        }
    }

    fn differences(&self, there: &Self, found: &mut dyn FnMut(Difference)) {
        compare::differences(self, there, found);
    }
}

/// Appends the bits of a number.
fn number(bytes: &mut Vec<u8>, value: f32) {
    bytes.extend_from_slice(&value.to_bits().to_le_bytes());
}

/// Keeps the decision frames, for pictures.
#[derive(Debug, Clone, Default)]
pub struct History {
    /// Frames at the positioning rate, in order.
    pub frames: Vec<Frame>,
}

impl Recorder<Frame> for History {
    fn frame(&mut self, frame: &Frame) -> Result<(), RecordError> {
        if frame.decision {
            self.frames.push(frame.clone());
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analyse::Digest;

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
            doing: None,
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
