//! Explorations end at home, with everything seen and nothing touched.

mod invariants;
mod own_strategy;
mod passages;
mod paths;
mod radio;
mod real_maps;
mod recording;
mod strategies;
mod table;
mod vehicles;

use std::sync::Arc;

use uchain_sim::{
    config::builtin,
    mission::explore::{ExploreSummary, Site},
    run::run,
};

/// A compiled-in exploration with keys set.
fn site(name: &str, sets: &[&str]) -> Arc<Site> {
    let sets: Vec<String> = sets.iter().map(ToString::to_string).collect();
    Site::read(&builtin(name).expect("a compiled-in scenario"), &sets).unwrap_or_else(|e| panic!("{e}"))
}

fn summary(site: &Arc<Site>, seed: u64) -> ExploreSummary {
    run(site, seed, &mut ()).expect("a run")
}
