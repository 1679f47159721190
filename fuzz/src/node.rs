//! A node with any tunables that are legal sees anything at all.

use serde_json::{Map, Value};
use uchain_core::{
    chain::{
        BASE_ID, Brain as _, CenterLaw, CenterParams, Command, EqualizeParams, Follow, Gap, Heard,
        KalmanParams, Launch, LinkParams, Node, NodeParams, Observation, Packet, PilotInput, Role, Signal,
        SpeedLaw, TakeoffParams, Tof,
    },
    params::Key,
};

use crate::bytes::Bytes;

/// Bytes as a node, its tunables and all it sees, one decision after the other.
///
/// # Panics
/// If a command is no number or exceeds a limit, if a UAV on the ground asks for a speed, or if what it believes is no
/// number.
pub fn node(bytes: &[u8]) {
    let mut bytes = Bytes(bytes);
    let params = params(&mut bytes);
    assert_eq!(params.check(), Ok(()), "within their ranges");
    fly(&params, &mut bytes);
}

fn fly(params: &NodeParams, bytes: &mut Bytes<'_>) {
    let role = bytes.one_of(&[Role::Head, Role::Relay]);
    let mut node = Node::new(role, params.clone());
    while !bytes.is_empty() {
        let seen = seen(bytes);
        let said = node.say(&seen);
        assert!(said.flown_s >= 0.0 && !said.imbalance_db.is_nan(), "{said:?}");
        // A law of one's own may ask for anything as well.
        let mut led = node.clone();
        _ = led.prepare(&seen);
        keeps_its_limits(&led.conclude(&seen, bytes.number(-1.0, 1.0)), params);
        keeps_its_limits(&node.decide(&seen), params);
        believes_numbers(&node, &seen);
    }
}

fn params(bytes: &mut Bytes<'_>) -> NodeParams {
    let read = "ranges are legal";
    let mut params = NodeParams {
        kalman: serde_json::from_value(ranged(bytes, KalmanParams::KEYS)).expect(read),
        equalize: serde_json::from_value(ranged(bytes, EqualizeParams::KEYS)).expect(read),
        center: serde_json::from_value(ranged(bytes, CenterParams::KEYS)).expect(read),
        takeoff: serde_json::from_value(ranged(bytes, TakeoffParams::KEYS)).expect(read),
        link: serde_json::from_value(ranged(bytes, LinkParams::KEYS)).expect(read),
        ..NodeParams::default()
    };
    params.equalize.law = bytes.one_of(&[SpeedLaw::Lipschitz, SpeedLaw::InverseModel, SpeedLaw::BangBang]);
    params.equalize.spacing = bytes.flag();
    params.center.law = bytes.one_of(&[CenterLaw::Wall, CenterLaw::Paper, CenterLaw::Firmware]);
    params.takeoff.launch = bytes.one_of(&[Launch::Threshold, Launch::Converged]);
    params.takeoff.launch_signal = bytes.one_of(&[Signal::Filtered, Signal::Raw]);
    params.link.signal = bytes.one_of(&[Signal::Filtered, Signal::Raw]);
    params.link.gap = bytes.one_of(&[Gap::Hold, Gap::Predict]);
    params.link.base_flow = bytes.flag();
    params
}

/// A third of the tunables that have a range, at one of its ends or anywhere between them; the others are not named.
fn ranged(bytes: &mut Bytes<'_>, keys: &[Key]) -> Value {
    let mut table = Map::new();
    for key in keys {
        let Some((low, high)) = key.range.filter(|_| bytes.byte() < 85) else { continue };
        let value = match bytes.byte() {
            0..=31 => low,
            32..=63 => high,
            _ => low + f64::from(bytes.share()) * (high - low),
        };
        // Read as `f32`, a bound is rounded as the range's own bound is.
        table.insert(key.name.into(), value.into());
    }
    Value::Object(table)
}

fn seen(bytes: &mut Bytes<'_>) -> Observation {
    let tof = bytes.flag().then(|| {
        let mut beam_m = || bytes.number(0.0, 2.5);
        Tof { nw_m: beam_m(), ne_m: beam_m(), sw_m: beam_m(), se_m: beam_m() }
    });
    let packets = bytes.byte();
    let radio = (packets < 224).then(|| (0..packets % 10).map(|_| heard(bytes)).collect());
    Observation {
        place: place(bytes),
        tof,
        radio,
        ground_speed_mps: bytes.maybe(-1.0, 1.0),
        battery: bytes.maybe(0.0, 1.0),
        pilot: bytes.flag().then(|| PilotInput { speed_mps: bytes.number(-1.0, 1.0), follow: follow(bytes) }),
    }
}

fn place(bytes: &mut Bytes<'_>) -> Option<u16> {
    match bytes.byte() {
        0..=127 => None,
        128..=239 => Some(bytes.byte() as u16 % 4),
        _ => Some(bytes.word()),
    }
}

fn follow(bytes: &mut Bytes<'_>) -> Follow {
    bytes.one_of(&[Follow::Centre, Follow::Left, Follow::Right])
}

fn heard(bytes: &mut Bytes<'_>) -> Heard {
    let loss_db = bytes.number(30.0, 110.0);
    if bytes.byte() < 64 {
        return Heard { from: BASE_ID, loss_db, packet: Packet::BASE };
    }
    let packet = Packet {
        place: place(bytes).unwrap_or(0),
        ground_speed_mps: bytes.number(-1.0, 1.0),
        flown_s: bytes.number(0.0, 600.0),
        follow: follow(bytes),
        imbalance_db: bytes.number(0.0, 40.0),
        is_base: bytes.byte() < 16,
        battery: bytes.maybe(0.0, 1.0),
        own: [bytes.byte(); 8],
    };
    Heard { from: bytes.word(), loss_db, packet }
}

fn keeps_its_limits(command: &Command, params: &NodeParams) {
    let Command { forward_mps, lateral_mps, yaw_rate_radps, airborne } = *command;
    let center = &params.center;
    let lateral_max_mps = center.lateral_max_mps.max(center.push_mps);
    assert!(forward_mps.abs() <= params.equalize.v_max_mps, "{command:?}");
    assert!(lateral_mps.abs() <= lateral_max_mps, "{command:?}");
    assert!(yaw_rate_radps.abs() <= center.yaw_rate_max_radps, "{command:?}");
    assert!(airborne || (forward_mps, lateral_mps, yaw_rate_radps) == (0.0, 0.0, 0.0), "{command:?}");
}

fn believes_numbers(node: &Node, seen: &Observation) {
    let believed = node.estimates();
    for link in [believed.back, believed.front] {
        for number in [link.filtered_db, link.raw_db, link.silent_s].into_iter().flatten() {
            assert!(number.is_finite(), "{link:?}");
        }
    }
    assert!(believed.allowed_mps.is_none_or(f32::is_finite), "{believed:?}");
    let why = node.explain(seen).expect("a node explains itself");
    for number in [why.back_variance_db2, why.front_variance_db2].into_iter().flatten() {
        assert!(number.is_finite() && number >= 0.0, "{why:?}");
    }
    assert!(why.wish_mps.is_finite() && (0.0..=1.0).contains(&why.speed_share), "{why:?}");
    assert!(node.doing(seen).is_some());
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[should_panic(expected = "NaN")]
    fn sensors_without_a_range_are_not_legal_and_what_they_make_of_a_command_is_noticed() {
        let params = NodeParams { tof_range_m: f32::INFINITY, ..NodeParams::default() };
        assert_eq!(params.check().map_err(|error| error.key), Err("tof_range_m"));
        for seed in 0..=255_u8 {
            let input: Vec<u8> = (0..4000_u16).map(|i| (i.wrapping_mul(40_503) >> 7) as u8 ^ seed).collect();
            fly(&params, &mut Bytes(&input));
        }
    }
}
