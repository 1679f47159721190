use std::fs;

use crate::{folder, stderr, stdout, uchain};

/// What a beginner types, the exit code, and what has to stand in the answer.
const SLIPS: &[(&str, i32, &[&str])] = &[
    // Commands.
    ("corner", 2, &["unrecognized subcommand 'corner'", "tip: to fly a scenario: uchain run corner"]),
    ("mine.toml", 2, &["tip: to fly a scenario: uchain run mine.toml"]),
    ("map.yaml", 2, &["tip: to plan for a map: uchain plan map.yaml --base=X,Y --goal=X,Y"]),
    ("alpha_wall", 2, &["tip: to read about a key: uchain explain alpha_wall"]),
    ("rum corner", 2, &["tip: a similar subcommand exists: 'run'"]),
    ("run corner --sed 3", 2, &["tip: a similar argument exists: '--seed'"]),
    ("completions bsh", 2, &["tip: a similar value exists: 'bash'"]),
    ("show", 2, &["tip: what is there to fly: uchain list"]),
    ("completions", 2, &["tip: one of bash, "]),
    ("run corner --preset cavemod", 2, &["tip: a key of the scenario: --set preset=VALUE"]),
    ("run corner --uavs 5", 2, &["tip: a key of the scenario: --set chain.uavs=VALUE"]),
    ("run corner --seed 1.5", 2, &["'--seed <N>': expected a whole number from 0"]),
    // Names of scenarios, presets and files.
    ("run mine", 3, &["unknown scenario 'mine'", "hint: there is a file mine.toml"]),
    ("run Corner", 3, &["unknown scenario 'Corner'; did you mean 'corner'?"]),
    (
        "run cavemod",
        3,
        &["hint: 'cavemod' is a preset: uchain show --preset cavemod, or --set preset=cavemod"],
    ),
    ("show cavemod", 3, &["hint: 'cavemod' is a preset"]),
    ("show --preset corner", 3, &["hint: 'corner' is a scenario: uchain show corner"]),
    ("run corner.toml", 3, &["No such file", "hint: 'corner', without folder and .toml, is built in"]),
    ("run mien.toml", 3, &["No such file", "did you mean 'mine.toml'?"]),
    ("run ./map.yaml", 3, &["./map.yaml: origin = (absent): expected [x, y, yaw]"]),
    ("run map.pgm", 3, &["map.pgm: No such file"]),
    ("plan map.pgm --base=0,0 --goal=1,1", 3, &["map.pgm: No such file"]),
    // Keys and values.
    (
        "run corner --set uavs=5",
        3,
        &["unknown key 'uavs'; did you mean 'chain.uavs'?", "hint: all keys: uchain explain\n"],
    ),
    (
        "run corner --set radio.detour_db_per=40",
        3,
        &["did you mean 'detour_db_per_m'?", "hint: keys of radio: uchain explain radio"],
    ),
    ("run corner --set chain.uavs 5", 2, &["tip: --set takes one word: --set chain.uavs=5"]),
    ("run corner --set chain.uavs = 5", 2, &["tip: --set takes one word: --set chain.uavs=5"]),
    ("run corner --set chain.uavs", 2, &["expected key=value"]),
    (
        "run corner --set chain.uavs=5 --set radio.sigma_db 0",
        2,
        &["tip: --set takes one word: --set radio.sigma_db=0"],
    ),
    ("run corner --set pilot.speed_mps=0.1", 3, &["write which one, such as pilot.0.speed_mps"]),
    (
        "run corner --set equalize.law=Lipshitz",
        3,
        &["did you mean 'lipschitz'?", "hint: what may stand there: uchain explain equalize.law"],
    ),
    (
        "run corner --set takeoff.s_min_db=55dB",
        3,
        &["\"55dB\": expected a number", "uchain explain takeoff.s_min_db"],
    ),
    ("run corner --set chain.uavs=5.0", 3, &["expected a whole number"]),
    ("run corner --set chain.goal_m=4,-5", 3, &["chain.goal_m = \"4,-5\": expected two numbers [x, y]"]),
    ("run corner --set preset=cavemood", 3, &["did you mean 'cavemod'?"]),
    (
        "check empty.toml",
        3,
        &["empty.toml: missing key 'name'", "hint: what may stand there: uchain explain name"],
    ),
    // Explanations.
    ("explain corner", 3, &["hint: 'corner' is a scenario: uchain show corner"]),
    ("explain radio.alpha_wal", 3, &["did you mean 'radio.alpha_wall'?"]),
    ("explain law", 3, &["(known: equalize.law, center.law)"]),
];

#[test]
fn what_a_beginner_mistypes_is_answered_with_a_remedy() {
    let here = folder();
    let shown = uchain(here.path(), &["show", "corner"]);
    fs::write(here.path().join("mine.toml"), &shown.stdout).unwrap();
    fs::write(here.path().join("empty.toml"), "").unwrap();
    fs::write(here.path().join("word.toml"), "name = corner\n").unwrap();
    fs::write(here.path().join("map.yaml"), "image: map.pgm\nresolution: 0.05\n").unwrap();
    for (typed, code, wanted) in SLIPS {
        let output = uchain(here.path(), &typed.split(' ').collect::<Vec<_>>());
        let said = stderr(&output);
        assert_eq!((output.status.code(), stdout(&output)), (Some(*code), ""), "{typed}: {said}");
        for wanted in *wanted {
            assert!(said.contains(wanted), "uchain {typed}\n  got    {said}\n  wanted {wanted}");
        }
    }
}
