use std::{
    fs,
    path::{Path, PathBuf},
    process::{Child, Stdio},
    time::Duration,
};

use crate::{SHORT, command, files, folder, stderr, stdout, uchain};

fn ok(folder: &Path, args: &[&str]) {
    let output = uchain(folder, args);
    assert_eq!(output.status.code(), Some(0), "{args:?}: {}", stderr(&output));
}

/// Names of what is in a folder.
fn names(folder: &Path) -> Vec<String> {
    files(folder).iter().map(|path| path.file_name().unwrap().to_str().unwrap().to_owned()).collect()
}

#[test]
fn a_folder_tells_of_one_run_whatever_was_flown_into_it_before() {
    let here = folder();
    let results = here.path().join("results");
    let chain = ["run", "straight", "--set", SHORT, "--quiet", "--out", "results"];
    let rooms = ["run", "apartment", "--set", SHORT, "--quiet", "--out", "results"];
    let of_a_chain = ["run.png", "summary.json"];
    let of_rooms = ["map.pgm", "map.yaml", "run.png", "states.png", "summary.json"];
    for (args, recorded, left) in [
        (rooms, true, &of_rooms[..]),
        (chain, false, &of_a_chain),
        (chain, true, &of_a_chain),
        (rooms, false, &of_rooms),
        (chain, true, &of_a_chain),
        (chain, false, &of_a_chain),
    ] {
        // What was looked at before is about the older run, too.
        if results.join("run.mcap").exists() {
            ok(here.path(), &["inspect", "results/run.mcap", "--quiet", "--out", "results"]);
            assert!(results.join("inspect.json").exists());
        }
        let choice = if recorded { "--record" } else { "--no-record" };
        ok(here.path(), &[&args[..], &[choice]].concat());
        let mut expected: Vec<&str> = left.iter().copied().chain(recorded.then_some("run.mcap")).collect();
        expected.sort_unstable();
        assert_eq!(names(&results), expected, "{args:?} {choice}");
    }
}

#[test]
fn a_run_that_was_refused_or_stopped_leaves_an_older_one_whole() {
    let here = folder();
    ok(here.path(), &["run", "straight", "--set", SHORT, "--quiet", "--out", "results"]);
    let results = here.path().join("results");
    let bytes = || files(&results).iter().map(|file| fs::read(file).unwrap()).collect::<Vec<_>>();
    let before = bytes();
    let mut child = under_way(here.path(), &["--no-record"]);
    child.kill().unwrap();
    child.wait().unwrap();
    let refused = uchain(here.path(), &["run", "straight", "--set", "chain.uavs=0", "--out", "results"]);
    assert_eq!(refused.status.code(), Some(3));
    assert!(bytes() == before);
}

#[test]
fn unfinished_files_of_a_run_that_was_killed_go_with_the_next_one() {
    let here = folder();
    let results = here.path().join("results");
    fs::create_dir(&results).unwrap();
    fs::write(results.join(".uchain-aBcDeF"), "half a picture").unwrap();
    ok(here.path(), &["run", "straight", "--set", SHORT, "--quiet", "--out", "results"]);
    assert_eq!(names(&results), ["run.mcap", "run.png", "summary.json"]);
}

#[test]
fn a_look_into_a_recording_is_not_mixed_with_another_run() {
    let here = folder();
    for out in ["one", "other"] {
        ok(here.path(), &["run", "straight", "--set", SHORT, "--quiet", "--out", out]);
    }
    ok(here.path(), &["inspect", "one/run.mcap", "--quiet", "--out", "one"]);
    let before = fs::read(here.path().join("other/run.png")).unwrap();
    for force in [&[][..], &["--force"]] {
        let refused = uchain(here.path(), &[&["inspect", "one/run.mcap", "--out", "other"], force].concat());
        assert_eq!(refused.status.code(), Some(2), "{}", stderr(&refused));
        assert!(stderr(&refused).contains("other holds another run (summary.json)"), "{}", stderr(&refused));
    }
    assert!(fs::read(here.path().join("other/run.png")).unwrap() == before);
    assert_eq!(names(&here.path().join("other")), ["run.mcap", "run.png", "summary.json"]);
}

#[test]
fn a_report_of_papers_stands_beside_its_own_pictures_only() {
    let here = folder();
    let paper = here.path().join("paper");
    fs::create_dir(&paper).unwrap();
    for name in ["fig10.png", "fig10-points.csv", "REPORT.md"] {
        fs::write(paper.join(name), "older").unwrap();
    }
    ok(here.path(), &["paper", "table1", "--quiet"]);
    assert!(names(&paper).iter().all(|name| !name.starts_with("fig10")), "{:?}", names(&paper));
    assert!(fs::read_to_string(paper.join("REPORT.md")).unwrap().contains("table1"));
}

/// A run that lasts, in `results`; it holds the folder by now.
fn under_way(folder: &Path, extra: &[&str]) -> Child {
    let args =
        [&["run", "corner", "--set", "duration_s=86400", "--out", "results", "--quiet"], extra].concat();
    let mut child = command(folder, &args).stderr(Stdio::piped()).spawn().unwrap();
    let results = folder.join("results");
    let is_held = || match fs::File::open(&results) {
        Ok(results) => matches!(results.try_lock(), Err(fs::TryLockError::WouldBlock)),
        Err(_) => false,
    };
    while !is_held() {
        assert!(child.try_wait().unwrap().is_none(), "it was over before it held its folder");
        std::thread::sleep(Duration::from_millis(1));
    }
    child
}

#[cfg(unix)]
#[test]
fn one_uchain_at_a_time_writes_into_a_folder_and_one_that_was_killed_stops_nobody() {
    let here = folder();
    ok(here.path(), &["run", "straight", "--set", SHORT, "--quiet", "--out", "other"]);
    let mut child = under_way(here.path(), &[]);
    for args in [
        &["run", "straight", "--set", SHORT][..],
        &["run", "straight", "--set", SHORT, "--no-record"],
        &["run", "apartment", "--set", SHORT, "--force"],
        &["plan", "straight"],
        &["paper", "table1"],
        &["inspect", "other/run.mcap"],
    ] {
        let second = uchain(here.path(), &[args, &["--out", "results"]].concat());
        assert_eq!(second.status.code(), Some(2), "{args:?}: {}", stderr(&second));
        let words =
            "error: results: another uchain writes there; wait for it, or name another folder with --out\n";
        assert_eq!((stdout(&second), stderr(&second)), ("", words), "{args:?}");
    }
    child.kill().unwrap();
    child.wait().unwrap();
    ok(here.path(), &["run", "straight", "--set", SHORT, "--quiet", "--out", "results"]);
    assert_eq!(names(&here.path().join("results")), ["run.mcap", "run.png", "summary.json"]);
}

#[cfg(unix)]
#[test]
fn a_report_and_a_row_flown_again_wait_for_nobody_and_mix_with_nobody() {
    let here = folder();
    ok(here.path(), &["sweep", "straight", "--set", SHORT, "--replicates", "2", "--quiet", "--out", "s"]);
    let held = fs::File::open(here.path().join("s")).unwrap();
    held.lock().unwrap();
    let second = uchain(here.path(), &["report", "s"]);
    assert_eq!(second.status.code(), Some(2), "{}", stderr(&second));
    assert!(stderr(&second).contains("s: another process works on this sweep"), "{}", stderr(&second));
    drop(held);
    ok(here.path(), &["report", "s", "--quiet"]);
    fs::write(here.path().join("s/plots/older.png"), "older").unwrap();
    ok(here.path(), &["report", "s", "--quiet"]);
    assert!(!here.path().join("s/plots/older.png").exists());

    let out = here.path().join("runs/straight-run1");
    fs::create_dir_all(&out).unwrap();
    let held = fs::File::open(&out).unwrap();
    held.lock().unwrap();
    let second = uchain(here.path(), &["repro", "s", "--run", "1"]);
    assert_eq!(second.status.code(), Some(2), "{}", stderr(&second));
    assert!(
        stderr(&second).contains("runs/straight-run1: another uchain writes there"),
        "{}",
        stderr(&second)
    );
}

#[test]
fn a_folder_that_nothing_comes_into_goes_again() {
    let here = folder();
    let output = uchain(here.path(), &["plan", "straight", "--to", "1000"]);
    assert_eq!(output.status.code(), Some(3), "{}", stderr(&output));
    assert_eq!(files(here.path()), Vec::<PathBuf>::new());
}

#[test]
fn a_file_names_its_folder_and_not_the_scenario_it_was_copied_from() {
    let here = folder();
    ok(here.path(), &["run", "corner", "--set", SHORT, "--quiet"]);
    let before = fs::read(here.path().join("runs/corner-s1/summary.json")).unwrap();
    fs::write(here.path().join("mine.toml"), uchain(here.path(), &["show", "corner"]).stdout).unwrap();
    for args in [
        &["run", "mine.toml", "--set", SHORT][..],
        &["run", "./mine.toml", "--set", SHORT, "--seed", "2"],
        &["plan", "mine.toml", "--to", "2"],
        &["sweep", "mine.toml", "--set", SHORT, "--quiet", "--out", "s"],
        &["repro", "s", "--run", "0"],
    ] {
        ok(here.path(), args);
    }
    for name in ["runs/mine-s1", "runs/mine-s2", "plans/mine", "runs/mine-run0"] {
        assert!(here.path().join(name).is_dir(), "{name}: {:?}", files(here.path()));
    }
    assert!(!here.path().join("plans/corner").exists());
    assert!(fs::read(here.path().join("runs/corner-s1/summary.json")).unwrap() == before);
}

/// A picture of 40 by 40 cells, free within a wall.
fn room() -> String {
    let mut map = "P2\n40 40\n255\n".to_owned();
    for y in 0..40 {
        for x in 0..40 {
            map += if (1..39).contains(&x) && (1..39).contains(&y) { "255 " } else { "0 " };
        }
    }
    map
}

#[test]
fn results_never_take_the_place_of_what_they_are_made_of() {
    let here = folder();
    fs::create_dir(here.path().join("a")).unwrap();
    let log = "time_s,back_loss_db,front_loss_db\n0,50,60\n0.2,50,60\n";
    let cell = ["--set", "map.cell_m=0.1", "--set", SHORT];
    for (name, content, args) in [
        ("a/map.pgm", room(), [&["run", "a/map.pgm"][..], &cell].concat()),
        ("a/commands.csv", log.to_owned(), vec!["node", "a/commands.csv"]),
        ("a/node.json", log.to_owned(), vec!["node", "a/node.json", "--force"]),
    ] {
        let file = here.path().join(name);
        fs::write(&file, &content).unwrap();
        let refused = uchain(here.path(), &[&args[..], &["--out", "a"]].concat());
        let wanted =
            format!("error: {name}: results in a would take its place; name another folder with --out\n");
        assert_eq!((refused.status.code(), stderr(&refused)), (Some(2), &*wanted));
        assert_eq!(fs::read_to_string(&file).unwrap(), content);
        ok(here.path(), &[&args[..], &["--quiet", "--out", "b"]].concat());
        fs::remove_dir_all(here.path().join("b")).unwrap();
        fs::remove_file(&file).unwrap();
    }
}

#[test]
fn maps_with_names_in_other_scripts_have_folders_of_their_own() {
    let here = folder();
    let map = room();
    for name in ["карта", "схема", "地図", "my map", "my_map"] {
        let file = format!("{name}.pgm");
        fs::write(here.path().join(&file), &map).unwrap();
        ok(here.path(), &["run", &file, "--set", "map.cell_m=0.1", "--set", SHORT, "--quiet"]);
    }
    let mut runs: Vec<String> = fs::read_dir(here.path().join("runs"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    runs.sort();
    assert_eq!(runs, ["my-map-s1", "my_map-s1", "карта-s1", "схема-s1", "地図-s1"]);
}
