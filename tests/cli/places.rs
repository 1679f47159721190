use std::{fs, path::Path};

use serde_json::Value;

use crate::{folder, shared_cases, stderr, stdout, uchain};

/// The arguments of every `--set` that a message tells to paste, as a shell would take them.
fn told_sets(message: &str) -> Vec<String> {
    let mut sets = Vec::new();
    for told in message.split("--set ").skip(1) {
        let quoted = told.strip_prefix('\'').and_then(|rest| rest.split('\'').next());
        sets.push(quoted.unwrap_or_else(|| told.split_whitespace().next().unwrap()).to_owned());
    }
    sets
}

#[test]
fn more_robots_than_places_are_refused_with_what_to_paste_and_that_flies() {
    let here = folder();
    for name in ["apartment", "corridors", "lab"] {
        let asked = ["run", name, "--set", "explore.robots=7", "--set", "duration_s=5"];
        let refused = uchain(here.path(), &asked);
        assert_eq!(refused.status.code(), Some(3), "{name}: {}", stderr(&refused));
        let said = stderr(&refused);
        let told = told_sets(said.split("add: ").nth(1).unwrap_or_else(|| panic!("{name}: {said}")));
        assert_eq!(told.len(), 2, "{said}");
        let pasted = told.iter().flat_map(|set| ["--set", set.as_str()]);
        let args: Vec<&str> = asked.into_iter().chain(["--no-record", "--json"]).chain(pasted).collect();
        let flown = uchain(here.path(), &args);
        let summary: Value =
            serde_json::from_str(stdout(&flown)).unwrap_or_else(|_| panic!("{name}: {}", stderr(&flown)));
        assert_eq!(summary["robots"], 7, "{name}");
    }
}

#[test]
fn robots_without_room_are_refused_with_the_number_that_has_room() {
    let here = folder();
    let asked = ["check", "lab", "--set", "explore.spawns_m=[]", "--set", "explore.robots=1000"];
    let refused = uchain(here.path(), &asked);
    assert_eq!(refused.status.code(), Some(3), "{}", stderr(&refused));
    let told = told_sets(stderr(&refused));
    let fits = told.last().unwrap_or_else(|| panic!("{}", stderr(&refused)));
    let taken = uchain(here.path(), &["check", "lab", "--set", "explore.spawns_m=[]", "--set", fits]);
    assert_eq!(taken.status.code(), Some(0), "{}", stderr(&taken));
}

#[test]
fn a_place_in_rock_within_rock_or_beyond_the_outer_wall_is_refused() {
    let Some(cases) = shared_cases() else { return };
    let here = folder();
    for (file, place, expected) in [
        (
            "nested.toml",
            "[3.5,2.0]",
            "robot 0 would start at (3.5, 2) m, which is in rock; expected free space",
        ),
        (
            "outside.toml",
            "[8.5,1.5]",
            "which is in rock, outside the map, which reaches from (0, 0) to (6, 4) m",
        ),
    ] {
        let file = cases.join("solids").join(file);
        let spawns = format!("explore.spawns_m=[{place}]");
        let args = ["run", file.to_str().unwrap(), "--set", "explore.robots=1", "--set", &spawns];
        let refused = uchain(here.path(), &args);
        assert_eq!(refused.status.code(), Some(3), "{}", stderr(&refused));
        assert!(stderr(&refused).contains(expected), "{}", stderr(&refused));
        // The same map is flown from its own start.
        let flown = uchain(here.path(), &["run", file.to_str().unwrap(), "--no-record", "--quiet"]);
        assert_eq!((flown.status.code(), stderr(&flown)), (Some(0), ""));
    }
}

#[test]
fn a_start_beyond_the_map_is_refused_with_its_extent_and_one_in_rock_is_moved_aloud() {
    let Some(cases) = shared_cases() else { return };
    let here = folder();
    let run = |file: &str| {
        let file = cases.join("starts").join(file);
        uchain(here.path(), &["run", file.to_str().unwrap(), "--no-record"])
    };
    for (file, expected) in [
        (
            "start_far.toml",
            "explore.start_m = [100, 100]: outside the map, which reaches from (0, 0) to (6, 4) m",
        ),
        (
            "utm.toml",
            "explore.start_m = [1, 1]: outside the map, which reaches from (450000, 5400000) to (450006, 5400004) m",
        ),
    ] {
        let refused = run(file);
        assert_eq!(refused.status.code(), Some(3), "{}", stderr(&refused));
        assert!(stderr(&refused).contains(expected), "{}", stderr(&refused));
    }
    let moved = run("start_rock.toml");
    assert_eq!(moved.status.code(), Some(0), "{}", stderr(&moved));
    let note = "explore.start_m = [2.5, 1.5] is in rock: robots start around (";
    assert!(stderr(&moved).contains(note), "{}", stderr(&moved));
    // A place with room is taken as it is, and nothing is said.
    let free = cases.join("starts/start_rock.toml");
    let args = ["run", free.to_str().unwrap(), "--no-record", "--set", "explore.start_m=[1.0, 1.0]"];
    assert_eq!(stderr(&uchain(here.path(), &args)), "");
}

#[test]
fn every_place_beyond_the_map_is_refused_with_how_far_that_reaches() {
    let here = folder();
    let beyond = |args: &[&str], expected: &str| {
        let refused = uchain(here.path(), args);
        assert_eq!(refused.status.code(), Some(3), "{args:?}: {}", stderr(&refused));
        assert!(stderr(&refused).contains(expected), "{args:?}: {}", stderr(&refused));
        assert!(stderr(&refused).contains("outside the map, which reaches from ("), "{}", stderr(&refused));
    };
    beyond(&["check", "straight", "--set", "chain.base_m=[-900, 0]"], "the base is in rock, ");
    beyond(&["check", "straight", "--set", "chain.goal_m=[900, 0]"], "the goal is in rock, ");
    beyond(
        &["check", "straight", "--set", "chain.uavs=2", "--set", "chain.spawns_m=[[0.3, 0], [0, 900]]"],
        "UAV 1 would wait at (0, 900) m, which is in rock, ",
    );
    beyond(
        &["check", "apartment", "--set", "explore.spawns_m.0=[90, 5]"],
        "robot 0 would start at (90, 5) m",
    );
    beyond(
        &["check", "apartment", "--set", "explore.spawns_m=[]", "--set", "explore.start_m=[90, 5]"],
        "explore.start_m = [90, 5]: ",
    );
    let map = "type octile\nheight 4\nwidth 8\nmap\n........\n........\n........\n........\n";
    fs::write(here.path().join("hall.map"), map).unwrap();
    beyond(&["plan", "hall.map", "--base=90,0.5", "--goal=3,0.5"], "the base is in rock, ");
    beyond(&["plan", "hall.map", "--base=0.5,1", "--goal=90,0.5"], "the goal is in rock, ");
}

#[test]
fn transparent_cells_of_mode_scale_are_flown_as_unknown_grey_is() {
    let Some(cases) = shared_cases() else { return };
    let here = folder();
    let folder = cases.join("scale-alpha");
    let picture = image::open(folder.join("scale_alpha.png")).unwrap().into_rgba8();
    assert!(picture.pixels().any(|pixel| pixel.0[3] < 255), "nothing in it is transparent");
    // Without transparency, and grey in its place.
    let grey = image::GrayImage::from_fn(picture.width(), picture.height(), |x, y| {
        let pixel = picture.get_pixel(x, y).0;
        image::Luma([if pixel[3] < 255 { 205 } else { pixel[0] }])
    });
    grey.save(here.path().join("scale_alpha.png")).unwrap();
    fs::copy(folder.join("scale_alpha.yaml"), here.path().join("scale_alpha.yaml")).unwrap();
    let digest = |yaml: &Path| {
        let run =
            uchain(here.path(), &["run", yaml.to_str().unwrap(), "--seed", "3", "--no-record", "--json"]);
        let summary: Value =
            serde_json::from_str(stdout(&run)).unwrap_or_else(|_| panic!("{}", stderr(&run)));
        summary["digest"].as_str().unwrap().to_owned()
    };
    let clear = digest(&folder.join("scale_alpha.yaml"));
    assert_eq!(clear, digest(&here.path().join("scale_alpha.yaml")));
    // The negative control: read as free, it is another flight.
    let yaml = fs::read_to_string(folder.join("scale_alpha.yaml")).unwrap().replace("scale\n", "trinary\n");
    let trinary = here.path().join("trinary");
    fs::create_dir(&trinary).unwrap();
    fs::copy(folder.join("scale_alpha.png"), trinary.join("scale_alpha.png")).unwrap();
    fs::write(trinary.join("map.yaml"), yaml).unwrap();
    assert_ne!(clear, digest(&trinary.join("map.yaml")));
}
