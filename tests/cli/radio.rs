//! `uchain radio`: logs fitted, refused, planned with; losses over a map.

use std::{
    fmt::Write as _,
    fs,
    path::{Path, PathBuf},
};

use serde_json::Value;
use uchain_sim::{
    config::builtin,
    glam::Vec2,
    mission::chain::Course,
    radio::Antenna,
    seed::{Seed, Source},
};

use crate::{folder, stderr, stdout, uchain};

fn ok(here: &Path, args: &[&str]) -> String {
    let output = uchain(here, args);
    assert_eq!((output.status.code(), stderr(&output)), (Some(0), ""), "{args:?}");
    stdout(&output).to_owned()
}

fn refused(here: &Path, args: &[&str], code: i32) -> String {
    let output = uchain(here, args);
    assert_eq!(output.status.code(), Some(code), "{args:?}: {}", stderr(&output));
    stderr(&output).to_owned()
}

fn examples() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/radio")
}

/// A walk out and back in a tunnel of the simulator, a packet every 5 cm: shadowing of 4 dB that stays, noise of 3 dB, and no
/// packet heard from 82 dB on.
fn walk() -> String {
    let sets = [
        "map.corridor.centre_line_m=[[0.0, 0.0], [32.0, 0.0]]",
        "radio.sigma_static_db=4",
        "radio.correlation_m=1.5",
        "radio.alpha_free=2.5",
    ];
    let course = Course::read(&builtin("straight").unwrap(), &sets.map(str::to_owned)).unwrap();
    let radio = course.radio.seeded(Seed(7)).unwrap();
    let mut stream = Seed(7).stream(0, Source::Start);
    let mut text = "# Made by the simulator (tests/cli/radio.rs): L0 35 dB, exponent 2.5, noise 3 dB, 4 dB that stay over 1.5 m, no packet from 82 dB on.\n\
                    seq,rssi_dbm,x1_m,y1_m,x2_m,y2_m,link\n"
        .to_owned();
    for seq in 0..1_000_u16 {
        let step = if seq < 500 { seq } else { 999 - seq };
        let at = course.base + Vec2::new(0.5 + 0.05 * f32::from(step), 0.0);
        let loss_db = radio.loss_db(&course.map, &Antenna::from(course.base), &Antenna::from(at))
            + 3.0 * stream.normal();
        if loss_db < 82.0 {
            let [base, at] = [course.base, at];
            let _ = writeln!(
                text,
                "{seq},{:.1},{:.2},{:.2},{:.2},{:.2},base",
                -loss_db, at.x, at.y, base.x, base.y
            );
        }
    }
    text
}

/// Losses of the simulator between places of a hall of 12 by 8 m: shadowing of 2 dB that stays, noise of 2 dB.
fn in_a_hall(seed: u64) -> impl FnMut([f32; 2], [f32; 2]) -> f32 {
    let sets = [
        "map.corridor.centre_line_m=[[-1.0, 4.0], [15.0, 4.0]]",
        "map.corridor.width_m=10",
        "chain.base_m=[0.0, 4.0]",
        "radio.sigma_static_db=2",
        "radio.correlation_m=1",
    ];
    let course = Course::read(&builtin("straight").unwrap(), &sets.map(str::to_owned)).unwrap();
    let radio = course.radio.seeded(Seed(seed)).unwrap();
    let mut stream = Seed(seed).stream(0, Source::Start);
    move |from, to| {
        let [from, to] = [from, to].map(|[x, y]| Antenna::from(course.map.to_local([x.into(), y.into()])));
        radio.loss_db(&course.map, &from, &to) + 2.0 * stream.normal()
    }
}

/// Distances in centimetres, as somebody else may write them.
fn theirs() -> String {
    let mut loss_db = in_a_hall(1);
    let mut text = "distance,rssiBLE,y\n".to_owned();
    for packet in 0..280_u16 {
        let cm = 50 + packet / 10 * 40;
        let rssi_dbm = -loss_db([0.0, 4.0], [0.01 * f32::from(cm), 4.0]);
        let _ = writeln!(text, "{cm},{rssi_dbm:.0},{}", if cm < 150 { "close" } else { "safe" });
    }
    text
}

/// Poses of a robot that hears three anchors, and where those stand.
fn poses() -> [String; 2] {
    let anchors = [[0.5, 0.5], [11.5, 4.0], [3.0, 7.5]];
    let mut loss_db = in_a_hall(2);
    let mut text = "x,y,rssi_1,rssi_2,rssi_3\n".to_owned();
    for pose in 0..240_u16 {
        let (row, along) = (pose / 48, 0.25 * f32::from(pose % 48));
        let at = [0.25 + if row % 2 == 0 { along } else { 11.75 - along }, 1.0 + 1.5 * f32::from(row)];
        let [a, b, c] = anchors.map(|anchor| -loss_db(anchor, at));
        let _ = writeln!(text, "{:.2},{:.2},{a:.1},{b:.1},{c:.1}", at[0], at[1]);
    }
    let rows = anchors.iter().enumerate().map(|(nth, [x, y])| format!("{},{x},{y}\n", nth + 1));
    [text, "id,x,y\n".to_owned() + &rows.collect::<String>()]
}

#[test]
fn the_examples_are_what_the_simulator_makes() {
    let [poses, anchors] = poses();
    for (name, text) in
        [("walk.csv", walk()), ("theirs.csv", theirs()), ("poses.csv", poses), ("anchors.csv", anchors)]
    {
        let file = examples().join(name);
        if std::env::var("UCHAIN_WRITE_EXAMPLES").is_ok() {
            fs::write(&file, &text).unwrap();
        }
        assert!(
            fs::read_to_string(&file).unwrap() == text,
            "{name}: write it again with UCHAIN_WRITE_EXAMPLES=1"
        );
    }
}

#[test]
fn a_log_of_the_simulator_is_fitted_back_drawn_and_its_table_is_a_scenarios() {
    let here = folder();
    fs::write(here.path().join("walk.csv"), walk()).unwrap();
    let said = ok(here.path(), &["radio", "fit", "walk.csv"]);
    assert!(said.contains("files: fits/walk/fit.json, fit.png and radio.toml"), "{said}");
    let json: Value =
        serde_json::from_str(&ok(here.path(), &["radio", "fit", "walk.csv", "--json"])).unwrap();
    for (key, truth) in [
        ("reference_loss_db", 35.0),
        ("alpha", 2.5),
        ("sigma_db", 3.0),
        ("sigma_static_db", 4.0),
        ("correlation_m", 1.5),
    ] {
        let [low, high] = ["low", "high"].map(|end| json[key][end].as_f64().unwrap());
        assert!((low..=high).contains(&truth), "{key}: {low} to {high} and not {truth}");
    }
    assert!((json["packets"]["limit_db"].as_f64().unwrap() - 82.0).abs() < 1.5, "{}", json["packets"]);
    let picture = image::open(here.path().join("fits/walk/fit.png")).unwrap();
    assert_eq!(picture.width(), 1400);
    // The table is taken as it stands.
    let table = fs::read_to_string(here.path().join("fits/walk/radio.toml")).unwrap();
    assert!(said.contains(&table), "{said}");
    let scenario = ok(here.path(), &["show", "straight"]);
    fs::write(here.path().join("mine.toml"), format!("{scenario}\n{table}")).unwrap();
    assert!(ok(here.path(), &["check", "./mine.toml"]).starts_with("ok: "));
    let sets: Vec<&str> = json["sets"].as_array().unwrap().iter().map(|set| set.as_str().unwrap()).collect();
    let sets: Vec<&str> = sets.iter().flat_map(|&set| ["--set", set]).collect();
    ok(here.path(), &[&["check", "straight"][..], &sets].concat());
}

#[test]
fn a_plan_by_a_fit_says_how_many_relays_its_interval_leaves_open() {
    let here = folder();
    fs::write(here.path().join("walk.csv"), walk()).unwrap();
    let args = ["radio", "fit", "walk.csv", "--plan", "straight", "--json"];
    let json: Value = serde_json::from_str(&ok(here.path(), &args)).unwrap();
    let cases = json["plan"]["cases"].as_array().unwrap();
    let relays: Vec<u64> = cases.iter().map(|case| case["relays"].as_u64().unwrap()).collect();
    let names: Vec<&str> = cases.iter().map(|case| case["case"].as_str().unwrap()).collect();
    assert_eq!(names, ["fit", "low", "high", "margin"]);
    assert!(
        relays[1] <= relays[0] && relays[0] <= relays[2] && relays[1] < relays[2] && relays[0] <= relays[3],
        "{relays:?}"
    );
    // The middle case is the plan that one gets with these values.
    let sets: Vec<&str> = json["sets"].as_array().unwrap().iter().map(|set| set.as_str().unwrap()).collect();
    let line = sets.iter().filter(|set| set.contains("reference") || set.contains("alpha"));
    let line: Vec<&str> = line.flat_map(|&set| ["--set", set]).collect();
    let plan: Value =
        serde_json::from_str(&ok(here.path(), &[&["plan", "straight", "--json"][..], &line].concat()))
            .unwrap();
    assert_eq!(plan["uavs_needed"].as_u64().unwrap(), relays[0] + 1);
    let error = refused(here.path(), &["radio", "fit", "walk.csv", "--plan", "straight", "--to", "99"], 3);
    assert!(error.contains("--to 99: the tunnel ends at 13.50 m"), "{error}");
}

#[test]
fn data_that_support_no_fit_are_drawn_and_leave_no_table() {
    let here = folder();
    let mut text = "distance_m,loss_db\n".to_owned();
    for nth in 0..200_u32 {
        let (m, noise_db) = (1.0 + f64::from(nth / 20), f64::from(nth % 7) * 0.3);
        let _ = writeln!(text, "{m},{}", 60.0 - 2.0 * m + noise_db);
    }
    fs::write(here.path().join("falls.csv"), text).unwrap();
    fs::write(here.path().join("walk.csv"), walk()).unwrap();
    ok(here.path(), &["radio", "fit", "walk.csv", "--out", "out"]);
    assert!(here.path().join("out/radio.toml").exists());
    let error = refused(here.path(), &["radio", "fit", "falls.csv", "--out", "out"], 3);
    assert!(
        error.contains("falls.csv: the data do not support a fit: ") && error.contains("mean loss falls"),
        "{error}"
    );
    assert!(
        here.path().join("out/fit.png").exists() && !here.path().join("out/radio.toml").exists(),
        "no table of another log"
    );
    let error = refused(here.path(), &["radio", "fit", "walk.csv", "--columns", "distance=x"], 2);
    assert!(error.contains("did you mean 'distance_m'?"), "{error}");
    let error = refused(here.path(), &["radio", "fit", "none.csv"], 3);
    assert!(error.contains("none.csv: cannot read it: "), "{error}");
    let error = refused(here.path(), &["radio", "fit", "walk.csv", "--link", "head"], 3);
    assert!(error.contains("no link is called 'head': it has base"), "{error}");
}

/// The folder of measured losses; `None`, said aloud, where it is absent.
fn measured() -> Option<PathBuf> {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/rssi");
    if !data.is_dir() {
        eprintln!("skipped: {} is not there", data.display());
    }
    data.is_dir().then_some(data)
}

#[test]
fn logs_that_others_measured_are_fitted_or_refused_with_the_reason() {
    let Some(data) = measured() else { return };
    let here = folder();
    let path = |name: &str| data.join(name).display().to_string();
    let flat = path("ble_flat_calib2021/calibration/calibration_df.csv");
    let anchors = path("ble_flat_calib2021/anchors.csv");
    let columns = "x1_m=x,y1_m=y,z1_m=0.3,rssi_dbm=rssi_*";
    let args =
        ["radio", "fit", &flat, "--anchors", &anchors, "--columns", columns, "--out", "flat", "--json"];
    let json: Value = serde_json::from_str(&ok(here.path(), &args)).unwrap();
    assert_eq!(json["packets"]["heard"], 22_277);
    let share = json["static_share"].as_f64().unwrap();
    assert!((0.5..0.8).contains(&share), "half to three quarters of the variance stay: {share}");
    let plain =
        json["exponents"].as_array().unwrap().iter().map(|one| one["least_squares"].as_f64().unwrap());
    let (low, high) = plain.fold((f64::INFINITY, 0.0_f64), |(l, h), alpha| (l.min(alpha), h.max(alpha)));
    assert!(high - low > 1.0, "exponents of anchors by least squares: {low} to {high}");
    assert!(json["warnings"].to_string().contains("exponents of the 6 links range"), "{}", json["warnings"]);
    for (file, why) in [
        ("bus/measurement_section/Pi.csv", "the mean loss falls with the distance"),
        ("parking/Pi.csv", "the mean loss falls with the distance"),
        ("train/Pi.csv", "605 packets heard at 2 places: expected at least 8 at 3"),
    ] {
        let file = path(&format!("multichannel_distance/data/{file}"));
        let columns = "distance_m=distance*0.01,rssi_dbm=rssiBLE";
        let error = refused(here.path(), &["radio", "fit", &file, "--columns", columns, "--out", "multi"], 3);
        assert!(error.contains(why), "{error}");
    }
}

#[test]
fn a_radio_map_says_how_far_a_link_reaches() {
    let here = folder();
    let said = ok(here.path(), &["radio", "map", "corner"]);
    assert!(
        said.contains("\nwithin 60 dB: ")
            && said.contains("radiomaps/corner/loss.json, loss.png and loss.csv"),
        "{said}"
    );
    assert_eq!(image::open(here.path().join("radiomaps/corner/loss.png")).unwrap().width(), 1400);
    // 60 = 35 + 20 log10(d / 0.25): 0.25 · 10^1.25 = 4.446 m, where nothing is in the way.
    let json: Value =
        serde_json::from_str(&ok(here.path(), &["radio", "map", "straight", "--json"])).unwrap();
    assert!((json["farthest_m"].as_f64().unwrap() - 4.446).abs() < 0.1, "{}", json["farthest_m"]);
    let along: Value =
        serde_json::from_str(&ok(here.path(), &["radio", "map", "straight", "--along", "--json"])).unwrap();
    assert!((along["passes_m"][0].as_f64().unwrap() - 4.446).abs() < 0.05, "{}", along["passes_m"]);
    let error = refused(here.path(), &["radio", "map", "apartment", "--from=1,1"], 3);
    assert!(error.contains("add --set radio.model=path-loss"), "{error}");
    let error = refused(here.path(), &["radio", "map", "straight", "--from=0,50"], 3);
    assert!(error.contains("--from=0,50: that is in rock"), "{error}");
}
