/// Processes that are killed.
#[cfg(target_os = "linux")]
mod crash;
/// Keys and tables of values, as people and programs write them.
mod design;
/// Disks that are full, folders that cannot be written, files that are damaged.
#[cfg(target_os = "linux")]
mod disk;
/// What is asked for and cannot be.
mod refuse;
/// What comes after: `report`, `repro`, recordings.
mod rows;
/// What stands in a table is what was flown, bit for bit, and all of it.
mod whole;

use std::{
    fs,
    path::Path,
    process::{Command, Output},
};

use serde_json::Value;

use crate::{command, files, folder, stderr, stdout, uchain};

/// Twelve short runs in four variants: a chunk each.
const SMALL: [&str; 8] =
    ["sweep", "straight", "--set", "duration_s=3", "--vary", "radio.sigma_db=0..6/4", "--replicates", "3"];

/// A small sweep into a folder.
fn small<'a>(out: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    SMALL.into_iter().chain(["--out", out]).chain(more.iter().copied()).collect()
}

fn ok(output: Output) -> Output {
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    output
}

fn table(folder: &Path) -> Vec<u8> {
    fs::read(folder.join("runs.parquet")).unwrap()
}

/// The table of the small sweep, made in one go.
fn reference(here: &Path) -> Vec<u8> {
    ok(uchain(here, &small("reference", &["--quiet"])));
    table(&here.join("reference"))
}

/// Whether a tool is here; in the gate absence is a failure.
#[cfg(target_os = "linux")]
fn has(tool: &str, args: &[&str]) -> bool {
    let works = Command::new(tool).args(args).output().is_ok_and(|output| output.status.success());
    assert!(
        works || std::env::var("CI").as_deref() != Ok("true"),
        "the gate needs {tool} {}",
        args.join(" ")
    );
    if !works {
        eprintln!("skipped: {tool} is not here, or may not do its work");
    }
    works
}

#[test]
fn the_table_has_the_same_bytes_for_any_number_of_threads_and_shards() {
    let here = folder();
    let reference = reference(here.path());
    for threads in ["1", "2", "3", "7", "16"] {
        ok(uchain(here.path(), &small(threads, &["--threads", threads, "--quiet"])));
        assert!(table(&here.path().join(threads)) == reference, "{threads} threads");
    }
    let parts: Vec<String> = (1..=4).map(|i| format!("part{i}")).collect();
    for (i, part) in parts.iter().enumerate() {
        let shard = format!("{}/4", i + 1);
        let output = ok(uchain(here.path(), &small(part, &["--shard", &shard, "--json"])));
        let said: Value = serde_json::from_str(stdout(&output)).unwrap();
        assert_eq!((&said["runs"], &said["complete"]), (&3.into(), &false.into()), "{said}");
    }
    let missing = uchain(here.path(), &["merge", "part1", "part3", "part4", "--out", "whole"]);
    assert_eq!(missing.status.code(), Some(3));
    assert!(
        stderr(&missing).contains("3 of 12 runs are missing, the first is run 1"),
        "{}",
        stderr(&missing)
    );
    assert!(!here.path().join("whole").exists());
    ok(uchain(here.path(), &["merge", "part1", "part2", "part3", "part4", "--out", "whole"]));
    assert!(table(&here.path().join("whole")) == reference, "merged");
    assert_eq!(files(&here.path().join("part2/chunks")).len(), 3, "the shards stay as they are");

    // Were the comparison blind, it would not see this either.
    ok(uchain(here.path(), &small("other", &["--seed", "2", "--quiet"])));
    assert!(table(&here.path().join("other")) != reference);
}

#[test]
fn json_ends_with_the_promised_numbers_and_the_digest_counts_every_run() {
    let here = folder();
    let said = |out: &str, more: &[&str]| -> Value {
        let more: Vec<&str> = more.iter().chain(&["--json"]).copied().collect();
        serde_json::from_str(stdout(&ok(uchain(here.path(), &small(out, &more))))).unwrap()
    };
    let first = said("a", &[]);
    let keys: Vec<&String> = first.as_object().unwrap().keys().collect();
    assert_eq!(keys[keys.len() - 5..], ["runs", "failed", "sim_s", "wall_s", "digest"]);
    assert_eq!((first["runs"].as_u64(), first["sim_s"].as_f64()), (Some(12), Some(36.0)));
    assert_eq!(said("a", &["--resume"])["digest"], first["digest"], "there is nothing left to do");
    assert_ne!(said("b", &["--seed", "2"])["digest"], first["digest"]);
}

#[test]
fn the_runs_of_a_replicate_have_the_same_seed_and_run_with_that_seed_is_the_same_flight() {
    let here = folder();
    ok(uchain(here.path(), &small("a", &["--record", "all", "--quiet"])));
    let seed = |run: usize| -> String {
        let file = format!("a/recordings/run-{run:08}.mcap");
        let inspected = ok(uchain(here.path(), &["inspect", &file, "--json"]));
        let inspected: Value = serde_json::from_str(stdout(&inspected)).unwrap();
        inspected["seed"].to_string()
    };
    // Variant-major: run 4 is replicate 1 of variant 1, sigma 2 dB.
    assert_eq!(seed(1), seed(4));
    assert_ne!(seed(0), seed(1));
    let args =
        ["run", "straight", "--set", "duration_s=3", "--set", "radio.sigma_db=2", "--quiet", "--out", "one"];
    ok(uchain(here.path(), &args.into_iter().chain(["--seed", &seed(4)]).collect::<Vec<_>>()));
    ok(uchain(here.path(), &["diff", "a/recordings/run-00000004.mcap", "one/run.mcap"]));
    let other = uchain(here.path(), &["diff", "a/recordings/run-00000005.mcap", "one/run.mcap"]);
    assert_eq!(other.status.code(), Some(4), "another replicate is another flight");
}
