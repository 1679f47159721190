//! `uchain-core` links without std and without a heap, and the build that claims so would notice if it did not.

use anyhow::{Result, ensure};

use super::{NO_STD, Outcome};
use crate::{
    house::{House, must_fail_with, run},
    nm,
};

/// What the core may ask of its host: copying and comparing memory, which every target brings.
const MEMORY: &[&str] = &["memcpy", "memmove", "memset", "memcmp", "bcmp"];

pub(super) fn links(house: &House) -> Result<Outcome> {
    run(&mut house.cargo_in(NO_STD, "build --locked --release"))?;
    if nm::is_there()? {
        let mut asked = nm::unresolved(&house.built(NO_STD).join("release/libno_std.a"))?;
        println!("asks its host for: {asked:?}");
        asked.retain(|name| !MEMORY.contains(&name.as_str()));
        ensure!(asked.is_empty(), "uchain-core asks its host for {asked:?}");
    } else {
        println!(
            "`nm` is missing (apt-get install binutils): what the archive asks of its host is not looked at"
        );
    }
    let control = |feature| house.cargo_in(NO_STD, &format!("build --locked --release --features {feature}"));
    must_fail_with(&mut control("control-std"), "duplicate lang item in crate `std`")?;
    must_fail_with(&mut control("control-alloc"), "no global memory allocator found")?;
    Ok(Outcome::Passed)
}
