//! Recordings of a chain.

mod events;
mod message;
mod poses;
mod scans;
mod scene;

use std::io::Write;

use foxglove::messages::{FrameTransforms, LaserScan, Log, PointCloud, PosesInFrame, SceneUpdate};

use crate::{
    mission::chain::{Course, Frame, Moment},
    record::{
        RecordError, Recorder,
        mcap::{About, Channel, FRAME_TOPIC, Out, Recordable as _, SHOWN_TICKS, scene as shared},
    },
};
use events::Events;
use message::{FrameMessage, MetricsMessage};
use poses::{Poses, Transforms};
use scans::Scans;
use scene::{Bodies, Links};

/// Records every frame of a run in MCAP.
///
/// What is written reaches the writer below chunk by chunk: a run that is killed loses at most the last 64 KiB.
/// Recording changes no bit of a run.
///
/// ```
/// use uchain_libm as _; // the same bits on every system
/// use uchain_sim::{mission::chain::{Course, McapRecorder}, config::builtin, record::mcap::Recording, run::run};
/// let course = Course::read(&builtin("corner").unwrap(), &["duration_s=2".to_owned()]).unwrap();
/// let mut recorder = McapRecorder::start(Vec::new(), &course, 1).unwrap();
/// let summary = run(&course, 1, &mut recorder).unwrap();
/// let file = recorder.finish().unwrap();
///
/// let mut recording = Recording::read(file.as_slice(), "memory").unwrap();
/// let course = recording.course().unwrap();
/// assert_eq!(recording.summary(&course, &mut ()).unwrap(), summary);
/// ```
pub struct McapRecorder<W: Write> {
    out: Out<W>,
    channels: Channels,
    lost_s: f32,
    frame: FrameMessage,
    transforms: Transforms,
    poses: Poses,
    scans: Scans,
    bodies: Bodies,
    links: Links,
    events: Events,
}

struct Channels {
    frame: Channel,
    metrics: Channel,
    transforms: Channel,
    poses: Channel,
    hits: Channel,
    bodies: Channel,
    links: Channel,
    log: Channel,
}

impl<W: Write> std::fmt::Debug for McapRecorder<W> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("McapRecorder").finish_non_exhaustive()
    }
}

impl<W: Write> McapRecorder<W> {
    /// Begins a recording: what it is of, the walls, the UAVs on the ground. All of that has reached `to` when this
    /// returns; from here on `to` always holds a readable file.
    ///
    /// # Errors
    /// [`RecordError::Io`].
    pub fn start(to: W, course: &Course, seed: u64) -> Result<Self, RecordError> {
        let scenario = course.scenario.to_toml().map_err(std::io::Error::other)?;
        let mut out = Out::begin(to, &About::of(scenario, &course.map, seed), &course.map)?;
        let channels = Channels {
            frame: out.own_channel(FRAME_TOPIC, "Frame")?,
            metrics: out.own_channel("/metrics", "Metrics")?,
            transforms: out.channel::<FrameTransforms>("/tf")?,
            poses: out.channel::<PosesInFrame>("/poses")?,
            hits: out.channel::<PointCloud>("/hits")?,
            bodies: out.channel::<SceneUpdate>("/uavs")?,
            links: out.channel::<SceneUpdate>("/links")?,
            log: out.channel::<Log>("/log")?,
        };
        let scans = (0..course.spawns.len()).map(|uav| out.channel::<LaserScan>(&format!("/tof/uav_{uav}")));
        let scans = Scans::new(course, scans.collect::<Result<_, _>>()?);
        let map = out.channel::<SceneUpdate>("/map")?;

        let mut recorder = Self {
            out,
            channels,
            lost_s: course.scenario.link.lost_s,
            frame: FrameMessage::default(),
            transforms: Transforms::new(course),
            poses: Poses::new(course.spawns.len()),
            scans,
            bodies: Bodies::new(course),
            links: Links::new(course),
            events: Events::new(course),
        };
        recorder.out.send(map, 0, &shared::map(&course.map, Some(course.base)))?;
        recorder.out.send(recorder.channels.transforms, 0, &poses::at_start(course))?;
        recorder.out.send(recorder.channels.bodies, 0, recorder.bodies.all())?;
        recorder.out.flush()?;
        Ok(recorder)
    }

    /// Ends the recording with its index and hands the writer back. Without this the file is readable as well, but
    /// counts as cut short.
    ///
    /// # Errors
    /// [`RecordError::Io`].
    pub fn finish(self) -> Result<W, RecordError> {
        self.out.finish()
    }

    fn show(&mut self, frame: &Frame) -> Result<(), RecordError> {
        let (out, channels, tick) = (&mut self.out, &self.channels, frame.tick);
        out.write(channels.transforms, tick, |buffer| self.transforms.encode(frame, buffer))?;
        out.send(channels.poses, tick, self.poses.update(frame))?;
        if let Some(changed) = self.bodies.update(frame) {
            out.send(channels.bodies, tick, changed)?;
        }
        if let Some(links) = self.links.update(frame) {
            out.send(channels.links, tick, links)?;
        }
        Ok(())
    }
}

impl<W: Write> Recorder<Frame> for McapRecorder<W> {
    fn frame(&mut self, frame: &Frame) -> Result<(), RecordError> {
        // Sensors read at the start of the tick, where the last one ended.
        let read_tick = frame.tick.saturating_sub(1);
        if read_tick.is_multiple_of(SHOWN_TICKS) && self.scans.update(frame) {
            for (channel, scan) in self.scans.seen() {
                self.out.send(channel, read_tick, scan)?;
            }
            self.out.send(self.channels.hits, read_tick, &self.scans.hits(read_tick))?;
        }
        self.scans.stand(frame);
        frame.fill(&mut self.frame);
        self.out.send(self.channels.frame, frame.tick, &self.frame)?;
        if frame.decision {
            let moment = MetricsMessage::from(Moment::of(frame, self.lost_s));
            self.out.send(self.channels.metrics, frame.tick, &moment)?;
        }
        if frame.tick.is_multiple_of(SHOWN_TICKS) {
            self.show(frame)?;
        }
        for event in self.events.update(frame) {
            self.out.send(self.channels.log, frame.tick, event)?;
        }
        Ok(())
    }
}
