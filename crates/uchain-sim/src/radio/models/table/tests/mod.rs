mod flown;
mod hostile;
#[cfg(feature = "maps")]
mod numpy;

use std::{fmt::Write as _, io::Write as _, path::Path, sync::Arc};

use glam::Vec2;
use tempfile::NamedTempFile;

use crate::{
    map::{Map, drawn},
    radio::{NO_LINK_DB, RadioError, RadioKind, RadioModel, RadioParams},
};

/// Between the corners of a square of 2 m, the pair 0 2 – 2 0 left out, and one written both ways.
const SQUARE: &str = "\
x1_m,y1_m,x2_m,y2_m,loss_db
0,0,2,0,50
0,0,0,2,57
2,2,0,0,60
2,0,2,2,52
2,2,2,0,52.0005
0,2,2,2,55
0,2,2,0,
";

fn file(bytes: &[u8]) -> NamedTempFile {
    let mut file = NamedTempFile::new().unwrap();
    file.write_all(bytes).unwrap();
    file
}

/// Free ground, whose own frame begins far from the middle that the map is built around.
fn open() -> Map {
    let map = drawn(&[vec![[-50.0, -40.0], [90.0, -40.0], [90.0, 40.0], [-50.0, 40.0]]]).unwrap();
    map.with_offset_m([30.0, -7.0])
}

fn params(file: &Path) -> RadioParams {
    let table_file = Some(file.to_str().unwrap().to_owned());
    RadioParams { model: "table".to_owned(), table_file, ..RadioParams::default() }
}

fn make(params: &RadioParams) -> Result<Arc<dyn RadioModel>, RadioError> {
    let kind = RadioKind::BUILTIN.into_iter().find(|kind| kind.word() == "table").unwrap();
    kind.make(params, &open())
}

fn of(bytes: &[u8]) -> Arc<dyn RadioModel> {
    make(&params(file(bytes).path())).unwrap_or_else(|error| panic!("{error}"))
}

/// Loss between two places of the scenario's own frame.
fn db(model: &dyn RadioModel, from: [f64; 2], to: [f64; 2]) -> f32 {
    let map = open();
    let [a, b] = [from, to].map(|at| map.to_local(at).into());
    let there_db = model.loss_db(&map, &a, &b);
    assert_eq!(there_db.to_bits(), model.loss_db(&map, &b, &a).to_bits(), "{from:?} to {to:?}");
    there_db
}

fn assert_db(got_db: f32, expected_db: f32) {
    assert!((got_db - expected_db).abs() < 1e-4, "{got_db} dB, by hand {expected_db}");
}

#[test]
fn between_places_a_loss_is_the_mean_of_the_pairs_around_it_by_their_shares() {
    let square = of(SQUARE.as_bytes());
    let db = |from, to| db(&*square, from, to);
    assert_db(db([0.0, 0.0], [2.0, 0.0]), 50.0);
    assert_db(db([0.0, 0.0], [2.0, 2.0]), 60.0);
    // Of two that are nearly the same the smaller.
    assert_db(db([2.0, 2.0], [2.0, 0.0]), 52.0);
    // A place to itself loses the least of what the table has from there.
    assert_db(db([2.0, 2.0], [2.0, 2.0]), 52.0);
    // 0 0 with 3/4 and 2 0 with 1/4, each to 2 0 and 2 2 with one half:
    // 3/8 · 50 + 3/8 · 60 + 1/8 · 50 (2 0 to itself) + 1/8 · 52
    assert_db(db([0.5, 0.0], [2.0, 1.0]), 54.0);
    // A quarter of a step beyond the grid is its edge.
    assert_db(db([-0.5, -0.5], [2.5, 0.0]), 50.0);
}

#[test]
fn there_is_no_link_where_the_table_has_none_and_none_beyond_it() {
    let square = of(SQUARE.as_bytes());
    let db = |from, to| db(&*square, from, to);
    assert_eq!(db([0.0, 2.0], [2.0, 0.0]), NO_LINK_DB);
    // Half of the shares: 0 2 and 0 0 to 2 0. The other half has 50 dB.
    assert_db(db([0.0, 1.0], [2.0, 0.0]), 50.0);
    assert_eq!(db([0.0, 1.001], [2.0, 0.0]), NO_LINK_DB);
    for beyond in [[3.01, 0.0], [-1.01, 0.0], [0.0, 3.01], [0.0, -1.01], [f64::NAN, 0.0], [1e9, 1e9]] {
        assert_eq!(db([0.0, 0.0], beyond), NO_LINK_DB, "{beyond:?}");
    }
    let file = file(SQUARE.as_bytes());
    let short = make(&RadioParams { range_m: Some(1.0), ..params(file.path()) }).unwrap();
    assert_eq!(super::tests::db(&*short, [0.0, 0.0], [1.1, 0.0]), NO_LINK_DB);
    assert!(super::tests::db(&*short, [0.0, 0.0], [0.9, 0.0]) < NO_LINK_DB);
}

#[test]
fn the_order_of_lines_and_of_ends_does_not_matter_and_lines_of_the_grid_may_be_missing() {
    let (header, rest) = SQUARE.split_once('\n').unwrap();
    let swapped = rest.lines().rev().map(|line| {
        let cells: Vec<&str> = line.split(',').collect();
        format!("{},{},{},{},{}\r\n", cells[2], cells[3], cells[0], cells[1], cells[4])
    });
    let swapped = of(format!("\u{feff}{header}\r\n{}\r\n", swapped.collect::<String>()).as_bytes());
    let square = of(SQUARE.as_bytes());
    for i in 0..200 {
        let at = |i: u32| [f64::from(i % 7) * 0.4 - 0.2, f64::from(i % 11) * 0.25 - 0.3];
        let [a, b] = [&square, &swapped].map(|model| db(&**model, at(i), at(3 * i + 1)));
        assert_eq!(a.to_bits(), b.to_bits(), "{i}");
    }
    // Thirds with three digits, and no place at 2/3: half a metre is nearer to 1/3.
    let thirds = of(b"x1_m,y1_m,x2_m,y2_m,loss_db\n0,0,0.333,0,40\n0,0,1.000,0,70\n0.333,0,1,0,60\n");
    assert_db(db(&*thirds, [0.0, 0.0], [0.4, 0.0]), 40.0);
    assert_eq!(db(&*thirds, [0.0, 0.0], [0.6, 0.0]), NO_LINK_DB);
    // A line of places holds at its side as well.
    assert_db(db(&*thirds, [0.0, 5.0], [1.0, -9.0]), 70.0);
}

#[test]
fn no_loss_is_below_the_least_of_its_distance_which_does_not_fall() {
    // 8 by 5 places, 1.5 m and 0.5 m apart, losses like noise around one that grows with distance; every seventh is missing.
    let mut state = 7_u32;
    let mut noise = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        state >> 16
    };
    let mut text = "x1_m,y1_m,x2_m,y2_m,loss_db\n".to_owned();
    let at = |place: u32| [f64::from(place % 8) * 1.5 + 20.0, f64::from(place / 8) * 0.5 - 3.0];
    for from in 0..40 {
        for to in from..40 {
            let ([x1, y1], [x2, y2]) = (at(from), at(to));
            let loss_db = 40.0 + 5.0 * libm::hypot(x1 - x2, y1 - y2) + f64::from(noise() % 100) / 10.0;
            if noise() % 7 > 0 {
                writeln!(text, "{x1},{y1},{x2},{y2},{loss_db}").unwrap();
            }
        }
    }
    let model = of(text.as_bytes());
    let (map, mut links, mut tight_db) = (open(), 0, f32::INFINITY);
    let mut places = || {
        let at = [f64::from(noise() % 1250) * 0.01 + 19.0, f64::from(noise() % 300) * 0.01 - 3.5];
        map.to_local(at)
    };
    for _ in 0..20_000 {
        let (a, b): (Vec2, Vec2) = (places(), places());
        let loss_db = model.loss_db(&map, &a.into(), &b.into());
        assert_eq!(loss_db.to_bits(), model.loss_db(&map, &b.into(), &a.into()).to_bits());
        let least_db = model.least_loss_db(a.distance(b));
        assert!(loss_db >= least_db, "{a} to {b}: {loss_db} < {least_db}");
        if loss_db < NO_LINK_DB {
            links += 1;
            tight_db = tight_db.min(loss_db - least_db);
        }
    }
    assert!(links > 10_000 && tight_db < 5.0, "{links} links, the nearest {tight_db} dB above its bound");
    let least: Vec<f32> = (0..300).map(|i| model.least_loss_db(0.1 * i as f32)).collect();
    assert!(least.is_sorted() && least[100] > least[0] + 20.0 && least[299] == NO_LINK_DB, "{least:?}");
}

#[test]
fn a_key_names_what_the_file_holds_and_not_what_it_is_called() {
    let key = |text: &str| of(text.as_bytes()).key().unwrap();
    assert_eq!(key(SQUARE), key(SQUARE));
    assert!(key(SQUARE).starts_with("table "));
    assert_ne!(key(SQUARE), key(&SQUARE.replace("57", "58")), "the control");
    let model = of(SQUARE.as_bytes());
    assert!(!model.is_costly() && format!("{model:?}").len() < 100, "{model:?}");
}
