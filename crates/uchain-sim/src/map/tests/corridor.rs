//! The corridor builder and its centre line.

use std::f32::consts::PI;

use glam::vec2;

use super::sharp;
use crate::map::{MapError, Vertex, corridor};

fn bend(x: f64, y: f64, bend_radius_m: f64) -> Vertex {
    Vertex { x, y, bend_radius_m }
}

#[test]
fn a_straight_corridor_is_a_rectangle() {
    let (map, line) = corridor(&sharp(&[(0.0, 0.0), (10.0, 0.0)]), 2.0, false).unwrap();
    assert_eq!(map.walls().len(), 4);
    assert_eq!(map.bounds(), (vec2(0.0, -1.0), vec2(10.0, 1.0)));
    assert_eq!(line.length_m(), 10.0);
    assert_eq!(line.at(4.0), (vec2(4.0, 0.0), 0.0));
    assert_eq!(line.project(vec2(7.0, 0.9)), 7.0);
    assert_eq!(line.project(vec2(-3.0, 0.9)), 0.0);
}

#[test]
fn a_sharp_corner_has_mitred_walls() {
    let (map, line) = corridor(&sharp(&[(0.0, 0.0), (10.0, 0.0), (10.0, 10.0)]), 2.0, false).unwrap();
    assert_eq!(map.walls().len(), 6);
    assert_eq!(line.length_m(), 20.0);
    assert!(!map.in_rock(vec2(10.9, -0.9)));
    assert!(map.in_rock(vec2(8.9, 1.1)));
    assert_eq!(line.at(15.0), (vec2(10.0, 5.0), PI / 2.0));
}

#[test]
fn a_bend_keeps_its_width_to_a_millimetre_and_its_arc_length() {
    let (map, line) =
        corridor(&[bend(0.0, 0.0, 0.0), bend(10.0, 0.0, 3.0), bend(10.0, 8.0, 0.0)], 2.0, false).unwrap();
    assert!((line.length_m() - (7.0 + 3.0 * PI / 2.0 + 5.0)).abs() < 1e-5);
    for step in 0..=100 {
        let abscissa_m = 7.0 + 3.0 * PI / 2.0 * step as f32 / 100.0;
        let (p, heading_rad) = line.at(abscissa_m);
        assert!((map.clearance_m(p) - 1.0).abs() < 1e-3, "{}", map.clearance_m(p));
        assert!((heading_rad - PI / 2.0 * step as f32 / 100.0).abs() < 1e-5);
        assert!((line.project(p) - abscissa_m).abs() < 1e-4);
    }
}

#[test]
fn a_ring_has_two_walls_and_goes_round() {
    let square = [bend(0.0, 0.0, 2.0), bend(10.0, 0.0, 2.0), bend(10.0, 10.0, 0.0), bend(0.0, 10.0, 2.0)];
    let (map, line) = corridor(&square, 1.0, true).unwrap();
    assert_eq!(map.loops().count(), 2);
    assert!(map.in_rock(vec2(5.0, 5.0)) && !map.in_rock(vec2(5.0, 0.0)) && map.in_rock(vec2(5.0, -1.0)));
    let length_m = line.length_m();
    assert!((length_m - (40.0 - 3.0 * (4.0 - PI))).abs() < 1e-4);
    let (start, after_a_lap) = (line.at(1.0).0, line.at(1.0 + length_m).0);
    assert!(start.distance(after_a_lap) < 1e-4);
    assert!(line.at(-1.0).0.distance(line.at(length_m - 1.0).0) < 1e-4);
}

#[test]
fn what_cannot_be_a_corridor_is_an_error_with_numbers() {
    let line = sharp(&[(0.0, 0.0), (10.0, 0.0)]);
    let error = |corners: &[Vertex], width_m, closed| corridor(corners, width_m, closed).unwrap_err();
    assert!(matches!(error(&line, 0.05, false), MapError::Range { what: "width_m", .. }));
    assert!(matches!(error(&line, f64::NAN, false), MapError::Range { .. }));
    assert!(matches!(error(&line[..1], 1.0, false), MapError::Count { got: 1, least: 2, .. }));
    assert!(matches!(error(&line, 1.0, true), MapError::Count { got: 2, least: 3, .. }));
    assert!(matches!(error(&vec![line[0]; 10_001], 1.0, true), MapError::Count { got: 10_001, .. }));
    let nowhere = [bend(0.0, f64::INFINITY, 0.0), bend(1.0, 0.0, 0.0)];
    assert!(matches!(error(&nowhere, 1.0, false), MapError::Coordinate { index: 0, .. }));
    assert!(matches!(
        error(&sharp(&[(1.0, 1.0), (1.0, 1.0)]), 1.0, false),
        MapError::LegTooShort { leg: 0, .. }
    ));
    let back = sharp(&[(0.0, 0.0), (10.0, 0.0), (0.0, 0.0)]);
    assert!(matches!(error(&back, 1.0, false), MapError::TurnsBack { corner: 1, .. }));
    let stub = sharp(&[(0.0, 0.0), (10.0, 0.0), (10.0, 0.4)]);
    assert!(matches!(error(&stub, 1.0, false), MapError::LegTooShort { leg: 1, .. }));
    let wide = [bend(0.0, 0.0, 0.0), bend(10.0, 0.0, 6.0), bend(10.0, 5.0, 0.0)];
    assert!(matches!(error(&wide, 1.0, false), MapError::LegTooShort { leg: 1, .. }));
    let tight = [bend(0.0, 0.0, 0.0), bend(10.0, 0.0, 0.4), bend(10.0, 5.0, 0.0)];
    assert!(matches!(error(&tight, 1.0, false), MapError::BendTooTight { corner: 1, .. }));
    let hook = sharp(&[(0.0, 0.0), (10.0, 0.0), (10.0, 5.0), (5.0, 5.0), (5.0, -5.0)]);
    assert!(matches!(error(&hook, 1.0, false), MapError::WallsCross { .. }));
    // A bend of exactly half the width is allowed: its inner wall is a point.
    assert!(corridor(&[bend(0.0, 0.0, 0.0), bend(10.0, 0.0, 0.5), bend(10.0, 5.0, 0.0)], 1.0, false).is_ok());
}
