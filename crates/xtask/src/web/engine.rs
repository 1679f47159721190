//! The engine of the page: `uchain-view` as WebAssembly.

use std::{
    fs,
    path::{Path, PathBuf},
    process::{Command, Stdio},
};

use anyhow::{Context as _, Result};

use super::Effort;
use crate::house::{House, read, run};

const TARGET: &str = "wasm32-unknown-unknown";

/// What LLVM takes for granted in this target; an older wasm-opt has to be told.
const FEATURES: [&str; 6] = [
    "--enable-bulk-memory",
    "--enable-multivalue",
    "--enable-mutable-globals",
    "--enable-nontrapping-float-to-int",
    "--enable-reference-types",
    "--enable-sign-ext",
];

/// Whether Rust can build for wasm here. What is missing is fetched if rustup is there; else what to do, in a line.
pub(crate) fn is_ready() -> Result<Result<(), String>> {
    if has_target()? {
        return Ok(Ok(()));
    }
    if is_there("rustup") {
        // Without a network it says so itself.
        let _ = run(Command::new("rustup").args(["target", "add", TARGET]));
        if has_target()? {
            return Ok(Ok(()));
        }
    }
    let remedy =
        "rustup target add wasm32-unknown-unknown (or your system's package, such as libstd-rust-dev-wasm32)";
    Ok(Err(format!("this Rust cannot build for {TARGET}: {remedy}")))
}

/// Whether the standard library is there for this target.
fn has_target() -> Result<bool> {
    let folder = read(Command::new("rustc").args(["--print", "target-libdir", "--target", TARGET]))?;
    Ok(Path::new(&folder).exists())
}

/// Whether a program can be started.
fn is_there(program: &str) -> bool {
    let mut asked = Command::new(program);
    asked.arg("--version").stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    asked.status().is_ok_and(|status| status.success())
}

/// The engine's bytes. It is an ordinary library in the workspace, which costs nobody anything; a module of wasm it becomes
/// here alone.
pub(super) fn build(house: &House, effort: Effort) -> Result<Vec<u8>> {
    let profile = match effort {
        Effort::Quick => "page",
        Effort::Dist => "page-dist",
    };
    run(&mut house.cargo(&format!(
        "rustc --locked --package uchain-view --lib --crate-type cdylib --target {TARGET} --profile {profile}"
    )))?;
    let mut module = house.target.join(TARGET).join(profile).join("uchain_view.wasm");
    if effort == Effort::Dist {
        module = optimised(module)?;
    }
    fs::read(&module).with_context(|| format!("cannot read {}", module.display()))
}

/// What binaryen makes of it, where binaryen is.
fn optimised(module: PathBuf) -> Result<PathBuf> {
    if !is_there("wasm-opt") {
        println!(
            "`wasm-opt` is missing (apt-get install binaryen): the engine stays a fifth larger than it need be"
        );
        return Ok(module);
    }
    let smaller = module.with_extension("opt.wasm");
    run(Command::new("wasm-opt").arg("-Oz").args(FEATURES).arg(&module).arg("-o").arg(&smaller))?;
    Ok(smaller)
}
