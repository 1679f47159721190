//! W1 through the simulator's own rooms.

use uchain_core::chain::{CenterParams, Command};
use uchain_sim::{
    map::Map,
    sense::{ParryRays, TofParams, read_tof},
    world::{MotionParams, World},
};

use super::{RADIUS_M, RANGE_M, Seen, command, spawns};

pub(crate) struct Ours<'a> {
    world: World<'a>,
    rays: ParryRays,
    tof: TofParams,
    center: CenterParams,
    asked: Vec<Command>,
}

impl<'a> Ours<'a> {
    pub(crate) fn new(map: &'a Map, count: usize, _seen: Seen) -> Self {
        let motion = MotionParams { radius_m: RADIUS_M, ..MotionParams::default() };
        let mut world = World::new(map, motion, spawns(count).into_iter());
        let asked = vec![Command { airborne: true, ..Command::default() }; count];
        world.act(&asked);
        let tof = TofParams { range_m: RANGE_M, rays: 1, period_s: 0.05, ..TofParams::default() };
        Self { world, rays: ParryRays::new(map), tof, center: CenterParams::default(), asked }
    }

    pub(crate) fn tick(&mut self) {
        for (i, asked) in self.asked.iter_mut().enumerate() {
            *asked = command(&read_tof(&self.rays, &self.world, i, &self.tof), &self.center);
        }
        self.world.act(&self.asked);
        self.world.advance();
    }
}
