//! Into a real cave, as its survey has it.

use std::path::Path;

use uchain_sim::{config::Source, run::run};

use crate::lay;

/// The stream of Dow Cave from its entrance on: passages of 1.7 m, a bend every ten metres. Links reach about 4 m there, so
/// a hundred metres take more than 20 relays, whose launches take the time.
const DOW: &str = r#"
name = "dow"
duration_s = 1500.0

[map.survex]
file = "FILE"
from = "dowcave.entrance"
to = "dow1.24c"

[chain]
uavs = 26
base_m = [398378.0, 474300.0]
goal_m = [398455.01, 474322.07]
heading_deg = -27.5
spacing_m = 0.14
endurance_s = 1800.0

[[pilot]]
start_s = 0.0
speed_mps = 0.2
"#;

#[test]
fn a_chain_flies_a_hundred_metres_into_the_dow_cave() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data/caves/dow_providence/DowProv.3d");
    if !file.is_file() {
        assert!(std::env::var_os("CI").is_none_or(|ci| ci != "true"), "{} is absent", file.display());
        eprintln!("skipped: {} is absent", file.display());
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let scenario = folder.path().join("dow.toml");
    std::fs::write(&scenario, DOW.replace("FILE", file.to_str().unwrap())).unwrap();
    let course = lay(&Source::find(scenario.to_str().unwrap()).unwrap(), &[]);
    let summary = run(&course, 1, &mut ()).unwrap();
    assert!(summary.head_reach_m > 100.0, "{} m", summary.head_reach_m);
    assert_eq!(summary.wall_contacts, 0);
}
