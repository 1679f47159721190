//! `uchain-core` links without std and, but for exploration, without a heap; the build that claims so would notice if
//! it did not.

use std::process::Command;

use anyhow::{Result, ensure};

use super::{NO_STD, Outcome};
use crate::{
    house::{House, must_fail_with, run},
    nm,
};

/// The functions of the proof that call the laws.
const LAWS: &[&str] = &["fly", "laws", "hover", "complain"];
/// And with exploration, on a heap that the proof brings.
const EXPLORING: &[&str] = &["fly", "laws", "hover", "complain", "explore"];

/// What the core may ask of its host: copying and comparing memory, which every target brings.
const MEMORY: [&str; 5] = ["memcpy", "memmove", "memset", "memcmp", "bcmp"];

pub(super) fn links(house: &House) -> Result<Outcome> {
    run(&mut house.cargo_in(NO_STD, "build --locked --release"))?;
    asks_for_memory_only(house, LAWS)?;
    run(&mut house.cargo_in(NO_STD, "build --locked --release --features explore"))?;
    asks_for_memory_only(house, EXPLORING)?;
    let control = |feature| house.cargo_in(NO_STD, &format!("build --locked --release --features {feature}"));
    must_fail_with(&mut control("control-std"), "found duplicate lang item `panic_impl`")?;
    must_fail_with(&mut control("control-alloc"), "no global memory allocator found")?;
    Ok(Outcome::Passed)
}

/// Links the archive with nothing else, and looks at what is still open.
fn asks_for_memory_only(house: &House, exports: &[&str]) -> Result<()> {
    if !nm::is_there()? {
        println!(
            "`nm` is missing (apt-get install binutils): what the core asks of its host is not looked at"
        );
        return Ok(());
    }
    let built = house.built(NO_STD).join("release");
    let linked = built.join("no_std.so");
    let mut link = Command::new("cc");
    link.args(["-shared", "-nostdlib"]).args(exports.iter().map(|name| format!("-Wl,--undefined={name}")));
    run(link.arg("-o").arg(&linked).arg(built.join("libno_std.a")))?;

    let asked = nm::imported(&linked)?;
    println!("the core asks its host for {asked:?}");
    let stray: Vec<_> = asked.iter().filter(|name| !MEMORY.contains(&name.as_str())).collect();
    ensure!(stray.is_empty(), "uchain-core asks its host for {stray:?}");
    Ok(())
}
