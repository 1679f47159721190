//! Flies a scenario that comes along and reads what it came to.
//!
//! `cargo run --release --example fly`
//!
//! ```text
//! corner: 8.1 of 8.8 m flown; 3 links within 60 dB, the worst 56.5 dB; its link held the head back for 4.8 s, 1.0 m
//! take-offs at [0.0, 19.6, 48.6] s
//! link of UAV 0: 56.5 dB
//! link of UAV 1: 55.5 dB
//! link of UAV 2: 56.1 dB
//! digest 4cb3614f4c4f29fd
//! ```

use std::error::Error;

// Brings the program its own exp, sin and log: the same bits on every system. Without this line all works as well, and the
// last bits depend on the system's C library.
use uchain_libm as _;
use uchain_sim::{config::builtin, mission::chain::Course, run::run};

fn main() -> Result<(), Box<dyn Error>> {
    // A scenario is text in TOML. `Source::find` takes a file's path as well as the name of one that comes along.
    let corner = builtin("corner").ok_or("corner comes along")?;

    // A course is a scenario of a chain: read, checked and laid out in its map. Any number of runs share it. What is set
    // here is written over the scenario; a mistyped key is an error that names the nearest one.
    let course = Course::read(&corner, &["radio.sigma_db=3".to_owned()])?;

    // A run is a function of course and seed. The third argument is who watches every frame: nobody.
    let summary = run(&course, 1, &mut ())?;

    // All that `summary.json` holds is a field, with its unit in the name.
    println!("{}: {}", summary.scenario, summary.verdict);
    println!("take-offs at {:?} s", summary.launches_s);
    for link in &summary.links {
        println!("link of UAV {}: {:.1} dB", link.uav, link.true_db);
    }
    println!("digest {}", summary.digest);

    // The same seed gives the same run, bit for bit, and another one another.
    assert_eq!(run(&course, 1, &mut ())?, summary);
    assert_ne!(run(&course, 2, &mut ())?.digest, summary.digest);
    Ok(())
}
