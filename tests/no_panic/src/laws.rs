//! The laws that stand by themselves.

use std::hint::black_box;

use no_panic::no_panic;
use uchain_core::{
    bounded,
    chain::{
        CenterParams, Centering, End, EqualizeParams, Follow, HeadGuard, Heard, KalmanParams, LinkEnd,
        LinkParams, Override, Packet, RelayGuard, ScalarKalman, Signal, Takeoff, TakeoffParams, Tof, center,
    },
};

#[no_panic]
fn hold(value: f32, low: f32, high: f32) -> f32 {
    bounded(value, low, high)
}

#[no_panic]
fn equalize(back_db: f32, front_db: f32, params: &EqualizeParams) -> f32 {
    uchain_core::chain::equalize(back_db, front_db, params)
}

#[no_panic]
fn centre(tof: &Tof, range_m: f32, backward: bool, follow: Follow, params: &CenterParams) -> Centering {
    center(tof, range_m, backward, follow, params)
}

#[no_panic]
fn start(loss_db: f32, params: &KalmanParams) -> Option<ScalarKalman> {
    ScalarKalman::start(loss_db, params)
}

#[no_panic]
fn resume(loss_db: f32, variance_db2: f32) -> Option<ScalarKalman> {
    ScalarKalman::resume(loss_db, variance_db2)
}

#[no_panic]
fn predict(filter: &mut ScalarKalman, speed_mps: f32, period_s: f32, params: &KalmanParams) {
    filter.predict(speed_mps, period_s, params);
}

#[no_panic]
fn update(filter: &mut ScalarKalman, loss_db: f32, params: &KalmanParams) {
    filter.update(loss_db, params);
}

#[no_panic]
fn hear(
    end: &mut LinkEnd,
    heard: Option<&Heard>,
    own_mps: Option<f32>,
    period_s: f32,
    params: (&KalmanParams, &LinkParams),
) {
    end.hear(heard, own_mps, period_s, params.0, params.1);
}

#[no_panic]
fn known(end: &LinkEnd, signal: Signal, params: &LinkParams) -> (Option<f32>, Option<f32>, Packet, bool) {
    (end.signal_db(signal).or(end.loss_db()), end.variance_db2(), end.neighbour(), end.is_lost(params))
}

#[no_panic]
fn due(takeoff: &mut Takeoff, loss_db: f32, front: &Packet, period_s: f32, params: &TakeoffParams) -> bool {
    takeoff.due(loss_db, front, period_s, params)
}

#[no_panic]
fn head(
    guard: &mut HeadGuard,
    wish_mps: f32,
    back: &LinkEnd,
    params: &LinkParams,
) -> (f32, Option<Override>) {
    (guard.limit(wish_mps, back, params), guard.reason(back, params))
}

#[no_panic]
fn relay(
    guard: &mut RelayGuard,
    wish_mps: f32,
    back: &LinkEnd,
    front: &LinkEnd,
    params: &LinkParams,
) -> (f32, Option<Override>) {
    (guard.limit(wish_mps, back, front, params), guard.reason(back, front, params))
}

/// Every one of them once, of values that the compiler cannot know.
pub(super) fn all() -> f32 {
    let (x, y, z) = black_box((60.0_f32, 57.0_f32, 0.2_f32));
    let (kalman, link) = black_box((KalmanParams::default(), LinkParams::default()));
    let tof = black_box(Tof { nw_m: 1.0, ne_m: 1.0, sw_m: 0.5, se_m: 1.0 });
    let steered =
        centre(&tof, y, black_box(true), black_box(Follow::Left), &black_box(CenterParams::default()));
    let mut filter = black_box(start(x, &kalman).or(resume(x, y)));
    if let Some(filter) = &mut filter {
        predict(filter, z, y, &kalman);
        update(filter, x, &kalman);
    }
    let mut end = LinkEnd::new(black_box(End::Front));
    let heard = black_box(Some(Heard { from: 0, loss_db: x, packet: Packet::default() }));
    hear(&mut end, heard.as_ref(), black_box(Some(z)), y, (&kalman, &link));
    let mut end = black_box(end);
    hear(&mut end, heard.as_ref(), None, y, (&kalman, &link));
    let (signal_db, ..) = black_box(known(&end, black_box(Signal::Raw), &link));
    let mut takeoff = black_box(Takeoff::default());
    let is_due = due(&mut takeoff, x, &black_box(Packet::BASE), z, &black_box(TakeoffParams::default()));
    let (head_mps, _) = black_box(head(&mut black_box(HeadGuard::default()), z, &end, &link));
    let (relay_mps, _) = black_box(relay(&mut black_box(RelayGuard::default()), z, &end, &end, &link));
    let level_mps = equalize(x, y, &black_box(EqualizeParams::default()));
    let held = hold(x, y, z) + filter.map_or(0.0, |filter| filter.loss_db() + filter.variance_db2());
    let asked = steered.lateral_mps + level_mps + head_mps + relay_mps;
    held + asked + signal_db.unwrap_or(0.0) + f32::from(u8::from(is_due))
}
