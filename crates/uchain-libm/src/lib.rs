//! One mathematics for the whole program: the C names of the transcendental functions, answered by the Rust
//! crate `libm`.
//!
//! The simulation calls `libm` itself. What it links does not always: rapier and parry call `f32::log2`,
//! `exp`, `atan2` and `sin_cos` of std whatever their features say, and std asks the system, whose last bits
//! depend on the C library and on the CPU. A program that links this crate brings its own symbols, so nobody
//! in it asks the system. The step `libm` of the gate looks at a finished program to see that this holds.
//!
//! Nothing here is called by name. One line is all it takes:
//!
//! ```
//! use uchain_libm as _;
//! // Whoever asks std from here on is answered by the crate `libm`, on every system the same.
//! assert_eq!(std::hint::black_box(0.5_f64).exp().to_bits(), 0x3ffa_6129_8e1e_069c);
//! ```
//!
//! It is for programs. A library that said it would replace `exp`, `sin` and 59 other functions of C in every program
//! that uses it; `uchain-sim` does not. No heap, no std. The one feature, `hidden`, is for shared libraries: the functions
//! are theirs alone, and not of whoever loads them. Rounding is that of `libm`: most results are within one
//! unit of the last place, and slower to come by than those of a C library with vector instructions.
#![no_std]
#![expect(unsafe_code, reason = "a symbol under a C name is all this crate is for; its meaning is C's own")]

/// Gives a function's symbol ELF's visibility "hidden", which has no attribute in Rust. With link-time optimization the
/// linker gets our functions as part of the library itself, and its `--exclude-libs` does not know them any more.
macro_rules! hide {
    ($name:ident) => {
        #[cfg(all(
            feature = "hidden",
            not(windows),
            not(target_vendor = "apple"),
            not(target_family = "wasm")
        ))]
        core::arch::global_asm!(concat!(".hidden ", stringify!($name)));
    };
}

/// Functions of numbers, under the names and with the arguments of C's `math.h`.
macro_rules! answer {
    ($float:ident: $($name:ident($($x:ident),+))*) => {
        $(
            #[unsafe(no_mangle)]
            extern "C" fn $name($($x: $float),+) -> $float {
                libm::$name($($x),+)
            }
            hide!($name);
        )*
    };
}

answer! {
    f32:
    sinf(x) cosf(x) tanf(x) asinf(x) acosf(x) atanf(x) atan2f(y, x)
    sinhf(x) coshf(x) tanhf(x) asinhf(x) acoshf(x) atanhf(x)
    expf(x) exp2f(x) exp10f(x) expm1f(x) logf(x) log2f(x) log10f(x) log1pf(x)
    powf(x, y) cbrtf(x) hypotf(x, y) fmaf(x, y, z)
}

answer! {
    f64:
    sin(x) cos(x) tan(x) asin(x) acos(x) atan(x) atan2(y, x)
    sinh(x) cosh(x) tanh(x) asinh(x) acosh(x) atanh(x)
    exp(x) exp2(x) exp10(x) expm1(x) log(x) log2(x) log10(x) log1p(x)
    pow(x, y) cbrt(x) hypot(x, y) fma(x, y, z)
}

/// C's `sincosf`: the compiler makes it of a sine and a cosine of one angle.
#[unsafe(no_mangle)]
extern "C" fn sincosf(x: f32, sin: &mut f32, cos: &mut f32) {
    (*sin, *cos) = libm::sincosf(x);
}
hide!(sincosf);

/// C's `sincos`.
#[unsafe(no_mangle)]
extern "C" fn sincos(x: f64, sin: &mut f64, cos: &mut f64) {
    (*sin, *cos) = libm::sincos(x);
}
hide!(sincos);

#[cfg(test)]
mod tests {
    extern crate std;

    use std::hint::black_box;

    #[test]
    fn what_std_computes_is_what_libm_computes() {
        for i in 0..2000_i16 {
            let x = black_box(f32::from(i) * 0.037 - 30.0);
            let y = f64::from(x);
            #[expect(
                clippy::disallowed_methods,
                reason = "whether std's functions arrive here is the question"
            )]
            let of_std = (x.exp(), x.sin_cos(), x.atan2(0.7), y.ln(), y.sin(), y.powf(1.7), y.hypot(3.0));
            let ours = (
                libm::expf(x),
                libm::sincosf(x),
                libm::atan2f(x, 0.7),
                libm::log(y),
                libm::sin(y),
                libm::pow(y, 1.7),
                libm::hypot(y, 3.0),
            );
            assert_eq!(std::format!("{of_std:?}"), std::format!("{ours:?}"), "x = {x}");
        }
    }
}
