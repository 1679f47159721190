//! The simulation takes no transcendental function from the system, and the check would notice if it did.

use anyhow::{Result, ensure};

use super::{LIBM_ONLY, Outcome};
use crate::{
    house::{House, run},
    nm,
};

pub(super) fn imports_nothing(house: &House) -> Result<Outcome> {
    if !nm::is_there()? {
        return Ok(Outcome::Skipped("`nm` is missing (apt-get install binutils)".into()));
    }
    run(&mut house.cargo_in(LIBM_ONLY, "build --locked --release --features control"))?;
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
    Ok(Outcome::Passed)
}
