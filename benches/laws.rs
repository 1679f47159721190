use std::hint::black_box;

use criterion::Criterion;
use uchain_core::chain::{
    CenterParams, EqualizeParams, Follow, KalmanParams, ScalarKalman, Tof, center, equalize,
};

pub(crate) fn all(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("laws");
    let kalman = KalmanParams::default();
    group.bench_function("kalman step", |b| {
        let mut filter = ScalarKalman::start(50.0, &kalman).expect("a finite loss");
        b.iter(|| {
            filter.predict(black_box(0.1), 0.2, &kalman);
            filter.update(black_box(55.0), &kalman);
            filter.loss_db()
        });
    });
    let gains = EqualizeParams::default();
    group.bench_function("equalize", |b| b.iter(|| equalize(black_box(50.0), black_box(53.0), &gains)));
    let params = CenterParams::default();
    let tof = Tof { nw_m: 0.7, ne_m: 0.8, sw_m: 0.75, se_m: 0.9 };
    group.bench_function("center", |b| {
        b.iter(|| center(black_box(&tof), false, Follow::Centre, &params));
    });
    group.finish();
}
