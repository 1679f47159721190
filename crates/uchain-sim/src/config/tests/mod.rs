mod messages;
mod preset;

use std::path::PathBuf;

use proptest::prelude::*;

use super::{ConfigError, Source, TEXT_MAX_BYTES, builtin, builtin_names};
use crate::{
    mission::chain::{Course, Scenario},
    registry::{About, Registry},
};

const PLAIN: &str = r#"name = "plain"
duration_s = 10.0

[map.corridor]
centre_line_m = [[-0.6, 0.0], [8.0, 0.0]]
width_m = 0.8

[chain]
uavs = 3
base_m = [0.0, 0.0]

[equalize]
k_db_per_m = 20.0

[[pilot]]
start_s = 0.0
speed_mps = 0.2
"#;

fn source(text: &str) -> Source {
    Source { label: "plain.toml".to_owned(), text: text.to_owned(), folder: PathBuf::new() }
}

#[test]
fn every_builtin_scenario_is_named_as_its_file_and_passes_its_checks() {
    for &name in builtin_names() {
        let About { name: called, description, .. } =
            Registry::default().describe(&builtin(name).unwrap(), &[]).unwrap();
        assert_eq!(called, name);
        assert!(!description.is_empty(), "{name}");
    }
}

#[test]
fn a_set_writes_over_the_file_and_the_last_one_wins() {
    let sets =
        ["equalize.k_db_per_m=30", "pilot.0.follow=left", "link.lost_s=2", "link.lost_s=3", "name=other"];
    let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
    let scenario = Scenario::parse(&source(PLAIN), &sets).unwrap();
    assert_eq!(scenario.equalize.k_db_per_m, 30.0);
    assert_eq!(scenario.pilot[0].follow, uchain_core::chain::Follow::Left);
    assert_eq!(scenario.link.lost_s, 3.0);
    assert_eq!(scenario.name, "other");
}

#[test]
fn a_missing_map_names_the_file_looked_for_from_the_scenarios_folder() {
    let text = PLAIN
        .replace("[map.corridor]", "[map.ros]\nfile = \"maps/none.yaml\"")
        .replace("width_m = 0.8\n", "");
    let text = text.replace("centre_line_m = [[-0.6, 0.0], [8.0, 0.0]]\n", "");
    let source = Source { folder: PathBuf::from("some-folder"), ..source(&text) };
    let error = Course::read(&source, &[]).unwrap_err();
    assert!(matches!(error, ConfigError::Map { .. }), "{error}");
    assert!(error.to_string().contains("plain.toml:5: map.ros.file"), "{error}");
    assert!(error.to_string().contains("some-folder/maps/none.yaml"), "{error}");
}

#[test]
fn the_row_waits_head_farthest_and_the_last_uav_at_the_base() {
    let course = Course::read(&source(PLAIN), &["chain.spacing_m=0.3".to_owned()]).unwrap();
    let along_m: Vec<f32> = course.spawns.iter().map(|spawn| spawn.at.x).collect();
    assert_eq!(along_m, [0.6, 0.3, 0.0]);
}

#[test]
fn a_scenario_changed_in_code_is_checked_when_it_is_laid_out() {
    let source = source(PLAIN);
    let mut scenario = Scenario::parse(&source, &[]).unwrap();
    scenario.tof.period_s = 0.07;
    let error = Course::lay_out(scenario, &source).unwrap_err();
    assert!(error.to_string().contains("tof.period_s = 0.07"), "{error}");
}

#[test]
fn what_is_not_a_scenario_file_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("big.toml");
    std::fs::write(&path, vec![b'#'; TEXT_MAX_BYTES as usize + 1]).unwrap();
    assert!(matches!(Source::read(&path), Err(ConfigError::TooLong { .. })));
    std::fs::write(&path, [b'a', 0xff]).unwrap();
    assert!(matches!(Source::read(&path), Err(ConfigError::NotText { byte: 1, .. })));
    assert!(matches!(Source::read(folder.path()), Err(ConfigError::Read { .. })));
    std::fs::write(folder.path().join("mine.toml"), "").unwrap();
    let absent = Source::read(&folder.path().join("mien.toml")).unwrap_err().to_string();
    assert!(absent.contains("; did you mean '") && absent.contains("mine.toml'?"), "{absent}");
    assert!(Source::find("cornr").unwrap_err().to_string().contains("did you mean 'corner'?"));
}

#[test]
fn depth_counts_from_the_base_to_the_goal() {
    let course = |sets: &[&str]| {
        let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
        Course::read(&source(PLAIN), &sets).unwrap()
    };
    let tunnel = |course: &Course| {
        let at = course.map.to_local([3.0, 0.1]);
        (course.tunnel.as_ref().unwrap().length_m(), course.depth_m(at))
    };
    assert_eq!(tunnel(&course(&[])), (8.0, Some(3.0)));
    assert_eq!(tunnel(&course(&["chain.goal_m=[6, 0.2]"])), (6.0, Some(3.0)));
    let (length_m, depth_m) = tunnel(&course(&["chain.base_m=[7, 0]", "chain.heading_deg=180"]));
    assert!((length_m - 7.6).abs() < 1e-6 && depth_m == Some(4.0), "{length_m} {depth_m:?}");
}

fn shared(_: &Course)
where
    Course: Send + Sync,
{
}

#[test]
fn a_course_is_shared_by_many_runs() {
    shared(&Course::read(&source(PLAIN), &[]).unwrap());
}

proptest! {
    #[test]
    fn no_text_makes_the_reader_panic(text in "\\PC{0,200}", set in "\\PC{0,20}=\\PC{0,20}") {
        let _ = Course::read(&source(&text), &[]);
        let _ = Scenario::parse(&source(PLAIN), &[set]);
    }

    #[test]
    fn no_change_of_a_few_bytes_makes_the_reader_panic(
        at in proptest::collection::vec((0usize..400, any::<u8>()), 1..4),
    ) {
        let mut bytes = PLAIN.as_bytes().to_vec();
        for (index, byte) in at {
            if let Some(place) = bytes.get_mut(index) {
                *place = byte;
            }
        }
        let text = String::from_utf8_lossy(&bytes);
        // A corridor of a kilometre is legal; the tunnel is not built here.
        let _ = Scenario::parse(&source(&text), &[]);
    }
}
