//! What every program has: start-up, and two calls of a firmware's own.
#![no_std]
#![no_main]

use core::hint::black_box;

use image as _;

#[cortex_m_rt::entry]
fn main() -> ! {
    loop {
        black_box(0.0_f32);
    }
}
