//! One scenario and one seed give one digest: twice, in debug and release, in the profile of the tests with
//! every feature on, and with the CPU's FMA and AVX2 hidden from the system's libraries.

use std::process::Command;

use anyhow::{Context as _, Result, ensure};

use super::{LIBM_ONLY, Outcome};
use crate::house::{House, read, run};

const SCENARIO: &str = "corner";

/// Makes the system's C library choose its functions as on a CPU without FMA and AVX2 (glibc on x86-64).
const PLAIN_CPU: (&str, &str) = ("GLIBC_TUNABLES", "glibc.cpu.hwcaps=-FMA,-AVX2");

pub(super) fn agrees(house: &House) -> Result<Outcome> {
    run(&mut house.cargo_in(LIBM_ONLY, "build --locked --release --features control"))?;
    run(&mut house.cargo_in(LIBM_ONLY, "build --locked --bin digest"))?;
    let program = |profile: &str, name: &str| Command::new(house.built(LIBM_ONLY).join(profile).join(name));
    let digest = |profile: &str, seed: &str| {
        let mut command = program(profile, "digest");
        command.args([SCENARIO, seed]);
        command
    };

    let first = read(&mut digest("release", "1"))?;
    ensure!(first.len() == 16, "a digest has 16 digits, this one is `{first}`");
    println!("release: {first}");
    let same = |what: &str, other: String| {
        ensure!(other == first, "{what}: digest {other}, in release {first}");
        println!("{what}: the same");
        Ok(())
    };
    same("release again", read(&mut digest("release", "1"))?)?;
    same("debug", read(&mut digest("debug", "1"))?)?;
    same("release, plain CPU", read(digest("release", "1").env(PLAIN_CPU.0, PLAIN_CPU.1))?)?;
    same("command line, profile of the tests, all features", command_line(house)?)?;

    let other = read(&mut digest("release", "2"))?;
    ensure!(other != first, "control: seed 2 gives the digest of seed 1");
    println!("control, seed 2: {other}");
    plain_cpu_shows(&program)?;
    Ok(Outcome::Passed)
}

/// The digest as a user sees it.
fn command_line(house: &House) -> Result<String> {
    let out = house.target.join("proof/run");
    let out = out.to_str().context("the target folder's path is not UTF-8")?;
    let mut command = house.cargo("run --quiet --locked --profile checked -p uchain-cli -- run");
    let summary = read(command.args([SCENARIO, "--seed", "1", "--json", "--force", "--out", out]))?;
    let digest = summary.split("\"digest\"").nth(1).and_then(|rest| rest.split('"').nth(1));
    Ok(digest.with_context(|| format!("no digest in {summary}"))?.into())
}

/// Hiding the FMA has to change what the system's exp returns, or the comparison above compared nothing.
fn plain_cpu_shows(program: &dyn Fn(&str, &str) -> Command) -> Result<()> {
    if !has_fma() || !cfg!(target_env = "gnu") {
        println!("control, plain CPU: nothing to hide on this machine");
        return Ok(());
    }
    let usual = read(&mut program("release", "control"))?;
    let plain = read(program("release", "control").env(PLAIN_CPU.0, PLAIN_CPU.1))?;
    ensure!(usual != plain, "control: {}={} changes nothing in the system's exp", PLAIN_CPU.0, PLAIN_CPU.1);
    println!("control, plain CPU: the system's exp gives {usual} and {plain}");
    Ok(())
}

#[cfg(target_arch = "x86_64")]
fn has_fma() -> bool {
    std::arch::is_x86_feature_detected!("fma")
}

#[cfg(not(target_arch = "x86_64"))]
fn has_fma() -> bool {
    false
}
