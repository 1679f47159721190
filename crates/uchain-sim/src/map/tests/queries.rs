//! Rock, sight and clearance against answers by hand.

use glam::vec2;

use super::room_with_a_pillar;

#[test]
fn a_point_on_a_wall_is_free_and_one_beyond_it_is_rock() {
    let map = room_with_a_pillar();
    for (x, y, rock) in [
        (1.0, 1.0, false),
        (5.0, 3.0, true),
        (4.0, 3.0, false),
        (4.0, 2.0, false),
        (3.999, 2.0, false),
        (1.0, 2.0, false),
        (8.0, 4.0, false),
        (10.0, 6.0, false),
        (10.001, 6.0, true),
        (-50.0, 3.0, true),
        (5.0, 7.0, true),
        (f32::NAN, 3.0, true),
        (f32::MAX, f32::MIN, true),
    ] {
        assert_eq!(map.in_rock(vec2(x, y)), rock, "({x}, {y})");
    }
}

#[test]
fn the_share_of_a_segment_in_rock_is_exact_through_corners_and_along_walls() {
    let map = room_with_a_pillar();
    for (a, b, fraction) in [
        ((1.0, 3.0), (9.0, 3.0), 0.25),
        ((1.0, 1.0), (9.0, 1.0), 0.0),
        // Along the pillar's lower wall, and along the line that wall lies on.
        ((4.0, 2.0), (6.0, 2.0), 0.0),
        ((0.0, 2.0), (10.0, 2.0), 0.0),
        // From corner to corner through the pillar, and past both of its corners.
        ((4.0, 2.0), (6.0, 4.0), 1.0),
        ((3.0, 1.0), (7.0, 5.0), 0.5),
        // Touching one corner from outside.
        ((3.0, 3.0), (5.0, 1.0), 0.0),
        // From one wall to the opposite one, and out of the room through the pillar.
        ((0.0, 3.0), (10.0, 3.0), 0.2),
        ((-10.0, 3.0), (10.0, 3.0), 0.6),
        // Inside one wall's line, beyond both ends.
        ((-5.0, 0.0), (15.0, 0.0), 0.5),
        ((5.0, 3.0), (5.0, 3.0), 1.0),
        ((1.0, 1.0), (1.0, 1.0), 0.0),
    ] {
        let (a, b) = (vec2(a.0, a.1), vec2(b.0, b.1));
        assert!((map.rock_fraction(a, b) - fraction).abs() < 1e-6, "{a} {b}: {}", map.rock_fraction(a, b));
        assert_eq!(map.rock_fraction(a, b).to_bits(), map.rock_fraction(b, a).to_bits());
    }
}

#[test]
fn sight_passes_corners_and_runs_along_walls_but_enters_no_rock() {
    let map = room_with_a_pillar();
    assert!(map.sees(vec2(4.0, 2.0), vec2(6.0, 2.0)));
    assert!(map.sees(vec2(0.0, 2.0), vec2(10.0, 2.0)));
    assert!(map.sees(vec2(3.0, 3.0), vec2(5.0, 1.0)));
    assert!(!map.sees(vec2(4.0, 2.0), vec2(6.0, 4.0)));
    assert!(!map.sees(vec2(3.0, 3.0), vec2(7.0, 3.0)));
    assert!(!map.sees(vec2(0.0, 0.0), vec2(-1.0, 0.0)));
    assert!(!map.sees(vec2(5.0, 2.5), vec2(5.0, 3.5)));
}

#[test]
fn clearance_is_the_distance_to_the_nearest_wall_on_either_side() {
    let map = room_with_a_pillar();
    for (x, y, clearance_m) in
        [(5.0, 1.25, 0.75), (5.0, 3.0, 1.0), (9.75, 3.0, 0.25), (-3.0, -4.0, 5.0), (10.0, 1.0, 0.0)]
    {
        assert!((map.clearance_m(vec2(x, y)) - clearance_m).abs() < 1e-6, "({x}, {y})");
    }
}

#[test]
fn stretches_of_rock_are_counted_one_by_one_and_touching_a_corner_is_none() {
    let map = room_with_a_pillar();
    for (a, b, stretches) in [
        ((1.0, 1.0), (9.0, 1.0), 0),
        ((1.0, 3.0), (9.0, 3.0), 1),
        // Out of the room on the left, through the pillar, out on the right.
        ((-1.0, 3.0), (11.0, 3.0), 3),
        // Along the pillar's lower wall, and past one of its corners.
        ((4.0, 2.0), (6.0, 2.0), 0),
        ((3.0, 3.0), (5.0, 1.0), 0),
        ((f32::NAN, 3.0), (9.0, 3.0), 1),
    ] {
        let (a, b) = (vec2(a.0, a.1), vec2(b.0, b.1));
        assert_eq!((map.rock_stretches(a, b), map.rock_stretches(b, a)), (stretches, stretches), "{a} {b}");
    }
}
