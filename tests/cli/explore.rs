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
    assert_eq!(names, ["map.pgm", "map.yaml", "run.png", "summary.json"]);
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
fn a_plan_is_for_chains_and_says_so() {
    let here = folder();
    let plan = uchain(here.path(), &["plan", "apartment"]);
    assert_eq!(plan.status.code(), Some(3));
    assert!(stderr(&plan).contains("this is an exploration; expected a chain"), "{}", stderr(&plan));
    let check = uchain(here.path(), &["check", "corridors"]);
    assert!(stdout(&check).starts_with("ok: corridors: 3 robots, "), "{}", stdout(&check));
}
