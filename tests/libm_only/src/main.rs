//! `digest SCENARIO SEED [KEY=VALUE]...`: flies a compiled-in scenario and prints the digest of the run; `digest libm`
//! says whether it computes with the mathematics of `uchain_libm`.

use std::{env, error::Error, process::ExitCode};

// Brings the program its own exp, sin and log, for what rapier and parry ask of the system.
use uchain_libm as _;
use uchain_sim::{config::Source, mathematics, registry::Registry};

fn main() -> ExitCode {
    let args: Vec<String> = env::args().skip(1).collect();
    match digest(&args) {
        Ok(digest) => {
            println!("{digest}");
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn digest(args: &[String]) -> Result<String, Box<dyn Error>> {
    if args == ["libm"] {
        return Ok(format!("libm: {}", mathematics::is_libm()));
    }
    let [scenario, seed, sets @ ..] = args else {
        return Err("usage: digest SCENARIO SEED [KEY=VALUE]...".into());
    };
    let scene = Registry::default().read(&Source::find(scenario)?, sets)?;
    Ok(scene.fly(seed.parse()?, &mut ())?.digest().to_owned())
}
