//! Chains, on a chip without a heap: no allocator is linked. What a node costs at most comes first.
#![no_std]
#![no_main]

use image::{clock, flight, hardest, host, say};
use uchain_core::chain::{Node, NodeParams, Observation, RadioSlot};

#[cortex_m_rt::entry]
fn main() -> ! {
    clock::start();
    say!("size_of Node {}", size_of::<Node>());
    say!("size_of NodeParams {}", size_of::<NodeParams>());
    say!("size_of Observation {}", size_of::<Observation>());
    say!("size_of RadioSlot {}", size_of::<RadioSlot>());
    let most = hardest::fly();
    say!("hardest decisions {}", most.decisions);
    say!("hardest instructions {}", most.instructions);
    say!("hardest decide_stack {}", most.decide_stack);
    say!("hardest say_stack {}", most.say_stack);
    flight::fly::<1024>(flight::None);
    host::end(true)
}
