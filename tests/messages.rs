//! Files that are wrong: what is said names the file's own line, or none, in words for people.

use uchain_sim::{config::Source, registry::Registry};

use crate::shared_cases;

/// What reading a map file, or a scenario file, comes to.
fn said(path: &str) -> String {
    said_with(path, &[])
}

fn said_with(path: &str, sets: &[String]) -> String {
    let read = Source::find(path).and_then(|source| Registry::default().read(&source, sets));
    read.map_or_else(|error| error.to_string(), |_| "ok".to_owned())
}

#[test]
fn what_is_wrong_with_a_map_is_said_without_a_line_of_a_scenario_that_nobody_wrote() {
    let Some(cases) = shared_cases() else { return };
    let folder = cases.join("messages");
    for (name, expected) in [
        ("dup.yaml", "line 7: 'resolution' is written a second time; expected every key once"),
        ("multi.yaml", "line 7: a second document begins; expected one, without --- after it"),
        (
            "thr_swapped.yaml",
            "free_thresh = 0.65: expected at most occupied_thresh, 0.196; are the two exchanged?",
        ),
        ("h_more.map", "the file ends after 20 rows: expected 21, the height in its line 2"),
        ("absent.yaml", "No such file or directory (os error 2)"),
    ] {
        let path = folder.join(name).display().to_string();
        assert_eq!(said(&path), format!("{path}: {expected}"));
    }
    let picture = folder.join("l8.png").display().to_string();
    let scale = ["map.cell_m=0.05".to_owned()];
    assert_eq!(said_with(&picture, &scale), "ok", "the control: a picture that is whole");
    let alone = said(&picture);
    assert!(alone.contains("a picture does not say how large its pixels are"), "{alone}");
}
