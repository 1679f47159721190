//! A strategy of one's own: where an explorer flies next, given all that it knows.
//!
//! `cargo run --release --example own_strategy`
//!
//! ```text
//! cssg: 74 rounds; 99.9 % seen, no frontier left, all home
//! widest: 81 rounds; 99.9 % seen, no frontier left, all home
//! ```

use std::error::Error;

use uchain_core::explore::{Cssg, Goal, Strategy, StrategyKind, View};
use uchain_libm as _; // the same bits on every system
use uchain_sim::{
    config::builtin,
    mission::{
        Scene as _,
        explore::{ExploreSummary, Site, SiteExtensions},
    },
    registry::{AnyMission, Of, Registry},
};

/// Of the frontiers here it takes the widest one; without any it goes where CSSG would go. Every robot has a copy of its
/// own, which may remember things. What is random is drawn from `view.draw`, so that a run can be flown again.
#[derive(Debug, Clone)]
struct Widest;

impl Strategy for Widest {
    fn goal(&mut self, view: &mut View<'_>) -> Goal {
        match view.merged().max_by_key(|candidate| candidate.run.count) {
            Some(widest) => Goal::Frontier(widest),
            None => Cssg.goal(view),
        }
    }
}

/// Its word in scenarios, `explore.strategy = "widest"`, and what `uchain explain explore.strategy` says of it.
const WIDEST: StrategyKind = StrategyKind::new("widest", "The widest frontier here.", |_| Box::new(Widest));

/// The missions of this program: explorations that know the word.
static MISSIONS: [&dyn AnyMission; 1] =
    [&Of::<Site>::with(SiteExtensions { strategies: &[WIDEST], ..Site::BUILTIN })];

fn main() -> Result<(), Box<dyn Error>> {
    let registry = Registry::new(&MISSIONS);
    let apartment = builtin("apartment").ok_or("apartment comes along")?;
    for strategy in ["cssg", "widest"] {
        let scene = registry.read(&apartment, &[format!("explore.strategy={strategy}")])?;
        let flown = scene.fly(1, &mut ())?;
        let summary = flown.summary::<ExploreSummary>().ok_or("an exploration")?;
        println!("{strategy}: {} rounds; {}", summary.iterations, summary.verdict);
    }
    Ok(())
}
