//! `uchain map`: made, told, plotted, converted.

use std::{fs, path::Path};

use serde_json::Value;

use crate::{files, folder, stderr, stdout, uchain};

fn ok(here: &Path, args: &[&str]) -> String {
    let output = uchain(here, args);
    assert_eq!((output.status.code(), stderr(&output)), (Some(0), ""), "{args:?}");
    stdout(&output).to_owned()
}

fn refused(here: &Path, args: &[&str], code: i32) -> String {
    let output = uchain(here, args);
    assert_eq!((output.status.code(), stdout(&output)), (Some(code), ""), "{args:?}: {}", stderr(&output));
    stderr(&output).to_owned()
}

fn names(here: &Path) -> Vec<String> {
    files(here).iter().map(|path| path.strip_prefix(here).unwrap().display().to_string()).collect()
}

#[test]
fn a_map_that_was_made_is_told_plotted_and_planned_for_as_it_says_itself() {
    let here = folder();
    let said = ok(here.path(), &["map", "make", "tunnel", "--seed", "4", "--length", "40", "--out", "t.png"]);
    assert!(said.starts_with("tunnel, seed 4: "), "{said}");
    assert_eq!(names(here.path()), ["t.png", "t.yaml"]);
    // The next command can be typed as it stands.
    let next = said.lines().find_map(|line| line.strip_prefix("next: uchain ")).unwrap();
    let plan = ok(here.path(), &next.split(' ').collect::<Vec<_>>());
    assert!(plan.contains("relay"), "{plan}");

    let info = ok(here.path(), &["map", "info", "t.yaml"]);
    assert!(info.starts_with("t.yaml: ROS map\n") && info.contains("\nsize  "), "{info}");
    assert!(info.contains("; 2 dead ends, 0 junctions, 0 ways round\n"), "{info}");
    let next = info.lines().find_map(|line| line.strip_prefix("next       uchain ")).unwrap();
    ok(here.path(), &next.split(' ').collect::<Vec<_>>());
    let json: Value = serde_json::from_str(&ok(here.path(), &["map", "info", "t.yaml", "--json"])).unwrap();
    assert!(json["size_m"][0].as_f64().unwrap() > 20.0 && json["walls"].as_u64().unwrap() > 10, "{json}");
    // From dead end to dead end, each as far from the end of its passage as the passage is wide.
    assert!((35.0..42.0).contains(&json["ends"]["way_m"].as_f64().unwrap()), "{json}");
    assert!((1.5..2.5).contains(&json["numbers"]["width_m"]["median"].as_f64().unwrap()), "{json}");

    let said = ok(here.path(), &["map", "plot", "t.yaml", "--at=0,0", "--at=0,40"]);
    assert!(said.starts_with("(0, 0): free, ") && said.contains("\n(0, 40): in rock, "), "{said}");
    let picture = image::open(here.path().join("plots/t.png")).unwrap();
    assert!((1200..5000).contains(&picture.width()), "{}", picture.width());
    ok(here.path(), &["map", "plot", "t.yaml", "--graph", "--out", "graph.png"]);
    let blue = |name: &str| {
        let picture = image::open(here.path().join(name)).unwrap().into_rgb8();
        picture.pixels().filter(|pixel| pixel.0 == [0x00, 0x72, 0xb2]).count()
    };
    assert!(blue("graph.png") > 500 && blue("plots/t.png") == 0, "the middle of its passages");
}

#[test]
fn the_same_seed_writes_the_same_bytes_and_another_one_others() {
    let here = folder();
    for kind in ["tunnel", "cave", "maze", "rooms", "room-and-pillar", "branching"] {
        let make = |seed: &str, name: &str| {
            ok(here.path(), &["map", "make", kind, "--seed", seed, "--out", name]);
            fs::read(here.path().join(name)).unwrap()
        };
        let first = make("7", &format!("{kind}-a.csv"));
        assert!(first.starts_with(b"loop,x_m,y_m\n"), "{kind}");
        assert!(first == make("7", &format!("{kind}-b.csv")) && first != make("8", &format!("{kind}-c.csv")));
    }
}

#[test]
fn a_file_that_is_there_is_replaced_only_with_force_and_an_input_never() {
    let here = folder();
    ok(here.path(), &["map", "make", "maze", "--out", "m.png"]);
    fs::write(here.path().join("letter.yaml"), "dear").unwrap();
    let before = names(here.path());
    for args in [
        &["map", "make", "maze", "--out", "letter.png"][..],
        &["map", "convert", "m.yaml", "letter.yaml"],
        &["map", "plot", "m.yaml", "--out", "m.png"],
    ] {
        let said = refused(here.path(), args, 2);
        assert!(
            said.contains("letter.yaml is there already; name another file, or add --force")
                || said.contains("m.png"),
            "{said}"
        );
    }
    // Its own picture and its own yaml, whatever they are called by, and even by force.
    for out in ["m.png", "m.yaml", "./m.yaml", "m.pgm"] {
        let said = refused(here.path(), &["map", "convert", "m.yaml", out, "--force"], 2);
        assert!(said.contains("is what the map is read from; name another file"), "{out}: {said}");
    }
    // A bare picture is its own map.
    let convert = ["map", "convert", "m.png", "m.png", "--cell", "0.05", "--force"];
    assert!(refused(here.path(), &convert, 2).contains("is what the map is read from"));
    fs::write(here.path().join("s.toml"), SCENARIO).unwrap();
    let said = refused(here.path(), &["map", "convert", "s.toml", "m.png", "--force"], 2);
    assert!(said.contains("is what the map is read from"), "{said}");
    fs::remove_file(here.path().join("s.toml")).unwrap();
    assert_eq!(names(here.path()), before);
    assert_eq!(fs::read_to_string(here.path().join("letter.yaml")).unwrap(), "dear");
    ok(here.path(), &["map", "plot", "m.png", "--cell", "0.05", "--out", "p.png"]);
    ok(here.path(), &["map", "convert", "m.yaml", "letter.yaml", "--force"]);
    assert!(fs::read_to_string(here.path().join("letter.yaml")).unwrap().starts_with("image: letter.pgm\n"));
}

/// A scenario in a map that `make` wrote.
const SCENARIO: &str = "name = \"s\"\nduration_s = 10\n[map.ros]\nfile = \"m.yaml\"\n[explore]\n";

#[test]
fn maps_of_scenarios_are_told_too_and_what_is_wrong_is_said() {
    let here = folder();
    let info = ok(here.path(), &["map", "info", "corner"]);
    assert!(info.starts_with("corner: drawn in the scenario\n"), "{info}");
    let area = |what: &str| -> f64 {
        let info: Value = serde_json::from_str(&ok(here.path(), &["map", "info", what, "--json"])).unwrap();
        info["numbers"]["free_area_m2"].as_f64().unwrap()
    };
    for other in ["corner.csv", "corner.svg", "corner.geojson"] {
        ok(here.path(), &["map", "convert", "corner", other]);
        assert!((area(other) - area("corner")).abs() < 0.02, "{other}: {} m2", area(other));
    }
    assert!(ok(here.path(), &["map", "info", "corner.csv"]).contains("\nwalls "));

    fs::write(here.path().join("notes.txt"), "no map").unwrap();
    let cases: [(&[&str], i32, &str); 7] = [
        (&["map", "info", "notes.txt"], 3, "neither a scenario in TOML nor a map that is read here"),
        (&["map", "info", "absent.yaml"], 3, "absent.yaml"),
        (&["map", "info", "cornr"], 3, "did you mean 'corner'?"),
        (&["map", "make", "castle", "--out", "c.png"], 2, "expected one of tunnel, cave, maze"),
        (
            &["map", "make", "maze", "--length", "9", "--out", "c.png"],
            2,
            "a maze has no length; it has a size",
        ),
        (&["map", "convert", "corner", "corner.bmp"], 2, "expected a name that ends in .yaml"),
        (&["map", "convert", "corner", "c.csv", "--out-cell", "1"], 2, "--out-cell is for maps in cells"),
    ];
    let before = names(here.path());
    for (args, code, wanted) in cases {
        let said = refused(here.path(), args, code);
        assert!(said.contains(wanted), "{args:?}: {said}");
    }
    assert_eq!(names(here.path()), before, "nothing is written");
}
