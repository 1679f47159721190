//! On maps of kilometres a run is what it is on small ones.

use uchain_sim::{config::Source, run::run};

use crate::{lay, shared_cases};

/// The way from base to goal is searched on cells wider than the distance beyond which walls no longer push.
#[test]
fn a_map_of_twelve_kilometres_is_laid_without_a_panic() {
    let Some(cases) = shared_cases() else { return };
    let case = cases.join("far/panic1.toml");
    let course = lay(&Source::find(case.to_str().unwrap()).unwrap(), &[]);
    assert_eq!(course.scenario.name, "panic1");
}

/// 50 km from the middle of a tunnel of 100 km a tick's way at 0.1 m/s is about the spacing of two coordinates.
#[test]
fn a_head_in_100_km_of_tunnel_comes_as_far_as_in_100_m() {
    let Some(cases) = shared_cases() else { return };
    let source = Source::find(cases.join("far/slow-far-from-centre.toml").to_str().unwrap()).unwrap();
    let short = "map.walls.outer_m=[[0.0, 0.0], [100.0, 0.0], [100.0, 1.0], [0.0, 1.0]]";
    for (speed_mps, reach_m) in [(0.05, 2.9), (0.1, 5.8), (0.3, 17.5)] {
        let pilot = format!("pilot=[{{start_s=0.0, speed_mps={speed_mps}}}]");
        let [far_m, near_m] = [vec![&*pilot], vec![&*pilot, short]]
            .map(|sets| f64::from(run(&lay(&source, &sets), 1, &mut ()).unwrap().head_reach_m));
        assert!((near_m / reach_m - 1.0).abs() < 0.1, "{near_m} m at {speed_mps} m/s");
        // Of the way, and what a single coordinate is rounded by there.
        assert!(
            (far_m - near_m).abs() < 1e-3 * near_m + 0.002,
            "{far_m} m for {near_m} m at {speed_mps} m/s"
        );
    }
}
