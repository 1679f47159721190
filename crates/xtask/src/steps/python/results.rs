//! The libraries of the formats' own authors read what we record and what a sweep leaves: a second pair of eyes, in
//! another language.

use std::{fs, process::Command};

use anyhow::{Context as _, Result};

use super::environment::Environment;
use crate::{
    house::{House, read, run},
    steps::Outcome,
};

pub(crate) fn are_read(house: &House) -> Result<Outcome> {
    let python = match Environment::of_tests(house)? {
        Ok(environment) => environment.python(),
        Err(why) => return Ok(Outcome::Skipped(why)),
    };
    // Words of the step `test`: whole workspace, same features, so that nothing compiles a second time.
    run(&mut house.cargo("test --locked --profile checked --workspace --tests --no-run"))?;
    let uchain = || Command::new(house.target.join("checked/uchain"));
    let script = |name: &str| house.root.join("tests/python").join(name);
    // A chain and an exploration.
    for scenario in ["corner", "apartment"] {
        let folder = house.target.join("proof/recording").join(scenario);
        run(uchain().args(["run", scenario, "--quiet", "--force", "--out"]).arg(&folder))?;
        let recording = folder.join("run.mcap");
        let inspected = folder.join("inspect.json");
        let json = read(uchain().args(["inspect", "--json"]).arg(&recording))?;
        fs::write(&inspected, json).with_context(|| format!("cannot write {}", inspected.display()))?;
        run(Command::new(&python).arg(script("read_mcap.py")).arg(&recording).arg(&inspected))?;
    }

    let folder = house.target.join("proof/sweep");
    // What an older version left there is another sweep.
    if folder.exists() {
        fs::remove_dir_all(&folder).with_context(|| format!("cannot remove {}", folder.display()))?;
    }
    // UAVs 0.05 m apart overlap: some runs fail.
    let design = "--set duration_s=30 --vary chain.spacing_m=0.05,0.25,0.5 --replicates 4 --quiet --out";
    run(uchain().args(["sweep", "corner"]).args(design.split(' ')).arg(&folder))?;
    run(uchain().args(["report", "--quiet"]).arg(&folder))?;
    run(Command::new(&python).arg(script("read_parquet.py")).arg(&folder))?;
    Ok(Outcome::Passed)
}
