use std::{fs, path::Path, process::Output};

use base64::{Engine as _, prelude::BASE64_STANDARD};
use serde_json::{Value, json};
use tempfile::TempDir;
use uchain_sim::{config::Source, registry::Registry};

use crate::{command, folder, install, install_script, stderr, stdout, uchain};

/// As `cargo xtask web` leaves it, but for all that is in it.
pub(crate) const PAGE: &str = "<!doctype html>\n<main></main>\n<!-- uchain:flight -->\n<p>after</p>\n";

/// A folder with a page in it.
fn place() -> TempDir {
    let here = folder();
    fs::write(here.path().join("page.html"), PAGE).unwrap();
    here
}

fn view(here: &Path, args: &[&str]) -> Output {
    let mut view = command(here, &[&["view", "--no-open"], args].concat());
    view.env("UCHAIN_PAGE", "page.html").output().unwrap()
}

/// The page that a command wrote, and where.
fn viewed(here: &Path, args: &[&str]) -> (String, String) {
    let output = view(here, args);
    assert_eq!((output.status.code(), stderr(&output)), (Some(0), ""), "{args:?}");
    let file = stdout(&output).trim_end().to_owned();
    (fs::read_to_string(here.join(&file)).unwrap(), file)
}

/// The flight in a page.
fn flight(page: &str) -> Value {
    let start = "<script type=\"application/json\" id=\"flight\">";
    let (before, rest) = page.split_once(start).unwrap_or_else(|| panic!("{page}"));
    let (json, after) = rest.split_once("</script>").unwrap();
    assert_eq!(format!("{before}<!-- uchain:flight -->{after}"), PAGE);
    serde_json::from_str(json).unwrap()
}

fn refused(here: &Path, args: &[&str], code: i32) -> String {
    let output = view(here, args);
    let said = stderr(&output).to_owned();
    assert_eq!((output.status.code(), stdout(&output)), (Some(code), ""), "{args:?}: {said}");
    assert!(!here.join("views").exists(), "{args:?}");
    said
}

#[test]
fn a_scenario_goes_into_the_page_as_it_was_written() {
    let here = place();
    let (page, file) = viewed(here.path(), &["corner"]);
    assert_eq!(file, "views/corner-s1.html");
    let corner = uchain_sim::config::builtin("corner").unwrap().text;
    assert_eq!(flight(&page), json!({"kind": "scenario", "label": "corner.toml", "text": corner, "seed": 1}));
    let (page, file) = viewed(here.path(), &["corner", "--seed", "7", "--out", "a/mine.html"]);
    assert_eq!((flight(&page)["seed"].as_u64(), file.as_str()), (Some(7), "a/mine.html"));
    let (page, _) = viewed(here.path(), &["corner", "--seed", "18446744073709551615"]);
    assert_eq!(flight(&page)["seed"].as_str(), Some("18446744073709551615"), "a page would round the number");

    let text = format!("# </script><!-- made by hand -->\n{corner}");
    fs::write(here.path().join("mine.toml"), &text).unwrap();
    let (page, file) = viewed(here.path(), &["mine.toml"]);
    assert_eq!((flight(&page)["text"].as_str(), file.as_str()), (Some(text.as_str()), "views/mine-s1.html"));
}

#[test]
fn without_a_name_it_is_the_page_alone() {
    let here = place();
    assert_eq!(viewed(here.path(), &[]), (PAGE.to_owned(), "views/uchain.html".to_owned()));
}

#[test]
fn what_was_set_is_in_the_text_that_the_page_gets() {
    let here = place();
    let (page, _) = viewed(here.path(), &["corner", "--set", "chain.uavs=4", "--set", "preset=cavemod"]);
    let flight = flight(&page);
    let text: toml::Table = flight["text"].as_str().unwrap().parse().unwrap();
    assert_eq!(text["chain"]["uavs"].as_integer(), Some(4));
    assert_eq!(text["equalize"]["decision_s"].as_float(), Some(0.1), "of the preset");
    assert_eq!(flight.get("walls_csv"), None, "a corridor is built again, and can be edited");
}

/// Digest of a flight, flown by the library as the page flies it: from its text, in its walls.
fn digest_of(flight: &Value) -> String {
    let source = Source {
        label: flight["label"].as_str().unwrap().to_owned(),
        text: flight["text"].as_str().unwrap().to_owned(),
        folder: "/nowhere".into(),
    };
    // A page reads numbers as `f64`.
    let seed = match &flight["seed"] {
        Value::String(digits) => digits.parse().unwrap(),
        number => number.as_f64().unwrap() as u64,
    };
    let registry = Registry::default();
    let scene = match flight["walls_csv"].as_str() {
        Some(csv) => {
            let map = uchain_sim::record::mcap::walls_from_csv(csv.as_bytes()).unwrap();
            let offset_m = serde_json::from_value(flight["map_offset_m"].clone()).unwrap();
            registry.read_in(&source, &[], map.with_offset_m(offset_m)).unwrap()
        }
        None => registry.read(&source, &[]).unwrap(),
    };
    scene.fly(seed, &mut ()).unwrap().digest().to_owned()
}

#[test]
fn a_map_travels_as_its_walls_and_is_explored_bit_for_bit_as_from_its_file() {
    let here = place();
    // Two rooms, and a door between them.
    let mut picture = b"P5\n60 30\n255\n".to_vec();
    for (y, x) in (0..30).flat_map(|y| (0..60).map(move |x| (y, x))) {
        let is_rock = !(2..28).contains(&y)
            || !(2..58).contains(&x)
            || ((28..31).contains(&x) && !(10..20).contains(&y));
        picture.push(if is_rock { 0 } else { 254 });
    }
    fs::write(here.path().join("floor.pgm"), picture).unwrap();
    let yaml = "image: floor.pgm\nresolution: 0.2\norigin: [100.0, 200.0, 0.0]\nnegate: 0\n\
                occupied_thresh: 0.65\nfree_thresh: 0.196\n";
    fs::write(here.path().join("floor.yaml"), yaml).unwrap();
    let short = ["--set", "duration_s=60"];
    for sets in [&short[..0], &short[..]] {
        let (page, file) = viewed(here.path(), &[&["floor.yaml", "--seed", "3"], sets].concat());
        assert_eq!(file, "views/floor-s3.html");
        let flight = flight(&page);
        let run = uchain(here.path(), &[&["run", "floor.yaml", "--json", "--seed", "3"], sets].concat());
        let summary: Value = serde_json::from_str(stdout(&run)).unwrap();
        assert_eq!(digest_of(&flight), summary["digest"], "{sets:?}");
        if sets.is_empty() {
            let mut other = flight.clone();
            other["text"] = (flight["text"].as_str().unwrap().to_owned() + "robots = 2\n").into();
            assert_ne!(digest_of(&other), summary["digest"], "the control");
        }
    }
}

#[test]
fn a_recording_goes_in_byte_for_byte_by_its_name_or_its_folder() {
    let here = place();
    let run = uchain(here.path(), &["run", "corner", "--quiet", "--set", "duration_s=5"]);
    assert_eq!(run.status.code(), Some(0));
    let bytes = fs::read(here.path().join("runs/corner-s1/run.mcap")).unwrap();
    for what in ["runs/corner-s1/run.mcap", "runs/corner-s1", "runs/corner-s1/"] {
        let (page, file) = viewed(here.path(), &[what]);
        assert_eq!(file, "views/corner-s1-recording.html");
        let flight = flight(&page);
        assert_eq!(
            (flight["kind"].as_str(), flight["label"].as_str()),
            (Some("recording"), Some("run.mcap"))
        );
        assert_eq!(BASE64_STANDARD.decode(flight["base64"].as_str().unwrap()).unwrap(), bytes, "{what}");
    }
    let said = refused(folder_with_page(here.path()).path(), &["run.mcap", "--seed", "2"], 2);
    assert!(said.contains("run.mcap is a recording, flown as it is"), "{said}");
}

/// Another place, with the recording of this one in it.
fn folder_with_page(here: &Path) -> TempDir {
    let there = place();
    fs::copy(here.join("runs/corner-s1/run.mcap"), there.path().join("run.mcap")).unwrap();
    there
}

#[test]
fn a_row_of_a_sweep_is_the_flight_of_that_row() {
    let here = place();
    let design = ["--vary", "radio.sigma_db=0,4", "--replicates", "2", "--set", "duration_s=20"];
    let sweep = uchain(here.path(), &[&["sweep", "corner", "--quiet", "--out", "s"], &design[..]].concat());
    assert_eq!(sweep.status.code(), Some(0), "{}", stderr(&sweep));
    let (page, file) = viewed(here.path(), &["s", "--run", "3"]);
    assert_eq!(file, "views/corner-run3.html");
    let repro = uchain(here.path(), &["repro", "s", "--run", "3", "--json"]);
    let summary: Value = serde_json::from_str(stdout(&repro)).unwrap();
    assert_eq!(digest_of(&flight(&page)), summary["digest"]);

    fs::remove_dir_all(here.path().join("views")).unwrap();
    let said = refused(here.path(), &["s"], 2);
    assert!(said.contains("s is a sweep: add --run I"), "{said}");
    assert!(
        refused(here.path(), &["s", "--run", "4"], 3).contains("no run 4: the sweep has the runs 0 to 3")
    );
    assert!(refused(here.path(), &["corner", "--run", "0"], 3).contains("corner"));
    assert!(refused(here.path(), &["--run", "0"], 2).contains("NAME|FILE|DIR"));
}

#[test]
fn what_cannot_be_shown_is_refused_in_words_and_leaves_nothing() {
    let here = place();
    let said = refused(here.path(), &["cornr"], 3);
    assert!(said.contains("corner"), "{said}");
    fs::write(here.path().join("bad.toml"), "name = \"bad\"\nduration = 3\n").unwrap();
    assert!(refused(here.path(), &["bad.toml"], 3).contains("bad.toml:2"));
    fs::write(here.path().join("empty.mcap"), "").unwrap();
    assert!(refused(here.path(), &["empty.mcap"], 3).contains("empty.mcap"));
    assert!(refused(here.path(), &["nowhere.mcap"], 3).contains("nowhere.mcap"));
    fs::create_dir(here.path().join("empty")).unwrap();
    assert!(refused(here.path(), &["empty"], 3).contains("neither run.mcap nor a sweep"));
    fs::write(here.path().join("page.html"), "<main></main>").unwrap();
    assert!(refused(here.path(), &["corner"], 3).contains("no place for a flight"));
    fs::remove_file(here.path().join("page.html")).unwrap();
    assert!(refused(here.path(), &["corner"], 3).contains("UCHAIN_PAGE=page.html"));
}

#[test]
fn a_recording_too_large_for_a_page_is_refused_with_what_to_do() {
    let here = place();
    let run = uchain(
        here.path(),
        &["run", "corner", "--quiet", "--seed", "5", "--set", "duration_s=5", "--out", "."],
    );
    assert_eq!(run.status.code(), Some(2), "the page is in that folder: {}", stderr(&run));
    let run = uchain(
        here.path(),
        &["run", "corner", "--quiet", "--seed", "5", "--set", "duration_s=5", "--out", "r"],
    );
    assert_eq!(run.status.code(), Some(0));
    // Long enough, and readable: nothing but zeros behind it.
    let file = fs::OpenOptions::new().write(true).open(here.path().join("r/run.mcap")).unwrap();
    file.set_len((64 << 20) + 1).unwrap();
    let said = refused(here.path(), &["r/run.mcap"], 3);
    assert!(said.contains("more than 64 MiB") && said.contains("--seed 5"), "{said}");
}

#[test]
fn without_a_page_one_line_says_what_to_type() {
    let here = folder();
    // As if it were installed: no target folder around it.
    let program = here.path().join("bin/uchain");
    fs::create_dir(here.path().join("bin")).unwrap();
    install(env!("CARGO_BIN_EXE_uchain").as_ref(), &program);
    let mut view = std::process::Command::new(&program);
    let output =
        view.args(["view", "circuit"]).current_dir(here.path()).env_remove("UCHAIN_PAGE").output().unwrap();
    let said = stderr(&output);
    assert_eq!(output.status.code(), Some(3), "{said}");
    assert_eq!(said.lines().count(), 1, "{said}");
    assert!(said.contains("`cargo xtask web`") && said.contains("--features view"), "{said}");
}

#[test]
fn the_page_is_opened_and_where_nothing_opens_it_a_note_says_where_it_is() {
    let here = place();
    let bin = here.path().join("bin");
    fs::create_dir(&bin).unwrap();
    let opener = |script: &str| install_script(&format!("#!/bin/sh\n{script}\n"), &bin.join("xdg-open"));
    let open = |path: &str| {
        let mut view = command(here.path(), &["view", "corner"]);
        view.env("UCHAIN_PAGE", "page.html").env("PATH", path).output().unwrap()
    };
    // Nothing else is on the path: no other browser opens.
    let ours = bin.display().to_string();
    opener("echo chatter; echo \"$1\" > opened");
    let output = open(&ours);
    assert_eq!((output.status.code(), stderr(&output)), (Some(0), ""));
    assert_eq!(stdout(&output), "views/corner-s1.html\n");
    let opened = fs::read_to_string(here.path().join("opened")).unwrap();
    assert_eq!(
        Path::new(opened.trim_end()),
        fs::canonicalize(here.path().join("views/corner-s1.html")).unwrap()
    );

    opener("exit 3");
    for (path, why) in [(ours.as_str(), "found no browser"), ("/nowhere", "nothing here opens pages")] {
        let output = open(path);
        assert_eq!(output.status.code(), Some(0));
        let said = stderr(&output);
        assert!(said.starts_with("note: ") && said.contains(why), "{said}");
        assert!(said.contains("open views/corner-s1.html yourself"), "{said}");
    }
}
