use std::fs;

use serde_json::Value;

use crate::{files, folder, stderr, stdout, uchain};

#[test]
fn an_exploration_leaves_its_numbers_a_picture_and_a_map_that_is_flown_through_next() {
    let here = folder();
    let run =
        uchain(here.path(), &["run", "apartment", "--set", "explore.robots=4", "--out", "out", "--json"]);
    assert_eq!(run.status.code(), Some(0), "{}", stderr(&run));
    let said: Value = serde_json::from_str(stdout(&run)).unwrap();
    assert_eq!(said["stopped"], "explored");
    assert_eq!(said["distance_m"].as_array().unwrap().len(), 4);
    let out = here.path().join("out");
    let names: Vec<_> = files(&out).iter().map(|path| path.file_name().unwrap().to_owned()).collect();
    assert_eq!(names, ["map.pgm", "map.yaml", "run.mcap", "run.png", "summary.json"]);
    assert_eq!(fs::read_to_string(out.join("summary.json")).unwrap(), stdout(&run));
    assert!(fs::read(out.join("run.png")).unwrap().starts_with(b"\x89PNG"));
    // The folder is ours, and can be written again.
    let again = uchain(here.path(), &["run", "apartment", "--out", "out", "--set", "duration_s=10"]);
    assert!(stdout(&again).contains("the time is up (duration_s)"), "{}{}", stdout(&again), stderr(&again));

    let mine = "name = \"again\"\nduration_s = 600.0\n[map.ros]\nfile = \"out/map.yaml\"\n[explore]\nrobots = 1\n\
                spawns_m = [[1.0, 5.0]]\n";
    let whole = uchain(here.path(), &["run", "apartment", "--out", "out", "--quiet"]);
    assert_eq!((whole.status.code(), stdout(&whole)), (Some(0), ""));
    fs::write(here.path().join("mine.toml"), mine).unwrap();
    let next = uchain(here.path(), &["run", "mine.toml", "--json"]);
    let next: Value = serde_json::from_str(stdout(&next)).unwrap_or_else(|_| panic!("{}", stderr(&next)));
    assert_eq!(next["stopped"], "explored");
    assert!(next["coverage"].as_f64().unwrap() > 0.97, "{next}");
}

#[test]
fn a_recorded_exploration_is_inspected_verified_and_told_from_another_one() {
    let here = folder();
    for seed in ["1", "2"] {
        let run = uchain(here.path(), &["run", "apartment", "--seed", seed, "--quiet"]);
        assert_eq!((run.status.code(), stdout(&run)), (Some(0), ""), "{}", stderr(&run));
    }
    let [first, second] = ["runs/apartment-s1/run.mcap", "runs/apartment-s2/run.mcap"];
    let inspect = uchain(here.path(), &["inspect", first, "--json", "--out", "again"]);
    let said: Value =
        serde_json::from_str(stdout(&inspect)).unwrap_or_else(|_| panic!("{}", stderr(&inspect)));
    let summary = fs::read_to_string(here.path().join("runs/apartment-s1/summary.json")).unwrap();
    let summary: Value = serde_json::from_str(&summary).unwrap();
    for key in ["digest", "stopped", "iterations", "distance_m", "coverage", "unseen"] {
        assert_eq!(said[key], summary[key], "{key}");
    }
    assert_eq!(said["progress"].as_array().unwrap().last().unwrap()["hubs"], 0);
    let picture = |folder: &str| fs::read(here.path().join(folder).join("run.png")).unwrap();
    assert!(picture("again") == picture("runs/apartment-s1"), "another picture");

    let verify = uchain(here.path(), &["verify", first]);
    assert_eq!(verify.status.code(), Some(0), "{}", stderr(&verify));
    assert!(stdout(&verify).ends_with("ticks are the same, bit for bit\n"), "{}", stdout(&verify));
    let diff = uchain(here.path(), &["diff", first, second]);
    assert_eq!(diff.status.code(), Some(4), "{}", stderr(&diff));
    assert!(stdout(&diff).starts_with("seed: 1 and 2\n"), "{}", stdout(&diff));

    let bare = uchain(here.path(), &["run", "apartment", "--no-record", "--quiet", "--out", "bare"]);
    assert_eq!(bare.status.code(), Some(0));
    let names: Vec<_> =
        files(&here.path().join("bare")).iter().map(|path| path.file_name().unwrap().to_owned()).collect();
    assert_eq!(names, ["map.pgm", "map.yaml", "run.png", "summary.json"]);
}

#[test]
fn a_plan_is_for_chains_and_says_so() {
    let here = folder();
    let plan = uchain(here.path(), &["plan", "apartment"]);
    assert_eq!(plan.status.code(), Some(3));
    assert!(stderr(&plan).contains("this is an exploration; expected a chain"), "{}", stderr(&plan));
    let check = uchain(here.path(), &["check", "corridors"]);
    assert!(stdout(&check).starts_with("ok: corridors: 3 robots, "), "{}", stdout(&check));
}
