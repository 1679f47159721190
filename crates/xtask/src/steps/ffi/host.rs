//! C on a host: the same bits, wrong use under the eyes of sanitizers, and the app in a tunnel that stands in for one.

use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
};

use anyhow::{Result, ensure};

use super::{APP, FOLDER, STRICT, ask, built, cargo, must_be_the_same, must_differ, sources};
use crate::house::{House, capture, run};

/// Sanitizers of addresses and of what C leaves undefined.
const WATCHED: [&str; 2] = ["-fsanitize=address,undefined", "-fno-sanitize-recover=all"];

pub(super) fn answers(house: &House, recorded: &Path) -> Result<()> {
    run(&mut cargo(house, "build --locked --release --package uchain-ffi"))?;
    let folder = built(house).join("on-host");
    fs::create_dir_all(&folder)?;
    let watched = watches(&folder)?;
    if !watched {
        println!("this cc has no sanitizers (apt-get install gcc brings them): wrong use is tried without");
    }
    let harness = sources(house, FOLDER, &["harness/main.c", "harness/abuse.c"]);
    let harness = compile(house, watched, &folder.join("harness"), &["crates/uchain-ffi/harness"], harness)?;
    let fly = |words: &[&str]| run(Command::new(&harness).args(words).current_dir(&folder));
    fly(&["abuse"])?;
    ask(house, &folder, recorded)?;
    fly(&["asked.bin", "replies.bin"])?;
    must_be_the_same(house, &folder, "C on this host")?;
    fly(&["asked.bin", "replies.bin", "plant"])?;
    must_differ(house, &folder, "C on this host")?;

    let app = sources(house, APP, &["src/uchain_app.c", "stubs/world.c"]);
    let app = compile(house, watched, &folder.join("crazyflie"), &["examples/crazyflie-app/stubs"], app)?;
    run(&mut Command::new(&app))?;
    let deaf = capture(Command::new(&app).arg("deaf"))?;
    ensure!(
        !deaf.status.success() && deaf.stdout.starts_with(b"not so: it takes off"),
        "the app without a radio has to stay on the ground, and says {}",
        String::from_utf8_lossy(&deaf.stdout)
    );
    println!("the control is caught: without a radio the app stays on the ground");
    Ok(())
}

/// Whether this compiler can watch a program.
fn watches(folder: &Path) -> Result<bool> {
    let source = folder.join("empty.c");
    fs::write(&source, "int main(void) { return 0; }\n")?;
    let mut command = Command::new("cc");
    command.args(WATCHED).arg(&source).arg("-o").arg(folder.join("empty"));
    Ok(capture(&mut command)?.status.success())
}

fn compile(
    house: &House,
    watched: bool,
    to: &Path,
    includes: &[&str],
    sources: impl Iterator<Item = PathBuf>,
) -> Result<PathBuf> {
    let mut command = Command::new("cc");
    command.args(["-std=c99", "-O1", "-g", "-ffp-contract=off"]).args(STRICT);
    for folder in [&[FOLDER], includes].concat() {
        command.arg("-I").arg(house.root.join(folder));
    }
    if watched {
        command.args(WATCHED);
    }
    command.args(sources).arg(built(house).join("host/release/libuchain_ffi.a"));
    run(command.args(["-Wl,--gc-sections", "-lm", "-o"]).arg(to))?;
    Ok(to.to_owned())
}
