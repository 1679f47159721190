//! Places that nobody drew for robots: a city, an office building.

use std::path::Path;

use uchain_sim::{
    analyse::Outcome,
    config::Source,
    mission::{Stopped, explore::Site},
};

use super::summary;
use crate::shared_data;

fn explored(map: &Path, sets: &[&str], nodes: usize, coverage: f64, noted: &str) {
    let sets: Vec<String> = sets.iter().map(ToString::to_string).collect();
    let source = Source::find(map.to_str().unwrap()).unwrap();
    let site = Site::read(&source, &sets).unwrap();
    let notes = site.notes();
    assert!(notes.iter().any(|note| note.contains(noted)), "{notes:?}");
    let summary = summary(&site, 1);
    // Both have doors of less than 0.9 m with rooms behind them that nobody saw, and say so.
    let Outcome::Unseen { behind, .. } = summary.verdict.outcome() else { panic!("{}", summary.verdict) };
    assert!(*behind > 0.8 * (1.0 - summary.coverage), "{}", summary.verdict);
    assert_eq!((summary.stopped, summary.hubs_left), (Some(Stopped::Explored), 0));
    assert_eq!((summary.wall_contacts, summary.robot_contacts), (0, 0));
    assert!(summary.coverage > coverage, "{}", summary.coverage);
    assert!(summary.nodes.iter().sum::<u32>() as usize > nodes, "{:?}", summary.nodes);
}

#[test]
fn a_hundred_robots_explore_a_city_and_come_home() {
    let Some(data) = shared_data() else { return };
    let city = data.join("maps/movingai/Berlin_1_256.map");
    explored(
        &city,
        &["map.cell_m=0.25", "explore.robots=100"],
        2500,
        0.96,
        "of 2741.5 m2 in reach (3 %) lie in or behind passages narrower than 0.90 m, in 8 places",
    );
}

#[test]
fn twenty_robots_explore_an_office_building_and_come_home() {
    let Some(data) = shared_data() else { return };
    let building = data.join("maps/ros/willow/willow-full-0.05.pgm");
    explored(
        &building,
        &["map.cell_m=0.05", "explore.robots=20"],
        1000,
        0.89,
        "of 1106.6 m2 in reach (45 %) lie in or behind passages narrower than 0.90 m, in 48 places",
    );
}
