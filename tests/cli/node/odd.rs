//! Logs that are read, and told to be odd.

use std::fmt::Write as _;

use super::{json, relay};

/// The notes of a replay.
fn notes(log: &str, args: &[&str]) -> Vec<String> {
    let numbers = json(log, args);
    let notes = numbers["notes"].as_array().unwrap();
    notes.iter().map(|note| note.as_str().unwrap().to_owned()).collect()
}

/// A log of two links, with a row every so often (s).
fn links(period_s: f64, rows: u32) -> String {
    let mut log = "time_s,back_rssi_dbm,front_rssi_dbm\n".to_owned();
    for row in 0..rows {
        let _ = writeln!(log, "{},{},-57", 12.3 + f64::from(row) * period_s, -50 - i64::from(row % 2));
    }
    log
}

/// A log with one column filled in every row beside two links.
fn with(column: &str, of: impl Fn(usize) -> String) -> String {
    let row = |(row, line): (usize, &str)| match row {
        0 => format!("{line},{column}\n"),
        _ => format!("{line},{}\n", of(row)),
    };
    links(0.05, 40).lines().enumerate().map(row).collect()
}

#[test]
fn a_log_is_slow_only_where_decisions_fall_between_its_rows() {
    let is_slow = |log: &str| notes(log, &[]).iter().any(|note| note.contains("rows come every"));
    // The sum of such times is off by its last bits, on either side.
    assert!(!is_slow(&links(0.2, 40)) && !is_slow(&links(0.200_01, 40)) && !is_slow(&links(0.05, 40)));
    // A decision without a row in a log that is no slow one is a gap, and is told as that.
    let hole: String = links(0.2, 40).lines().enumerate().filter(|(i, _)| !(20..25).contains(i)).fold(
        String::new(),
        |mut log, (_, line)| {
            let _ = writeln!(log, "{line}");
            log
        },
    );
    assert!(!is_slow(&hole) && notes(&hole, &[])[0].contains("1.20 s after the row before"));
    assert!(is_slow(&links(0.25, 40)) && is_slow(&links(1.0, 40)));
}

#[test]
fn a_beam_without_a_number_sees_nothing_and_nobody_is_told_to_leave_it_empty() {
    let told = notes(&relay().replacen("\n50.00,0.6,", "\n50.00,nan,", 1), &[]);
    assert_eq!(told, ["log.csv:1002: tof_nw_m: 1 cell with no number: a beam that sees nothing there"]);
    let told = notes(&relay().replacen(",0,,\n", ",nan,,\n", 1), &[]);
    assert!(told[0].starts_with("log.csv:3: ground_speed_mps: 1 cell") && told[0].ends_with("left empty"));
}

#[test]
fn a_place_that_was_asked_for_and_is_not_the_logs_is_told() {
    let log = with("place", |_| "2".to_owned());
    let wanted = "log.csv:2: place = 2: what the log tells counts, and not the place";
    assert!(notes(&log, &["--place", "3"])[0].starts_with(wanted));
    assert!(notes(&log, &["--role", "head"])[0].starts_with(wanted));
    assert_eq!((notes(&log, &[]), notes(&log, &["--place", "2"])), (vec![], vec![]));
}

#[test]
fn why_it_never_took_off_is_said_by_the_condition() {
    let grounded = |log: &str, args: &[&str]| json(log, args)["grounded"].as_str().map(str::to_owned);
    assert_eq!(grounded(&relay(), &[]), None);
    let high = grounded(&relay(), &["--set", "takeoff.s_min_db=69.9"]).unwrap();
    assert_eq!(
        high,
        "its front link came to 69.70 dB at most, and it takes off above takeoff.s_min_db = 69.9"
    );
    let young = relay().replacen("rssi_dbm\n", "rssi_dbm,front_flown_s\n", 1);
    let young: String = young
        .lines()
        .map(|line| if line.ends_with('s') { format!("{line}\n") } else { format!("{line},1\n") })
        .collect();
    let young = grounded(&young, &[]).unwrap();
    assert!(
        young.ends_with("but the UAV ahead had not flown for takeoff.after_previous_s = 3 (front_flown_s)"),
        "{young}"
    );
    let held = grounded(&relay(), &["--set", "takeoff.launch_hold_s=60"]).unwrap();
    assert!(
        held.contains("at the end (69.70 dB at most)") && held.ends_with("takeoff.launch_hold_s = 60"),
        "{held}"
    );
    let deaf = "time_s,back_rssi_dbm,front_rssi_dbm\n0,-50,\n0.2,-51,\n";
    assert_eq!(grounded(deaf, &[]).unwrap(), "nothing was heard of the neighbour toward the head");
    // Loud enough for two decisions, and silent ever after.
    let silent: String = relay()
        .lines()
        .enumerate()
        .map(|(i, line)| {
            let line =
                if i > 245 { line.rsplit_once(',').unwrap().0.to_owned() + "," } else { line.to_owned() };
            line + "\n"
        })
        .collect();
    let silent = grounded(&silent, &["--set", "takeoff.launch_hold_s=60"]).unwrap();
    assert!(silent.ends_with("nothing had been heard for longer than link.lost_s = 1"), "{silent}");
}

#[test]
fn readings_in_another_unit_and_readings_that_never_change_are_told() {
    let four = |of: &dyn Fn(usize) -> String| with("tof_nw_m,tof_ne_m,tof_sw_m,tof_se_m", of);
    let centimetres = notes(&four(&|row| format!("60,6{},60,62", row % 3)), &[]);
    let wanted = "log.csv:2: no distance of any row is within tof.range_m = 2, the least is 60: in cm? expected metres";
    assert!(centimetres[0].starts_with(wanted), "{centimetres:?}");
    assert_eq!(notes(&four(&|row| format!("2,2,2,{}", if row == 9 { "0.9" } else { "2" })), &[]), [""; 0]);

    let fast = notes(&with("ground_speed_mps", |row| if row < 3 { "-12" } else { "1.5" }.to_owned()), &[]);
    assert_eq!(
        fast,
        ["log.csv:2: ground_speed_mps: 2 rows beyond 1.5 m/s, -12 at most: in cm/s? expected m/s"]
    );
    let theirs = notes(&with("front_ground_speed_mps", |_| "12".to_owned()), &[]);
    assert!(theirs[0].starts_with("log.csv:2: front_ground_speed_mps: 40 rows beyond 1.5 m/s"));

    // 57 dB in every packet: 49 of them may be, 50 are told.
    let stuck = notes(&links(0.05, 50), &[]);
    assert_eq!(
        stuck,
        ["log.csv:2: packets of the front link with a loss of 57 dB, the same in all 50 of them: stuck?"]
    );
    assert_eq!(notes(&links(0.05, 49), &[]), [""; 0]);
    let still = relay().replace(",0.701,", ",0.7,").replace(",0.702,", ",0.7,").replace("0.700,", "0.7,");
    let still = notes(&still, &[]);
    assert_eq!(still, ["log.csv:2: sets of four distances, the same in all 1200 of them: stuck?"]);
}

#[test]
fn nothing_is_printed_as_minus_zero() {
    let log: String =
        links(0.05, 80).lines().map(|line| line.replace("-57", "0").replace("-5", "-0.0") + "\n").collect();
    let here = crate::folder();
    let text = crate::stdout(&super::node(here.path(), &log, &["--airborne"])).to_owned();
    assert!(
        text.contains("0.0 dB in the mean") && !text.contains("-0.0 ") && !text.contains("-0.000"),
        "{text}"
    );
}
