//! The Dow Cave and Providence Pot, and what Survex itself wrote.

use super::{
    super::read::{Leg, read},
    *,
};

#[test]
fn all_versions_of_the_format_tell_of_one_cave() {
    let newest = read(&by_survex(8)).unwrap();
    assert_eq!((newest.stations.len(), newest.legs.len(), newest.sections.len()), (12, 9, 3));
    assert_eq!(newest.sections[1].left_m, Some(400.0), "too wide for two bytes");
    assert_eq!((newest.sections[2].left_m, newest.sections[2].right_m), (None, Some(1.0)));
    assert!(newest.sections[2].last && !newest.sections[1].last);
    assert_eq!(newest.stations.iter().filter(|station| station.entrance).count(), 1);
    assert_eq!(newest.legs.iter().filter(|leg| leg.unsurveyed).count(), 1);
    let count = |flags| newest.legs.iter().filter(|leg| leg.flags == flags).count();
    assert_eq!([count(0), count(Leg::SURFACE), count(Leg::DUPLICATE), count(Leg::SPLAY)], [6, 1, 1, 1]);
    for version in 3..8 {
        let survey = read(&by_survex(version)).unwrap();
        assert_eq!(survey.stations, newest.stations, "version {version}");
        // Only version 8 knows of legs that nobody has measured.
        let measured = newest.legs.iter().map(|leg| Leg { unsurveyed: false, ..*leg });
        assert_eq!(survey.legs, measured.collect::<Vec<_>>(), "version {version}");
        let sections = if version < 5 { Vec::new() } else { newest.sections.clone() };
        assert_eq!(survey.sections, sections, "version {version}");
    }
}

/// The sums are those of what `dump3d -l` of Survex 1.4.4 prints of the file.
#[test]
fn the_dow_cave_is_read_as_survex_reads_it() {
    let Some(file) = dow() else { return };
    let survey = read(&std::fs::read(file).unwrap()).unwrap();
    let sum_cm =
        |axis: usize| survey.stations.iter().map(|station| i64::from(station.at_cm[axis])).sum::<i64>();
    assert_eq!(survey.stations.len(), 802);
    assert_eq!([sum_cm(0), sum_cm(1), sum_cm(2)], [31_991_096_571, 37_999_343_789, 28_922_051]);
    let length_m = |leg: &Leg| {
        let apart_m = [0, 1, 2].map(|axis| f64::from(leg.from_cm[axis] - leg.to_cm[axis]) / 100.0);
        apart_m.iter().map(|m| m * m).sum::<f64>().sqrt()
    };
    let total_m: f64 = survey.legs.iter().map(length_m).sum();
    assert_eq!((survey.legs.len(), (total_m * 100.0).round()), (759, 488_097.0));
    let count = |flag| survey.legs.iter().filter(|leg| leg.is(flag)).count();
    assert_eq!([count(Leg::SURFACE), count(Leg::DUPLICATE), count(Leg::SPLAY)], [25, 25, 20]);
    let widths_m = survey.sections.iter().map(|section| section.left_m.unwrap() + section.right_m.unwrap());
    assert_eq!((survey.sections.len(), (widths_m.sum::<f64>() * 100.0).round()), (58, 12_350.0));
    let at_cm = |name: &str| survey.stations.iter().find(|station| station.name == name).unwrap().at_cm;
    assert_eq!(at_cm("dowcave.entrance"), [39_837_800, 47_430_000, 33_400]);
}

#[test]
fn the_whole_dow_cave_comes_with_what_was_made_up_and_kept_apart() {
    let Some(file) = dow() else { return };
    let map = read_survex(&file, &settings("")).unwrap();
    let said = remarks(&map);
    for part in [
        "legs: ",
        "dropped 25 legs above ground",
        "dropped 25 legs that survey again",
        "dropped 20 splays",
        "legs whose width was not measured at both ends: 1.7 m wide there (the median of 100 measured widths",
        "separated ",
        "merged ",
    ] {
        assert!(said.contains(part), "{part}: {said}");
    }
    assert!(
        map.places().len() > 600 && map.loops().count() > 1,
        "{} {}",
        map.places().len(),
        map.loops().count()
    );
}

/// Ways in of a hundred metres and more, up the stream and across.
const WAYS: [(&str, &str, f64); 3] = [
    ("dowcave.dow1.1", "dowcave.dow1.24c", 300.0),
    ("dowcave.dow1.1", "dowbergill1.dgp3.31", 950.0),
    ("providencepot.ppot1.1", "providencepot.ppot4.4", 215.0),
];

#[test]
fn ways_into_the_dow_cave_are_free_from_end_to_end() {
    let Some(file) = dow() else { return };
    for (from, to, least_m) in WAYS {
        let map = read_survex(&file, &settings(&format!("from = \"{from}\"\nto = \"{to}\""))).unwrap();
        let at =
            |name: &str| map.to_local(map.places().iter().find(|place| place.name == name).unwrap().at_m);
        assert!(map.clearance_m(at(from)) > 0.5 && map.clearance_m(at(to)) > 0.5);
        let way_m = map.geodesic(at(from)).unwrap().distance_m(&map, at(to)).unwrap();
        assert!(way_m > least_m as f32 * 0.9, "{from} to {to}: {way_m} m; {}", remarks(&map));
        let (said, legs) = (remarks(&map), format!("legs on the way from {from} to {to} and beside it"));
        assert!(said.contains(&legs) && !said.contains("separated"), "{said}");
    }
}
