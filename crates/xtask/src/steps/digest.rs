//! One mission and one seed give one digest: twice, in debug and release, in the profile of the tests with every
//! feature on, and with the CPU's FMA and AVX2 hidden from the system's libraries.

use std::process::Command;

use anyhow::{Context as _, Result, ensure};

use super::{LIBM_ONLY, Outcome};
use crate::house::{House, read, run};

/// What is flown: a scenario, and keys set otherwise than in it.
type Mission = (&'static str, &'static [&'static str]);

/// A clean flight; one whose laws are switched off so that it ends at a wall, where rapier moves the body; one with
/// the other speed law and with tunnel distances in its radio; an exploration with all that is random in one; one with
/// quadrotors.
const MISSIONS: [Mission; 5] = [
    ("corner", &[]),
    ("corner", &["center.c_t_per_s=0.0", "center.c_r_rad_per_s_m=0.0"]),
    ("circuit-frontiers2021", &[]),
    ("apartment", &["explore.position_sigma_m=0.02", "explore.scan_s=0.2", "explore.range_m=3"]),
    ("lab", &["explore.position_sigma_m=0.005"]),
];

/// Makes the system's C library choose its functions as on a CPU without FMA and AVX2 (glibc on x86-64).
const PLAIN_CPU: (&str, &str) = ("GLIBC_TUNABLES", "glibc.cpu.hwcaps=-FMA,-AVX2");

pub(super) fn agrees(house: &House) -> Result<Outcome> {
    run(&mut house.cargo_in(LIBM_ONLY, "build --locked --release --workspace --features control"))?;
    run(&mut house.cargo_in(LIBM_ONLY, "build --locked --bin digest"))?;
    // Words of the step `test`: whole workspace, same features, so that nothing compiles a second time.
    run(&mut house.cargo("test --locked --profile checked --workspace --tests --no-run"))?;
    for mission in MISSIONS {
        flown_alike(house, mission)?;
    }
    plain_cpu_shows(house)?;
    Ok(Outcome::Passed)
}

fn flown_alike(house: &House, mission: Mission) -> Result<()> {
    let flown = |profile: &str, seed: &str| {
        let mut command = program(house, profile, "digest");
        command.args([mission.0, seed]).args(mission.1);
        command
    };
    let first = read(&mut flown("release", "1"))?;
    ensure!(first.len() == 16, "a digest has 16 digits, this one is `{first}`");
    println!("release: {first}");
    let same = |what: &str, other: String| {
        ensure!(other == first, "{what}: digest {other}, in release {first}");
        println!("{what}: the same");
        Ok(())
    };
    same("release again", read(&mut flown("release", "1"))?)?;
    same("debug", read(&mut flown("debug", "1"))?)?;
    same("release, plain CPU", read(flown("release", "1").env(PLAIN_CPU.0, PLAIN_CPU.1))?)?;
    same("command line, profile of the tests, all features", command_line(house, mission)?)?;

    let other = read(&mut flown("release", "2"))?;
    ensure!(other != first, "control: seed 2 gives the digest of seed 1");
    println!("control, seed 2: {other}");
    Ok(())
}

fn program(house: &House, profile: &str, name: &str) -> Command {
    Command::new(house.built(LIBM_ONLY).join(profile).join(name))
}

/// The digest as a user sees it.
fn command_line(house: &House, mission: Mission) -> Result<String> {
    let mut command = Command::new(house.target.join("checked/uchain"));
    command.args(["run", mission.0, "--seed", "1", "--json", "--force", "--out"]);
    command.arg(house.target.join("proof/run"));
    for set in mission.1 {
        command.args(["--set", set]);
    }
    let summary = read(&mut command)?;
    let digest = summary.split("\"digest\"").nth(1).and_then(|rest| rest.split('"').nth(1));
    Ok(digest.with_context(|| format!("no digest in {summary}"))?.into())
}

/// Hiding the FMA has to change what the system's exp returns, or the comparison above compared nothing.
fn plain_cpu_shows(house: &House) -> Result<()> {
    if !has_fma() || !cfg!(target_env = "gnu") {
        println!("control, plain CPU: nothing to hide on this machine");
        return Ok(());
    }
    let usual = read(&mut program(house, "release", "control"))?;
    let plain = read(program(house, "release", "control").env(PLAIN_CPU.0, PLAIN_CPU.1))?;
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
