//! The module computes with its own mathematics, and shows it to nobody: see `crates/uchain-py/build.rs`.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rustc-cdylib-link-arg=-Wl,-Bsymbolic-functions");
    println!("cargo::rustc-cdylib-link-arg=-Wl,--exclude-libs,ALL");
}
