//! How deep a call goes into the stack: it is painted, and looked at afterwards.

use core::arch::asm;

const PAINT: u32 = 0xdead_beef;
/// What a call returns, and the bytes it and whatever it calls took below the caller's own: so many are painted, and a
/// call that goes through all of them is told as that.
///
/// No interrupt is on: nobody else writes there.
#[inline(never)]
pub fn depth_of<const BYTES: usize, T>(call: impl FnOnce() -> T) -> (T, usize) {
    let top: usize;
    // SAFETY: writes below the stack pointer, where nothing lives until the next call, and within RAM: the stack has
    // more than this to itself, or the memory layout of the image would be no use for anything.
    unsafe {
        asm!(
            "mov {top}, sp",
            "mov {at}, sp",
            "2:",
            "str {paint}, [{at}, #-4]!",
            "subs {left}, {left}, #1",
            "bne 2b",
            top = out(reg) top,
            at = out(reg) _,
            left = inout(reg) BYTES / 4 => _,
            paint = in(reg) PAINT,
        );
    }
    let result = call();
    let mut low = top - BYTES;
    // SAFETY: words that were painted above, aligned because the stack pointer is.
    while low < top && unsafe { (low as *const u32).read_volatile() } == PAINT {
        low += 4;
    }
    (result, top - low)
}
