//! A node as a whole.

use std::hint::black_box;

use no_panic::no_panic;
use uchain_core::chain::{
    Brain as _, Command, Doing, Estimates, Explanation, Heard, Levelling, Node, NodeParams, Observation,
    Packet, PilotInput, RadioSlot, Role, Tof,
};

#[no_panic]
fn make(role: Role, params: NodeParams) -> Node {
    Node::new(role, params)
}

#[no_panic]
fn decide(node: &mut Node, seen: &Observation) -> Command {
    let command = node.decide(seen);
    planted(command)
}

#[no_panic]
fn prepare(node: &mut Node, seen: &Observation) -> Option<Levelling> {
    node.prepare(seen)
}

#[no_panic]
fn conclude(node: &mut Node, seen: &Observation, level_mps: f32) -> Command {
    node.conclude(seen, level_mps)
}

#[no_panic]
fn say(node: &Node, seen: &Observation) -> Packet {
    node.say(seen)
}

#[no_panic]
fn believe(node: &Node, seen: &Observation) -> (Estimates, Option<Explanation>, Option<Doing>) {
    (node.estimates(), node.explain(seen), node.doing(seen))
}

#[no_panic]
fn take_in(slot: &mut RadioSlot, heard: Heard, place: u16) -> (bool, Option<u16>) {
    let has_room = slot.push(heard);
    (has_room, slot.front(place).or(slot.back(place)).map(|heard| heard.from))
}

#[no_panic]
fn gather(heard: &[Heard]) -> RadioSlot {
    heard.iter().copied().collect()
}

/// Nothing; or, as a control, what must not link.
#[cfg(not(any(feature = "control-index", feature = "control-inside")))]
fn planted(command: Command) -> Command {
    command
}

/// An index that nobody has checked.
#[cfg(feature = "control-index")]
fn planted(command: Command) -> Command {
    const SHARES: [f32; 4] = [0.0, 0.5, 0.75, 1.0];
    Command { forward_mps: SHARES[(command.lateral_mps * 10.0) as usize], ..command }
}

/// The same in a function of its own, as most of the laws are.
#[cfg(feature = "control-inside")]
#[inline(never)]
fn planted(command: Command) -> Command {
    const SHARES: [f32; 4] = [0.0, 0.5, 0.75, 1.0];
    Command { forward_mps: SHARES[(command.lateral_mps * 10.0) as usize], ..command }
}

/// A node that the compiler knows nothing of decides on what it cannot know.
pub(super) fn all() -> f32 {
    let heard = black_box([Heard { from: 0, loss_db: 60.0, packet: Packet::default() }; 3]);
    let mut slot = gather(black_box(heard.as_slice()));
    let taken = black_box(take_in(&mut slot, heard[0], black_box(1)));
    let seen = black_box(Observation {
        place: Some(1),
        tof: Some(Tof { nw_m: 1.0, ne_m: 1.0, sw_m: 0.5, se_m: 1.0 }),
        radio: Some(slot),
        ground_speed_mps: Some(0.1),
        battery: Some(0.5),
        pilot: Some(PilotInput::default()),
    });
    let mut node = black_box(make(black_box(Role::Relay), black_box(NodeParams::default())));
    let mut sum = decide(&mut node, &seen).forward_mps;
    if let Some(asked) = black_box(prepare(&mut node, &seen)) {
        sum += asked.back_db;
    }
    sum += conclude(&mut node, &seen, black_box(0.1)).yaw_rate_radps + say(&node, &seen).flown_s;
    let believed = black_box(believe(&node, &seen));
    sum + believed.0.allowed_mps.unwrap_or(0.0) + f32::from(u8::from(taken.0))
}
