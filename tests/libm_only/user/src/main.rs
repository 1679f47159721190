//! Flies a mission and says whether this program computes with the mathematics of `uchain_libm`. It does not: it lacks
//! the line `use uchain_libm as _;`.

use std::{error::Error, process::ExitCode};

use uchain_sim::{config::builtin, mathematics, mission::chain::Course, run::run};

fn main() -> ExitCode {
    match digest() {
        Ok(digest) => {
            println!("libm: {}, digest {digest}", mathematics::is_libm());
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn digest() -> Result<String, Box<dyn Error>> {
    let corner = builtin("corner").ok_or("corner is built in")?;
    let course = Course::read(&corner, &["duration_s=20".to_owned()])?;
    Ok(run(&course, 1, &mut ())?.digest)
}
