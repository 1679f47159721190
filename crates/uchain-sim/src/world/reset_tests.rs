//! A world that is reset, against a new one.

use std::sync::Arc;

use glam::Vec2;
use uchain_core::chain::Command;

use super::*;
use crate::{
    map::{Map, Vertex, corridor},
    seed::{Seed, Source, Stream},
};

/// Narrow: walls and others are touched all the time.
fn ring() -> Arc<Map> {
    let corners = [[0.0, 0.0], [4.0, 0.0], [3.0, 2.0], [4.0, 4.0], [0.0, 4.0], [0.8, 2.0]];
    let corners = corners.map(|[x, y]| Vertex { x, y, bend_radius_m: 0.0 });
    corridor(&corners, 0.6, true).unwrap().0.into()
}

fn places(map: &Map, random: &mut Stream, count: usize, levels: u32) -> Vec<Waypoint> {
    let mut places: Vec<Waypoint> = Vec::with_capacity(count);
    while places.len() < count {
        let at = Vec2::new(5.0 * random.uniform() - 0.5, 5.0 * random.uniform() - 0.5);
        let is_apart = places.iter().all(|other| other.at.distance(at) > 0.13);
        if is_apart && !map.in_rock(at) && map.clearance_m(at) > 0.07 {
            let z_m = 1.0 + (levels as f32 * random.uniform()).floor();
            places.push(Waypoint { at, z_m, heading_rad: 6.0 * random.uniform() - 3.0 });
        }
    }
    places
}

/// Which kinds of motion a world holds, in turn.
#[derive(Debug, Clone, Copy)]
enum Kinds {
    Velocities,
    Waypoints,
    Both,
}

impl Kinds {
    fn flies_to_waypoints(self, body: usize) -> bool {
        match self {
            Self::Velocities => false,
            Self::Waypoints => true,
            Self::Both => body.is_multiple_of(2),
        }
    }

    fn start(self, body: usize, at: Waypoint) -> Start {
        match (self.flies_to_waypoints(body), body % 4 < 2) {
            (false, _) => Start::by_velocity(at),
            (true, true) => Start::by_waypoint(Box::new(PointMass::new(at, 0.5, 0.5))),
            (true, false) => {
                Start::by_waypoint(Box::new(Quadrotor::new(at, &QuadrotorParams::default(), 0.5, 0.5)))
            }
        }
    }

    /// Flies under random commands; the bodies after every tick.
    fn fly(self, world: &mut World, seed: u64, levels: u32) -> Vec<Vec<Body>> {
        let (map, mut random) = (world.map().clone(), Seed(seed).stream(1, Source::Start));
        let mut flown = vec![world.bodies().to_vec()];
        for tick in 0..200 {
            for body in (0..world.bodies().len()).filter(|_| tick % 10 == 0) {
                let motion = if self.flies_to_waypoints(body) {
                    places(&map, &mut random, 1, levels)[0].into()
                } else {
                    let command = Command {
                        forward_mps: 0.8 * random.uniform() - 0.2,
                        lateral_mps: 0.2 * random.uniform() - 0.1,
                        yaw_rate_radps: 2.0 * random.uniform() - 1.0,
                        airborne: random.uniform() > 0.05,
                    };
                    command.into()
                };
                world.command(body, motion).unwrap();
            }
            world.advance();
            flown.push(world.bodies().to_vec());
        }
        flown
    }
}

#[test]
fn a_world_that_is_reset_flies_bit_for_bit_as_a_new_one() {
    let map = ring();
    for (kinds, levels) in [
        (Kinds::Velocities, 1),
        (Kinds::Velocities, 2),
        (Kinds::Waypoints, 2),
        (Kinds::Both, 1),
        (Kinds::Both, 2),
    ] {
        let (mut reused, mut solver_steps): (Option<World>, u64) = (None, 0);
        for seed in 0..8 {
            let starts = places(&map, &mut Seed(seed).stream(0, Source::Start), 20, levels);
            let of = |(body, &at): (usize, &Waypoint)| kinds.start(body, at);
            let mut new = World::new(map.clone(), MotionParams::default(), starts.iter().enumerate().map(of));
            let flown = kinds.fly(&mut new, seed, levels);
            let Some(world) = &mut reused else {
                reused = Some(new);
                continue;
            };
            let before = (world.bodies().to_vec(), world.tick());
            assert_eq!(
                world.reset(starts[1..].iter().copied()),
                Err(WorldError::Starts { got: 19, count: 20 })
            );
            assert_eq!((world.bodies(), world.tick()), (&*before.0, before.1));
            world.reset(starts.iter().copied()).unwrap();
            assert_eq!((world.tick(), world.solver_steps()), (0, 0));
            let again = kinds.fly(world, seed, levels);
            for (tick, (again, flown)) in again.iter().zip(&flown).enumerate() {
                assert_eq!(again, flown, "{kinds:?} on {levels} levels, seed {seed}, tick {tick}");
            }
            assert_eq!((world.tick(), world.solver_steps()), (new.tick(), new.solver_steps()));
            solver_steps += new.solver_steps();
            // The control: from where it is, without a reset, the same commands lead elsewhere.
            assert_ne!(kinds.fly(world, seed, levels), flown);
        }
        assert_eq!(solver_steps > 500, !matches!(kinds, Kinds::Waypoints), "{kinds:?}: {solver_steps}");
    }
}
