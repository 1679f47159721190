use std::fs;

use serde_json::Value;

use crate::{SHORT, folder, stdout, uchain};

#[test]
fn a_preset_is_listed_shown_named_by_check_and_changes_the_flight() {
    let here = folder();
    let list = uchain(here.path(), &["list"]);
    for name in ["cavemod", "frontiers2021"] {
        assert!(stdout(&list).contains(&format!("preset={name}")), "{}", stdout(&list));
        let check = uchain(here.path(), &["check", "corner", "--set", &format!("preset={name}")]);
        assert!(stdout(&check).starts_with(&format!("ok: corner, preset {name}: ")), "{}", stdout(&check));
    }

    // What is shown, written by hand, flies as the preset does.
    let shown =
        [&["show", "corner"][..], &["show", "--preset", "cavemod"]].map(|args| uchain(here.path(), args));
    fs::write(here.path().join("mine.toml"), shown.map(|output| output.stdout).concat()).unwrap();
    let digest = |args: &[&str]| {
        let output = uchain(here.path(), &[&["run", "--json", "--set", SHORT], args].concat());
        let summary: Value = serde_json::from_str(stdout(&output)).unwrap();
        summary["digest"].as_str().unwrap().to_owned()
    };
    let by_name = digest(&["corner", "--set", "preset=cavemod"]);
    assert_eq!(by_name, digest(&["mine.toml"]));
    assert_ne!(by_name, digest(&["corner"]));
    assert_ne!(by_name, digest(&["corner", "--set", "preset=frontiers2021"]));
    // A key written by hand wins.
    assert_ne!(by_name, digest(&["corner", "--set", "preset=cavemod", "--set", "equalize.decision_s=0.2"]));
}
