use core::{iter, time::Duration};

use criterion::{Criterion, Throughput};
use glam::Vec2;
use uchain_sim::{
    map::Map,
    sense::{GridRays, ParryRays, Rays, TofBeams, TofParams},
};

use crate::maps::{clutter, corridor, poses};

/// Enough places that the next one is not in the nearest cache for having been there before.
const PLACES: usize = 1 << 14;

/// `rays/<map>/<walls>/<range>/<beams>/<ours or parry>`: one time is that of one cast or of one set of readings; beside
/// it stands the number of rays a second.
pub(crate) fn all(criterion: &mut Criterion) {
    for (name, build) in [("corridor", corridor as fn(usize) -> Map), ("clutter", clutter)] {
        for walls in [40, 400, 4_000, 40_000] {
            let map = build(walls);
            let poses = poses(&map, PLACES);
            for range_m in [2.0, 30.0] {
                let name = format!("{name}/{walls}/{range_m} m");
                measure(criterion, &name, "ours", &GridRays::new(&map, range_m), &poses, range_m);
                measure(criterion, &name, "parry", &ParryRays::new(&map), &poses, range_m);
            }
        }
    }
}

fn measure(
    criterion: &mut Criterion,
    name: &str,
    whose: &str,
    rays: &impl Rays,
    poses: &[(Vec2, Vec2)],
    range_m: f32,
) {
    let mut group = criterion.benchmark_group("rays");
    group
        .sample_size(20)
        .warm_up_time(Duration::from_millis(100))
        .measurement_time(Duration::from_millis(500));
    let mut places = poses.iter().cycle();
    group.throughput(Throughput::Elements(1)).bench_function(format!("{name}/one ray/{whose}"), |b| {
        b.iter(|| places.next().map(|&(from, direction)| rays.cast(from, direction, range_m)));
    });
    for per_sensor in [1, 5] {
        let beams = TofBeams::new(&TofParams { range_m, rays: per_sensor, ..TofParams::default() });
        let id = format!("{name}/4 x {per_sensor}/{whose}");
        group.throughput(Throughput::Elements(u64::from(4 * per_sensor))).bench_function(id, |b| {
            b.iter(|| {
                places.next().map(|&(from, forward)| beams.read(rays, from, forward, iter::empty(), 0.0))
            });
        });
    }
    group.finish();
}
