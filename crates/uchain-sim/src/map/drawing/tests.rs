//! What is drawn, and what comes of it.

use proptest::prelude::*;

use super::*;

fn rectangle([x0, y0, x1, y1]: [f64; 4]) -> Shape {
    Shape { outline: vec![[x0, y0], [x1, y0], [x1, y1], [x0, y1]], holes: Vec::new() }
}

fn solid(shape: Shape) -> Solid {
    Solid { shape, material: None }
}

fn wall(line: &[[f64; 2]], thickness_m: f64) -> Wall {
    Wall { line: line.to_vec(), closed: false, thickness_m, material: None }
}

fn area_m2(map: &Map) -> f64 {
    let cross = |walls: &[crate::map::Segment]| -> f64 {
        walls.iter().map(|wall| wall.a.as_dvec2().perp_dot(wall.b.as_dvec2())).sum::<f64>() / 2.0
    };
    map.loops().map(cross).sum()
}

fn is_free(map: &Map, at: [f64; 2]) -> bool {
    !map.in_rock(map.to_local(at))
}

fn said(map: &Map) -> String {
    map.import().remarks.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
}

#[test]
fn free_areas_that_overlap_are_one_and_rock_in_them_is_left_out() {
    let drawing = Drawing {
        free: vec![rectangle([0.0, 0.0, 6.0, 2.0]), rectangle([4.0, 0.0, 6.0, 8.0])],
        solids: vec![solid(rectangle([1.0, 0.5, 2.0, 1.5]))],
        ..Drawing::default()
    };
    let map = drawing.into_map().unwrap();
    assert!((area_m2(&map) - (12.0 + 12.0 - 1.0)).abs() < 1e-4, "{}", area_m2(&map));
    assert_eq!(map.offset_m(), [3.0, 4.0]);
    assert!(is_free(&map, [0.5, 1.0]) && is_free(&map, [5.0, 7.0]));
    assert!(!is_free(&map, [1.5, 1.0]) && !is_free(&map, [1.0, 4.0]));
}

#[test]
fn walls_enclose_a_room_and_a_door_in_the_outer_one_opens_it_to_the_box() {
    let square = |gap: f64| {
        let line = [[gap, 0.0], [10.0, 0.0], [10.0, 5.0], [0.0, 5.0], [0.0, 0.0]];
        let walls = vec![wall(&line, 0.2)];
        Drawing { walls, ..Drawing::default() }.into_map().unwrap()
    };
    let closed = square(0.0);
    // From middle to middle of the walls, less half of their thickness on all sides.
    assert!((area_m2(&closed) - 9.8 * 4.8).abs() < 1e-3, "{}", area_m2(&closed));
    assert!(is_free(&closed, [5.0, 2.0]) && !is_free(&closed, [5.0, -0.05]));
    assert!(said(&closed).contains("is rock"), "{}", said(&closed));
    let open = square(1.0);
    assert!(is_free(&open, [5.0, 2.0]) && is_free(&open, [0.5, -0.05]), "the door is free");
    assert!(said(&open).contains("is free"), "{}", said(&open));
}

#[test]
fn whoever_says_what_lies_outside_is_not_guessed_for() {
    let ring = || {
        vec![
            Wall { closed: true, ..wall(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]], 0.2) },
            wall(&[[8.0, 0.0], [9.0, 0.0]], 0.2),
        ]
    };
    let map = |outside| Drawing { walls: ring(), outside, ..Drawing::default() }.into_map().unwrap();
    let (rock, free) = (map(Outside::Rock), map(Outside::Free));
    assert!(!is_free(&rock, [6.0, 2.0]) && is_free(&free, [6.0, 2.0]));
    assert!(is_free(&rock, [2.0, 2.0]) && is_free(&free, [2.0, 2.0]));
    assert!(rock.import().remarks.is_empty() && free.import().remarks.is_empty());
}

#[test]
fn areas_that_touch_at_a_corner_are_drawn_apart() {
    for free in [
        vec![rectangle([0.0, 0.0, 1.0, 1.0]), rectangle([1.0, 1.0, 2.0, 2.0])],
        vec![Shape {
            outline: rectangle([0.0, 0.0, 4.0, 4.0]).outline,
            holes: vec![rectangle([1.0, 1.0, 2.0, 2.0]).outline, rectangle([2.0, 2.0, 3.0, 3.0]).outline],
        }],
    ] {
        let drawing = Drawing { free, ..Drawing::default() };
        let map = drawing.into_map().unwrap();
        assert_eq!(map.first_crossing(), None);
        assert!(said(&map).contains("separated"), "{}", said(&map));
        assert!(map.geodesic(map.to_local([0.5, 0.5])).is_ok());
    }
}

#[test]
fn a_wall_knows_what_it_is_made_of() {
    let mut drawing = Drawing { free: vec![rectangle([0.0, 0.0, 9.0, 4.0])], ..Drawing::default() };
    let concrete = drawing.material("concrete", Some(12.0));
    let wood = drawing.material("wood", None);
    assert_eq!(drawing.material("wood", None), wood);
    drawing.solids = vec![Solid { shape: rectangle([1.0, 1.0, 2.0, 2.0]), material: Some(concrete) }];
    drawing.walls = vec![Wall { material: Some(wood), ..wall(&[[5.0, 1.0], [5.0, 3.0]], 0.1) }];
    let map = drawing.into_map().unwrap();
    let names: Vec<Option<&str>> =
        (0..3).map(|i| map.material_of_loop(i).map(|material| material.name.as_str())).collect();
    assert_eq!(names.iter().flatten().count(), 2, "the outer wall is of nothing: {names:?}");
    assert!(names.contains(&Some("concrete")) && names.contains(&Some("wood")));
}

#[test]
fn lines_that_all_cross_each_other_are_refused_before_they_are_joined() {
    let star = |lines: u32| {
        let line = |i: u32| {
            let angle_rad = std::f64::consts::PI * f64::from(i) / f64::from(lines);
            let at = [100.0 * libm::cos(angle_rad), 100.0 * libm::sin(angle_rad)];
            wall(&[at, [-at[0], -at[1]]], 0.01)
        };
        Drawing { walls: (0..lines).map(line).collect(), outside: Outside::Free, ..Drawing::default() }
            .into_map()
    };
    let words = star(600).unwrap_err().to_string();
    assert!(words.starts_with("places where lines of the drawing cross: "), "{words}");
    assert!(star(12).is_ok(), "the control");
    // A single wall that crosses itself, before it is made thick.
    let mut draw = 1_u64;
    let mut next = || {
        draw = draw.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (draw >> 40) as f64 / 1e4
    };
    let line: Vec<[f64; 2]> = (0..2000).map(|_| [next(), next()]).collect();
    let scribble = Drawing { walls: vec![wall(&line, 0.1)], ..Drawing::default() };
    let words = scribble.into_map().unwrap_err().to_string();
    assert!(words.starts_with("places where lines of the drawing cross: "), "{words}");
}

#[test]
fn what_cannot_be_a_map_is_refused_in_words() {
    let words = |drawing: Drawing| drawing.into_map().unwrap_err().to_string();
    assert!(words(Drawing::default()).starts_with("corners of all that is drawn: 0"));
    let far = Drawing { free: vec![rectangle([0.0, 0.0, f64::NAN, 1.0])], ..Drawing::default() };
    assert!(words(far).contains("must be numbers within"));
    let large = Drawing { free: vec![rectangle([0.0, 0.0, 1e6, 1.0])], ..Drawing::default() };
    assert!(words(large).contains("size of the drawing (m) = 1000000"));
    let covered = Drawing {
        free: vec![rectangle([0.0, 0.0, 1.0, 1.0])],
        solids: vec![solid(rectangle([-1.0, -1.0, 2.0, 2.0]))],
        ..Drawing::default()
    };
    assert!(words(covered).contains("free areas that no rock covers: 0"));
    let alone = Drawing { walls: vec![wall(&[[0.0, 0.0], [1.0, 0.0]], 0.1)], ..Drawing::default() };
    assert!(words(alone).contains("nothing is enclosed by walls"));
}

proptest! {
    #[test]
    fn whatever_is_drawn_comes_to_walls_that_do_not_cross(
        free in prop::collection::vec(prop::array::uniform4(-40_i32..40), 0..6),
        rock in prop::collection::vec(prop::array::uniform4(-40_i32..40), 0..6),
        lines in prop::collection::vec(prop::collection::vec(prop::array::uniform2(-40_i32..40), 1..5), 0..5),
        step in prop::sample::select(vec![0.01, 0.25, 1.0, 100.0]), far in prop::sample::select(vec![0.0, 5e5]),
    ) {
        let place = |at: i32| f64::from(at) * step + far;
        let shape = |corners: &[i32; 4]| rectangle(corners.map(place));
        let lines = lines.iter().map(|line| wall(&line.iter().map(|at| at.map(place)).collect::<Vec<_>>(), step));
        let drawing = Drawing {
            free: free.iter().map(shape).collect(),
            solids: rock.iter().map(|corners| solid(shape(corners))).collect(),
            walls: lines.collect(),
            snap_m: 0.001,
            ..Drawing::default()
        };
        if let Ok(map) = drawing.into_map() {
            prop_assert_eq!(map.first_crossing(), None);
        }
    }
}
