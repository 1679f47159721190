//! Instructions, counted: under QEMU's `-icount shift=0` a timer without a divider ticks once per instruction.

const TIM2: usize = 0x4000_0000;
const CONTROL: usize = 0x00;
const EVENT: usize = 0x14;
const COUNT: usize = 0x24;
const DIVIDER: usize = 0x28;
const RELOAD: usize = 0x2c;

fn write(register: usize, value: u32) {
    // SAFETY: a register of TIM2, which is on every STM32F405 and nobody else's here.
    unsafe { ((TIM2 + register) as *mut u32).write_volatile(value) }
}

/// Starts counting, round and round through all 32 bits.
pub fn start() {
    write(DIVIDER, 0);
    write(RELOAD, u32::MAX);
    write(EVENT, 1);
    write(CONTROL, 1);
}

/// Instructions so far, modulo 2^32.
#[inline(never)]
pub fn now() -> u32 {
    // SAFETY: as in `write`; reading has no effect.
    unsafe { ((TIM2 + COUNT) as *const u32).read_volatile() }
}

/// What a call returns, and the instructions it took.
#[inline(never)]
pub fn cost_of<T>(call: impl FnOnce() -> T) -> (T, u32) {
    let idle = now();
    let begun = now();
    let result = call();
    let ended = now();
    (result, ended.wrapping_sub(begun).wrapping_sub(begun.wrapping_sub(idle)))
}
