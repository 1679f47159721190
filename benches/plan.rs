//! Plans of long tunnels: a straight one, and a mine whose drifts lie side by side.

use std::fmt::Write as _;

use criterion::{BenchmarkId, Criterion};
use uchain_sim::{
    config::{Source, builtin},
    mission::chain::{Course, plan},
};

/// Length of a drift and distance to the next (m).
const DRIFT_M: f64 = 240.0;
const ASIDE_M: f64 = 10.0;

pub(crate) fn all(criterion: &mut Criterion) {
    straight(criterion);
    mine(criterion);
}

/// A scenario of a corridor through these points, in full.
fn scenario(line: &[[f64; 2]]) -> Source {
    let mut text = String::from("name = \"long\"\ndescription = \"long\"\nduration_s = 60.0\n");
    let _ = writeln!(text, "[map.corridor]\nwidth_m = 4.0\ncentre_line_m = {line:?}");
    text += "[chain]\nuavs = 3\nbase_m = [3.0, 0.0]\n[[pilot]]\nstart_s = 0.0\nspeed_mps = 0.2\n";
    Source { text, ..builtin("straight").expect("a compiled-in scenario") }
}

/// Reads the scenario as well: whoever plans does.
fn planned(source: &Source, length_m: f64) -> Option<usize> {
    let course = Course::read(source, &[]).expect("a corridor");
    plan(&course, None, length_m / 20.0, None).expect("a tunnel of known middle").uavs_needed
}

fn straight(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("plan of a straight tunnel, by its length in m");
    group.sample_size(10);
    for length_m in [1_000.0, 10_000.0] {
        let source = scenario(&[[0.0, 0.0], [length_m, 0.0]]);
        group.bench_function(BenchmarkId::new("ours", length_m), |b| b.iter(|| planned(&source, length_m)));
    }
    group.finish();
}

fn mine(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("plan of a mine of parallel drifts, by its length in m");
    group.sample_size(10);
    for drifts in [4, 40] {
        let corners = (0..drifts).flat_map(|drift| {
            let (y, ends) = (f64::from(drift) * ASIDE_M, [0.0, DRIFT_M]);
            let [from, to] = if drift % 2 == 0 { ends } else { [ends[1], ends[0]] };
            [[from, y], [to, y]]
        });
        let source = scenario(&corners.collect::<Vec<_>>());
        let length_m = f64::from(drifts) * (DRIFT_M + ASIDE_M) - ASIDE_M;
        group.bench_function(BenchmarkId::new("ours", length_m), |b| b.iter(|| planned(&source, length_m)));
    }
    group.finish();
}
