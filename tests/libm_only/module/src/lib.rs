//! Brings `exp` of its own, as the Python module does, but is linked without its flags: whoever loads it into a process
//! that has the C library's mathematics gets that one.

use uchain_libm as _;

/// What `exp` is here.
#[unsafe(no_mangle)]
pub extern "C" fn exp_here(x: f64) -> f64 {
    std::hint::black_box(x).exp()
}
