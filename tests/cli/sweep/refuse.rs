use std::{fs, process::Command};

use super::{files, folder, ok, small, stderr, uchain};

#[test]
fn bad_keys_and_values_are_refused_before_the_first_run_with_the_place_they_stand_in() {
    let here = folder();
    fs::write(here.path().join("d.csv"), "radio.sigma_db,chain.uavs\n1,3\n2,0\n").unwrap();
    fs::write(here.path().join("keys.csv"), "radio.sigma_db,chain.uavz\n1,3\n").unwrap();
    fs::write(here.path().join("ragged.csv"), "radio.sigma_db,chain.uavs\n1\n").unwrap();
    let before = files(here.path());
    let table: &[(&[&str], i32, &str)] = &[
        (
            &["--vary", "radio.sigma_db=1,2,-3"],
            3,
            "error: --vary radio.sigma_db=-3: radio.sigma_db = -3: must lie in 0..=50",
        ),
        (&["--vary", "radio.sigma=1,3"], 3, "unknown key 'radio.sigma'; did you mean 'sigma_db'?"),
        (
            &["--vary", "chain.uavs=2..5/6"],
            3,
            "error: --vary chain.uavs=2.6: chain.uavs = 2.6: expected a whole number",
        ),
        (&["--vary", "pilot.0.follow=left,lefd"], 3, "did you mean 'left'?"),
        (&["--vary", "radio.sigma_db"], 2, "expected key=values"),
        (&["--vary", "radio.sigma_db=0..5"], 3, "expected low..high/count, such as 0..5/6"),
        (&["--vary", "radio.sigma_db=1", "--vary", "radio.sigma_db=2"], 3, "radio.sigma_db is written twice"),
        (
            &["--vary", "radio.sigma_db=1", "--set", "radio.sigma_db=2"],
            3,
            "by --set radio.sigma_db, and by --vary radio.sigma_db",
        ),
        (&["--design", "d.csv"], 3, "error: d.csv:3: chain.uavs = 0: must lie in 1..=1000"),
        (&["--design", "keys.csv"], 3, "error: keys.csv:1: unknown key 'chain.uavz'; did you mean 'uavs'?"),
        (&["--design", "ragged.csv"], 3, "error: ragged.csv:2: 1 cells, expected 2"),
        (&["--design", "none.csv"], 3, "error: none.csv: cannot read the design: No such file"),
        (&["--vary", "chain.base_m=[0,50],[0,60]"], 3, "the base is in rock"),
        (&["--replicates", "0"], 3, "0 replicates: expected at least 1"),
        (&["--threads", "0"], 2, "expected a whole number from 1 to 1024"),
        (&["--shard", "5/4"], 2, "expected I/N with I from 1 to N"),
    ];
    for (args, code, wanted) in table {
        let args = [&["sweep", "corner", "--out", "results"], *args].concat();
        let output = uchain(here.path(), &args);
        assert_eq!(output.status.code(), Some(*code), "{args:?}: {}", stderr(&output));
        assert!(stderr(&output).contains(wanted), "{args:?}\n  got    {}  wanted {wanted}", stderr(&output));
        assert_eq!(files(here.path()), before, "{args:?}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_trillion_combinations_are_refused_in_little_memory() {
    let here = folder();
    let sweep = "sweep corner --out results --vary radio.sigma_db=0..5/1000000 --vary motion.radius_m";
    let limited = |count: &str| {
        let script = format!("ulimit -v 1000000; exec \"$0\" {sweep}=0.05..0.06/{count}");
        let uchain = env!("CARGO_BIN_EXE_uchain");
        Command::new("sh").current_dir(here.path()).args(["-c", &script, uchain]).output().unwrap()
    };
    for (count, runs) in
        [("1000000", "1000000000000 runs"), ("18446744073709551615", "18446744073709551615000000 runs")]
    {
        let output = limited(count);
        assert_eq!(output.status.code(), Some(3), "{}", stderr(&output));
        assert!(stderr(&output).contains(runs), "{}", stderr(&output));
        assert!(stderr(&output).contains("expected at most 10000000"), "{}", stderr(&output));
    }
    assert!(!here.path().join("results").exists());
}

#[test]
fn a_folder_of_another_sweep_is_refused_by_what_differs() {
    let here = folder();
    ok(uchain(here.path(), &small("a", &["--quiet"])));
    let again = uchain(here.path(), &small("a", &[]));
    assert_eq!(again.status.code(), Some(2));
    assert!(stderr(&again).contains("a holds a sweep already: add --resume"), "{}", stderr(&again));
    let others: &[(&[&str], &str)] = &[
        (&["--seed", "2"], "seed = 1 there, 2 asked for"),
        (
            &["--vary", "chain.uavs=2,3"],
            "--vary radio.sigma_db=0..6/4 there, --vary radio.sigma_db=0..6/4 --vary chain.uavs=2,3 asked for",
        ),
        (
            &["--set", "chain.uavs=2"],
            "set = [\"duration_s=3\"] there, [\"duration_s=3\",\"chain.uavs=2\"] asked for",
        ),
    ];
    for (more, wanted) in others {
        let output = uchain(here.path(), &small("a", &[more, &["--resume"][..]].concat()));
        assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
        assert!(stderr(&output).contains(wanted), "{}", stderr(&output));
    }
    let file = here.path().join("a/sweep.json");
    let text = fs::read_to_string(&file).unwrap();
    let ours = concat!("\"version\": \"", env!("CARGO_PKG_VERSION"));
    fs::write(&file, text.replace(ours, "\"version\": \"0.0.7")).unwrap();
    let output = uchain(here.path(), &small("a", &["--resume"]));
    assert!(stderr(&output).contains("version = \"0.0.7\" there"), "{}", stderr(&output));
    fs::write(&file, text).unwrap();
    ok(uchain(here.path(), &small("a", &["--resume", "--quiet"])));

    fs::create_dir(here.path().join("b")).unwrap();
    fs::write(here.path().join("b/letter.txt"), "dear").unwrap();
    let occupied = uchain(here.path(), &small("b", &["--resume"]));
    assert_eq!(occupied.status.code(), Some(2));
    assert!(stderr(&occupied).contains("b holds something else (letter.txt)"), "{}", stderr(&occupied));
    assert_eq!(files(&here.path().join("b")).len(), 1);
}
