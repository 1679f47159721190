use std::{fs, path::Path, process::Output};

use serde_json::Value;
use uchain_sim::{
    analyse::{Cell, Kind},
    sweep::folder::{Folder, FolderError},
};

use super::{folder, ok, stderr, stdout, uchain};
use crate::{files, shared_cases};

/// Flies a scenario for a second.
fn short(here: &Path, scenario: &str, out: &str, more: &[&str]) -> Output {
    let args = ["sweep", scenario, "--set", "duration_s=1", "--out", out, "--json"];
    uchain(here, &args.into_iter().chain(more.iter().copied()).collect::<Vec<_>>())
}

/// A column of a table: what it is, and its cells.
fn column(folder: &Path, name: &str) -> (Kind, Vec<Cell>) {
    let folder = Folder::open(folder).unwrap();
    let columns = folder.sweep().unwrap().columns();
    let column =
        columns.iter().find(|column| column.name == name).unwrap_or_else(|| panic!("no column {name}"));
    let cells: Result<Vec<_>, FolderError> = folder.column(column).unwrap().collect();
    (column.kind, cells.unwrap().concat())
}

#[test]
fn tables_as_programs_write_them_give_the_variants_that_are_meant() {
    let Some(cases) = shared_cases() else { return };
    let here = folder();
    let (count, number) = (|n| Cell::Count(n), |n| Cell::Number(n));
    let text = |word: &str| Cell::Text(word.to_owned());
    let table: [(&str, &str, &str, Kind, Vec<Cell>); 7] = [
        (
            "polars_null",
            "straight",
            "radio.sigma_db",
            Kind::Number,
            vec![number(1.0), Cell::Absent, number(2.0)],
        ),
        ("float_int", "straight", "chain.uavs", Kind::Count, vec![count(2), count(3), count(4)]),
        ("np_nocomment", "straight", "chain.uavs", Kind::Count, vec![count(2), count(3)]),
        ("np_nocomment", "straight", "radio.sigma_db", Kind::Number, vec![number(1.5), number(2.0)]),
        ("pandas_nan_int", "straight", "chain.uavs", Kind::Count, vec![count(2), Cell::Absent, count(3)]),
        ("bool", "apartment", "explore.arc_ends", Kind::Text, vec![text("true"), text("false")]),
        ("np", "straight", "chain.uavs", Kind::Count, vec![count(2), count(3)]),
    ];
    for (number, (file, scenario, key, kind, wanted)) in table.into_iter().enumerate() {
        let design = cases.join(format!("designs/{file}.csv"));
        let out = format!("{file}{number}");
        let output = ok(short(here.path(), scenario, &out, &["--design", design.to_str().unwrap()]));
        let said: Value = serde_json::from_str(stdout(&output)).unwrap();
        assert_eq!(said["variants"], wanted.len(), "{file}");
        assert_eq!(column(&here.path().join(&out), key), (kind, wanted), "{file}");
        // Nobody failed for a value that was misread.
        let failed = column(&here.path().join(&out), "digest").1;
        assert!(failed.iter().all(|digest| digest.text().is_some()), "{file}");
    }
}

#[test]
fn tables_that_are_not_clear_are_refused_at_line_1_for_what_they_are() {
    let Some(cases) = shared_cases() else { return };
    let here = folder();
    let table = [
        (
            "designs/comment.csv",
            "a comment; expected keys such as radio.sigma_db,chain.uavs in the first line",
        ),
        ("designs/pandas_index.csv", "column 1 has no name, as the index of a data frame"),
        ("designs/tab.csv", "columns are separated by tabs, expected commas"),
        (
            "designs/dupcol.csv",
            "chain.uavs is written twice: by column 1, 'chain.uavs', and by column 2, 'chain.uavs'",
        ),
        (
            "sweep-keys/spaces.csv",
            "radio.sigma_db is written twice: by column 1, 'radio . sigma_db', and by column 2, 'radio.sigma_db'",
        ),
        ("sweep-keys/parent.csv", "column 1, 'radio.alpha_free' lies within column 2, 'radio'"),
    ];
    for (file, wanted) in table {
        let design = cases.join(file);
        let output = short(here.path(), "straight", "out", &["--design", design.to_str().unwrap()]);
        assert_eq!(output.status.code(), Some(3), "{file}: {}", stderr(&output));
        let wanted = format!("error: {}:1: {wanted}", design.display());
        assert!(
            stderr(&output).starts_with(&wanted),
            "{file}\n  got    {}  wanted {wanted}",
            stderr(&output)
        );
        assert_eq!(files(here.path()), Vec::<std::path::PathBuf>::new(), "{file}");
    }
}

#[test]
fn a_key_that_is_written_twice_or_within_another_is_refused_wherever_it_stands() {
    let here = folder();
    fs::write(here.path().join("d.csv"), "radio.alpha_free\n2\n").unwrap();
    let table: &[(&[&str], &str)] = &[
        (
            &["--set", "radio={sigma_db=1}", "--vary", "radio.alpha_free=2,3"],
            "--vary radio.alpha_free lies within --set radio:",
        ),
        (
            &["--set", "radio.alpha_free=2", "--vary", "radio={sigma_db=1},{sigma_db=2}"],
            "--set radio.alpha_free lies within --vary radio:",
        ),
        (
            &["--set", "radio={sigma_db=1}", "--set", "radio.alpha_free=2"],
            "--set radio.alpha_free lies within --set radio:",
        ),
        (
            &["--design", "d.csv", "--vary", "radio={sigma_db=1}"],
            "d.csv:1: column 1, 'radio.alpha_free' lies within --vary radio:",
        ),
        (
            &["--design", "d.csv", "--set", "radio . alpha_free=1"],
            "d.csv:1: radio.alpha_free is written twice: by --set radio . alpha_free, and by column 1",
        ),
        (
            &["--vary", "pilot.00.speed_mps=0.1", "--set", "pilot.0.speed_mps=0.1"],
            "pilot.0.speed_mps is written twice: by --set pilot.0.speed_mps, and by --vary pilot.00.speed_mps",
        ),
        (&["--set", "radio.sigma_db=1", "--set", "radio.sigma_db=2"], "radio.sigma_db is written twice"),
    ];
    for (more, wanted) in table {
        let output = short(here.path(), "corner", "out", more);
        assert_eq!(output.status.code(), Some(3), "{more:?}: {}", stderr(&output));
        assert!(stderr(&output).contains(wanted), "{more:?}\n  got    {}  wanted {wanted}", stderr(&output));
        assert!(!here.path().join("out").exists(), "{more:?}");
    }
    // Apart from each other they are flown.
    ok(short(here.path(), "corner", "out", &["--design", "d.csv", "--set", "radio.sigma_db=1"]));
}

#[test]
fn a_column_is_of_the_type_of_its_key_whatever_its_values_are() {
    let here = folder();
    fs::write(here.path().join("none.csv"), "radio.sigma_db,chain.uavs\n,\n").unwrap();
    let swept = |out: &str, more: &[&str]| {
        ok(short(here.path(), "straight", out, more));
        here.path().join(out)
    };
    let number = |n| Cell::Number(n);
    let whole = swept("whole", &["--vary", "radio.sigma_db=1,2"]);
    assert_eq!(column(&whole, "radio.sigma_db"), (Kind::Number, vec![number(1.0), number(2.0)]));
    let mixed = swept("mixed", &["--vary", "radio.sigma_db=2,2.5"]);
    assert_eq!(column(&mixed, "radio.sigma_db"), (Kind::Number, vec![number(2.0), number(2.5)]));
    let none = swept("none", &["--design", "none.csv"]);
    assert_eq!(column(&none, "radio.sigma_db"), (Kind::Number, vec![Cell::Absent]));
    assert_eq!(column(&none, "chain.uavs"), (Kind::Count, vec![Cell::Absent]));
    let words = swept("words", &["--vary", "pilot.0.follow=left,'left'"]);
    let left = || Cell::Text("left".to_owned());
    assert_eq!(column(&words, "pilot.0.follow"), (Kind::Text, vec![left(), left()]));
}
