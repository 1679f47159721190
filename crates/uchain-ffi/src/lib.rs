//! The chain node of `uchain-core` for C. `uchain.h` is made of this crate: its comments are the header's.
//!
//! All memory is the caller's, nothing is allocated, and no input panics: pointers are looked at before they are followed,
//! numbers and choices before they are believed. What is wrong is answered by a [`Status`].
#![no_std]

mod choice;
mod explanation;
mod hear;
mod node;
mod observation;
mod params;
mod pointer;
mod status;

pub use choice::{CenterLaw, Follow, Gap, Launch, Override, Role, Signal, SpeedLaw, Stage, Walls};
pub use explanation::{Explanation, uchain_explain};
pub use hear::{uchain_hear, uchain_say, uchain_say_base};
pub use node::{Node, uchain_node_init, uchain_step};
pub use observation::{Command, Observation};
pub use params::{
    Params, uchain_params_cavemod, uchain_params_check, uchain_params_default, uchain_params_frontiers2021,
};
pub use status::Status;

/// Version of this interface. It changes whenever a program that was compiled with another header would go wrong.
pub const UCHAIN_ABI_VERSION: u32 = 1;

/// Most bytes of a packet.
pub const UCHAIN_PACKET_MAX: usize = 30;

/// Id of the base station, which is no UAV.
pub const UCHAIN_BASE_ID: u16 = 65535;

/// No place in the chain is known.
pub const UCHAIN_NO_PLACE: u16 = 65535;

/// Size of `uchain_node` (32-bit words).
pub const UCHAIN_NODE_WORDS: usize = 180;
/// Size of `uchain_params` (bytes).
pub const UCHAIN_PARAMS_BYTES: usize = 212;
/// Size of `uchain_observation` (bytes).
pub const UCHAIN_OBSERVATION_BYTES: usize = 40;
/// Size of `uchain_command` (bytes).
pub const UCHAIN_COMMAND_BYTES: usize = 16;
/// Size of `uchain_explanation` (bytes).
pub const UCHAIN_EXPLANATION_BYTES: usize = 56;

// The header asserts the same of what a C compiler makes of it.
const _: () = {
    assert!(size_of::<Node>() == 4 * UCHAIN_NODE_WORDS && align_of::<Node>() == 4);
    assert!(size_of::<Params>() == UCHAIN_PARAMS_BYTES && align_of::<Params>() == 4);
    assert!(size_of::<Observation>() == UCHAIN_OBSERVATION_BYTES && align_of::<Observation>() == 4);
    assert!(size_of::<Command>() == UCHAIN_COMMAND_BYTES && align_of::<Command>() == 4);
    assert!(size_of::<Explanation>() == UCHAIN_EXPLANATION_BYTES && align_of::<Explanation>() == 4);
    assert!(size_of::<Status>() == 1);
    assert!(UCHAIN_PACKET_MAX == uchain_core::wire::SIZE_MAX);
    assert!(UCHAIN_BASE_ID == uchain_core::chain::BASE_ID);
};

/// Version of the library that is linked; it has to be `UCHAIN_ABI_VERSION`.
#[unsafe(no_mangle)]
pub extern "C" fn uchain_abi_version() -> u32 {
    UCHAIN_ABI_VERSION
}

/// Nothing comes here: the gate looks that no program that is linked with this library holds it.
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}
