//! The steps that cargo does alone.

use anyhow::Result;

use super::{LIBM_ONLY, NO_STD, Outcome};
use crate::{
    firmware,
    house::{House, run},
};

pub(super) fn fmt(house: &House) -> Result<Outcome> {
    run(&mut house.cargo("fmt --all --check"))?;
    for proof in [NO_STD, LIBM_ONLY, firmware::WORKSPACE] {
        run(&mut house.cargo_in(proof, "fmt --all --check"))?;
    }
    Ok(Outcome::Passed)
}

pub(super) fn clippy(house: &House) -> Result<Outcome> {
    run(&mut house.cargo("clippy --locked --profile checked --workspace --all-targets -- -D warnings"))?;
    Ok(Outcome::Passed)
}

/// Clippy is `cargo check` with more to say; one package at a time, so that no other one switches a feature on.
pub(super) fn lean(house: &House) -> Result<Outcome> {
    for package in ["uchain-core", "uchain-sim"] {
        run(&mut house.cargo(&format!(
            "clippy --locked --profile checked -p {package} --no-default-features -- -D warnings"
        )))?;
    }
    Ok(Outcome::Passed)
}

pub(super) fn doc(house: &House) -> Result<Outcome> {
    run(house
        .cargo("doc --locked --profile checked --workspace --no-deps")
        .env("RUSTDOCFLAGS", "-D warnings"))?;
    Ok(Outcome::Passed)
}

/// `--tests` means libraries, programs and integration tests; benchmarks are checked by clippy, and run by
/// hand.
pub(super) fn test(house: &House) -> Result<Outcome> {
    run(&mut house.cargo("test --locked --profile checked --workspace --tests"))?;
    Ok(Outcome::Passed)
}

pub(super) fn doctest(house: &House) -> Result<Outcome> {
    run(&mut house.cargo("test --locked --profile checked --workspace --doc"))?;
    Ok(Outcome::Passed)
}
