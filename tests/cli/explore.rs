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
    assert_eq!(said["outcome"], "explored");
    assert_eq!(said["distance_m"].as_array().unwrap().len(), 4);
    let out = here.path().join("out");
    let names: Vec<_> = files(&out).iter().map(|path| path.file_name().unwrap().to_owned()).collect();
    assert_eq!(names, ["map.pgm", "map.yaml", "run.mcap", "run.png", "states.png", "summary.json"]);
    assert_eq!(fs::read_to_string(out.join("summary.json")).unwrap(), stdout(&run));
    assert!(fs::read(out.join("run.png")).unwrap().starts_with(b"\x89PNG"));
    // The folder is ours, and can be written again.
    let again = uchain(here.path(), &["run", "apartment", "--out", "out", "--set", "duration_s=10"]);
    assert!(
        stdout(&again).contains("time-up: 26.7 % seen when the time was up, after 10 s (duration_s)"),
        "{}{}",
        stdout(&again),
        stderr(&again)
    );

    let mine = "name = \"again\"\nduration_s = 600.0\n[map.ros]\nfile = \"out/map.yaml\"\n[explore]\nrobots = 1\n\
                spawns_m = [[1.0, 5.0]]\n";
    let whole = uchain(here.path(), &["run", "apartment", "--out", "out", "--quiet"]);
    assert_eq!((whole.status.code(), stdout(&whole)), (Some(0), ""));
    fs::write(here.path().join("mine.toml"), mine).unwrap();
    let next = uchain(here.path(), &["run", "mine.toml", "--json"]);
    let next: Value = serde_json::from_str(stdout(&next)).unwrap_or_else(|_| panic!("{}", stderr(&next)));
    assert_eq!(next["outcome"], "explored");
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
    for key in ["digest", "outcome", "verdict", "iterations", "distance_m", "coverage", "unseen"] {
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
    assert_eq!(names, ["map.pgm", "map.yaml", "run.png", "states.png", "summary.json"]);
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

#[test]
fn a_table_of_corners_is_explored_and_planned_for_as_it_is() {
    let here = folder();
    let room = "loop,x_m,y_m\n0,0,0\n0,4,0\n0,4,3\n0,0,3\n1,2,1\n1,2,2\n1,2.5,2\n1,2.5,1\n";
    fs::write(here.path().join("room.csv"), room).unwrap();
    let sets = ["--set", "explore.robots=1", "--json", "--no-record"];
    let run = uchain(here.path(), &[&["run", "room.csv"][..], &sets].concat());
    assert_eq!(run.status.code(), Some(0), "{}", stderr(&run));
    let said: Value = serde_json::from_str(stdout(&run)).unwrap();
    assert_eq!((&said["scenario"], &said["outcome"]), (&"room".into(), &"explored".into()), "{said}");
    let plan = uchain(here.path(), &["plan", "room.csv", "--base=0.5,0.5", "--goal=3.5,2.5"]);
    assert_eq!(plan.status.code(), Some(0), "{}", stderr(&plan));

    fs::write(here.path().join("room.csv"), room.replace("1,2,2\n", "1,2,x\n")).unwrap();
    for args in [&["run", "room.csv"][..], &["plan", "room.csv", "--base=0.5,0.5", "--goal=3.5,2.5"]] {
        let wrong = uchain(here.path(), args);
        assert_eq!(wrong.status.code(), Some(3), "the control");
        let expected = "error: room.csv: line 7: \"1,2,x\": expected a loop's number, x and y";
        assert!(stderr(&wrong).starts_with(expected), "{}", stderr(&wrong));
    }
}

#[test]
fn a_bare_map_is_explored_and_doors_that_are_too_narrow_are_told_of_before() {
    let here = folder();
    // Two rooms of 3 by 3 m, with a door of 0.25 m between them.
    let (open, wall) = (".".repeat(12) + "@" + &".".repeat(12), "@".repeat(25));
    let mut rows = vec![open; 12];
    rows[6] = ".".repeat(25);
    let text = format!("type octile\nheight 13\nwidth 25\nmap\n{wall}\n{}\n", rows.join("\n"));
    fs::write(here.path().join("two-rooms.map"), text).unwrap();
    let run = |r_body_m: &str| {
        let body = format!("explore.r_body_m={r_body_m}");
        let sets = ["--set", "map.cell_m=0.25", "--set", "explore.robots=2", "--set", &body];
        uchain(here.path(), &[&["run", "two-rooms.map", "--json"][..], &sets].concat())
    };
    let thin = run("0.1");
    assert_eq!(thin.status.code(), Some(0), "{}", stderr(&thin));
    let may_miss = "of 15.7 m2 in reach (50 %) lie in or behind passages narrower than 0.90 m, in 1 place, the narrowest \
                    0.25 m wide near (3.";
    let remedy =
        "stars may not look through: --set explore.sectors=144 --set explore.arc_ends=true sees more\n";
    assert!(
        stderr(&thin).starts_with("note: 7.9 ")
            && stderr(&thin).contains(may_miss)
            && stderr(&thin).contains(remedy),
        "{}",
        stderr(&thin)
    );
    let said: Value = serde_json::from_str(stdout(&thin)).unwrap();
    assert_eq!((&said["scenario"], &said["outcome"]), (&"two-rooms".into(), &"unseen".into()));
    let words = said["verdict"].as_str().unwrap();
    assert!(words.contains(" behind passages narrower than 0.90 m, the largest piece 7."), "{words}");
    // As was to be feared.
    assert!(said["coverage"].as_f64().unwrap() < 0.6 && said["shut_off_m2"] == 0.0, "{said}");
    let fat = run("0.15");
    let note = "m2 of free ground lie behind passages narrower than 0.3 m, two explore.r_body_m";
    assert!(stderr(&fat).starts_with("note: 7.3 ") && stderr(&fat).contains(note), "{}", stderr(&fat));
    let check = uchain(here.path(), &["check", "two-rooms.map", "--set", "explore.r_body_m=2"]);
    assert!(stderr(&check).contains("room for"), "{}", stderr(&check));
    let absent = uchain(here.path(), &["run", "no-rooms.map"]);
    assert!(stderr(&absent).contains("no-rooms.map: No such file"), "{}", stderr(&absent));
}
