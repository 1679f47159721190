//! What C has to answer: flies chains by `uchain-core` itself, writes down what each UAV is shown, and what it says, asks
//! for and believes. The harness in C is shown the same, and what it answers is compared.
//!
//! ```text
//! reference write FOLDER [TRACE]   asked.bin and expected.bin, of recorded flights as well
//! reference compare FOLDER         expected.bin with replies.bin
//! ```

mod compare;
mod flight;
mod steps;
mod trace;
mod world;

use std::{env, error::Error, path::PathBuf, process::ExitCode};

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<(), Box<dyn Error>> {
    let args: Vec<String> = env::args().skip(1).collect();
    match args.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["write", folder] => flight::write(&PathBuf::from(folder), None),
        ["write", folder, trace] => flight::write(&PathBuf::from(folder), Some(&PathBuf::from(trace))),
        ["compare", folder] => compare::compare(&PathBuf::from(folder)),
        _ => Err("usage: reference write FOLDER [TRACE] | reference compare FOLDER".into()),
    }
}
