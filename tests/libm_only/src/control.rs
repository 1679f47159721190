//! What the simulation must not do: call the system's exp, whose last bits depend on the CPU. Prints a hash of
//! what it returns.

use std::hint::black_box;

fn main() {
    let bits = (0..100_000).map(|i| black_box(f64::from(i) * 2e-4 - 10.0).exp().to_bits());
    println!("{:016x}", bits.fold(0_u64, |hash, bits| hash.wrapping_mul(0x0100_0000_01b3) ^ bits));
}
