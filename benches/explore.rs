//! Whole explorations: how their cost grows with the place, and what a quadrotor costs.

use std::sync::Arc;

use std::fmt::Write as _;

use criterion::{BenchmarkId, Criterion, Throughput};
use uchain_sim::{
    config::{Source, builtin},
    mission::explore::Site,
    run::run,
};

/// Side of a room, wall to wall (m).
const ROOM_M: f64 = 3.0;

pub(crate) fn all(criterion: &mut Criterion) {
    offices(criterion, "exploration of rooms [move]", "");
    offices(criterion, "exploration of rooms, messages reach 6 m [move]", "range_m = 6.0\n");
    vehicles(criterion);
}

/// Ten robots in offices of 4 × 4 to 16 × 16 rooms, with more keys of theirs; digest and summary included.
fn offices(criterion: &mut Criterion, name: &str, keys: &str) {
    let mut group = criterion.benchmark_group(name);
    group.sample_size(10);
    for rooms in [4, 8, 16] {
        let site = office(rooms, keys);
        let summary = run(&site, 1, &mut ()).expect("nobody stops it");
        group.throughput(Throughput::Elements(summary.moves.iter().sum::<u32>().into()));
        let nodes: u32 = summary.nodes.iter().sum();
        group.bench_function(BenchmarkId::new("ours", nodes), |b| {
            b.iter(|| run(&site, 1, &mut ()).expect("nobody stops it"));
        });
    }
    group.finish();
}

/// The same decisions, flown by points and by quadrotors.
fn vehicles(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("exploration of the apartment [round]");
    group.sample_size(20);
    for (function, vehicle) in [("ours", "point-mass"), ("quadrotors", "quadrotor")] {
        let sets = [format!("explore.vehicle={vehicle}")];
        let site = Site::read(&builtin("apartment").expect("a compiled-in scenario"), &sets);
        let site = site.expect("a valid site");
        let summary = run(&site, 1, &mut ()).expect("nobody stops it");
        group.throughput(Throughput::Elements(summary.iterations.into()));
        group.bench_function(BenchmarkId::new(function, summary.robots), |b| {
            b.iter(|| run(&site, 1, &mut ()).expect("nobody stops it"));
        });
    }
    group.finish();
}

/// Square rooms side by side, with doors of 1 m and more: crosses of walls where four of them meet.
fn office(rooms: u32, keys: &str) -> Arc<Site> {
    let side_m = ROOM_M * f64::from(rooms);
    let mut text = format!(
        "name = \"office\"\nduration_s = 86400.0\n[explore]\nrobots = 10\n{keys}[map.walls]\n\
         outer_m = [[0.0, 0.0], [{side_m}, 0.0], [{side_m}, {side_m}], [0.0, {side_m}]]\ninner_m = [\n"
    );
    // A quarter of a cross; the others are the same, turned.
    let (half_m, arm_m) = (0.05, 1.0);
    let quarter = [[half_m, half_m], [half_m, arm_m], [-half_m, arm_m]];
    for (column, row) in (1..rooms).flat_map(|x| (1..rooms).map(move |y| (x, y))) {
        let middle = [ROOM_M * f64::from(column), ROOM_M * f64::from(row)];
        text.push('[');
        let mut turned = quarter;
        for _ in 0..4 {
            for [x, y] in turned {
                write!(text, "[{}, {}], ", middle[0] + x, middle[1] + y).expect("into a String");
            }
            turned = turned.map(|[x, y]| [-y, x]);
        }
        text.push_str("],\n");
    }
    text.push_str("]\n");
    let source = Source { text, ..builtin("apartment").expect("a compiled-in scenario") };
    Site::read(&source, &[]).unwrap_or_else(|error| panic!("{error}"))
}
