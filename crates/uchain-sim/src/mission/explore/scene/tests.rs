use std::path::PathBuf;

use super::Site;
use crate::{config::Source, mission::chain::Course, registry::Registry};

const ROOM: &str = r#"
name = "room"
duration_s = 60.0
[map.walls]
outer_m = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]]
[explore]
robots = 2
spawns_m = [[1.0, 1.0], [2.0, 1.0]]
"#;

fn room() -> Source {
    Source { label: "room.toml".to_owned(), text: ROOM.to_owned(), folder: PathBuf::new() }
}

fn error(sets: &[&str]) -> String {
    let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
    match Registry::default().read(&room(), &sets) {
        Ok(_) => panic!("{sets:?} is taken"),
        Err(error) => error.to_string(),
    }
}

#[test]
fn what_is_wrong_with_an_exploration_is_said_with_its_place_and_its_numbers() {
    let cases = [
        (&["explore.robots=0"][..], "--set explore.robots=0: explore.robots = 0: must lie in 1..=1000"),
        (&["explore.r_s_m=-1"], "explore.r_s_m = -1: must lie in 0.05..=100"),
        (&["explore.robots=3"], "explore.spawns_m = 2 places: must be one place per robot at least"),
        (&["explore.stratgy=srg"], "unknown key 'explore.stratgy'; did you mean 'strategy'?"),
        (&["explore.robot=2"], "unknown key 'explore.robot'; did you mean 'robots'?"),
        (&["explore.strategy=rsg"], "explore.strategy = \"rsg\": unknown choice; did you mean 'srg'?"),
        (&["explore.range_m=2"], "explore.range_m = 2: must be at least 2.25"),
        (&["explore.scan_s=0.07"], "explore.scan_s = 0.07: must be a multiple of the tick"),
        (&["explore.spawns_m.0=[5, 1]"], "robot 0 would start at (5, 1) m, which is in rock"),
        (&["explore.spawns_m.1=[3.95, 1]"], "robot 1 would start at (3.95, 1) m, 0.050 m from a wall"),
        (&["explore.spawns_m.1=[1.2, 1]"], "0.200 m from robot 0; expected at least 0.250 m"),
        (&["explore.scatter_m=0.6"], "expected at least 1.947 m"),
        (&["explore=3"], "--set explore=3: explore = 3: expected a table"),
        (&["explore.range_m=nan"], "explore.range_m = nan: must lie in 0.1..=1000000"),
        (&["preset=cavemod"], "--set preset=cavemod: preset = \"cavemod\": belongs to a chain"),
        (&["link.lost_s=1"], "belongs to a chain, and a scenario with [explore] is an exploration"),
        (&["radio.sigma_db=-1"], "radio.sigma_db = -1: must lie in 0..=50"),
        (&["packets.drop_rate=2"], "packets.drop_rate = 2: must lie in 0..=1"),
        (&["radio.sigma=1"], "unknown key 'radio.sigma'; did you mean 'sigma_db'?"),
        (&["radio=3"], "--set radio=3: radio = 3: expected a table"),
        (&["radio.model=disk"], "radio.model = \"disk\": unknown choice; did you mean 'disc'?"),
        (&["radio.model=disc"], "radio.range_m = nothing: the model \"disc\" needs a range"),
        (&["radio.model=disc", "radio.range_m=2"], "radio.range_m = 2: must be at least 2.25: two moves"),
        (
            &["explore.range_m=9", "radio.sigma_db=1"],
            "explore.range_m = 9: a range of messages beside a radio",
        ),
        (
            &["explore.range_m=9", "packets.drop_rate=0"],
            "explore.range_m = 9: a range of messages beside a radio",
        ),
        (
            &["packets.wire=true"],
            "packets.wire = true: robots tell each other a graph, which has no bytes yet",
        ),
        (&["packets.delay_ticks=4"], "packets.delay_ticks = 4: robots answer each other within a round"),
        (&["map.walls.outer_m.2=[1, -1]"], "room.toml:4: map.walls: walls cross or touch near"),
        (&["map.walls.outer_m.2=[nan, 0]"], "map.walls.outer_m.2.0 = nan"),
    ];
    for (sets, expected) in cases {
        let got = error(sets);
        assert!(got.contains(expected), "{sets:?}: {got}");
    }
}

#[test]
fn every_strategy_has_its_word() {
    for strategy in uchain_core::explore::StrategyKind::BUILTIN {
        let site = Site::read(&room(), &[format!("explore.strategy={}", strategy.word())]).unwrap();
        assert_eq!(site.scenario.params.strategy, strategy);
    }
}

#[test]
fn an_exploration_is_no_chain_and_a_chain_no_exploration() {
    let error = Course::read(&room(), &[]).unwrap_err().to_string();
    assert!(error.contains("this is an exploration; expected a chain"), "{error}");
    let corner = crate::config::builtin("corner").unwrap();
    assert!(Site::read(&corner, &[]).unwrap_err().to_string().contains("chain"), "said");
}

#[test]
fn a_room_of_16_m2_is_reachable_but_for_a_body_along_its_walls() {
    let site = Site::read(&room(), &[]).unwrap();
    let cell_m = f64::from(site.ground().cells().cell_m());
    let area_m2 = site.ground().count() as f64 * cell_m * cell_m;
    assert!((area_m2 - 3.8 * 3.8).abs() < 0.01, "{area_m2}");
}

#[test]
fn a_radio_is_written_into_a_scenario_if_it_is_asked_for_whichever_of_its_tables_asks() {
    let text = |sets: &[&str]| {
        let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
        let scenario = Site::read(&room(), &sets).unwrap().scenario.clone();
        let text = scenario.to_toml().unwrap();
        let again = Site::read(&Source { text: text.clone(), ..room() }, &[]).unwrap();
        assert_eq!(again.scenario, scenario);
        text
    };
    let plain = text(&[]);
    assert!(!plain.contains("[radio]") && !plain.contains("[packets]"), "{plain}");
    for set in ["radio.sigma_db=1", "packets.drop_rate=0"] {
        let text = text(&[set]);
        assert!(text.starts_with(&plain) && text.contains("[radio]") && text.contains("[packets]"), "{text}");
    }
}
