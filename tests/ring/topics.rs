//! What a recording of a ring shows beside its frames.

use foxglove::messages::{PosesInFrame, SceneUpdate};
use glam::Vec2;
use uchain_sim::{
    mission::Recorded,
    record::{
        RecordError,
        mcap::{
            Channel, Out, SHOWN_TICKS, Topics,
            scene::{self, MAP, pose, time},
        },
    },
};

use super::{Ring, RingFrame, RingScene};

/// `/map` once, `/poses` ten times per simulated second.
#[derive(Debug)]
pub(crate) struct RingTopics {
    poses: Channel,
}

impl Recorded for Ring {
    type Topics = RingTopics;
}

impl Topics for RingTopics {
    type Scene = RingScene;
    type Frame = RingFrame;

    fn start(scene: &RingScene, out: &mut Out<'_>) -> Result<Self, RecordError> {
        let map = out.channel::<SceneUpdate>("/map")?;
        out.send(map, 0, &scene::map(&scene.map, None))?;
        Ok(Self { poses: out.channel::<PosesInFrame>("/poses")? })
    }

    fn show(&mut self, frame: &RingFrame, out: &mut Out<'_>) -> Result<(), RecordError> {
        if !frame.tick.is_multiple_of(SHOWN_TICKS) {
            return Ok(());
        }
        let poses = frame.robots.iter().map(|robot| pose(Vec2::new(robot.x_m, robot.y_m))).collect();
        let shown = PosesInFrame { timestamp: Some(time(frame.tick)), frame_id: MAP.to_owned(), poses };
        out.send(self.poses, frame.tick, &shown)
    }
}
