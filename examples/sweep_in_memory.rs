//! Flies many runs on all processors and keeps what they came to in memory: how well a chain levels, over the noise of
//! the radio.
//!
//! `cargo run --release --example sweep_in_memory`
//!
//! ```text
//! noise 0 dB: losses 0.2 dB apart at the end, in the mean
//! noise 4 dB: losses 1.0 dB apart at the end, in the mean
//! noise 8 dB: losses 4.2 dB apart at the end, in the mean
//! ```

use std::error::Error;

use uchain_libm as _; // the same bits on every system
use uchain_sim::{
    config::builtin,
    mission::chain::Summary,
    sweep::{Design, DesignText, Sweep},
};

/// Runs of each variant.
const REPLICATES: u64 = 8;

fn main() -> Result<(), Box<dyn Error>> {
    // What is varied is written as behind `uchain sweep --vary`: any key, with a list or a range with both ends. Several
    // give every combination.
    let vary = vec!["radio.sigma_db=0..8/3".to_owned()];
    let design = Design::parse(&DesignText { vary, table: None }, "")?;
    let scenario = builtin("corner").ok_or("corner comes along")?;
    let sets = vec!["duration_s=120".to_owned()];
    let sweep = Sweep::new(scenario, sets, design, REPLICATES, 1)?;
    // Every variant is looked at before the first run.
    sweep.check()?;

    // Any function of a run will do; results are in the order of the runs, whoever flew them. All variants of a replicate
    // have the same seed, so that they can be compared pair by pair. A run that fails is an `Err`, and takes no other
    // with it.
    let spread_db = sweep.each(|scene, run| {
        let flown = scene.fly(run.seed, &mut ()).map_err(|error| error.to_string())?;
        let summary = flown.summary::<Summary>().ok_or("a chain")?;
        summary.spread_db.ok_or_else(|| "no two links".to_owned())
    });
    let spread_db: Vec<f32> = spread_db.into_iter().map(Result::flatten).collect::<Result<_, _>>()?;

    for (sigma_db, runs) in [0, 4, 8].iter().zip(spread_db.chunks(REPLICATES as usize)) {
        let mean_db = runs.iter().sum::<f32>() / runs.len() as f32;
        println!("noise {sigma_db} dB: losses {mean_db:.1} dB apart at the end, in the mean");
    }
    Ok(())
}
