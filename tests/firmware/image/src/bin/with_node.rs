//! A node that speaks and decides, with tunables and readings that the compiler cannot know.
#![no_std]
#![no_main]

use core::hint::black_box;

use image as _;
use uchain_core::chain::{Brain as _, Node, NodeParams, Observation, Role};

#[cortex_m_rt::entry]
fn main() -> ! {
    let mut node = Node::new(black_box(Role::Relay), black_box(NodeParams::default()));
    loop {
        let seen = black_box(Observation::default());
        black_box(node.say(&seen));
        black_box(node.decide(&seen));
    }
}
