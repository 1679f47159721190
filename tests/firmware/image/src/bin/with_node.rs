//! A firmware with a node that speaks and decides, with tunables and readings that the compiler cannot know. What
//! `without_node` has not is the node.
#![no_std]
#![no_main]

use core::hint::black_box;

use image as _;
use uchain_core::chain::{Brain as _, Node, NodeParams, Observation, Role};

static SEEN: Observation =
    Observation { place: None, tof: None, radio: None, ground_speed_mps: None, battery: None, pilot: None };

#[cortex_m_rt::entry]
fn main() -> ! {
    let mut node = Node::new(black_box(Role::Relay), black_box(NodeParams::default()));
    loop {
        let seen = black_box(&SEEN);
        black_box(&node.say(seen));
        black_box(&node.decide(seen));
    }
}
