//! W1 through the simulator's own rooms.

use std::{iter, sync::Arc};

use uchain_core::chain::{CenterParams, Command};
use uchain_sim::{
    map::Map,
    sense::{GridRays, TofBeams, TofParams, read_tof},
    world::{MotionParams, World},
};

use super::{RADIUS_M, RANGE_M, Seen, command, spawns};

pub(crate) struct Ours {
    world: World,
    rays: GridRays,
    beams: TofBeams,
    seen: Seen,
    center: CenterParams,
    asked: Vec<Command>,
}

impl Ours {
    pub(crate) fn new(map: &Arc<Map>, count: usize, seen: Seen) -> Self {
        let motion = MotionParams { radius_m: RADIUS_M, ..MotionParams::default() };
        let mut world = World::new(map.clone(), motion, spawns(count));
        let asked = vec![Command { airborne: true, ..Command::default() }; count];
        world.act(&asked);
        let tof = TofParams { range_m: RANGE_M, rays: 1, period_s: 0.05, ..TofParams::default() };
        let (rays, beams) = (GridRays::new(map, RANGE_M), TofBeams::new(&tof));
        Self { world, rays, beams, seen, center: CenterParams::default(), asked }
    }

    pub(crate) fn tick(&mut self) {
        for (i, asked) in self.asked.iter_mut().enumerate() {
            let tof = match self.seen {
                Seen::Robots => read_tof(&self.rays, &self.world, i, &self.beams),
                Seen::Walls => {
                    let body = &self.world.bodies()[i];
                    self.beams.read(&self.rays, body.at, body.forward(), iter::empty(), RADIUS_M)
                }
            };
            *asked = command(&tof, &self.center);
        }
        self.world.act(&self.asked);
        self.world.advance();
    }
}
