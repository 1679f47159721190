//! Whole missions, all sensors, noise and physics.

use std::sync::Arc;

use std::{fmt::Write as _, time::Duration};

use criterion::{BenchmarkId, Criterion, Throughput};
use uchain_sim::{
    clock::{TICKS_PER_S, total_ticks},
    config::{Source, builtin},
    mission::{
        Mission as _,
        chain::{Chain, Course, Scenario},
    },
    run::run,
    sense::{ParryRays, Rays},
};

pub(crate) fn all(criterion: &mut Criterion) {
    missions(criterion);
    chains(criterion);
}

/// The mission that is timed and counted.
pub(crate) fn circuit() -> Arc<Course> {
    let source = builtin("circuit").expect("a compiled-in scenario");
    Course::read(&source, &["chain.uavs=5".to_owned()]).expect("a valid course")
}

/// A mission from its first tick to its last; ours with digest and summary.
fn missions(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("mission circuit [simulated second]");
    group.sample_size(20);
    let course = circuit();
    let (uavs, ticks) = (course.scenario.chain.uavs, total_ticks(course.scenario.duration_s));
    group.throughput(Throughput::Elements(ticks / TICKS_PER_S as u64));
    group.bench_function(BenchmarkId::new("ours", uavs), |b| {
        b.iter(|| run(&course, 1, &mut ()).expect("nobody stops it"));
    });
    let rays = Arc::new(ParryRays::new(&course.map));
    group.bench_function(BenchmarkId::new("plain", uavs), |b| {
        b.iter(|| fly(&mut Chain::plain(&course, 1, rays.clone()), ticks));
    });
    group.finish();
}

/// A long tunnel with a chain of UAVs 2 m apart, all in the air.
fn chains(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("chain in a long tunnel [UAV-second]");
    group.sample_size(20).warm_up_time(Duration::from_millis(200)).measurement_time(Duration::from_secs(2));
    for uavs in [5, 20, 100, 1000] {
        let course = long_tunnel(uavs);
        let second = TICKS_PER_S as u64;
        // One takes off at every decision.
        let warm_up = second * (10 + uavs as u64 / 5);
        group.throughput(Throughput::Elements(uavs as u64));
        group.bench_function(BenchmarkId::new("ours", uavs), |b| {
            let mut sim: Chain = Chain::start(course.clone(), 1);
            fly(&mut sim, warm_up);
            b.iter(|| fly(&mut sim, second));
        });
        let rays = Arc::new(ParryRays::new(&course.map));
        group.bench_function(BenchmarkId::new("plain", uavs), |b| {
            let mut sim = Chain::plain(&course, 1, rays.clone());
            fly(&mut sim, warm_up);
            b.iter(|| fly(&mut sim, second));
        });
    }
    group.finish();
}

fn fly(sim: &mut Chain<impl Rays>, ticks: u64) {
    (0..ticks).for_each(|_| _ = sim.step(&mut ()).expect("nobody stops it"));
}

/// 2.1 km of zig-zag, 1.2 m wide, 420 walls.
fn long_tunnel(uavs: usize) -> Arc<Course> {
    let corner = |i: usize| [10.0 * i as f64, if i.is_multiple_of(2) { 0.0 } else { 3.0 }];
    let length_m = libm::hypot(10.0, 3.0);
    let place = |along_m: f64| {
        let (leg, rest) = ((along_m / length_m) as usize, along_m % length_m / length_m);
        let (from, to) = (corner(leg), corner(leg + 1));
        [from[0] + rest * (to[0] - from[0]), from[1] + rest * (to[1] - from[1])]
    };
    let mut text = String::from(
        "name = \"long-tunnel\"\nduration_s = 60.0\n\
         takeoff = { s_min_db = -50.0, launch_hold_s = 0.0, after_previous_s = 0.0 }\n\
         [map.corridor]\nwidth_m = 1.2\ncentre_line_m = [",
    );
    (0..=201).map(corner).for_each(|[x, y]| write!(text, "[{x}, {y}], ").expect("into a String"));
    let heading_deg = libm::atan2(3.0, 10.0).to_degrees();
    let [base_x_m, base_y_m] = place(1.0);
    write!(
        text,
        "]\n[chain]\nuavs = {uavs}\nbase_m = [{base_x_m}, {base_y_m}]\nheading_deg = {heading_deg}\nspawns_m = ["
    )
    .expect("into a String");
    (1..=uavs)
        .rev()
        .map(|i| place(1.0 + 2.0 * i as f64))
        .for_each(|[x, y]| write!(text, "[{x}, {y}], ").expect("into a String"));
    text.push_str("]\n[[pilot]]\nstart_s = 0.0\nspeed_mps = 0.0\n");
    let source = Source { text, ..builtin("corner").expect("a compiled-in scenario") };
    let scenario = Scenario::parse(&source, &[]).unwrap_or_else(|error| panic!("{error}"));
    Course::lay_out(scenario, &source).unwrap_or_else(|error| panic!("{error}"))
}
