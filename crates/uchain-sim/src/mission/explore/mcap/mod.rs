//! Writes a recording while robots explore.

mod message;
mod scene;

use foxglove::messages::{
    FrameTransform, FrameTransforms, Log, PointCloud, Pose, PosesInFrame, SceneUpdate, Vector3,
};

use crate::{
    mission::{
        Recorded,
        explore::{Exploration, ExploreFrame, Odometer, Site, events::Events},
    },
    record::{
        RecordError,
        mcap::{
            self, Channel, Out, POINTS_TICKS, SHOWN_TICKS, Topics,
            scene::{self as shared, Cloud, MAP, rotation, time, transform},
        },
    },
};
use message::ExploreMetricsMessage;
use scene::{Graph, Stars, Ways};

/// Records an exploration.
pub type ExploreRecorder<W> = mcap::McapRecorder<W, ExploreTopics>;

/// Topics of an exploration.
pub struct ExploreTopics {
    channels: Channels,
    odometer: Odometer,
    stars: Stars,
    graph: Graph,
    ways: Ways,
    bodies: Cloud,
    radius_m: f32,
    events: Events,
}

struct Channels {
    metrics: Channel,
    transforms: Channel,
    poses: Channel,
    stars: Channel,
    graph: Channel,
    ways: Channel,
    points: Channel,
    log: Channel,
}

impl std::fmt::Debug for ExploreTopics {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("ExploreTopics").finish_non_exhaustive()
    }
}

impl Recorded for Exploration {
    type Topics = ExploreTopics;
}

impl Topics for ExploreTopics {
    type Scene = Site;
    type Frame = ExploreFrame;

    fn start(site: &Site, out: &mut Out<'_>) -> Result<Self, RecordError> {
        let channels = Channels {
            metrics: out.own_channel("/metrics", "ExploreMetrics")?,
            transforms: out.channel::<FrameTransforms>("/tf")?,
            poses: out.channel::<PosesInFrame>("/poses")?,
            stars: out.channel::<SceneUpdate>("/stars")?,
            graph: out.channel::<SceneUpdate>("/graph")?,
            ways: out.channel::<SceneUpdate>("/ways")?,
            points: out.channel::<PointCloud>("/points/robots")?,
            log: out.channel::<Log>("/log")?,
        };
        let walls = out.channel::<PointCloud>("/points/walls")?;
        let (map, robots) = (out.channel::<SceneUpdate>("/map")?, out.channel::<SceneUpdate>("/robots")?);
        out.send(map, 0, &shared::map(&site.map, None))?;
        out.send(walls, 0, &shared::walls(&site.map, None))?;
        let place = transform("scenario", MAP.to_owned(), site.map.offset_m(), 0.0);
        out.send(channels.transforms, 0, &FrameTransforms { transforms: vec![place] })?;
        let radius_m = site.scenario.params.r_body_m;
        let robot = |i: usize| shared::disc_and_arrow(body(i), i, radius_m, shared::color(shared::crew(i)));
        let bodies = (0..site.spawns.len()).map(robot).collect();
        out.send(robots, 0, &SceneUpdate { deletions: Vec::new(), entities: bodies })?;
        Ok(Self {
            channels,
            odometer: Odometer::default(),
            stars: Stars::default(),
            graph: Graph::default(),
            ways: Ways::default(),
            bodies: Cloud::default(),
            radius_m,
            events: Events::default(),
        })
    }

    fn show(&mut self, frame: &ExploreFrame, out: &mut Out<'_>) -> Result<(), RecordError> {
        let progress = self.odometer.add(frame);
        let is_last = frame.stopped.is_some();
        if frame.decision || is_last {
            let metrics = ExploreMetricsMessage::from(progress);
            out.send(self.channels.metrics, frame.tick, &metrics)?;
            self.decision(frame, out)?;
        }
        self.ways.fly(frame);
        if frame.tick.is_multiple_of(SHOWN_TICKS) || is_last {
            out.send(self.channels.transforms, frame.tick, &transforms(frame))?;
            out.send(self.channels.poses, frame.tick, &poses(frame))?;
        }
        if frame.tick.is_multiple_of(POINTS_TICKS) || is_last {
            self.bodies.clear();
            for (i, robot) in frame.robots.iter().enumerate() {
                let at_m = [robot.x_m, robot.y_m, robot.z_m];
                self.bodies.push_body(at_m, robot.heading_rad, self.radius_m, shared::crew(i));
            }
            out.send(self.channels.points, frame.tick, &self.bodies.message(frame.tick))?;
        }
        for event in self.events.update(frame) {
            let name = event.robot.map_or_else(|| "exploration".to_owned(), body);
            out.send(self.channels.log, frame.tick, &shared::log(event, name))?;
        }
        Ok(())
    }
}

impl ExploreTopics {
    fn decision(&mut self, frame: &ExploreFrame, out: &mut Out<'_>) -> Result<(), RecordError> {
        let (channels, tick) = (&self.channels, frame.tick);
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
