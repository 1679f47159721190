//! Pictures of maps, by what they say and where.

use super::*;
use crate::{
    draw::said::words,
    map::{Map, drawn},
};

fn rectangle([x0, y0, x1, y1]: [f64; 4]) -> Vec<[f64; 2]> {
    vec![[x0, y0], [x1, y0], [x1, y1], [x0, y1]]
}

fn room(at: [f64; 2], [width, height]: [f64; 2]) -> Map {
    drawn(&[rectangle([at[0], at[1], at[0] + width, at[1] + height])]).unwrap()
}

/// Rooms of all sizes, near the origin and as far from it as surveyors are.
const ROOMS: [([f64; 2], [f64; 2]); 6] = [
    ([0.0, 0.0], [4.0, 3.0]),
    ([-0.1, 0.2], [0.3, 0.2]),
    ([0.0, -1.5], [1000.0, 3.0]),
    ([0.0, 0.0], [2.0, 900.0]),
    ([345_678.0, 5_678_901.0], [120.0, 80.0]),
    ([-40_000.0, 0.0], [80_000.0, 60_000.0]),
];

#[test]
fn a_metre_is_as_long_across_as_up_and_the_page_has_a_sensible_size() {
    for (at, size) in ROOMS {
        let map = room(at, size);
        let sheet = Sheet::new(&map, &[]);
        let page = |x, y| sheet.panel.at(at[0] + x, at[1] + y);
        let (corner, east, north) = (page(0.0, 0.0), page(size[0], 0.0), page(0.0, size[1]));
        let across = (east.0 - corner.0) / size[0];
        let up = (corner.1 - north.1) / size[1];
        assert!((across / up - 1.0).abs() < 1e-6, "{size:?}: {across} and {up} units a metre");
        // All of the map lies in the box.
        let panel = &sheet.panel;
        assert!(corner.0 > panel.left() && east.0 < panel.right(), "{size:?}");
        assert!(corner.1 < panel.bottom() && north.1 > panel.top(), "{size:?}");
        let (scene, _) = scene(&map, &Plot::default());
        assert!(
            (300.0..2700.0).contains(&scene.width) && (150.0..2700.0).contains(&scene.height),
            "{size:?}"
        );
    }
}

#[test]
fn long_thin_tunnels_are_drawn_so_large_that_they_can_be_seen() {
    let map = room([0.0, -1.5], [1000.0, 3.0]);
    let sheet = Sheet::new(&map, &[]);
    let (_, low) = sheet.panel.at(0.0, -1.5);
    let (_, high) = sheet.panel.at(0.0, 1.5);
    assert!(low - high > 6.0, "{} units", low - high);
}

#[test]
fn numbers_on_the_axes_are_whole_coordinates_of_the_maps_file() {
    let map = room([345_678.0, 5_678_901.0], [120.0, 80.0]);
    let (scene, _) = scene(&map, &Plot::default());
    let words = words(&scene);
    for number in ["345700", "345780", "5678920", "5678980", "x (m)", "y (m)", "20 m"] {
        assert!(words.contains(&number), "{number} in {words:?}");
    }
    assert_eq!(sheet::number(-0.0, 1), "0.0");
}

#[test]
fn marks_are_numbered_and_told_with_their_clearance() {
    let map = room([10.0, 0.0], [4.0, 3.0]);
    let plot = Plot { marks: vec![[11.5, 1.0], [14.25, 1.5], [1e7, 0.0]], ..Plot::default() };
    let (scene, _) = scene(&map, &plot);
    let words = words(&scene);
    for words_of in [
        "1: (11.5, 1): free, 1.00 m from the nearest wall",
        "2: (14.25, 1.5): in rock, 0.25 m from the nearest wall",
    ] {
        assert!(words.contains(&words_of), "{words_of} in {words:?}");
    }
    // One far off is told, and does not make the map tiny.
    let across = |marks: &[[f64; 2]]| {
        let sheet = Sheet::new(&map, marks);
        sheet.panel.at(14.0, 0.0).0 - sheet.panel.at(10.0, 0.0).0
    };
    assert!(across(&plot.marks) > 0.8 * across(&[]));
}

#[test]
fn as_many_places_are_named_as_fit_and_none_over_another_one() {
    let map = room([0.0, 0.0], [30.0, 20.0]);
    let place = |i: usize| (format!("station {i}"), [(i % 40) as f64 * 0.75, (i / 40) as f64]);
    let plot = Plot { places: (0..800).map(place).collect(), ..Plot::default() };
    let (scene, unnamed) = scene(&map, &plot);
    let named: Vec<(f64, f64, f64)> = scene
        .elements
        .iter()
        .filter_map(|element| match element {
            Primitive::Text { x, y, content, .. } if content.starts_with("station") => {
                Some((*x, *y, LETTER * content.chars().count() as f64))
            }
            _ => None,
        })
        .collect();
    assert_eq!(named.len() + unnamed, 800);
    assert!((100..400).contains(&named.len()), "{}", named.len());
    for (i, a) in named.iter().enumerate() {
        for b in &named[..i] {
            let apart = (a.1 - b.1).abs() >= 10.9 || a.0 + a.2 <= b.0 + 0.1 || b.0 + b.2 <= a.0 + 0.1;
            assert!(apart, "{a:?} over {b:?}");
        }
    }
    // The control: a few all find room.
    let few = Plot { places: (0..800).step_by(100).map(place).collect(), ..Plot::default() };
    assert_eq!(super::scene(&map, &few).1, 0);
}
