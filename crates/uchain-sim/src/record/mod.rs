//! What one instant of a run leaves behind, and who may listen.

mod explore;
#[cfg(feature = "record")]
pub mod mcap;
mod moment;
mod progress;
mod way;

use uchain_core::chain::Tof;

use crate::clock;

pub use explore::{ExploreFrame, LabelFrame, NodeFrame, RobotFrame, Stopped};
pub use moment::Moment;
pub(crate) use moment::spread_db;
pub(crate) use progress::Odometer;
pub use progress::Progress;
pub(crate) use way::Way;

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
}

/// One link of the flying chain, from a UAV to the next one in the air toward the base, or to the base.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinkFrame {
    /// The UAV at the link's front end, 0 = head.
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
    /// All UAVs, head first, those on the ground included.
    pub uavs: Vec<UavFrame>,
    /// Links of the flying chain, head first; as of the last decision. Empty before the first one.
    pub links: Vec<LinkFrame>,
    /// Tunnel distance from the base to the head (m).
    pub head_reach_m: f32,
    /// What became of the pilot's wish; `None` while the head cannot fly freely, and in recordings of versions that did not
    /// write it.
    pub head: Option<HeadFrame>,
}

impl Frame {
    /// Whether the head was in the chain at the last exchange, and every link was heard within `lost_s`, both ways; `None`
    /// if nobody knows. An empty chain connects nobody.
    pub fn is_connected(&self, lost_s: f32) -> Option<bool> {
        if self.links.first().is_none_or(|link| link.uav != 0) {
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

/// Someone who is shown every frame of a mission, in order: those of a chain, or [`ExploreFrame`]s. It can stop the run, it cannot change it.
pub trait Recorder<F = Frame> {
    /// One frame.
    ///
    /// # Errors
    /// [`RecordError`] ends the run.
    fn frame(&mut self, frame: &F) -> Result<(), RecordError>;
}

/// Why a recorder ended a run.
#[derive(Debug, thiserror::Error)]
pub enum RecordError {
    /// The caller asked to stop (Ctrl-C).
    #[error("interrupted at {time_s:.1} s of simulated time")]
    Interrupted {
        /// Simulated time (s).
        time_s: f64,
    },
    /// The recording cannot be written.
    #[error("cannot write the recording: {0}")]
    Io(#[from] std::io::Error),
}

/// Nobody listens.
impl<F> Recorder<F> for () {
    fn frame(&mut self, _: &F) -> Result<(), RecordError> {
        Ok(())
    }
}

/// Perhaps somebody listens.
impl<F, R: Recorder<F>> Recorder<F> for Option<R> {
    fn frame(&mut self, frame: &F) -> Result<(), RecordError> {
        self.as_mut().map_or(Ok(()), |recorder| recorder.frame(frame))
    }
}

/// Both listen, the first one first.
impl<F, A: Recorder<F>, B: Recorder<F>> Recorder<F> for (A, B) {
    fn frame(&mut self, frame: &F) -> Result<(), RecordError> {
        self.0.frame(frame)?;
        self.1.frame(frame)
    }
}

impl<F, R: Recorder<F> + ?Sized> Recorder<F> for &mut R {
    fn frame(&mut self, frame: &F) -> Result<(), RecordError> {
        (**self).frame(frame)
    }
}

/// Keeps the decision frames, for pictures.
#[derive(Debug, Clone, Default)]
pub struct History {
    /// Frames at the positioning rate, in order.
    pub frames: Vec<Frame>,
}

impl Recorder for History {
    fn frame(&mut self, frame: &Frame) -> Result<(), RecordError> {
        if frame.decision {
            self.frames.push(frame.clone());
        }
        Ok(())
    }
}
