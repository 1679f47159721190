//! Logs and arguments that are wrong.

use std::{fmt::Write as _, fs};

use super::{node, relay};
use crate::{files, folder, stderr, stdout, uchain};

#[test]
fn what_is_wrong_with_a_log_is_said_with_line_column_and_remedy_and_nothing_is_written() {
    let here = folder();
    let header = "time_s,place,tof_nw_m,tof_ne_m,tof_sw_m,tof_se_m,ground_speed_mps,battery,back_rssi_dbm,front_rssi_dbm\n";
    let row = |cells: &str| format!("{header}0,1,0.6,0.6,0.6,0.6,0,0.9,-50,-60\n{cells}\n");
    let ok = node(here.path(), &row("0.05,,,,,,,,,"), &["--quiet", "--out", "results"]);
    assert_eq!((ok.status.code(), stderr(&ok)), (Some(0), ""));
    fs::remove_dir_all(here.path().join("results")).unwrap();

    let pair = "time_s,back_rssi_dbm,front_rssi_dbm";
    let table: &[(String, &str)] = &[
        (String::new(), "log.csv: empty: expected a table in CSV"),
        (header.to_owned(), "log.csv: no rows below the header"),
        ("0,-50\n1,-50\n".to_owned(), "log.csv:1: column 1 is called '0': values without names"),
        (format!("{pair},tof_nw\n"), "log.csv:1: unknown column 'tof_nw'; did you mean 'tof_nw_m'?"),
        (
            format!("{pair},voltage\n"),
            "log.csv:1: unknown column 'voltage'; put a # before its name to leave it out",
        ),
        (format!("{pair},\n"), "log.csv:1: column 4 has no name"),
        (format!("{pair},time_s\n"), "log.csv:1: two columns are called time_s"),
        (
            "time_s;front_rssi_dbm\n0;1\n".to_owned(),
            "log.csv:1: columns are separated by semicolons, expected commas",
        ),
        (format!("{pair},back_loss_db\n"), "log.csv:1: back_rssi_dbm and back_loss_db are one thing"),
        (
            format!("{pair},tof_nw_m,tof_se_m\n"),
            "log.csv:1: no column tof_ne_m, tof_sw_m: expected all four distances",
        ),
        ("back_rssi_dbm,front_rssi_dbm\n".to_owned(), "log.csv:1: no column time_s"),
        (
            "time_s,back_rssi_dbm\n0,-50\n".to_owned(),
            "log.csv: no column front_rssi_dbm or front_loss_db: a relay decides by both",
        ),
        ("time_s,front_rssi_dbm\n0,-50\n".to_owned(), "log.csv: no column back_rssi_dbm or back_loss_db"),
        (row("0.05,,"), "log.csv:3: 3 cells: expected 10"),
        (row(",,,,,,,,,"), "log.csv:3: no time_s: expected one in every row"),
        (row("nan,,,,,,,,,"), "log.csv:3: time_s = nan: expected a number of seconds"),
        (row("now,,,,,,,,,"), "log.csv:3: time_s = now: expected a number of seconds"),
        (row("0,,,,,,,,,"), "log.csv:3: time_s = 0: not later than 0 in line 2: sort the rows by time"),
        (row("-1,,,,,,,,,"), "log.csv:3: time_s = -1: not later than 0 in line 2"),
        (
            row("50,,,,,,,,,"),
            "log.csv:3: time_s = 50: 50.0 s after line 2, expected at most 30 s: is it in milliseconds?",
        ),
        (row("0.05,1.5,,,,,,,,"), "log.csv:3: place = 1.5: expected a whole number"),
        (row("0.05,,0.6 m,,,,,,,"), "log.csv:3: tof_nw_m = 0.6 m: expected a number, or an empty cell"),
        (row("0.05,,,600,,,,,,"), "log.csv:3: tof_ne_m = 600: is it in millimetres? expected metres"),
        (row("0.05,,,,,,200,,,"), "log.csv:3: ground_speed_mps = 200: is it in mm/s?"),
        (row("0.05,,,,,,,90,,"), "log.csv:3: battery = 90: is it in per cent"),
        (
            row("0.05,,,,,,,,57,"),
            "log.csv:3: back_rssi_dbm = 57: is it without its minus? then the column is called back_loss_db",
        ),
        (row("0.05,,,,,,,,-257,"), "log.csv:3: back_rssi_dbm = -257: expected -200 to 20"),
        (row("0.05,,-5,,,,,,,"), "log.csv:3: tof_nw_m = -5: expected -1 to 100"),
        (row("0.05,,,,,,,,,NA"), "log.csv:3: front_rssi_dbm = NA: expected a number, or an empty cell"),
        (
            "time_s,back_loss_db,front_loss_db\n0,50,-60\n".to_owned(),
            "log.csv:2: front_loss_db = -60: is it a received power in dBm? then the column is called front_rssi_dbm",
        ),
        (format!("{pair},back_is_base\n0,-50,-60,yes\n"), "log.csv:2: back_is_base = yes: expected 1 or 0"),
        (
            format!("{pair},front_follow\n0,-50,-60,up\n"),
            "log.csv:2: front_follow = up: expected centre, left or right",
        ),
        (
            format!("{pair},asked_yaw_rate_radps\n0,-50,-60,90\n"),
            "log.csv:2: asked_yaw_rate_radps = 90: is it in degrees?",
        ),
    ];
    for (log, wanted) in table {
        let output = node(here.path(), log, &["--out", "results"]);
        assert_eq!(output.status.code(), Some(3), "{log}\n{}", stderr(&output));
        assert!(stderr(&output).starts_with(&format!("error: {wanted}")), "{}\n{wanted}", stderr(&output));
        assert_eq!((stdout(&output), files(here.path()).len()), ("", 1), "{log}");
    }
    fs::write(here.path().join("log.csv"), b"time_s\n\xff\xfe").unwrap();
    let output = uchain(here.path(), &["node", "log.csv"]);
    assert!(
        stderr(&output).starts_with("error: log.csv: not UTF-8 text from byte 7 on"),
        "{}",
        stderr(&output)
    );
    let output = uchain(here.path(), &["node", "absent.csv"]);
    assert_eq!(output.status.code(), Some(3));
    assert!(stderr(&output).starts_with("error: absent.csv: cannot read the log: "), "{}", stderr(&output));
}

#[test]
fn a_log_that_is_too_long_is_refused_at_its_line_and_one_that_is_too_large_unread() {
    let here = folder();
    let mut log = "time_s,back_rssi_dbm,front_rssi_dbm\n".to_owned();
    for row in 0..500_001 {
        let _ = writeln!(log, "{:.3},,", f64::from(row) * 0.001);
    }
    let output = node(here.path(), &log, &[]);
    let wanted = "error: log.csv:500002: more than 500000 rows, with the decisions between them: cut the log into parts";
    assert!(stderr(&output).starts_with(wanted), "{}", stderr(&output));
    let file = fs::File::create(here.path().join("log.csv")).unwrap();
    file.set_len((64 << 20) + 1).unwrap();
    let output = uchain(here.path(), &["node", "log.csv"]);
    assert_eq!(output.status.code(), Some(3));
    assert!(stderr(&output).starts_with("error: log.csv: longer than 67108864 bytes"), "{}", stderr(&output));
    // A row every 29 s, each with 579 decisions in between: what is asked of the node is bounded as well.
    let mut log = "time_s,back_rssi_dbm,front_rssi_dbm\n".to_owned();
    (0..2_900).for_each(|row| writeln!(log, "{},,", row * 29).unwrap());
    let output = node(here.path(), &log, &["--set", "equalize.decision_s=0.05"]);
    assert!(
        stderr(&output).contains("more than 500000 rows, with the decisions between them"),
        "{}",
        stderr(&output)
    );
    assert_eq!(files(here.path()).len(), 1);
}

#[test]
fn what_no_node_can_be_is_a_usage_error_or_a_key_with_its_place() {
    let here = folder();
    let table: &[(&[&str], i32, &str)] = &[
        (&["--role", "head", "--place", "2"], 2, "error: --role head --place 2: the head has place 0"),
        (&["--place", "0"], 2, "error: --place 0: that is the head; add --role head"),
        (&["--role", "tail"], 2, "error: invalid value 'tail' for '--role <ROLE>'"),
        (&["--csv", "--json"], 2, "error: the argument '--csv' cannot be used with '--json'"),
        (
            &["--set", "radio.sigma_db=3"],
            3,
            "error: --set radio.sigma_db=3: radio.sigma_db = 3: no value of a node",
        ),
        (&["--set", "tof.noise_m=0"], 3, "error: --set tof.noise_m=0: tof.noise_m = 0: no value of a node"),
        (
            &["--set", "equalise.k_db_per_m=3"],
            3,
            "error: --set equalise.k_db_per_m=3: equalise.k_db_per_m = 3: no value of a node: did you mean 'equalize'?",
        ),
        (
            &["--set", "equalize.k_db_per_n=3"],
            3,
            "error: --set equalize.k_db_per_n=3: unknown key 'equalize.k_db_per_n'; did you mean 'k_db_per_m'?",
        ),
        (
            &["--set", "equalize.k_db_per_m=0"],
            3,
            "error: --set equalize.k_db_per_m=0: equalize.k_db_per_m = 0: must lie in 0.1..=10000",
        ),
        (
            &["--set", "tof.range_m=0"],
            3,
            "error: --set tof.range_m=0: tof.range_m = 0: must lie in 0.1..=100",
        ),
        (
            &["--set", "takeoff.s_min_db=90"],
            3,
            "error: --set takeoff.s_min_db=90: takeoff.s_min_db = 90: must lie below link.head_stop_db = 70: else the head stops \
             before the next relay takes off; such as --set link.head_stop_db=100 --set link.head_back_db=105",
        ),
        (
            &["--set", "link.head_back_db=60"],
            3,
            "error: --set link.head_back_db=60: link.head_back_db = 60: must be at least link.head_stop_db = 70",
        ),
        (
            &["--preset", "cavemud"],
            3,
            "error: --preset cavemud: preset = \"cavemud\": unknown choice; did you mean 'cavemod'?",
        ),
    ];
    for (args, code, wanted) in table {
        let output = node(here.path(), &relay(), args);
        assert_eq!(output.status.code(), Some(*code), "{args:?}: {}", stderr(&output));
        assert!(
            stderr(&output).starts_with(wanted),
            "{args:?}\n  got    {}\n  wanted {wanted}",
            stderr(&output)
        );
        assert_eq!((stdout(&output), files(here.path()).len()), ("", 1), "{args:?}");
    }
    // A scenario has a key, a node has not: what may stand there helps nobody. It does where a node has the key.
    let hints = |set| stderr(&node(here.path(), &relay(), &["--set", set])).contains("uchain explain");
    assert!(!hints("radio.sigma_db=3") && hints("equalize.k_db_per_m=0"));
    let nothing = uchain(here.path(), &["node"]);
    assert_eq!(nothing.status.code(), Some(2));
    assert!(stderr(&nothing).contains("--help"), "{}", stderr(&nothing));
}
