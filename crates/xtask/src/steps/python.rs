//! The MCAP library of the format's own authors reads what we record: a second pair of eyes, in another language.

use std::{fs, process::Command};

use anyhow::{Context as _, Result, ensure};

use super::Outcome;
use crate::house::{self, House, read, run};

/// How the interpreter comes to where it is looked for.
const INSTALL: &str =
    "python3 -m venv target/venv && target/venv/bin/pip install -r tests/python/requirements.txt";

pub(super) fn reads_recordings(house: &House) -> Result<Outcome> {
    let python = house.target.join("venv/bin/python");
    if !python.exists() {
        ensure!(!house::ci(), "{} is missing: {INSTALL}", python.display());
        return Ok(Outcome::Skipped(format!("no Python with mcap in the target folder: {INSTALL}")));
    }
    // Words of the step `test`: whole workspace, same features, so that nothing compiles a second time.
    run(&mut house.cargo("test --locked --profile checked --workspace --tests --no-run"))?;
    // A chain and an exploration.
    for scenario in ["corner", "apartment"] {
        let folder = house.target.join("proof/recording").join(scenario);
        let uchain = || Command::new(house.target.join("checked/uchain"));
        run(uchain().args(["run", scenario, "--quiet", "--force", "--out"]).arg(&folder))?;
        let recording = folder.join("run.mcap");
        let inspected = folder.join("inspect.json");
        let json = read(uchain().args(["inspect", "--json"]).arg(&recording))?;
        fs::write(&inspected, json).with_context(|| format!("cannot write {}", inspected.display()))?;
        let script = house.root.join("tests/python/read_mcap.py");
        run(Command::new(&python).arg(script).arg(&recording).arg(&inspected))?;
    }
    Ok(Outcome::Passed)
}
