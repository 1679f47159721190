mod odd;
mod wrong;

use std::{fmt::Write as _, fs, path::Path};

use serde_json::Value;

use crate::{files, folder, stderr, stdout, uchain};

/// A relay for 60 s at 20 Hz, packets at 5 Hz, its front link growing from 58 dB.
fn relay() -> String {
    let mut log =
        "time_s,tof_nw_m,tof_ne_m,tof_sw_m,tof_se_m,ground_speed_mps,back_rssi_dbm,front_rssi_dbm\n"
            .to_owned();
    for row in 0..1200 {
        // No reading of a real sensor stands still.
        let _ = write!(
            log,
            "{:.2},0.6,0.7,0.6,{:.3},0,",
            f64::from(row) * 0.05,
            0.7 + f64::from(row % 3) * 0.001
        );
        let _ = match row % 4 {
            0 => writeln!(log, "{},{:.1}", -55 - (row / 4) % 2, -58.0 - f64::from(row) * 0.01),
            _ => writeln!(log, ","),
        };
    }
    log
}

fn node(here: &Path, log: &str, args: &[&str]) -> std::process::Output {
    fs::write(here.join("log.csv"), log).unwrap();
    uchain(here, &[&["node", "log.csv"], args].concat())
}

/// The numbers of a replay.
fn json(log: &str, args: &[&str]) -> Value {
    let output = node(folder().path(), log, &[args, &["--json"]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    serde_json::from_str(stdout(&output)).unwrap()
}

#[test]
fn a_log_leaves_commands_a_picture_and_numbers_and_a_few_lines_for_people() {
    let here = folder();
    let output = node(here.path(), &relay(), &[]);
    assert_eq!((output.status.code(), stderr(&output)), (Some(0), ""));
    insta::assert_snapshot!(stdout(&output));
    let results = here.path().join("nodes/log");
    let names: Vec<_> = files(&results).iter().map(|path| path.file_name().unwrap().to_owned()).collect();
    assert_eq!(names, ["commands.csv", "node.json", "node.png"]);
    let picture = image::load_from_memory(&fs::read(results.join("node.png")).unwrap()).unwrap();
    assert_eq!(picture.width(), 1400);
    let commands = fs::read_to_string(results.join("commands.csv")).unwrap();
    assert_eq!(commands.lines().count(), 1201);
    let shown: Vec<&str> =
        [0, 1, 2, 241, 1197].iter().map(|line| commands.lines().nth(*line).unwrap()).collect();
    insta::assert_snapshot!(shown.join("\n"));
}

#[test]
fn json_is_the_file_and_csv_the_other_one_and_each_stands_alone_on_stdout() {
    let here = folder();
    let json = node(here.path(), &relay(), &["--json", "--out", "results"]);
    assert_eq!(stdout(&json), fs::read_to_string(here.path().join("results/node.json")).unwrap());
    let csv = node(here.path(), &relay(), &["--csv", "--out", "results"]);
    assert_eq!(stdout(&csv), fs::read_to_string(here.path().join("results/commands.csv")).unwrap());
    assert_eq!((stderr(&json), stderr(&csv)), ("", ""));
    let quiet = node(here.path(), &relay(), &["--quiet"]);
    assert_eq!((quiet.status.code(), stdout(&quiet), stderr(&quiet)), (Some(0), "", ""));
    fs::write(here.path().join("results/letter.txt"), "dear").unwrap();
    assert_eq!(
        node(here.path(), &relay(), &["--out", "results"]).status.code(),
        Some(2),
        "a stranger's file"
    );
}

#[test]
fn a_template_is_a_log() {
    let here = folder();
    let template = uchain(here.path(), &["node", "--template"]);
    assert_eq!((template.status.code(), stderr(&template)), (Some(0), ""));
    insta::assert_snapshot!(stdout(&template));
    assert_eq!(files(here.path()), [""; 0].map(std::path::PathBuf::from));
    let numbers = json(stdout(&template), &[]);
    assert_eq!((numbers["rows"].as_u64(), numbers["decisions"].as_u64()), (Some(2), Some(1)));
}

#[test]
fn what_it_is_and_by_whose_values_it_decides_is_said_in_words() {
    // 62 dB launch a relay by the defaults, and nobody with another threshold.
    let launch = |args: &[&str]| json(&relay(), args)["launch_s"].as_f64();
    assert_eq!(launch(&["--set", "takeoff.s_min_db=69.9"]), None);
    // 60.1 dB of filtered loss, held for a second; the head at its first decision; one in the air at its first packet.
    assert!((11.0..15.0).contains(&launch(&[]).unwrap()), "{:?}", launch(&[]));
    assert_eq!(launch(&["--role", "head"]), Some(0.0));
    assert_eq!(launch(&["--airborne"]), Some(0.0));
    assert_eq!(json(&relay(), &["--airborne"])["flying_s"].as_f64(), Some(0.0));

    let decisions = |args: &[&str]| json(&relay(), args)["decisions"].as_u64();
    assert_eq!(decisions(&[]), Some(300));
    assert_eq!(decisions(&["--preset", "cavemod"]), Some(600));
    assert_eq!(decisions(&["--preset", "cavemod", "--set", "equalize.decision_s=0.4"]), Some(150));
    let place = |args: &[&str]| json(&relay(), args)["place"].as_u64();
    assert_eq!(
        (place(&[]), place(&["--role", "head"]), place(&["--place", "3"])),
        (Some(1), Some(0), Some(3))
    );
    // A column says it better.
    let told = relay().replacen("time_s,", "time_s,place,", 1).replacen("\n0.00,", "\n0.00,2,", 1);
    let told: Vec<String> = told
        .lines()
        .enumerate()
        .map(|(i, line)| if i < 2 { line.to_owned() } else { line.replacen(',', ",,", 1) })
        .collect();
    assert_eq!(json(&told.join("\n"), &[])["place"].as_u64(), Some(2));
}

#[test]
fn losses_and_received_powers_are_one_thing_with_another_sign() {
    let rssi = relay();
    let loss = rssi
        .replace("back_rssi_dbm", "back_loss_db")
        .replace("front_rssi_dbm", "front_loss_db")
        .replace(",-", ",");
    let asked = |log: &str| stdout(&node(folder().path(), log, &["--csv"])).to_owned();
    assert!(asked(&rssi) == asked(&loss));
    // Windows, a spreadsheet, numpy: the same table.
    let others = [
        rssi.replace('\n', "\r\n"),
        rssi.replace('\n', "\r"),
        format!("\u{feff}{rssi}"),
        format!("# {rssi}"),
        rssi.replace(',', " , "),
    ];
    for (number, other) in others.iter().enumerate() {
        assert!(asked(other) == asked(&rssi), "{number}");
    }
    // Lines are counted as editors count them.
    let gaps = rssi.replacen("\n0.05,", "\n\n\n0.05,", 1);
    let third = asked(&gaps).lines().nth(2).unwrap().to_owned();
    assert!(third.starts_with("5,0.05,"), "{third}");
}

#[test]
fn what_the_drone_asked_for_itself_is_compared_with_what_the_node_asks() {
    let commands = stdout(&node(folder().path(), &relay(), &["--csv"])).to_owned();
    let column =
        |name: &str| commands.lines().next().unwrap().split(',').position(|other| other == name).unwrap();
    let (forward, lateral) = (column("asked_forward_mps"), column("asked_lateral_mps"));
    let mut log = String::new();
    for (row, asked) in relay().lines().zip(commands.lines()) {
        let asked: Vec<&str> = asked.split(',').collect();
        let _ = writeln!(log, "{row},{},{}", asked[forward], asked[lateral]);
    }
    let compared = &json(&log, &[])["compared"];
    for i in 0..2 {
        assert_eq!(
            (&compared[i]["rows"], &compared[i]["same_bits"]),
            (&1200.into(), &1200.into()),
            "{compared}"
        );
    }
    // The drone flew by other values.
    let other = json(&log, &["--set", "equalize.k_db_per_m=40"]);
    assert!(other["compared"][0]["same_bits"].as_u64() < Some(1200), "{other}");
    assert!(
        other["compared"][0]["largest_line"].is_u64() && other["compared"][1]["same_bits"] == 1200,
        "{other}"
    );
}

#[test]
fn gaps_and_cells_without_numbers_are_told_by_line_and_flown_all_the_same() {
    // Two seconds without rows, and a sensor that says it has no number.
    let rows: Vec<String> = relay().lines().map(str::to_owned).collect();
    let log =
        [&rows[..1002], &rows[1041..]].concat().join("\n").replacen("50.00,0.6,0.7,", "50.00,nan,inf,", 1);
    let here = folder();
    let output = node(here.path(), &log, &[]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    insta::assert_snapshot!(stderr(&output));
    let numbers = json(&log, &[]);
    let words = stderr(&output).lines().map(|line| line.strip_prefix("note: ").unwrap());
    assert_eq!(numbers["notes"], Value::from(words.collect::<Vec<_>>()));
    assert_eq!((&numbers["gaps"], &numbers["decisions_between_rows"]), (&1.into(), &9.into()));
    // In the gap its base is lost, and it flies back until the next packet.
    let over = &numbers["overrides"][0];
    assert_eq!((&over["by"], over["first_line"].is_null()), (&"back-lost".into(), true), "{numbers}");
    assert_eq!(numbers["rows"].as_u64().map(|rows| rows + 39), Some(1200));
}

#[test]
fn a_number_that_is_none_takes_nothing_away_from_what_was_measured_before_it() {
    let with = |speed: &str, rssi: &str| {
        let log = format!(
            "time_s,ground_speed_mps,back_rssi_dbm,front_rssi_dbm\n0,0.1,-50,-60\n0.05,0.3,-52,-61\n0.1,{speed},{rssi},\n0.2,,,\n"
        );
        let output = node(folder().path(), &log, &["--airborne", "--csv", "--quiet"]);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        stdout(&output).to_owned()
    };
    assert_eq!(with("nan", "nan"), with("", ""));
    assert_ne!(with("0.2", "-55"), with("", ""));
}
