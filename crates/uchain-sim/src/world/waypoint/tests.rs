use std::sync::Arc;

use super::{overlap::TOUCH_M, *};
use crate::{
    map::{Map, drawn},
    seed::{Seed, Source},
    world::{Body, MotionParams, World},
};

/// What a body has touched.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
struct Touches {
    walls: u32,
    robots: u32,
    passes: u32,
}

impl From<&Body> for Touches {
    fn from(body: &Body) -> Self {
        Self { walls: body.wall_contacts, robots: body.uav_contacts, passes: body.level_passes }
    }
}

/// Points of 0.1 m in radius, with 0.5 m/s in every direction.
fn points(map: Arc<Map>, starts: &[Waypoint]) -> World {
    let body = |&start: &Waypoint| Box::new(PointMass::new(start, 0.5, 0.5)) as Box<dyn Vehicle>;
    World::new(map, MotionParams { radius_m: 0.1, ..MotionParams::default() }, starts.iter().map(body))
}

fn at(x: f32, y: f32, z_m: f32) -> Waypoint {
    Waypoint { at: Vec2::new(x, y), z_m, heading_rad: 0.0 }
}

fn fly(starts: &[Waypoint], ends: &[Waypoint]) -> (u64, Vec<Touches>) {
    let map = Arc::new(drawn(&[vec![[-2.0, -2.0], [2.0, -2.0], [2.0, 2.0], [-2.0, 2.0]]]).unwrap());
    let mut world = points(map, starts);
    for (i, &end) in ends.iter().enumerate() {
        world.command(i, end.into()).unwrap();
    }
    while !world.has_arrived() {
        world.advance();
    }
    assert!(world.bodies().iter().zip(ends).all(|(body, &end)| body.pose() == end));
    (world.tick(), world.bodies().iter().map(Touches::from).collect())
}

#[test]
fn a_move_takes_as_long_as_its_way_over_ground_or_as_its_climb() {
    assert_eq!(fly(&[at(0.0, 0.0, 1.0)], &[at(0.8, 0.0, 1.5)]).0, 32);
    assert_eq!(fly(&[at(0.0, 0.0, 1.0)], &[at(0.1, 0.0, 1.5)]).0, 20);
    assert_eq!(fly(&[at(0.0, 0.0, 1.0)], &[at(0.0, 0.0, 1.0)]).0, 0);
}

#[test]
fn robots_that_cross_on_one_level_touch_once_and_on_two_levels_never() {
    let cross =
        |z_m: f32| fly(&[at(-1.0, 0.0, 1.0), at(0.0, -1.0, z_m)], &[at(1.0, 0.0, 1.0), at(0.0, 1.0, z_m)]).1;
    assert_eq!(cross(1.0), [Touches { robots: 1, ..Touches::default() }; 2]);
    assert_eq!(cross(1.5), [Touches::default(); 2]);
}

#[test]
fn a_robot_that_climbs_past_another_one_passes_it() {
    let (low, middle, high) = (at(0.0, 0.0, 0.5), at(0.1, 0.0, 1.0), at(0.0, 0.0, 1.5));
    assert_eq!(fly(&[low, middle], &[high, middle]).1, [Touches { passes: 1, ..Touches::default() }; 2]);
}

#[test]
fn a_robot_that_comes_nearer_to_a_wall_than_its_radius_touches_it_once() {
    assert_eq!(
        fly(&[at(1.0, 0.0, 1.0)], &[at(1.95, 0.5, 1.0)]).1,
        [Touches { walls: 1, ..Touches::default() }]
    );
    assert_eq!(fly(&[at(1.0, 0.0, 1.0)], &[at(1.9, 0.5, 1.0)]).1, [Touches::default()]);
}

/// Contacts as all pairs looked at in every tick have them.
#[derive(Default)]
struct AllPairs {
    pairs: Vec<([usize; 2], bool)>,
    met: Vec<(u32, u32)>,
}

impl AllPairs {
    fn feel(&mut self, now: &[Waypoint], levels_m: &[f32], near_m: f32) {
        self.met.resize(now.len(), (0, 0));
        let before = std::mem::take(&mut self.pairs);
        for (j, b) in now.iter().enumerate() {
            for (i, a) in now.iter().enumerate().take(j) {
                let (over2, up) = (a.at.distance_squared(b.at), a.z_m - b.z_m);
                let one_level = levels_m[i] == levels_m[j];
                if over2 + if one_level { 0.0 } else { up * up } >= near_m * near_m {
                    continue;
                }
                if !before.contains(&([i, j], one_level)) {
                    for robot in [i, j] {
                        let (robots, passes) = &mut self.met[robot];
                        *(if one_level { robots } else { passes }) += 1;
                    }
                }
                self.pairs.push(([i, j], one_level));
            }
        }
    }
}

#[test]
fn contacts_are_those_that_all_pairs_in_every_tick_have() {
    let map = Arc::new(drawn(&[vec![[-9.0, -9.0], [9.0, -9.0], [9.0, 9.0], [-9.0, 9.0]]]).unwrap());
    let mut total = (0, 0);
    for seed in 0..6 {
        let mut random = Seed(seed).stream(0, Source::Start);
        let count = 25;
        let spread_m = [1.0, 4.0][(seed % 2) as usize];
        let mut place = || {
            let level = (3.0 * random.uniform()) as i32 as f32;
            at(spread_m * (random.uniform() - 0.5), spread_m * (random.uniform() - 0.5), 0.5 + 0.5 * level)
        };
        let starts: Vec<Waypoint> = (0..count).map(|_| place()).collect();
        let mut world = points(map.clone(), &starts);
        let mut levels_m: Vec<f32> = starts.iter().map(|start| start.z_m).collect();
        let mut oracle = AllPairs::default();
        let near_m = 2.0 * 0.1 - TOUCH_M;
        oracle.feel(&starts, &levels_m, near_m);
        for tick in 0..400 {
            if tick % 40 == 0 {
                for (i, level_m) in levels_m.iter_mut().enumerate() {
                    let to = place();
                    world.command(i, to.into()).unwrap();
                    *level_m = to.z_m;
                }
            }
            world.advance();
            let now: Vec<Waypoint> = world.bodies().iter().map(Body::pose).collect();
            oracle.feel(&now, &levels_m, near_m);
            let met: Vec<(u32, u32)> =
                world.bodies().iter().map(|body| (body.uav_contacts, body.level_passes)).collect();
            assert_eq!(met, oracle.met, "seed {seed}, tick {tick}");
        }
        total = oracle.met.iter().fold(total, |sum, met| (sum.0 + met.0, sum.1 + met.1));
    }
    assert!(total.0 > 100 && total.1 > 100, "{total:?}");
}
