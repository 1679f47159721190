//! `cargo xtask firmware`: what flies on the drone, flown on the emulated chip of a drone.

mod budget;
pub(crate) mod chip;
mod elf;
mod figures;
mod flight;
pub(crate) mod toolchain;

use std::fs;

use anyhow::{Context as _, Result, bail, ensure};

use crate::house::{House, Proof, must_fail_with, run};
use figures::Figures;
use flight::Flights;
use toolchain::{Toolchain, toolchain};

pub(crate) use flight::recorded;

/// The workspace of the programs for the chip, and of those for the host that they are compared with.
pub(crate) const WORKSPACE: Proof = Proof("firmware");

/// Where it is.
const FOLDER: &str = "tests/firmware";

/// Where the docs tell what firmware costs.
const PAGE: &str = "docs/guide/firmware.md";

/// Builds the programs for the chip, flies them, and prints what they cost; an error in one line if that cannot be done
/// here.
pub(crate) fn firmware(house: &House) -> Result<()> {
    match toolchain(house)? {
        Ok(rust) => fly(house, rust).map(drop),
        Err(remedy) => bail!(remedy),
    }
}

/// The same where a chip is known to be there; and whether all of it would be noticed if it were not so.
pub(crate) fn prove(house: &House, rust: Toolchain) -> Result<()> {
    run(&mut house.cargo_in(WORKSPACE, "test --locked --features replay/explore"))?;
    run(&mut house
        .cargo_in(WORKSPACE, "clippy --locked --all-targets --features replay/explore -- -D warnings"))?;
    run(&mut rust.cargo(house, FOLDER, "clippy --locked --release --package image -- -D warnings"))?;
    run(&mut rust.cargo(
        house,
        FOLDER,
        "clippy --locked --release --package image --features explore --bin explore -- -D warnings",
    ))?;
    // The image of chains has no heap: with something in it that asks for one, it does not link.
    must_fail_with(
        &mut rust.cargo(
            house,
            FOLDER,
            "build --locked --release --package image --features explore --bin chain",
        ),
        "no global memory allocator found",
    )?;
    let (flights, table) = fly(house, rust)?;
    flights.notice_what_is_planted()?;
    let page = house.root.join(PAGE);
    let told = fs::read_to_string(&page).with_context(|| format!("cannot read {}", page.display()))?;
    budget::are_in(&told, &table)
}

fn fly(house: &House, rust: Toolchain) -> Result<(Flights, String)> {
    println!("builds with {}", rust.word());
    // The image of chains without a heap: linked with no allocator anywhere.
    run(&mut rust.cargo(house, FOLDER, "build --locked --release --package image"))?;
    run(&mut rust.cargo(
        house,
        FOLDER,
        "build --locked --release --package image --features explore --bin explore",
    ))?;
    let built = rust.built(house, FOLDER);

    let mut figures = Figures::default();
    let grows = elf::flash_bytes(&built.join("with_node"))?
        .checked_sub(elf::flash_bytes(&built.join("without_node"))?);
    figures.put("flash", grows.context("a program with a node is smaller than one without")?);
    figures.put("doubles", elf::doubles(&built.join("chain"))?.len() as u64);
    let control = elf::doubles(&built.join("explore"))?;
    ensure!(!control.is_empty(), "an explorer's sines compute with doubles, and the check sees none");

    let flights = Flights::record(house, built)?;
    let ticks = flights.fly(&mut figures)?;
    let table = budget::table(&figures)?;
    println!("\n{table}\nsame bits: {ticks} ticks, 0 differences\n");
    budget::hold(&figures)?;
    Ok((flights, table))
}
