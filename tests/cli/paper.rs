use std::fs;

use crate::{folder, stderr, stdout, uchain};

#[test]
fn an_item_leaves_its_picture_its_numbers_and_a_report_and_says_its_verdict() {
    let here = folder();
    let output = uchain(here.path(), &["paper", "table1"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(stdout(&output).starts_with("table1: ") && stderr(&output).starts_with("table1: "));
    let out = here.path().join("paper");
    for name in [
        "table1.csv",
        "table1-paths.png",
        "table1-paths.svg",
        "table1-heights.png",
        "table1-heights-points.csv",
        "verdicts.csv",
    ] {
        assert!(out.join(name).is_file(), "{name}");
    }
    let report = fs::read_to_string(out.join("REPORT.md")).unwrap();
    assert!(report.contains("## table1") && !report.contains("## fig10"));
    // The same folder again, and nothing said.
    let output = uchain(here.path(), &["paper", "table1", "--out", "paper", "--quiet"]);
    assert_eq!((output.status.code(), stdout(&output), stderr(&output)), (Some(0), "", ""));
}

#[test]
fn an_item_nobody_knows_is_refused_with_those_there_are() {
    let here = folder();
    let output = uchain(here.path(), &["paper", "fig5"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(
        stderr(&output).contains("fig4abc") && !here.path().join("paper").exists(),
        "{}",
        stderr(&output)
    );
}
