use std::fs;

use serde_json::Value;

use super::{files, folder, ok, small, stderr, stdout, uchain};

#[test]
fn repro_flies_one_row_again_and_a_row_that_differs_exits_with_4() {
    let here = folder();
    ok(uchain(here.path(), &small("a", &["--quiet"])));
    let repro = ok(uchain(here.path(), &["repro", "a", "--run", "7", "--json"]));
    let summary: Value = serde_json::from_str(stdout(&repro)).unwrap();
    assert_eq!(summary["sim_s"], 3.0);
    let results = here.path().join("runs/straight-run7");
    let names: Vec<_> = files(&results).iter().map(|path| path.file_name().unwrap().to_owned()).collect();
    assert_eq!(names, ["run.mcap", "run.png", "summary.json"]);
    ok(uchain(here.path(), &["verify", "runs/straight-run7/run.mcap"]));
    // Of a shard as well, as soon as the row is there.
    ok(uchain(here.path(), &small("part", &["--shard", "2/4", "--quiet"])));
    ok(uchain(here.path(), &["repro", "part", "--run", "1", "--quiet"]));
    assert_eq!(uchain(here.path(), &["repro", "part", "--run", "0"]).status.code(), Some(3));
    let beyond = uchain(here.path(), &["repro", "a", "--run", "12"]);
    assert_eq!(beyond.status.code(), Some(3));
    assert!(stderr(&beyond).contains("no run 12: the sweep has the runs 0 to 11"), "{}", stderr(&beyond));

    let file = here.path().join("a/sweep.json");
    let text = fs::read_to_string(&file).unwrap();
    fs::write(&file, text.replace("duration_s=3", "duration_s=2")).unwrap();
    let differs = uchain(here.path(), &["repro", "a", "--run", "7", "--quiet"]);
    assert_eq!(differs.status.code(), Some(4));
    assert!(stderr(&differs).contains("run 7 differs: its digest was "), "{}", stderr(&differs));
}

#[test]
fn a_failed_run_is_a_row_with_its_reason_and_leaves_a_recording_if_asked() {
    let here = folder();
    let args = [
        "sweep",
        "corner",
        "--set",
        "duration_s=10",
        "--set",
        "faults.dead=[{ uav = 0, start_s = 5 }]",
        "--vary",
        "chain.spacing_m=0.05,0.25",
        "--vary",
        "faults.dead.0.start_s=5,100",
        "--out",
        "a",
        "--record",
        "failed",
    ];
    ok(uchain(here.path(), &args));
    let report = ok(uchain(here.path(), &["report", "a"]));
    let text = stdout(&report);
    assert!(text.contains("- failed: 3\n"), "{text}");
    assert!(text.contains("| 2 | 0 | not flown: --vary chain.spacing_m=0.05: "), "{text}");
    assert!(text.contains("| 1 | 2 | head-failed | the head failed at 5.00 s"), "{text}");
    let recordings = files(&here.path().join("a/recordings"));
    assert_eq!(recordings, [here.path().join("a/recordings/run-00000002.mcap")]);
    ok(uchain(here.path(), &["verify", "a/recordings/run-00000002.mcap"]));
    let repro = uchain(here.path(), &["repro", "a", "--run", "0"]);
    assert_eq!(repro.status.code(), Some(3), "what could not be flown then cannot be flown now");
}

#[test]
fn a_report_says_mean_median_and_interval_of_every_cell_and_draws_them() {
    let here = folder();
    ok(uchain(here.path(), &small("a", &["--quiet"])));
    let report = ok(uchain(here.path(), &["report", "a"]));
    let written = fs::read_to_string(here.path().join("a/report.md")).unwrap();
    assert!(stdout(&report).starts_with(&written), "{}", stdout(&report));
    for wanted in [
        "# Sweep of straight\n",
        "- 12 runs: 4 variants × 3 replicates\n",
        "## head_reach_m\n",
        "| radio.sigma_db | runs | failed | mean | 95 % interval | median |",
        "![head_reach_m](plots/head_reach_m.svg)",
    ] {
        assert!(written.contains(wanted), "{wanted} is missing in {written}");
    }
    let csv = fs::read_to_string(here.path().join("a/report.csv")).unwrap();
    assert!(csv.starts_with("metric,variant,radio.sigma_db,runs,mean,mean_low,mean_high,median\n"), "{csv}");
    let picture = fs::read(here.path().join("a/plots/head_reach_m.png")).unwrap();
    assert_eq!(image::load_from_memory(&picture).unwrap().width(), 1400);
    assert!(fs::read_to_string(here.path().join("a/plots/head_reach_m.svg")).unwrap().starts_with("<svg"));
    assert_eq!(uchain(here.path(), &["report", "nowhere"]).status.code(), Some(3));
}

/// A relay takes off in one of six runs or two: Student's t alone would say that it may be fewer than none.
#[test]
fn no_interval_of_a_count_is_below_0() {
    let here = folder();
    let args =
        ["sweep", "corner", "--set", "duration_s=18", "--vary", "radio.sigma_db=3,6", "--replicates", "6"];
    ok(uchain(here.path(), &[&args[..], &["--out", "a", "--quiet"]].concat()));
    ok(uchain(here.path(), &["report", "a", "--quiet"]));
    let csv = fs::read_to_string(here.path().join("a/report.csv")).unwrap();
    let rows = csv.lines().filter(|line| line.starts_with("relays_used,"));
    let rows: Vec<Vec<f64>> =
        rows.map(|row| row.split(',').skip(4).map(|cell| cell.parse().unwrap()).collect()).collect();
    assert_eq!(rows.len(), 2);
    for row in rows {
        let [mean, low, high, _] = row[..] else { panic!("{row:?}") };
        assert!(2.0 * mean - high < 0.0, "nothing to cut: {row:?}");
        assert_eq!(low, 0.0);
    }
    let written = fs::read_to_string(here.path().join("a/report.md")).unwrap();
    assert!(written.contains("those of counts are cut at 0"), "{written}");
    let drawn = fs::read_to_string(here.path().join("a/plots/relays_used.svg")).unwrap();
    assert!(drawn.contains("cut at 0") && drawn.contains("relays in the air at the end"), "{drawn}");
}

#[test]
fn an_exploration_is_swept_like_a_chain() {
    let here = folder();
    let args = ["sweep", "apartment", "--set", "duration_s=20", "--vary", "explore.strategy=cssg,srg"];
    let sweep = |more: &[&str]| uchain(here.path(), &[&args[..], more].concat());
    ok(sweep(&["--replicates", "2", "--out", "a", "--quiet"]));
    ok(sweep(&["--replicates", "2", "--out", "b", "--threads", "1", "--quiet"]));
    assert!(super::table(&here.path().join("a")) == super::table(&here.path().join("b")));
    ok(uchain(here.path(), &["repro", "a", "--run", "3", "--quiet"]));
    let report = ok(uchain(here.path(), &["report", "a"]));
    assert!(stdout(&report).contains("## coverage\n"), "{}", stdout(&report));
    // The time is up long before all are home: the mission failed.
    ok(sweep(&["--out", "c", "--record", "failed", "--quiet"]));
    ok(uchain(here.path(), &["verify", "c/recordings/run-00000001.mcap"]));
}
