use core::{hint::black_box, iter, time::Duration};

use criterion::{BenchmarkId, Criterion, Throughput};
use glam::Vec2;
use uchain_sim::{
    map::Map,
    sense::{GridRays, ParryRays, Rays, TofBeams, TofParams},
};

use crate::maps::{clutter, corridor, poses};

/// Enough places that the next one is not in the nearest cache for having been there before.
const PLACES: usize = 1 << 14;

/// Single rays in any direction, and the readings of four sensors of one ray and of five; per ray.
pub(crate) fn all(criterion: &mut Criterion) {
    for (name, build) in [("corridor", corridor as fn(usize) -> Map), ("clutter", clutter)] {
        for range_m in [2.0, 30.0] {
            for walls in [40, 400, 4_000, 40_000] {
                let map = build(walls);
                let poses = poses(&map, PLACES);
                let name = format!("rays {range_m} m {name}");
                measure(criterion, &name, ("ours", walls), &GridRays::new(&map, range_m), &poses, range_m);
                measure(criterion, &name, ("parry", walls), &ParryRays::new(&map), &poses, range_m);
            }
        }
    }
}

fn measure(
    criterion: &mut Criterion,
    name: &str,
    (whose, walls): (&str, usize),
    rays: &impl Rays,
    poses: &[(Vec2, Vec2)],
    range_m: f32,
) {
    let mut places = poses.iter().cycle();
    let mut bench = |beams: &str, count, cast: &mut dyn FnMut(Vec2, Vec2)| {
        let mut group = criterion.benchmark_group(format!("{name}, {beams} [ray]"));
        group
            .sample_size(20)
            .warm_up_time(Duration::from_millis(100))
            .measurement_time(Duration::from_millis(300))
            .throughput(Throughput::Elements(count))
            .bench_function(BenchmarkId::new(whose, walls), |b| {
                b.iter(|| places.next().map(|&(from, forward)| cast(from, forward)));
            });
        group.finish();
    };
    bench("single", 1, &mut |from, direction| {
        black_box(rays.cast(from, direction, range_m));
    });
    for per_sensor in [1, 5] {
        let beams = TofBeams::new(&TofParams { range_m, rays: per_sensor, ..TofParams::default() });
        let name = format!("4 sensors of {per_sensor}");
        bench(&name, u64::from(4 * per_sensor), &mut |from, forward| {
            black_box(beams.read(rays, from, forward, iter::empty(), 0.0));
        });
    }
}
