//! W1, the workload swarm simulators are compared on: N discs of 6 cm radius follow a zig-zag ring 2 m wide with
//! 40 walls, by four single rays of 2 m and the centering law, at 0.2 m/s, with collisions, all at 20 Hz.

pub(crate) mod ours;
mod plain;

use core::time::Duration;
use std::sync::Arc;

use criterion::{BenchmarkId, Criterion, Throughput};
use glam::Vec2;
use uchain_core::chain::{CenterParams, Command, Follow, Tof, center};
use uchain_sim::map::{Map, Vertex, corridor};

use ours::Ours;
use plain::Plain;

const SPEED_MPS: f32 = 0.2;
const RANGE_M: f32 = 2.0;
const RADIUS_M: f32 = 0.06;
/// Half of the corners lie this far from the centre, the others `ZIG_ZAG_M` nearer (m).
const RING_M: f32 = 20.0;
const ZIG_ZAG_M: f32 = 1.0;
const CORNERS: usize = 20;
/// Past the start, at which nobody touches anybody (ticks).
const WARM_UP: usize = 400;

/// What the rays can hit.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Seen {
    Walls,
    Robots,
}

/// Corner `i` of the ring's middle (m).
fn corner(i: usize) -> Vec2 {
    let (sin, cos) = libm::sincosf(core::f32::consts::TAU * i as f32 / CORNERS as f32);
    (if i.is_multiple_of(2) { RING_M } else { RING_M - ZIG_ZAG_M }) * Vec2::new(cos, sin)
}

pub(crate) fn ring() -> Arc<Map> {
    let corners: Vec<Vertex> = (0..CORNERS)
        .map(corner)
        .map(|at| Vertex { x: f64::from(at.x), y: f64::from(at.y), bend_radius_m: 0.0 })
        .collect();
    corridor(&corners, 2.0, true).expect("the ring does not cross itself").0.into()
}

/// Evenly along the middle, a little to the left and to the right of it in turn; heading along it.
fn spawns(count: usize) -> Vec<(Vec2, f32)> {
    (0..count)
        .map(|i| {
            let along = (CORNERS * i) as f32 / count as f32;
            let (from, to) = (corner(along as usize), corner((along as usize + 1) % CORNERS));
            let way = to - from;
            let aside = way.normalize().perp() * [0.0, 0.3, -0.3, 0.15][i % 4];
            (from + way * along.fract() + aside, libm::atan2f(way.y, way.x))
        })
        .collect()
}

fn command(tof: &Tof, params: &CenterParams) -> Command {
    let centering = center(tof, RANGE_M, false, Follow::Centre, params);
    Command {
        forward_mps: SPEED_MPS * centering.speed_share,
        lateral_mps: centering.lateral_mps,
        yaw_rate_radps: centering.yaw_rate_radps,
        airborne: true,
    }
}

pub(crate) fn all(criterion: &mut Criterion) {
    let map = ring();
    for (name, seen) in
        [("w1 walls seen [robot-step]", Seen::Walls), ("w1 robots seen [robot-step]", Seen::Robots)]
    {
        let mut group = criterion.benchmark_group(name);
        group.warm_up_time(Duration::from_millis(500)).measurement_time(Duration::from_secs(2));
        for count in [4, 64, 256] {
            group.throughput(Throughput::Elements(count as u64));
            group.bench_function(BenchmarkId::new("ours", count), |b| {
                let mut ours = Ours::new(&map, count, seen);
                (0..WARM_UP).for_each(|_| ours.tick());
                b.iter(|| ours.tick());
            });
            group.bench_function(BenchmarkId::new("rapier", count), |b| {
                let mut plain = Plain::new(&map, count, seen);
                (0..WARM_UP).for_each(|_| plain.tick());
                b.iter(|| plain.tick());
            });
        }
        group.finish();
    }
}
