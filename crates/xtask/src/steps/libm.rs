//! A program that links `uchain-libm` takes no transcendental function from the system, and the check would notice if
//! it did. A program that only links the simulation keeps the mathematics it had.

use std::process::Command;

use anyhow::{Result, ensure};

use super::{LIBM_ONLY, Outcome};
use crate::{
    house::{House, read, run},
    nm,
};

pub(super) fn imports_nothing(house: &House) -> Result<Outcome> {
    if !nm::is_there()? {
        return Ok(Outcome::Skipped("`nm` is missing (apt-get install binutils)".into()));
    }
    run(&mut house.cargo_in(LIBM_ONLY, "build --locked --release --workspace --features control"))?;
    let built = house.built(LIBM_ONLY).join("release");
    let found = nm::imported_maths(&built.join("control"))?;
    ensure!(found == ["exp"], "the control calls the system's exp, and the check sees {found:?}");
    println!("the control is caught: it imports {found:?}");

    let found = nm::imported_maths(&built.join("digest"))?;
    ensure!(
        found.is_empty(),
        "the simulation imports {found:?} from the system; its results depend on the CPU"
    );
    println!("the simulation imports none");

    let brought = nm::brought_maths(&built.join("digest"))?;
    for name in ["exp", "expf", "log2f", "sincosf", "atan2f"] {
        ensure!(
            brought.iter().any(|brought| brought == name),
            "the control brings {name} of its own, and the check sees {brought:?}"
        );
    }
    println!("the control is seen: with `use uchain_libm as _;` a program brings {} names", brought.len());
    let brought = nm::brought_maths(&built.join("user"))?;
    ensure!(
        brought.is_empty(),
        "whoever links the simulation gets {brought:?} under the system's names, asked for or not"
    );
    println!("a user's program brings none");
    knows_whose(house)?;
    Ok(Outcome::Passed)
}

/// A program can tell whose mathematics it computes with.
fn knows_whose(house: &House) -> Result<()> {
    let built = house.built(LIBM_ONLY).join("release");
    let with = read(Command::new(built.join("digest")).arg("libm"))?;
    ensure!(with == "libm: true", "the program that links uchain_libm says `{with}`");
    let without = read(&mut Command::new(built.join("user")))?;
    ensure!(without.starts_with("libm: false, digest "), "the program that does not says `{without}`");
    println!("each knows it: `{with}` and `{without}`");
    Ok(())
}
