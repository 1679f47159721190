//! What flies on the drone, on the emulated chip of a drone: the same bits, within its budgets.

use anyhow::{Result, bail};

use super::Outcome;
use crate::{
    firmware::{self, toolchain::toolchain},
    house::{House, ci},
};

pub(super) fn flies_on_the_chip(house: &House) -> Result<Outcome> {
    match toolchain(house)? {
        Ok(rust) => firmware::prove(house, rust).map(|()| Outcome::Passed),
        Err(remedy) if ci() => bail!(remedy),
        Err(remedy) => Ok(Outcome::Skipped(remedy)),
    }
}
