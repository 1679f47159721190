//! `uchain-core` as a drone would link it. This library brings a panic handler and no allocator, so it builds only
//! while nothing under the core pulls in std, which brings another handler, or alloc, which needs an allocator.
//! Every law is called from an exported function: none is dropped before the archive is looked at.
#![no_std]

use core::fmt::Write as _;

use uchain_core::{
    chain::{
        CenterParams, EqualizeParams, Follow, HeadGuard, Heard, KalmanParams, LinkEnd, LinkParams, Node,
        NodeParams, Observation, Packet, RadioSlot, RelayGuard, Role, ScalarKalman, Takeoff, TakeoffParams,
        Tof, center, equalize,
    },
    params::OutOfRange,
    seam::Brain as _,
};

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}

/// Whole nodes, a head and a relay, for as many decisions as asked.
#[unsafe(no_mangle)]
pub extern "C" fn fly(decisions: u32, loss_db: f32, speed_mps: f32, distance_m: f32) -> f32 {
    let mut head = Node::new(Role::Head, NodeParams::default());
    let mut relay = Node::new(Role::Relay, NodeParams::default());
    let tof = Tof { nw_m: distance_m, ne_m: 1.0, sw_m: 1.0, se_m: distance_m };
    let mut sum = 0.0;
    for _ in 0..decisions {
        let heard = |packet| Some(Heard { loss_db, packet });
        let radio = RadioSlot { back: heard(relay.say(speed_mps)), front: heard(head.say(speed_mps)) };
        let seen = Observation {
            tof: Some(tof),
            radio: Some(radio),
            ground_speed_mps: speed_mps,
            ..Observation::default()
        };
        let (ahead, behind) = (head.decide(&seen), relay.decide(&seen));
        sum += ahead.forward_mps + behind.lateral_mps + behind.yaw_rate_radps;
    }
    sum + head.back_loss_db().unwrap_or(0.0) + relay.front_loss_db().unwrap_or(0.0)
}

/// Each law by itself.
#[unsafe(no_mangle)]
pub extern "C" fn laws(loss_db: f32, speed_mps: f32, distance_m: f32, backward: bool) -> f32 {
    let kalman = KalmanParams::default();
    let filtered = ScalarKalman::start(loss_db, &kalman).map_or(0.0, |mut filter| {
        filter.predict(speed_mps, 0.2, &kalman);
        filter.update(loss_db, &kalman);
        filter.loss_db() + filter.variance_db2()
    });
    let tof = Tof { nw_m: distance_m, ne_m: 1.0, sw_m: 1.0, se_m: distance_m };
    let centering = center(&tof, backward, Follow::Left, &CenterParams::default());
    let (link, mut end) = (LinkParams::default(), LinkEnd::new(uchain_core::chain::End::Front));
    end.hear(Some(&Heard { loss_db, packet: Packet::default() }), speed_mps, 0.2, &kalman);
    let held = HeadGuard::default().limit(speed_mps, &end, &link)
        + RelayGuard::default().limit(speed_mps, &end, &end, &link);
    let due = Takeoff::default().due(loss_db, 10.0, 0.2, &TakeoffParams::default());
    filtered
        + centering.lateral_mps
        + equalize(loss_db, distance_m, &EqualizeParams::default())
        + held
        + f32::from(u8::from(due))
}

/// How long the message about a bad tunable is, in bytes.
#[unsafe(no_mangle)]
pub extern "C" fn complain(gain: f32) -> usize {
    struct Length(usize);
    impl core::fmt::Write for Length {
        fn write_str(&mut self, text: &str) -> core::fmt::Result {
            self.0 += text.len();
            Ok(())
        }
    }
    let mut length = Length(0);
    let checked: Result<(), OutOfRange> = CenterParams { c_t_per_s: gain, ..CenterParams::default() }.check();
    if let Err(error) = checked {
        let _ = write!(length, "{error} {error:?}");
    }
    length.0
}
