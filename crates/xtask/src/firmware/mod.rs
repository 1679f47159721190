//! `cargo xtask firmware`: what flies on the drone, flown on the emulated chip of a drone.

pub(crate) mod chip;
pub(crate) mod toolchain;

use anyhow::{Result, bail};

use crate::house::{House, run};
use toolchain::{Toolchain, toolchain};

/// The workspace of the programs for the chip.
const FOLDER: &str = "tests/firmware";

/// How long the chip may take (s).
const LIMIT_S: u64 = 120;

/// Builds the programs for the chip and flies them; an error in one line if that cannot be done here.
pub(crate) fn firmware(house: &House) -> Result<()> {
    match toolchain(house)? {
        Ok(rust) => fly(house, rust),
        Err(remedy) => bail!(remedy),
    }
}

/// The same where a chip is known to be there.
pub(crate) fn fly(house: &House, rust: Toolchain) -> Result<()> {
    println!("builds with {}", rust.word());
    run(&mut rust.cargo(house, FOLDER, "build --locked --release --package image"))?;
    let folder = house.target.join("chip");
    print!("{}", chip::run(&rust.built(house, FOLDER).join("chain"), &folder, &[], LIMIT_S)?);
    Ok(())
}
