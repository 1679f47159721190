//! What the programs for the emulated chip share: its clock, the host behind the debugger, the depth of the stack.
//!
//! Only here and in the programs' heap is code `unsafe`: registers, a breakpoint, the stack pointer.
#![no_std]

pub mod clock;
pub mod flight;
pub mod hardest;
pub mod host;
pub mod stack;

use core::panic::PanicInfo;

use cortex_m_rt::{ExceptionFrame, exception};

#[panic_handler]
fn panic(info: &PanicInfo<'_>) -> ! {
    match info.location() {
        Some(place) => say!("panic at {}:{}", place.file(), place.line()),
        None => say!("panic"),
    }
    host::end(false)
}

#[exception]
unsafe fn HardFault(frame: &ExceptionFrame) -> ! {
    say!("fault at {:#x}", frame.pc());
    host::end(false)
}
