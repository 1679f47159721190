//! With the feature `view` the page of `uchain view` is inside the program. It is made before by `cargo xtask web`; nothing
//! is built here.

use std::{env, path::PathBuf};

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    if env::var_os("CARGO_FEATURE_VIEW").is_none() {
        return;
    }
    println!("cargo::rerun-if-env-changed=UCHAIN_PAGE");
    println!("cargo::rerun-if-env-changed=CARGO_TARGET_DIR");
    let page = page();
    println!("cargo::rerun-if-changed={}", page.display());
    if page.is_file() {
        println!("cargo::rustc-env=UCHAIN_PAGE_INSIDE={}", page.display());
    } else {
        println!(
            "cargo::error=the feature `view` puts the page into the program, and {} is not there: run `cargo xtask web` first",
            page.display()
        );
    }
}

/// Where the page is: what `UCHAIN_PAGE` says, else where `cargo xtask web` leaves it.
fn page() -> PathBuf {
    if let Some(named) = env::var_os("UCHAIN_PAGE") {
        return std::path::absolute(&named).unwrap_or_else(|_| named.into());
    }
    let root = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default()).join("../..");
    let target = env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), PathBuf::from);
    let page = target.join("web/uchain.html");
    std::path::absolute(&page).unwrap_or(page)
}
