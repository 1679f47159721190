//! Recordings of a chain.

mod input;
mod message;
mod points;
mod poses;
mod scans;
mod scene;

use foxglove::messages::{FrameTransforms, LaserScan, Log, PointCloud, PosesInFrame, SceneUpdate};

use crate::{
    mission::{
        Recorded,
        chain::{Chain, Course, Frame, Moment, events::Events},
    },
    record::{
        RecordError,
        mcap::{self, Channel, Out, POINTS_TICKS, SHOWN_TICKS, Topics, scene as shared},
    },
};
use message::MetricsMessage;
use points::Points;
use poses::{Poses, Transforms};
use scans::Scans;
use scene::{Bodies, Links};

/// Records a chain.
pub type McapRecorder<W> = mcap::McapRecorder<W, ChainTopics>;

/// Topics of a chain.
pub struct ChainTopics {
    channels: Channels,
    lost_s: f32,
    transforms: Transforms,
    poses: Poses,
    scans: Scans,
    bodies: Bodies,
    links: Links,
    points: Points,
    events: Events,
}

struct Channels {
    metrics: Channel,
    transforms: Channel,
    poses: Channel,
    hits: Channel,
    bodies: Channel,
    links: Channel,
    uav_points: Channel,
    link_points: Channel,
    log: Channel,
}

impl std::fmt::Debug for ChainTopics {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("ChainTopics").finish_non_exhaustive()
    }
}

impl Recorded for Chain {
    type Topics = ChainTopics;
}

impl Topics for ChainTopics {
    type Scene = Course;
    type Frame = Frame;

    fn start(course: &Course, out: &mut Out<'_>) -> Result<Self, RecordError> {
        let channels = Channels {
            metrics: out.own_channel("/metrics", "Metrics")?,
            transforms: out.channel::<FrameTransforms>("/tf")?,
            poses: out.channel::<PosesInFrame>("/poses")?,
            hits: out.channel::<PointCloud>("/hits")?,
            bodies: out.channel::<SceneUpdate>("/uavs")?,
            links: out.channel::<SceneUpdate>("/links")?,
            uav_points: out.channel::<PointCloud>("/points/uavs")?,
            link_points: out.channel::<PointCloud>("/points/links")?,
            log: out.channel::<Log>("/log")?,
        };
        let walls = out.channel::<PointCloud>("/points/walls")?;
        let scans = (0..course.spawns.len()).map(|uav| out.channel::<LaserScan>(&format!("/tof/uav_{uav}")));
        let scans = Scans::new(course, scans.collect::<Result<_, _>>()?);
        let map = out.channel::<SceneUpdate>("/map")?;
        let topics = Self {
            channels,
            lost_s: course.scenario.link.lost_s,
            transforms: Transforms::new(course),
            poses: Poses::new(course.spawns.len()),
            scans,
            bodies: Bodies::new(course),
            links: Links::new(course),
            points: Points::new(course),
            events: Events::new(course),
        };
        out.send(map, 0, &shared::map(&course.map, Some(course.base)))?;
        out.send(walls, 0, &shared::walls(&course.map, Some(course.base)))?;
        out.send(topics.channels.transforms, 0, &poses::at_start(course))?;
        out.send(topics.channels.bodies, 0, topics.bodies.all())?;
        Ok(topics)
    }

    fn sensed(&mut self, frame: &Frame, out: &mut Out<'_>) -> Result<(), RecordError> {
        // Sensors read at the start of the tick, where the last one ended.
        let read_tick = frame.tick.saturating_sub(1);
        if read_tick.is_multiple_of(SHOWN_TICKS) && self.scans.update(frame) {
            for (channel, scan) in self.scans.seen() {
                out.send(channel, read_tick, scan)?;
            }
            out.send(self.channels.hits, read_tick, &self.scans.hits(read_tick))?;
        }
        self.scans.stand(frame);
        Ok(())
    }

    fn show(&mut self, frame: &Frame, out: &mut Out<'_>) -> Result<(), RecordError> {
        if frame.decision {
            let moment = MetricsMessage::from(Moment::of(frame, self.lost_s));
            out.send(self.channels.metrics, frame.tick, &moment)?;
        }
        if frame.tick.is_multiple_of(SHOWN_TICKS) {
            self.show_bodies(frame, out)?;
        }
        if frame.tick.is_multiple_of(POINTS_TICKS) {
            self.show_points(frame, out)?;
        }
        for event in self.events.update(frame) {
            let name = event.robot.map_or_else(String::new, poses::body);
            out.send(self.channels.log, frame.tick, &shared::log(event, name))?;
        }
        Ok(())
    }
}

impl ChainTopics {
    fn show_bodies(&mut self, frame: &Frame, out: &mut Out<'_>) -> Result<(), RecordError> {
        let (channels, tick) = (&self.channels, frame.tick);
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

    fn show_points(&mut self, frame: &Frame, out: &mut Out<'_>) -> Result<(), RecordError> {
        out.send(self.channels.uav_points, frame.tick, &self.points.uavs(frame))?;
        if let Some(links) = self.points.links(frame) {
            out.send(self.channels.link_points, frame.tick, &links)?;
        }
        Ok(())
    }
}
