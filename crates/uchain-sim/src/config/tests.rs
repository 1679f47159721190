use std::path::PathBuf;

use proptest::prelude::*;

use super::{ConfigError, Course, Scenario, Source, builtin, builtin_names};

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

fn message(text: &str, sets: &[&str]) -> String {
    let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
    match Course::read(&source(text), &sets) {
        Ok(_) => "ok".to_owned(),
        Err(error) => error.to_string(),
    }
}

#[test]
fn every_builtin_scenario_is_named_as_its_file_and_passes_its_checks() {
    for &name in builtin_names() {
        let scenario = Scenario::parse(&builtin(name).unwrap(), &[]).unwrap();
        assert_eq!(scenario.name, name);
        assert!(!scenario.description.is_empty(), "{name}");
    }
}

#[test]
fn depth_counts_from_the_base_to_the_goal() {
    let course = |sets: &[&str]| {
        let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
        Course::read(&source(PLAIN), &sets).unwrap()
    };
    let at = glam::vec2(3.0, 0.1);
    let tunnel = |course: &Course| (course.tunnel.as_ref().unwrap().length_m(), course.depth_m(at));
    assert_eq!(tunnel(&course(&[])), (8.0, Some(3.0)));
    assert_eq!(tunnel(&course(&["chain.goal_m=[6, 0.2]"])), (6.0, Some(3.0)));
    let (length_m, depth_m) = tunnel(&course(&["chain.base_m=[7, 0]", "chain.heading_deg=180"]));
    assert!((length_m - 7.6).abs() < 1e-6 && depth_m == Some(4.0), "{length_m} {depth_m:?}");
}

/// (old text, new text, what the message must hold).
const BAD_LINES: &[(&str, &str, &str)] = &[
    (
        "k_db_per_m = 20.0",
        "k_db_per_n = 20.0",
        "plain.toml:13: unknown key 'equalize.k_db_per_n'; did you mean 'k_db_per_m'? (known: law, k_db_per_m, ",
    ),
    ("[equalize]", "[equalise]", "plain.toml:12: unknown key 'equalise'; did you mean 'equalize'?"),
    ("duration_s", "duration", "plain.toml:2: unknown key 'duration'; did you mean 'duration_s'?"),
    ("duration_s = 10.0\n", "", "plain.toml: missing key 'duration_s'"),
    ("uavs = 3\n", "", "plain.toml:8: missing key 'chain.uavs'"),
    (
        "k_db_per_m = 20.0",
        "k_db_per_m = \"x\"",
        "plain.toml:13: equalize.k_db_per_m = \"x\": expected a number",
    ),
    (
        "k_db_per_m = 20.0",
        "k_db_per_m = 0",
        "plain.toml:13: equalize.k_db_per_m = 0: must lie in 0.1..=10000",
    ),
    ("k_db_per_m = 20.0", "k_db_per_m = nan", "plain.toml:13: equalize.k_db_per_m = nan: must lie in"),
    (
        "k_db_per_m = 20.0",
        "decision_s = 0.21",
        "plain.toml:13: equalize.decision_s = 0.21: must be a multiple of the tick, 0.05 s",
    ),
    ("duration_s = 10.0", "duration_s = 0.0", "plain.toml:2: duration_s = 0.0: must lie in 0.05..=86400"),
    ("duration_s = 10.0", "duration_s = 86401", "plain.toml:2: duration_s = 86401: must lie in 0.05..=86400"),
    ("duration_s = 10.0", "duration_s = 10.01", "plain.toml:2: duration_s = 10.01: must be a multiple"),
    ("uavs = 3", "uavs = 0", "plain.toml:9: chain.uavs = 0: must lie in 1..=1000"),
    ("uavs = 3", "uavs = -3", "plain.toml:9: chain.uavs = -3: expected a whole number, not negative"),
    (
        "base_m = [0.0, 0.0]",
        "base_m = [0.0]",
        "plain.toml:10: chain.base_m = invalid length 1: expected two numbers [x, y]",
    ),
    (
        "base_m = [0.0, 0.0]",
        "base_m = [0.0, 3.0]",
        "plain.toml:10: chain.base_m = [0, 3]: the base is in rock",
    ),
    (
        "base_m = [0.0, 0.0]",
        "base_m = [0.0, 0.35]",
        "plain.toml:8: chain.spacing_m = 0.25: UAV 0 would wait at (0.5, 0.35) m, 0.050 m from a wall; expected at least its radius, 0.06 m",
    ),
    (
        "uavs = 3",
        "uavs = 3\nspacing_m = 0.1",
        "plain.toml:10: chain.spacing_m = 0.1: UAV 1 would wait at (0.1, 0) m, 0.100 m from UAV 0; expected at least two radii, 0.12 m",
    ),
    (
        "uavs = 3",
        "uavs = 3\nspawns_m = [[1, 0], [0.5, 0]]",
        "plain.toml:10: chain.spawns_m = 2 places: must be one place per UAV (chain.uavs = 3)",
    ),
    (
        "uavs = 3",
        "uavs = 3\nspawns_m = [[1, 0], [0.5, 4], [0, 0]]",
        "plain.toml:10: chain.spawns_m.1 = [0.5, 4]: UAV 1 would wait at (0.5, 4) m, which is in rock",
    ),
    (
        "uavs = 3",
        "uavs = 3\nspawns_m = [[1, 0], [0.5, 0], [1, 0]]",
        "plain.toml:10: chain.spawns_m.2 = [1, 0]: UAV 2 would wait at (1, 0) m, 0.000 m from UAV 0",
    ),
    (
        "uavs = 3",
        "uavs = 3\ngoal_m = [9, 0]",
        "plain.toml:10: chain.goal_m = [9, 0]: the goal is in rock; expected free space",
    ),
    (
        "uavs = 3",
        "uavs = 3\ngoal_m = [-0.4, 0]",
        "plain.toml:10: chain.goal_m = [-0.4, 0]: the goal lies behind the base",
    ),
    ("uavs = 3", "uavs = 3\nendurance_s = 0", "plain.toml:10: chain.endurance_s = 0: must lie in 1..=86400"),
    ("speed_mps = 0.2", "speed_mps = 20", "plain.toml:17: pilot.0.speed_mps = 20: must lie in -1..=1"),
    (
        "speed_mps = 0.2",
        "speed_mps = 0.2\nfollow = \"centr\"",
        "plain.toml:18: pilot.0.follow = \"centr\": unknown choice; did you mean 'centre'? (known: centre, left, right)",
    ),
    (
        "speed_mps = 0.2",
        "speed_mps = 0.2\n[[pilot]]\nstart_s = 0\nspeed_mps = 0",
        "plain.toml:19: pilot.1.start_s = 0: must be later than the step before it, which starts at 0 s",
    ),
    (
        "[map.corridor]",
        "[map.corridoor]",
        "plain.toml:4: unknown key 'map.corridoor'; did you mean 'corridor'? (known: corridor, ros)",
    ),
    (
        "[map.corridor]",
        "[map.ros]\nfile = \"x.yaml\"\n[map.corridor]",
        "plain.toml:4: map = { … }: expected one of the tables [map.corridor] and [map.ros]",
    ),
    ("width_m = 0.8", "width_m = -1", "plain.toml:6: map.corridor.width_m = -1: must lie in 0.1..=100"),
    (
        "[8.0, 0.0]]",
        "[8.0]]",
        "plain.toml:5: map.corridor.centre_line_m.1 = 1 numbers: must be [x, y] or [x, y, r]",
    ),
    ("[-0.6, 0.0], ", "", "plain.toml:4: map.corridor: "),
    ("name = \"plain\"", "name = \"../up\"", "plain.toml:1: name = \"../up\": must be 1 to 64 of"),
    ("width_m = 0.8", "width_m = 0.8.1", "plain.toml:6: not valid TOML: "),
    ("width_m = 0.8", "width_m = 0.8\nwidth_m = 0.9", "plain.toml:7: not valid TOML: duplicate key"),
];

#[test]
fn a_bad_line_is_named_with_its_key_and_the_nearest_known_name() {
    let mut wrong = Vec::new();
    for (old, new, wanted) in BAD_LINES {
        assert!(PLAIN.contains(old), "{old}");
        let got = message(&PLAIN.replacen(old, new, 1), &[]);
        if !got.contains(wanted) {
            wrong.push(format!("{new:?}\n  got    {got}\n  wanted {wanted}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn a_bad_set_is_named_instead_of_a_line() {
    let table: &[(&str, &str)] = &[
        ("chain.uavs=0", "--set chain.uavs=0: chain.uavs = 0: must lie in 1..=1000"),
        ("chain.uavz=2", "--set chain.uavz=2: unknown key 'chain.uavz'; did you mean 'uavs'?"),
        ("kalman.q=2", "--set kalman.q=2: unknown key 'kalman.q' (known: measurement_variance_db2"),
        (
            "pilot.0.speed_mps=fast",
            "--set pilot.0.speed_mps=fast: pilot.0.speed_mps = \"fast\": expected a number",
        ),
        ("pilot.3.speed_mps=0", "pilot is a list of 1: expected an index below 1 after it, got '3'"),
        ("duration_s.x=0", "--set duration_s.x=0: duration_s is a single value"),
        ("duration_s", "--set duration_s: expected key=value"),
        ("=3", "--set =3: expected key=value"),
        ("map={}", "--set map={}: map = { … }: expected one of the tables"),
        ("chain.base_m=[0, 9]", "--set chain.base_m=[0, 9]: chain.base_m = [0, 9]: the base is in rock"),
    ];
    for (set, wanted) in table {
        let got = message(PLAIN, &[set]);
        assert!(got.contains(wanted), "{set}\n  got    {got}\n  wanted {wanted}");
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
    let error = Course::lay(scenario, &source).unwrap_err();
    assert!(error.to_string().contains("tof.period_s = 0.07"), "{error}");
}

#[test]
fn what_is_not_a_scenario_file_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("big.toml");
    std::fs::write(&path, vec![b'#'; (1 << 20) + 1]).unwrap();
    assert!(matches!(Source::read(&path), Err(ConfigError::TooLong { .. })));
    std::fs::write(&path, [b'a', 0xff]).unwrap();
    assert!(matches!(Source::read(&path), Err(ConfigError::NotText { byte: 1, .. })));
    assert!(matches!(Source::read(folder.path()), Err(ConfigError::Read { .. })));
    assert!(Source::find("cornr").unwrap_err().to_string().contains("did you mean 'corner'?"));
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
