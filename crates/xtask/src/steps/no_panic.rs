//! Nothing that flies can panic: a program that calls it all links only if the compiler has proved so.

use anyhow::Result;

use super::{NO_PANIC, Outcome};
use crate::house::{House, must_fail_with, run};

pub(super) fn links(house: &House) -> Result<Outcome> {
    run(&mut house.cargo_in(NO_PANIC, "run --locked --profile proof"))?;
    let control =
        |feature| house.cargo_in(NO_PANIC, &format!("build --locked --profile proof --features {feature}"));
    for feature in ["control-index", "control-inside"] {
        must_fail_with(&mut control(feature), "detected panic in function `decide`")?;
    }
    Ok(Outcome::Passed)
}
