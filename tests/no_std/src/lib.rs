//! `uchain-core` as a drone would link it. This library brings a panic handler and no allocator, so it builds only
//! while nothing under the core pulls in std, which brings another handler, or alloc, which needs an allocator.
//!
//! With the feature `explore` it brings an allocator too, and explores.
//!
//! Whole nodes fly with tunables the compiler cannot know, so that every variant of every law is linked.
#![no_std]

#[cfg(feature = "explore")]
mod explore;

use core::{fmt::Write as _, hint::black_box};

use uchain_core::{
    chain::{
        Brain as _, CenterParams, EqualizeParams, Heard, KalmanParams, Node, NodeParams, Observation, Packet,
        RadioSlot, Role, ScalarKalman, TOF_RANGE_M, Tof, center, equalize,
    },
    flight::{Attitude, FlightState, PdLaw, QuadrotorParams},
};

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}

/// Whole nodes, a head and a relay, for as many decisions as asked.
#[unsafe(no_mangle)]
pub extern "C" fn fly(decisions: u32, loss_db: f32, speed_mps: f32, distance_m: f32) -> f32 {
    let mut head = Node::new(Role::Head, black_box(NodeParams::default()));
    let mut relay = Node::new(Role::Relay, black_box(NodeParams::default()));
    let tof = Tof { nw_m: distance_m, ne_m: 1.0, sw_m: 1.0, se_m: distance_m };
    let mut sum = 0.0;
    for _ in 0..decisions {
        let mut seen =
            Observation { tof: Some(tof), ground_speed_mps: Some(speed_mps), ..Observation::default() };
        let said = [head.say(&seen), relay.say(&seen), Packet::BASE];
        let mut radio = RadioSlot::default();
        for (from, packet) in said.into_iter().enumerate() {
            radio.push(Heard { from: from as u16, loss_db, packet });
        }
        seen.radio = Some(radio);
        let (ahead, behind) = (head.decide(&seen), relay.decide(&seen));
        sum += ahead.forward_mps + behind.lateral_mps + behind.yaw_rate_radps;
    }
    let why = relay.explain(&Observation::default()).map_or(0.0, |why| why.wish_mps + why.speed_share);
    let (head, relay) = (head.estimates(), relay.estimates());
    sum + why + head.back.filtered_db.unwrap_or(0.0) + relay.front.filtered_db.unwrap_or(0.0)
}

/// The laws that stand by themselves.
#[unsafe(no_mangle)]
pub extern "C" fn laws(loss_db: f32, speed_mps: f32, distance_m: f32, backward: bool) -> f32 {
    let kalman = black_box(KalmanParams::default());
    let filtered = ScalarKalman::start(loss_db, &kalman).map_or(0.0, |mut filter| {
        filter.predict(speed_mps, 0.2, &kalman);
        filter.update(loss_db, &kalman);
        filter.loss_db() + filter.variance_db2()
    });
    let tof = Tof { nw_m: distance_m, ne_m: 1.0, sw_m: 1.0, se_m: distance_m };
    let centering =
        center(&tof, TOF_RANGE_M, backward, Default::default(), &black_box(CenterParams::default()));
    filtered + centering.lateral_mps + equalize(loss_db, distance_m, &black_box(EqualizeParams::default()))
}

/// The law that keeps a quadrotor in the air.
#[unsafe(no_mangle)]
pub extern "C" fn hover(x_m: f32, z_m: f32, heading_rad: f32) -> f32 {
    let law = PdLaw::new(&black_box(QuadrotorParams::default()), 0.5, 0.5);
    let attitude = Attitude::level(heading_rad);
    let state = FlightState { at_m: [x_m, 0.0, z_m], attitude, ..FlightState::default() };
    let demand = law.demand(&state, 0.0, 0.005);
    demand.turn_radps2.iter().fold(demand.lift_mps2, |sum, turn| sum + turn)
}

/// How long the message about a bad tunable is, in bytes.
#[unsafe(no_mangle)]
pub extern "C" fn complain(v_max_mps: f32) -> usize {
    struct Length(usize);
    impl core::fmt::Write for Length {
        fn write_str(&mut self, text: &str) -> core::fmt::Result {
            self.0 += text.len();
            Ok(())
        }
    }
    let mut length = Length(0);
    if let Err(error) = (EqualizeParams { v_max_mps, ..EqualizeParams::default() }).check() {
        let _ = write!(length, "{error} {error:?}");
    }
    length.0
}
