//! Benchmarks, a file a room: `cargo bench`, or `cargo bench -- laws` for some of them; `cargo xtask bench` makes one
//! table of them. A group is named after what is measured, one element of it in brackets; its function `ours` stands
//! beside the baseline's.

mod count;
mod explore;
mod laws;
mod maps;
mod plan;
mod rays;
mod record;
mod run;
mod w1;

use std::process::ExitCode;

// What is measured is what flies: with the mathematics of the command line.
use uchain_libm as _;

fn main() -> ExitCode {
    let args: Vec<String> = std::env::args().skip(1).filter(|arg| arg != "--bench").collect();
    if args.first().is_some_and(|arg| arg == "count") {
        return count::count(args.get(1).map(String::as_str));
    }
    let mut criterion = criterion::Criterion::default().configure_from_args();
    laws::all(&mut criterion);
    rays::all(&mut criterion);
    w1::all(&mut criterion);
    record::all(&mut criterion);
    run::all(&mut criterion);
    explore::all(&mut criterion);
    plan::all(&mut criterion);
    criterion.final_summary();
    ExitCode::SUCCESS
}
