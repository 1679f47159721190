//! Writes a recording while robots explore.

mod message;
mod news;
mod scene;

use std::io::Write;

use foxglove::messages::{FrameTransform, FrameTransforms, Log, Pose, PosesInFrame, SceneUpdate, Vector3};

use crate::record::mcap::{
    Channel, Out, Recordable as _, SHOWN_TICKS,
    scene::{self as shared, MAP, rotation, time, transform},
};
use crate::{
    mission::explore::{ExploreFrame, Odometer, Site},
    record::{
        RecordError, Recorder,
        mcap::{About, FRAME_TOPIC},
    },
};
use message::{ExploreFrameMessage, ExploreMetricsMessage};
use news::News;
use scene::{Graph, Stars, Ways, robot_colour};

/// Records every frame of an exploration in MCAP, as [`McapRecorder`](super::McapRecorder) does of a chain.
///
/// ```
/// use uchain_libm as _; // the same bits on every system
/// use uchain_sim::{mission::explore::{Site, ExploreRecorder}, config::builtin, record::mcap::Recording, run::explore};
/// let site = Site::read(&builtin("apartment").unwrap(), &["duration_s=20".to_owned()]).unwrap();
/// let mut recorder = ExploreRecorder::start(Vec::new(), &site, 1).unwrap();
/// let (summary, _) = explore(&site, 1, &mut recorder).unwrap();
/// let file = recorder.finish().unwrap();
///
/// let mut recording = Recording::read_exploration(file.as_slice(), "memory").unwrap();
/// let site = recording.site().unwrap();
/// assert_eq!(recording.summary(&site, &mut ()).unwrap().0, summary);
/// ```
pub struct ExploreRecorder<W: Write> {
    out: Out<W>,
    channels: Channels,
    frame: ExploreFrameMessage,
    odometer: Odometer,
    stars: Stars,
    graph: Graph,
    ways: Ways,
    news: News,
}

struct Channels {
    frame: Channel,
    metrics: Channel,
    transforms: Channel,
    poses: Channel,
    stars: Channel,
    graph: Channel,
    ways: Channel,
    log: Channel,
}

impl<W: Write> std::fmt::Debug for ExploreRecorder<W> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("ExploreRecorder").finish_non_exhaustive()
    }
}

impl<W: Write> ExploreRecorder<W> {
    /// Begins a recording: what it is of, and the walls. All of that has reached `to` when this returns; from here on
    /// `to` always holds a readable file.
    ///
    /// # Errors
    /// [`RecordError::Io`].
    pub fn start(to: W, site: &Site, seed: u64) -> Result<Self, RecordError> {
        let scenario = site.scenario.to_toml().map_err(std::io::Error::other)?;
        let mut out = Out::begin(to, &About::of(scenario, &site.map, seed), &site.map)?;
        let channels = Channels {
            frame: out.own_channel(FRAME_TOPIC, "ExploreFrame")?,
            metrics: out.own_channel("/metrics", "ExploreMetrics")?,
            transforms: out.channel::<FrameTransforms>("/tf")?,
            poses: out.channel::<PosesInFrame>("/poses")?,
            stars: out.channel::<SceneUpdate>("/stars")?,
            graph: out.channel::<SceneUpdate>("/graph")?,
            ways: out.channel::<SceneUpdate>("/ways")?,
            log: out.channel::<Log>("/log")?,
        };
        let (map, robots) = (out.channel::<SceneUpdate>("/map")?, out.channel::<SceneUpdate>("/robots")?);
        out.send(map, 0, &shared::map(&site.map, None))?;
        let place = transform("scenario", MAP.to_owned(), site.map.offset_m(), 0.0);
        out.send(channels.transforms, 0, &FrameTransforms { transforms: vec![place] })?;
        let radius_m = site.scenario.params.r_body_m;
        let robot = |i: usize| shared::disc_and_arrow(body(i), radius_m, robot_colour(i));
        let bodies = (0..site.spawns.len()).map(robot).collect();
        out.send(robots, 0, &SceneUpdate { deletions: Vec::new(), entities: bodies })?;
        out.flush()?;
        Ok(Self {
            out,
            channels,
            frame: ExploreFrameMessage::default(),
            odometer: Odometer::default(),
            stars: Stars::default(),
            graph: Graph::default(),
            ways: Ways::default(),
            news: News::default(),
        })
    }

    /// Ends the recording with its index and hands the writer back. Without this the file is readable as well, but
    /// counts as cut short.
    ///
    /// # Errors
    /// [`RecordError::Io`].
    pub fn finish(self) -> Result<W, RecordError> {
        self.out.finish()
    }

    fn show(&mut self, frame: &ExploreFrame) -> Result<(), RecordError> {
        let (out, channels, tick) = (&mut self.out, &self.channels, frame.tick);
        out.send(channels.transforms, tick, &transforms(frame))?;
        out.send(channels.poses, tick, &poses(frame))
    }

    fn decision(&mut self, frame: &ExploreFrame) -> Result<(), RecordError> {
        let (out, channels, tick) = (&mut self.out, &self.channels, frame.tick);
        if let Some(stars) = self.stars.update(frame) {
            out.send(channels.stars, tick, &stars)?;
        }
        if let Some(graph) = self.graph.update(frame) {
            out.send(channels.graph, tick, &graph)?;
        }
        if let Some(ways) = self.ways.end_of_round(frame) {
            out.send(channels.ways, tick, &ways)?;
        }
        Ok(())
    }
}

impl<W: Write> Recorder<ExploreFrame> for ExploreRecorder<W> {
    fn frame(&mut self, frame: &ExploreFrame) -> Result<(), RecordError> {
        frame.fill(&mut self.frame);
        self.out.send(self.channels.frame, frame.tick, &self.frame)?;
        let progress = self.odometer.add(frame);
        let is_last = frame.stopped.is_some();
        if frame.decision || is_last {
            let metrics = ExploreMetricsMessage::from(progress);
            self.out.send(self.channels.metrics, frame.tick, &metrics)?;
            self.decision(frame)?;
        }
        self.ways.fly(frame);
        if frame.tick.is_multiple_of(SHOWN_TICKS) || is_last {
            self.show(frame)?;
        }
        for event in self.news.update(frame) {
            self.out.send(self.channels.log, frame.tick, event)?;
        }
        Ok(())
    }
}

/// The frame of a robot's body: x forward, y left.
fn body(robot: usize) -> String {
    format!("robot_{robot}")
}

/// `/tf`.
fn transforms(frame: &ExploreFrame) -> FrameTransforms {
    let robot = |(i, robot): (usize, &crate::mission::explore::RobotFrame)| FrameTransform {
        timestamp: Some(time(frame.tick)),
        translation: Some(Vector3 { x: robot.x_m.into(), y: robot.y_m.into(), z: robot.z_m.into() }),
        ..transform(MAP, body(i), [0.0; 2], robot.heading_rad)
    };
    FrameTransforms { transforms: frame.robots.iter().enumerate().map(robot).collect() }
}

/// `/poses`.
fn poses(frame: &ExploreFrame) -> PosesInFrame {
    let pose = |robot: &crate::mission::explore::RobotFrame| Pose {
        position: Some(Vector3 { x: robot.x_m.into(), y: robot.y_m.into(), z: robot.z_m.into() }),
        orientation: Some(rotation(robot.heading_rad)),
    };
    PosesInFrame {
        timestamp: Some(time(frame.tick)),
        frame_id: MAP.to_owned(),
        poses: frame.robots.iter().map(pose).collect(),
    }
}
