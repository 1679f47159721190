//! The same firmware with nobody to decide.
#![no_std]
#![no_main]

use core::hint::black_box;

use image as _;
use uchain_core::chain::{Command, NodeParams, Observation, Packet, Role};

static SEEN: Observation =
    Observation { place: None, tof: None, radio: None, ground_speed_mps: None, battery: None, pilot: None };

#[cortex_m_rt::entry]
fn main() -> ! {
    black_box((black_box(Role::Relay), black_box(NodeParams::default())));
    loop {
        black_box(&SEEN);
        black_box(&Packet::BASE);
        black_box(&Command { forward_mps: 0.0, lateral_mps: 0.0, yaw_rate_radps: 0.0, airborne: false });
    }
}
