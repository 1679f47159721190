//! Tunnel distances of five shapes of known answer, and where there is none.

use std::f32::consts::PI;

use glam::vec2;

use super::{rectangle, room_with_a_pillar, sharp};
use crate::{
    map::{Map, MapError, Trail, Vertex, corridor},
    seed::{Seed, Source},
};

fn assert_distance(map: &Map, from: (f32, f32), to: (f32, f32), expected_m: f32) {
    for (from, to) in [(from, to), (to, from)] {
        let got_m = map.geodesic(from.into()).unwrap().distance_m(map, to.into()).unwrap();
        assert!(
            (got_m / expected_m - 1.0).abs() < 1e-4,
            "{from:?} to {to:?}: {got_m} m, expected {expected_m} m"
        );
    }
}

#[test]
fn a_straight_tunnel_is_as_long_as_its_line() {
    let (map, _) = corridor(&sharp(&[(0.0, 0.0), (100.0, 0.0)]), 2.0, false).unwrap();
    assert_distance(&map, (1.0, -0.5), (99.0, 0.5), 98.005_1);
}

#[test]
fn the_way_round_one_corner_touches_it() {
    let (map, _) = corridor(&sharp(&[(0.0, 0.0), (10.0, 0.0), (10.0, 10.0)]), 2.0, false).unwrap();
    // The inner corner is (9, 1).
    let expected_m = (8.0_f32 * 8.0 + 1.0).sqrt() + (1.0_f32 + 64.0).sqrt();
    assert_distance(&map, (1.0, 0.0), (10.0, 9.0), expected_m);
}

#[test]
fn the_way_round_a_thin_wall_touches_both_its_corners() {
    // The wall, 2 cm thick, grows out of the left side of the room.
    let corners = [
        (0.0, 0.0),
        (10.0, 0.0),
        (10.0, 6.0),
        (0.0, 6.0),
        (0.0, 3.01),
        (9.0, 3.01),
        (9.0, 2.99),
        (0.0, 2.99),
    ];
    let map = Map::from_loops(vec![corners.map(|(x, y)| vec2(x, y)).to_vec()]).unwrap();
    let leg_m = (8.0_f32 * 8.0 + 1.99 * 1.99).sqrt();
    assert_distance(&map, (1.0, 1.0), (1.0, 5.0), 2.0 * leg_m + 0.02);
}

#[test]
fn the_way_through_a_zig_zag_is_pulled_taut_between_its_corners() {
    // Three baffles from alternate sides of a 12 × 4 m room, their tips at y = 3, 1, 3.
    let corners = [
        (0.0, 0.0),
        (2.9, 0.0),
        (3.0, 3.0),
        (3.1, 0.0),
        (8.9, 0.0),
        (9.0, 3.0),
        (9.1, 0.0),
        (12.0, 0.0),
        (12.0, 4.0),
        (6.1, 4.0),
        (6.0, 1.0),
        (5.9, 4.0),
        (0.0, 4.0),
    ];
    let map = Map::from_loops(vec![corners.map(|(x, y)| vec2(x, y)).to_vec()]).unwrap();
    let expected_m = 2.0 * (4.0_f32 + 4.0).sqrt() + 2.0 * (9.0_f32 + 4.0).sqrt();
    assert_distance(&map, (1.0, 1.0), (11.0, 1.0), expected_m);
}

#[test]
fn the_way_round_a_round_pillar_is_two_tangents_and_an_arc() {
    let bend = |x, y| Vertex { x, y, bend_radius_m: 5.0 };
    // A square of side 10 with bends of radius 5 is a circle: the ring's inner wall has radius 4.
    let square = [bend(-5.0, -5.0), bend(5.0, -5.0), bend(5.0, 5.0), bend(-5.0, 5.0)];
    let (map, _) = corridor(&square, 2.0, true).unwrap();
    let tangent_m = (25.0_f32 - 16.0).sqrt();
    let arc_m = 4.0 * (PI - 2.0 * libm::acosf(4.0 / 5.0));
    assert_distance(&map, (-5.0, 0.0), (5.0, 0.0), 2.0 * tangent_m + arc_m);
}

#[test]
fn rock_and_other_rooms_are_out_of_reach() {
    let mut map = room_with_a_pillar();
    let here = map.geodesic(vec2(1.0, 1.0)).unwrap();
    assert_eq!(here.distance_m(&map, vec2(5.0, 3.0)), None);
    assert!(matches!(map.geodesic(vec2(5.0, 3.0)), Err(MapError::InRock { .. })));
    map = Map::from_loops(vec![rectangle(0.0, 0.0, 1.0, 1.0), rectangle(2.0, 0.0, 3.0, 1.0)]).unwrap();
    assert_eq!(map.geodesic(vec2(0.5, 0.5)).unwrap().distance_m(&map, vec2(2.5, 0.5)), None);
}

#[test]
fn who_travels_is_told_the_same_as_who_asks_anew() {
    let corners = [(0.0, 0.0, 0.0), (6.0, 0.0, 0.0), (4.0, 4.0, 0.0), (7.0, 8.0, 1.0), (0.0, 8.0, 0.0)];
    let corners = corners.map(|(x, y, bend_radius_m)| Vertex { x, y, bend_radius_m });
    let ring = corridor(&corners, 1.0, true).unwrap().0;
    for (map, from) in [(ring, vec2(2.0, 0.2)), (room_with_a_pillar(), vec2(0.5, 0.5))] {
        let geodesic = map.geodesic(from).unwrap();
        let mut random = Seed(1).stream(0, Source::Start);
        let (mut trail, mut at, mut told) = (Trail::default(), from, 0);
        for step in 0..20_000 {
            // Mostly steps, sometimes a leap; into walls and rock, too.
            let stride_m = if step % 97 == 0 { 10.0 } else { 0.1 };
            let to = at + stride_m * vec2(random.uniform() - 0.5, random.uniform() - 0.5);
            let (told_m, asked_m) = (geodesic.follow_m(&map, &mut trail, to), geodesic.distance_m(&map, to));
            assert_eq!(told_m, asked_m, "at {to}");
            if told_m.is_some() {
                at = to;
                told += 1;
            }
        }
        assert!(told > 10_000, "{told}");
    }
}
