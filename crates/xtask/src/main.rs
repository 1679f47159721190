//! The gate: every check of the project, one after the other, stopping at the first that fails; the benchmarks; and the
//! page.

mod args;
mod bench;
mod firmware;
mod house;
mod maps;
mod nm;
mod rooms;
mod steps;
mod web;

use std::{
    process::ExitCode,
    time::{Instant, SystemTime},
};

use args::Wish;
use house::House;
use steps::{Outcome, Step};

fn main() -> ExitCode {
    if std::env::var_os(steps::python::PACKS_WITH).is_some() {
        return steps::python::build_for_maturin();
    }
    match args::parse(std::env::args().skip(1)) {
        Ok(Wish::Help) => {
            print!("{}", args::help());
            ExitCode::SUCCESS
        }
        Ok(Wish::Test(steps)) => test(&steps),
        Ok(Wish::Bench(asked)) => match bench::bench(&House::find(), &asked) {
            Ok(()) => ExitCode::SUCCESS,
            Err(error) => {
                eprintln!("\nbench: {error:#}");
                ExitCode::FAILURE
            }
        },
        Ok(Wish::Rooms) => match rooms::graphs(&House::find().root.join("crates")) {
            Ok(graphs) => {
                for graph in graphs {
                    print!("{}", graph.table());
                }
                ExitCode::SUCCESS
            }
            Err(error) => {
                eprintln!("rooms: {error:#}");
                ExitCode::FAILURE
            }
        },
        Ok(Wish::Maps(uchain)) => match maps::maps(&House::find(), uchain.as_deref()) {
            Ok(()) => ExitCode::SUCCESS,
            Err(error) => {
                eprintln!("maps: {error:#}");
                ExitCode::FAILURE
            }
        },
        Ok(Wish::Firmware) => match firmware::firmware(&House::find()) {
            Ok(()) => ExitCode::SUCCESS,
            Err(error) => {
                eprintln!("firmware: {error:#}");
                ExitCode::FAILURE
            }
        },
        Ok(Wish::Web(effort)) => match web::web(&House::find(), effort) {
            Ok(_) => ExitCode::SUCCESS,
            Err(error) => {
                eprintln!("web: {error:#}");
                ExitCode::FAILURE
            }
        },
        Err(message) => {
            eprintln!("{message}\n\n{}", args::help());
            ExitCode::from(2)
        }
    }
}

fn test(steps: &[&Step]) -> ExitCode {
    let house = House::find();
    let start = now();
    let mut skipped = Vec::new();
    for (i, step) in steps.iter().enumerate() {
        println!("\n==> [{}/{}] {}: {}", i + 1, steps.len(), step.name, step.about);
        let begun = now();
        match (step.run)(&house) {
            Ok(Outcome::Passed) => {
                println!("<== {} passed in {:.1} s", step.name, begun.elapsed().as_secs_f64());
            }
            Ok(Outcome::Skipped(why)) => {
                println!("<== {} skipped: {why}", step.name);
                skipped.push(step.name);
            }
            Err(error) => {
                eprintln!("\nstep `{}` failed: {error:#}", step.name);
                eprintln!("to run it alone: cargo xtask test {}", step.name);
                return ExitCode::FAILURE;
            }
        }
    }
    let seconds = start.elapsed().as_secs_f64();
    let passed = steps.len() - skipped.len();
    if skipped.is_empty() {
        println!("\nall {passed} steps passed in {seconds:.0} s");
    } else {
        println!("\n{passed} steps passed in {seconds:.0} s, skipped: {}", skipped.join(", "));
    }
    ExitCode::SUCCESS
}

#[expect(
    clippy::disallowed_methods,
    reason = "the gate tells how long each step takes; nothing simulated runs here"
)]
fn now() -> Instant {
    Instant::now()
}

#[expect(
    clippy::disallowed_methods,
    reason = "tells this run's estimates from older ones; nothing simulated runs here"
)]
fn system_now() -> SystemTime {
    SystemTime::now()
}
