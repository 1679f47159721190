//! The real binary: exit codes, files, messages.

/// Colour and other bytes for terminals.
#[path = "cli/colour.rs"]
mod colour;
/// Every example that users are shown.
#[cfg(unix)]
#[path = "cli/examples.rs"]
mod examples;
/// Explorations.
#[path = "cli/explore.rs"]
mod explore;
/// What a beginner mistypes.
#[path = "cli/hints.rs"]
mod hints;
/// A Ctrl-C, a reader that went away.
#[path = "cli/interrupt.rs"]
mod interrupt;
/// `uchain map`.
#[path = "cli/map.rs"]
mod map;
/// `uchain node`: logs of real flights.
#[path = "cli/node/mod.rs"]
mod node;
/// `uchain paper`.
#[path = "cli/paper.rs"]
mod paper;
/// Where robots and UAVs are put: in rock, beyond the map, with no room.
#[path = "cli/places.rs"]
mod places;
/// `uchain plan`.
#[path = "cli/plan.rs"]
mod plan;
/// `uchain radio`: logs of losses, and losses over a map.
#[path = "cli/radio.rs"]
mod radio;
/// Recordings: `inspect`, `verify`, `diff`, and runs that do not end.
#[path = "cli/record.rs"]
mod record;
/// Folders of results: whose they are, and that they tell of one run.
#[path = "cli/results.rs"]
mod results;
/// The JSON Schema against a validator that is not ours.
#[path = "cli/schema.rs"]
mod schema;
/// Many runs.
#[path = "cli/sweep/mod.rs"]
mod sweep;
/// Help, explanations, completions, manual pages.
#[path = "cli/teach.rs"]
mod teach;
/// `uchain view`: the page with a flight in it.
#[path = "cli/view.rs"]
mod view;

use std::{
    fs,
    path::{Path, PathBuf},
    process::{Command, Output, Stdio},
};

use serde_json::Value;
use tempfile::TempDir;
// Some tests fly here what the command line flies: the bits have to be the same.
use uchain_libm as _;

/// A short flight.
const SHORT: &str = "duration_s=5";

fn uchain(folder: &Path, args: &[&str]) -> Output {
    command(folder, args).output().unwrap()
}

fn command(folder: &Path, args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_uchain"));
    command.current_dir(folder).args(args).stdin(Stdio::null());
    command
}

/// Makes a program of a file. Another process writes it: what this one has open for writing is for a moment open in whatever a
/// test beside this one starts, and a program that is open for writing cannot be run (ETXTBSY, "text file busy").
fn install(from: &Path, to: &Path) {
    let done = Command::new("install").args(["-m", "755"]).arg(from).arg(to).status().unwrap();
    assert!(done.success(), "install {} {}", from.display(), to.display());
}

/// The same of the text of a script.
fn install_script(text: &str, to: &Path) {
    let written = to.with_extension("script");
    fs::write(&written, text).unwrap();
    install(&written, to);
    fs::remove_file(written).unwrap();
}

fn stdout(output: &Output) -> &str {
    std::str::from_utf8(&output.stdout).unwrap()
}

fn stderr(output: &Output) -> &str {
    std::str::from_utf8(&output.stderr).unwrap()
}

/// A scenario with a preset's values written into it by hand: those of a table that it has go into that table.
fn with_preset(scenario: &str, preset: &str) -> String {
    let [mut all, more]: [toml::Table; 2] = [scenario, preset].map(|text| text.parse().unwrap());
    for (table, values) in more {
        let values = values.as_table().unwrap().clone();
        let written = all.entry(table).or_insert_with(|| toml::Table::new().into());
        for (key, value) in values {
            written.as_table_mut().unwrap().entry(key).or_insert(value);
        }
    }
    all.to_string()
}

fn folder() -> TempDir {
    tempfile::tempdir().unwrap()
}

/// The folder of small inputs with their right answers; `None`, said aloud, where it is absent. In the gate absence is a
/// failure.
fn shared_cases() -> Option<PathBuf> {
    let cases = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/cases");
    if cases.is_dir() {
        return Some(cases);
    }
    assert!(
        std::env::var("CI").as_deref() != Ok("true"),
        "{} is missing: the gate needs it",
        cases.display()
    );
    eprintln!("skipped: {} is not there", cases.display());
    None
}

/// Everything below a folder, sorted.
fn files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(files(&path));
        }
        found.push(path);
    }
    found.sort();
    found
}

#[test]
fn a_run_leaves_a_summary_a_picture_and_a_recording_and_exits_with_0() {
    let here = folder();
    let output = uchain(here.path(), &["run", "corner", "--set", SHORT]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(stdout(&output).starts_with("corner, seed 1: 5 s simulated in "), "{}", stdout(&output));
    assert!(stdout(&output).contains("runs/corner-s1/summary.json"), "{}", stdout(&output));
    assert_eq!(stderr(&output), "", "no progress where there is no terminal");

    let results = here.path().join("runs/corner-s1");
    let names: Vec<_> = files(&results).iter().map(|path| path.file_name().unwrap().to_owned()).collect();
    assert_eq!(names, ["run.mcap", "run.png", "summary.json"]);
    let picture = image::load_from_memory(&fs::read(results.join("run.png")).unwrap()).unwrap();
    assert_eq!(picture.width(), 1400);
}

#[test]
fn json_is_the_summary_file_and_holds_every_promised_key() {
    let here = folder();
    let args = ["run", "corner", "--set", SHORT, "--seed", "3", "--json", "--out", "results"];
    let output = uchain(here.path(), &args);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert_eq!(stdout(&output), fs::read_to_string(here.path().join("results/summary.json")).unwrap());

    let summary: Value = serde_json::from_str(stdout(&output)).unwrap();
    let promised = "scenario seed sim_s wall_s outcome verdict launches_s uavs relays_used relays_needed bottleneck_gap_db links \
                    spread_db converged_s wall_contacts uav_contacts connected_fraction head_reach_m digest version";
    for key in promised.split_whitespace() {
        assert!(summary.get(key).is_some(), "{key} is missing in {summary}");
    }
    assert_eq!(summary["scenario"], "corner");
    assert_eq!(summary["seed"], 3);
    assert_eq!(summary["sim_s"], 5.0);
    assert_eq!(summary["digest"].as_str().unwrap().len(), 16);
    for link in summary["links"].as_array().unwrap() {
        assert!(link["true_db"].is_number() && link.get("filtered_db").is_some(), "{link}");
    }
}

#[test]
fn the_same_seed_gives_the_same_digest_and_another_seed_another() {
    let here = folder();
    let digest = |seed: &str| {
        let output = uchain(here.path(), &["run", "bend", "--set", SHORT, "--seed", seed, "--json"]);
        let summary: Value = serde_json::from_str(stdout(&output)).unwrap();
        summary["digest"].as_str().unwrap().to_owned()
    };
    let first = digest("5");
    assert_eq!(first, digest("5"), "a run overwrites its own folder and repeats itself");
    assert_ne!(first, digest("6"));
}

#[test]
fn a_folder_that_holds_something_else_is_refused_without_force() {
    let here = folder();
    let run = |extra: &[&str]| {
        let mut args = vec!["run", "straight", "--set", SHORT, "--quiet", "--out", "results"];
        args.extend(extra);
        uchain(here.path(), &args)
    };
    let first = run(&[]);
    assert_eq!((first.status.code(), stdout(&first)), (Some(0), ""));
    assert_eq!(run(&[]).status.code(), Some(0), "our own results are overwritten");

    let letter = here.path().join("results/letter.txt");
    fs::write(&letter, "dear").unwrap();
    fs::remove_file(here.path().join("results/run.png")).unwrap();
    let refused = run(&[]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(stderr(&refused).contains("results holds something else (letter.txt)"), "{}", stderr(&refused));
    assert!(stderr(&refused).contains("--force"));
    assert!(!here.path().join("results/run.png").exists());

    assert_eq!(run(&["--force"]).status.code(), Some(0));
    assert!(here.path().join("results/run.png").exists());
    assert_eq!(fs::read_to_string(letter).unwrap(), "dear", "only our own files are replaced");
}

#[test]
fn results_that_cannot_be_written_exit_with_1_and_a_file_as_folder_with_2() {
    let here = folder();
    fs::write(here.path().join("taken"), "").unwrap();
    let run = |out: &str| uchain(here.path(), &["run", "straight", "--set", SHORT, "--out", out]);
    assert_eq!(run("taken").status.code(), Some(2));
    // A folder may stand where a result should go, if forced.
    fs::create_dir_all(here.path().join("odd/run.png")).unwrap();
    fs::write(here.path().join("odd/run.png/x"), "").unwrap();
    let output = run("odd");
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    assert_eq!(files(&here.path().join("odd")).len(), 3, "the recording; no summary, nothing unfinished");
}

#[test]
fn wrong_arguments_exit_with_2_and_point_to_help() {
    let here = folder();
    let table: &[&[&str]] = &[
        &[],
        &["fly"],
        &["run"],
        &["run", "corner", "--seed", "-1"],
        &["run", "corner", "--set", "nothing"],
        &["run", "corner", "--set", "=1"],
        &["check", "corner", "--colour"],
    ];
    for args in table {
        let output = uchain(here.path(), args);
        assert_eq!(output.status.code(), Some(2), "{args:?}: {}", stderr(&output));
        assert!(stderr(&output).contains("--help"), "{args:?}: {}", stderr(&output));
    }
    assert_eq!(files(here.path()), Vec::<PathBuf>::new());
}

#[test]
fn invalid_input_exits_with_3_says_where_and_writes_nothing() {
    let here = folder();
    let shown = uchain(here.path(), &["show", "corner"]);
    let text = stdout(&shown).replacen("[chain]", "[equalize]\nk_db_per_n = 1.0\n\n[chain]", 1);
    let line = 1 + text.lines().position(|line| line.starts_with("k_db_per_n")).unwrap();
    fs::write(here.path().join("mine.toml"), &text).unwrap();
    let before = files(here.path());

    let mine = format!(
        "error: mine.toml:{line}: unknown key 'equalize.k_db_per_n'; did you mean 'k_db_per_m'? (known: law, k_db_per_m, "
    );
    let table: &[(&[&str], &str)] = &[
        (&["run", "mine.toml"], &mine),
        (&["check", "./mine.toml"], "error: ./mine.toml:"),
        (&["run", "mine.toml", "--out", "results", "--json"], &mine),
        (&["run", "cornr"], "error: unknown scenario 'cornr'; did you mean 'corner'?"),
        (
            &["run", "zzzzzzzz"],
            "unknown scenario 'zzzzzzzz' (known: apartment, bend, circuit, circuit-cavemod, circuit-frontiers2021, corner, corridors, lab, staircase, stata, straight); a path to a file works as well",
        ),
        (&["run", "absent.toml"], "error: absent.toml: cannot read the scenario: No such file"),
        (&["run", "./absent"], "error: ./absent: cannot read the scenario: No such file"),
        (&["show", "corners"], "did you mean 'corner'?"),
        (
            &["run", "corner", "--set", "chain.uavs=0"],
            "error: --set chain.uavs=0: chain.uavs = 0: must lie in 1..=1000",
        ),
        (&["run", "corner", "--set", "chain.uavs=many"], "chain.uavs = \"many\": expected a whole number"),
        (
            &["run", "corner", "--set", "motion.radius=1"],
            "unknown key 'motion.radius'; did you mean 'radius_m'?",
        ),
        (
            &["run", "corner", "--set", "pilot.0.follow=lefd"],
            "did you mean 'left'? (known: centre, left, right)",
        ),
        (&["run", "corner", "--set", "chain.base_m=[0, 50]"], "chain.base_m = [0, 50]: the base is in rock"),
        (&["run", "corner", "--set", "chain.spacing_m=0.05"], "two radii"),
        (&["run", "corner", "--set", "duration_s=1e9"], "duration_s = 1e9: must lie in 0.05..=86400"),
        (
            &["run", "corner", "--set", "preset=cavemud"],
            "error: --set preset=cavemud: preset = \"cavemud\": unknown choice; did you mean 'cavemod'?",
        ),
        (
            &["show", "--preset", "frontiers"],
            "error: unknown preset 'frontiers'; did you mean 'frontiers2021'?",
        ),
        (
            &["run", "corner", "--set", "faults.dead=[{ uav = 4, start_s = 10 }]"],
            "faults.dead.0.uav = 4: must be a UAV of the chain: 0, the head, to 3",
        ),
        (&["check", "corner", "--set", "faults.burst_rate=2"], "faults.burst_rate = 2: must lie in 0..=1"),
        (
            &["run", "stata", "--set", "map.ros.file=none.yaml"],
            "--set map.ros.file=none.yaml: map.ros.file: none.yaml",
        ),
    ];
    for (args, wanted) in table {
        let output = uchain(here.path(), args);
        assert_eq!(output.status.code(), Some(3), "{args:?}: {}", stderr(&output));
        assert!(
            stderr(&output).contains(wanted),
            "{args:?}\n  got    {}\n  wanted {wanted}",
            stderr(&output)
        );
        assert_eq!(stdout(&output), "", "{args:?}");
        assert_eq!(files(here.path()), before, "{args:?}");
    }
}

#[test]
fn list_show_and_check_lead_from_a_name_to_a_file_of_ones_own() {
    let here = folder();
    let list = uchain(here.path(), &["list"]);
    assert_eq!(list.status.code(), Some(0));
    for name in ["apartment", "bend", "corner", "corridors", "stata", "straight"] {
        assert!(stdout(&list).lines().any(|line| line.starts_with(name)), "{}", stdout(&list));
    }
    let shown = uchain(here.path(), &["show", "corner"]);
    fs::write(here.path().join("mine.toml"), &shown.stdout).unwrap();
    let check = uchain(here.path(), &["check", "mine.toml"]);
    assert_eq!(check.status.code(), Some(0), "{}", stderr(&check));
    assert!(stdout(&check).starts_with("ok: corner: "), "{}", stdout(&check));
    assert!(stdout(&check).contains(" UAVs, ") && stdout(&check).contains(" walls, "), "{}", stdout(&check));
}
