//! The node in C: a header that is what the library is, the same bits on a host and on the emulated chip, wrong use without
//! a crash, and an app for a Crazyflie that flies.

mod chip;
mod header;
mod host;

use std::{
    path::{Path, PathBuf},
    process::Command,
};

use anyhow::{Result, bail, ensure};

use super::Outcome;
use crate::{
    firmware::{
        self,
        toolchain::{is_there, toolchain},
    },
    house::{House, capture, ci, run},
};

/// The workspace of the library and of what it is compared with.
const FOLDER: &str = "crates/uchain-ffi";
/// The app.
const APP: &str = "examples/crazyflie-app";
/// The compiler for the chip.
const ARM_CC: &str = "arm-none-eabi-gcc";

/// No warning, in any dialect.
const STRICT: [&str; 5] = ["-Wall", "-Wextra", "-Wconversion", "-pedantic", "-Werror"];

pub(super) fn answers_as_rust_does(house: &House) -> Result<Outcome> {
    for check in [
        "fmt --all -- --check",
        "clippy --locked --release -- -D warnings",
        "clippy --locked --release --package reference --all-targets -- -D warnings",
        "test --locked --release --package reference",
    ] {
        run(&mut cargo(house, check))?;
    }
    header::is_the_library(house)?;
    let missing = ["cc", "c++"].into_iter().find(|compiler| !is_there(compiler));
    if let Some(compiler) = missing {
        return skipped(&format!("`{compiler}` is missing: apt-get install gcc g++"));
    }
    header::compiles(house)?;
    let recorded = firmware::recorded(house)?.join("chains.trace");
    host::answers(house, &recorded)?;
    match toolchain(house)? {
        Err(remedy) => skipped(&format!("nothing flew on the chip: {remedy}")),
        Ok(_) if !is_there(ARM_CC) => skipped(
            "nothing flew on the chip: apt-get install gcc-arm-none-eabi libnewlib-arm-none-eabi, or your \
             system's GCC and newlib for Arm",
        ),
        Ok(rust) => chip::answers(house, rust, &recorded).map(|()| Outcome::Passed),
    }
}

/// What could not be looked at: in CI that is a failure.
fn skipped(why: &str) -> Result<Outcome> {
    if ci() {
        bail!("{why}");
    }
    Ok(Outcome::Skipped(why.to_owned()))
}

/// `cargo` in the library's workspace, for the host.
fn cargo(house: &House, args: &str) -> Command {
    let mut command = house.cargo(args);
    command.current_dir(house.root.join(FOLDER)).env("CARGO_TARGET_DIR", built(house).join("host"));
    command
}

/// Where all of this is built.
fn built(house: &House) -> PathBuf {
    house.target.join("ffi")
}

/// Files below the project's root.
fn sources<'a>(house: &'a House, folder: &'a str, names: &'a [&str]) -> impl Iterator<Item = PathBuf> + 'a {
    names.iter().map(move |name| house.root.join(folder).join(name))
}

/// Writes what is asked and what has to come of it into a folder, of recorded flights as well.
fn ask(house: &House, folder: &Path, recorded: &Path) -> Result<()> {
    run(reference(house, "write").arg(folder).arg(recorded))
}

/// Whether the replies in a folder are the expected ones: what `reference` says of it.
fn differs(house: &House, folder: &Path) -> Result<Result<String, String>> {
    let output = capture(reference(house, "compare").arg(folder))?;
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).trim().to_owned();
    Ok(if output.status.success() { Ok(text(&output.stdout)) } else { Err(text(&output.stderr)) })
}

fn reference(house: &House, task: &str) -> Command {
    let mut command = cargo(house, "run --quiet --locked --release --package reference --");
    command.arg(task);
    command
}

/// The replies are the expected ones.
fn must_be_the_same(house: &House, folder: &Path, whose: &str) -> Result<()> {
    match differs(house, folder)? {
        Ok(same) => {
            println!("{whose}: {same}");
            Ok(())
        }
        Err(other) => bail!("{whose}: {other}"),
    }
}

/// The control: with the last bit of one loss spoilt they are not.
fn must_differ(house: &House, folder: &Path, whose: &str) -> Result<()> {
    let found = differs(house, folder)?;
    ensure!(
        matches!(&found, Err(other) if other.starts_with("other bits")),
        "{whose}: one bit of one loss is spoilt, and the comparison says {found:?}"
    );
    println!("{whose}: the control is caught, one bit of one loss");
    Ok(())
}
