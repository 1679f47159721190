//! What comes of small caves.

use super::*;

const FLAT: [[f64; 3]; 3] = [[0.0, 0.0, 5.0], [10.0, 0.0, 5.0], [10.0, 10.0, 5.0]];

#[test]
fn a_passage_is_as_wide_as_its_cross_sections_say_and_the_rest_is_made_up_aloud() {
    let stations = [("a.1", FLAT[0], 0), ("a.2", FLAT[1], 0), ("a.3", FLAT[2], 4)];
    let sections = [("a.1", [1.0, 2.0], false), ("a.2", [1.0, 2.0], true)];
    let bytes = written(&[Way { through_m: &FLAT, flags: 0 }], &stations, &sections);
    let map = laid(&bytes, "missing_width_m = 4").unwrap();
    let free = |x: f64, y: f64| !map.in_rock(map.to_local([x, y]));
    // Along x the passage has its left at y = 1 and its right at y = -2.
    assert!(free(5.0, 0.9) && !free(5.0, 1.1) && free(5.0, -1.9) && !free(5.0, -2.1));
    // Along y nobody has measured: 2 m to either side.
    assert!(free(8.1, 5.0) && free(11.9, 5.0) && !free(7.9, 5.0) && !free(12.1, 5.0));
    let said = remarks(&map);
    assert!(said.contains("guessed 1 legs whose width was not measured at both ends: 4 m wide"), "{said}");
    assert!(
        said.contains("read 2 legs: 20.0 m long, 20.0 m in plan") && said.contains("5.0 to 5.0 m"),
        "{said}"
    );
    let median = remarks(&laid(&bytes, "").unwrap());
    assert!(
        median.contains("3 m wide there (the median of 2 measured widths; key missing_width_m)"),
        "{median}"
    );
    let names: Vec<_> = map.places().iter().map(|place| (place.name.as_str(), place.height_m)).collect();
    assert_eq!(names, [("a.1", Some(5.0)), ("a.2", Some(5.0)), ("a.3", Some(5.0))]);
    // In the middle of the passage, not at the wall.
    assert_eq!(map.places()[0].at_m, [0.0, -0.5]);
}

#[test]
fn widths_count_the_other_way_round_where_a_leg_is_written_so() {
    let stations = [("1", FLAT[0], 0), ("2", FLAT[1], 0)];
    let sections = [("1", [1.0, 2.0], false), ("2", [1.0, 2.0], true)];
    let back = [FLAT[1], FLAT[0]];
    let map = laid(&written(&[Way { through_m: &back, flags: 0 }], &stations, &sections), "").unwrap();
    let free = |x: f64, y: f64| !map.in_rock(map.to_local([x, y]));
    assert!(free(5.0, 0.9) && !free(5.0, 1.1) && free(5.0, -1.9) && !free(5.0, -2.1));
}

#[test]
fn only_legs_below_ground_that_are_measured_once_and_along_the_passage_count() {
    let way = |flags, y| (flags, [[0.0, y, 0.0], [9.0, y, 0.0]]);
    let ways = [way(0, 0.0), way(1, 20.0), way(2, 40.0), way(4, 60.0)];
    let ways: Vec<Way> = ways.iter().map(|(flags, through_m)| Way { through_m, flags: *flags }).collect();
    let map = laid(&written(&ways, &[], &[]), "").unwrap();
    assert_eq!(map.loops().count(), 1);
    let said = remarks(&map);
    for part in ["dropped 1 legs above ground", "dropped 1 legs that survey again", "dropped 1 splays"] {
        assert!(said.contains(part), "{said}");
    }
    let none = laid(&written(&ways[1..], &[], &[]), "").unwrap_err().to_string();
    assert_eq!(none, "cave.3d: no leg below ground is in it");
}

/// Along x, up, back over the first leg: at y = 0 from 0 to 30, and across it at x = 15, this much higher.
fn over(gap_m: f64) -> Vec<u8> {
    let through_m = [
        [0.0, 0.0, 0.0],
        [30.0, 0.0, 0.0],
        [30.0, 20.0, gap_m],
        [15.0, 20.0, gap_m],
        [15.0, 10.0, gap_m],
        [15.0, -10.0, gap_m],
        [15.0, -20.0, gap_m],
    ];
    let names = ["s.1", "s.2", "s.3", "s.4", "s.5", "s.6", "s.7"];
    let stations: Vec<(&str, [f64; 3], u8)> =
        names.iter().zip(through_m).map(|(&name, at_m)| (name, at_m, 0)).collect();
    written(&[Way { through_m: &through_m, flags: 0 }], &stations, &[])
}

#[test]
fn passages_that_cross_at_different_heights_are_kept_apart_and_at_one_height_they_meet() {
    let apart = laid(&over(10.0), "").unwrap();
    let (a, b) = (apart.to_local([15.0, 0.0]), apart.to_local([15.0, 9.5]));
    assert!(!apart.in_rock(a) && !apart.in_rock(b) && apart.in_rock(apart.to_local([15.0, 3.0])));
    assert!(!apart.in_rock(apart.to_local([15.0, -15.0])), "what lies beyond stays, apart");
    assert_eq!(apart.loops().count(), 2);
    let said = remarks(&apart);
    assert!(
        said.contains("separated 1 legs that cross others more than 2 m above or below")
            && !said.contains("merged"),
        "{said}"
    );

    let one = laid(&over(1.0), "").unwrap();
    assert!(!one.in_rock(one.to_local([15.0, 3.0])));
    let said = remarks(&one);
    assert!(said.contains("merged 1 places") && !said.contains("separated"), "{said}");
    let as_said = laid(&over(10.0), "level_gap_m = 10").unwrap();
    assert!(
        remarks(&as_said).contains("merged 1 places where passages cross at heights less than 10 m apart")
    );
}

#[test]
fn the_one_nearer_to_where_the_reading_begins_is_kept() {
    let map = laid(&over(10.0), "from = \"s.7\"").unwrap();
    let free = |x: f64, y: f64| !map.in_rock(map.to_local([x, y]));
    assert!(free(15.0, 3.0) && !free(5.0, 0.0) && !free(25.0, 0.0) && free(30.0, 10.0));
}

#[test]
fn a_way_is_cut_out_and_one_that_crosses_itself_is_said_with_where_it_could_end() {
    let map = laid(&over(10.0), "from = \"1\"\nto = \"s.4\"").unwrap();
    assert_eq!(
        map.places().iter().map(|place| place.name.as_str()).collect::<Vec<_>>(),
        ["s.1", "s.2", "s.3", "s.4"]
    );
    let said = remarks(&map);
    assert!(
        said.contains("read 3 legs on the way from 1 to s.4 and beside it: 67.4 m long, 65.0 m in plan"),
        "{said}"
    );
    assert!(said.contains("dropped 3 legs farther from that way than branch_m"), "{said}");
    let said = laid(&over(10.0), "from = \"1\"\nto = \"7\"").unwrap_err().to_string();
    let parts = [
        "cave.3d: the way crosses itself",
        "between s.5 and s.6 it lies 10.0 m",
        "between s.1 and s.2",
        "to = \"s.5\"",
        "level_gap_m = 10 ",
    ];
    assert!(parts.iter().all(|part| said.contains(part)), "{said}");
    assert!(laid(&over(10.0), "from = \"1\"\nto = \"7\"\nlevel_gap_m = 10").is_ok());
    assert!(laid(&over(10.0), "from = \"1\"\nto = \"5\"").is_ok());
}

#[test]
fn side_passages_come_with_the_way_as_far_as_asked_for() {
    let side = [[10.0, 0.0, 5.0], [16.0, 0.0, 5.0], [22.0, 0.0, 5.0], [28.0, 0.0, 5.0]];
    let stations = [("1", FLAT[0], 0), ("3", FLAT[2], 0)];
    let bytes =
        written(&[Way { through_m: &FLAT, flags: 0 }, Way { through_m: &side, flags: 0 }], &stations, &[]);
    let free = |branch_m: f64, x: f64| {
        let map = laid(&bytes, &format!("from = \"1\"\nto = \"3\"\nbranch_m = {branch_m}")).unwrap();
        !map.in_rock(map.to_local([x, 0.0]))
    };
    assert!(
        !free(0.0, 13.0) && free(6.0, 13.0) && !free(11.9, 19.0) && free(12.0, 19.0) && !free(12.0, 25.0)
    );
}

#[test]
fn straight_up_is_a_place_in_plan_and_no_crossing() {
    let shaft = [[0.0, 0.0, 0.0], [9.0, 0.0, 0.0], [9.0, 0.0, 30.0], [9.0, 0.0, 60.0], [9.0, 9.0, 60.0]];
    let map = laid(&written(&[Way { through_m: &shaft, flags: 0 }], &[], &[]), "").unwrap();
    let said = remarks(&map);
    assert!(said.contains("78.0 m long, 18.0 m in plan") && said.contains("0.0 to 60.0 m"), "{said}");
    assert!(!said.contains("separated") && !said.contains("merged") && map.loops().count() == 1, "{said}");
}

#[test]
fn a_station_goes_by_the_end_of_its_name_if_that_is_one_only() {
    let stations = [("a.1", FLAT[0], 0), ("b.1", FLAT[1], 0), ("c.12", FLAT[2], 0), ("c.x.1", FLAT[2], 0)];
    let bytes = written(&[Way { through_m: &FLAT, flags: 0 }], &stations, &[]);
    let said = |from: &str, to: &str| match laid(&bytes, &format!("from = \"{from}\"\nto = \"{to}\"")) {
        Ok(map) => map.places().len().to_string(),
        Err(error) => error.to_string(),
    };
    assert_eq!((said("a.1", "12"), said("a.1", "x.1")), ("4".to_owned(), "4".to_owned()));
    let one = said("1", "12");
    assert!(
        one.starts_with(
            "cave.3d: from = \"1\": expected more of the name: 3 stations end in it, a.1, b.1, c.x.1"
        ),
        "{one}"
    );
    let near = said("a.1", "13");
    assert!(
        near.contains("to = \"13\": expected the name of a station")
            && near.contains("did you mean ")
            && near.contains("c.12"),
        "{near}"
    );
    assert!(said("a.1", "nowhere").ends_with("whole or its last parts"), "{}", said("a.1", "nowhere"));
    assert!(said("a.1", "").contains("the name of a station"), "an empty name");
    assert!(said("a.1", "a.1").contains("another station than from"));
    let lonely = [[90.0, 0.0, 0.0], [99.0, 0.0, 0.0]];
    let stations = [("1", FLAT[0], 0), ("2", lonely[0], 0)];
    let ways = [Way { through_m: &FLAT, flags: 0 }, Way { through_m: &lonely, flags: 0 }];
    let said = laid(&written(&ways, &stations, &[]), "from = \"1\"\nto = \"2\"").unwrap_err().to_string();
    assert_eq!(said, "cave.3d: no legs lead from 1 to 2; expected two stations of one cave");
    let fault = settings("to = \"2\"").legal().unwrap_err();
    assert_eq!((fault.key.as_str(), fault.expected.contains("needs from")), ("to", true));
}
