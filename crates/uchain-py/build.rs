//! Links the module so that it computes with its own mathematics, and gives it to nobody else.
//!
//! An executable's `exp` is its own if it has one. A shared library's is not: the loader asks the process first, and Python
//! has the system's. With `-Bsymbolic-functions` the linker binds the module's calls to the module's functions for good,
//! and with `--exclude-libs` nobody sees them from outside: rustc would show every function that has a name of C. (With
//! link-time optimization that is the feature `hidden` of uchain-libm.)

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rustc-cdylib-link-arg=-Wl,-Bsymbolic-functions");
    println!("cargo::rustc-cdylib-link-arg=-Wl,--exclude-libs,ALL");
}
