use std::hint::black_box;

use criterion::Criterion;
use uchain_core::chain::{
    Brain, CenterParams, EqualizeParams, Follow, Heard, KalmanParams, Node, NodeParams, Observation, Packet,
    RadioSlot, Role, ScalarKalman, TOF_RANGE_M, Tof, center, equalize,
};

pub(crate) fn all(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("laws [call]");
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
        b.iter(|| center(black_box(&tof), TOF_RANGE_M, false, Follow::Centre, &params));
    });
    let seen = Observation { tof: Some(tof), ..Observation::default() };
    group.bench_function("decide, distances only", |b| {
        let mut node = Node::new(Role::Head, NodeParams::default());
        node.decide(&Observation { radio: Some(RadioSlot::default()), ..seen.clone() });
        b.iter(|| node.decide(black_box(&seen)));
    });
    let heard = |place, loss_db| Heard {
        from: place,
        loss_db,
        packet: Packet { place, flown_s: 100.0, ..Packet::default() },
    };
    let radio = Some([heard(2, 55.0), heard(0, 55.0)].into_iter().collect());
    let seen = Observation { place: Some(1), radio, ground_speed_mps: Some(0.1), ..seen };
    group.bench_function("decide, distances and radio", |b| {
        let mut node = Node::new(Role::Relay, NodeParams::default());
        // On the ground until the loss has been above s_min for a while.
        let radio: Option<RadioSlot> = Some([heard(0, 80.0)].into_iter().collect());
        let far = Observation { radio, ..seen.clone() };
        for _ in 0..100 {
            node.decide(&far);
        }
        b.iter(|| node.decide(black_box(&seen)));
    });
    group.finish();
}
