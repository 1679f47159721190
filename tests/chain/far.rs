//! On maps of kilometres a run is what it is on small ones.

use uchain_sim::config::Source;

use crate::{lay, shared_cases};

/// The way from base to goal is searched on cells wider than the distance beyond which walls no longer push.
#[test]
fn a_map_of_twelve_kilometres_is_laid_without_a_panic() {
    let Some(cases) = shared_cases() else { return };
    let case = cases.join("far/panic1.toml");
    let course = lay(&Source::find(case.to_str().unwrap()).unwrap(), &[]);
    assert_eq!(course.scenario.name, "panic1");
}
