//! Tunnels that can be worked out by hand.

use super::*;
use crate::map::{Vertex, corridor};

fn built(corners: &[(f64, f64, f64)], width_m: f64, closed: bool) -> (Map, f64) {
    let corners: Vec<Vertex> =
        corners.iter().map(|&(x, y, bend_radius_m)| Vertex { x, y, bend_radius_m }).collect();
    let (map, line) = corridor(&corners, width_m, closed).unwrap();
    (map, f64::from(line.length_m()))
}

#[test]
fn a_straight_corridor_is_one_edge_of_its_length_and_width() {
    for (length_m, width_m) in [(10.0, 1.0), (400.0, 0.2), (30.0, 7.0), (10_000.0, 3.0)] {
        let (map, _) = built(&[(0.0, 0.0, 0.0), (length_m, 0.0, 0.0)], width_m, false);
        let graph = map.tunnel_graph().unwrap();
        check(&map, &graph);
        assert_eq!((kinds(&graph), graph.edges.len()), ([2, 0, 0, 0], 1), "{length_m} × {width_m}");
        let edge = &graph.edges[0];
        // It ends where the cap is as near as the walls on both sides.
        assert!((edge.length_m - (length_m - width_m)).abs() < 0.05 * width_m, "{}", edge.length_m);
        assert!((f64::from(edge.narrowest_m) - width_m).abs() < 0.03 * width_m, "{}", edge.narrowest_m);
        assert!(edge.line.iter().all(|at| at.y.abs() < 0.02 * width_m as f32));
    }
}

#[test]
fn a_ring_is_a_loop_as_long_as_its_centre_line() {
    let corners = [(0.0, 0.0, 3.0), (20.0, 0.0, 3.0), (20.0, 12.0, 3.0), (0.0, 12.0, 3.0)];
    let (map, length_m) = built(&corners, 2.0, true);
    let graph = map.tunnel_graph().unwrap();
    check(&map, &graph);
    assert_eq!((kinds(&graph), graph.edges.len()), ([0, 0, 1, 0], 1));
    assert_eq!(graph.nodes[0].edges, [0, 0]);
    assert!(
        (graph.edges[0].length_m - length_m).abs() < 0.01 * length_m,
        "{} {length_m}",
        graph.edges[0].length_m
    );
}

/// A cross of two corridors so wide, 20 m long each.
fn cross(a: f32, b: f32) -> Map {
    map_of(&[
        (-10.0, -a),
        (-b, -a),
        (-b, -10.0),
        (b, -10.0),
        (b, -a),
        (10.0, -a),
        (10.0, a),
        (b, a),
        (b, 10.0),
        (-b, 10.0),
        (-b, a),
        (-10.0, a),
    ])
}

#[test]
fn a_cross_is_one_junction_of_four() {
    for (a, b) in [(1.0, 1.0), (1.5, 1.0), (0.4, 1.0)] {
        let map = cross(a, b);
        let graph = map.tunnel_graph().unwrap();
        check(&map, &graph);
        assert_eq!((kinds(&graph), graph.edges.len()), ([4, 1, 0, 0], 4), "{a} {b}");
        let junction = graph.nodes.iter().find(|node| node.kind == NodeKind::Junction).unwrap();
        assert_eq!(junction.edges.len(), 4);
        assert!(junction.at.length() < 0.02, "{}", junction.at);
    }
}

#[test]
fn a_tee_is_one_junction_of_three() {
    let map = map_of(&[
        (-10.0, -1.0),
        (10.0, -1.0),
        (10.0, 1.0),
        (1.0, 1.0),
        (1.0, 10.0),
        (-1.0, 10.0),
        (-1.0, 1.0),
        (-10.0, 1.0),
    ]);
    let graph = map.tunnel_graph().unwrap();
    check(&map, &graph);
    assert_eq!((kinds(&graph), graph.edges.len()), ([3, 1, 0, 0], 3));
}

#[test]
fn two_rooms_that_nothing_joins_are_two_pieces() {
    let map = Map::from_loops(vec![rectangle(0.0, 0.0, 10.0, 2.0), rectangle(0.0, 2.1, 10.0, 4.0)]).unwrap();
    let graph = map.tunnel_graph().unwrap();
    check(&map, &graph);
    assert_eq!((graph.pieces(), kinds(&graph), graph.edges.len()), (2, [4, 0, 0, 0], 2));
    assert!(graph.way(&map, vec2(1.0, 1.0), vec2(1.0, 3.0)).is_none());
    assert!(graph.tree(&map, vec2(1.0, 1.0)).at.iter().all(|at| at.y < 2.0));
}

#[test]
fn an_empty_room_is_one_place_and_a_hall_one_line() {
    let square = Map::from_loops(vec![rectangle(0.0, 0.0, 8.0, 8.0)]).unwrap();
    let graph = square.tunnel_graph().unwrap();
    check(&square, &graph);
    assert_eq!((kinds(&graph), graph.edges.len()), ([0, 0, 0, 1], 0));
    assert!(graph.nodes[0].at.distance(vec2(4.0, 4.0)) < 1e-3);
    let hall = Map::from_loops(vec![rectangle(0.0, 0.0, 30.0, 8.0)]).unwrap();
    let graph = hall.tunnel_graph().unwrap();
    check(&hall, &graph);
    assert_eq!((kinds(&graph), graph.edges.len()), ([2, 0, 0, 0], 1));
    // A disc of many corners has no corners worth a passage.
    let disc = (0..200).map(|i| Vec2::from_angle(i as f32 * std::f32::consts::TAU / 200.0) * 5.0).collect();
    let disc = Map::from_loops(vec![disc]).unwrap();
    assert_eq!(kinds(&disc.tunnel_graph().unwrap()), [0, 0, 0, 1]);
}

#[test]
fn a_niche_deeper_than_wide_is_a_dead_end_and_a_dent_is_none() {
    for (deep_m, dead_ends) in [(0.3, 2), (0.9, 2), (1.3, 3), (5.0, 3)] {
        let top = 1.0 + deep_m;
        let map = map_of(&[
            (-10.0, -1.0),
            (10.0, -1.0),
            (10.0, 1.0),
            (0.5, 1.0),
            (0.5, top),
            (-0.5, top),
            (-0.5, 1.0),
            (-10.0, 1.0),
        ]);
        let graph = map.tunnel_graph().unwrap();
        check(&map, &graph);
        assert_eq!(kinds(&graph)[0], dead_ends, "{deep_m} m deep");
    }
}

#[test]
fn rough_walls_make_no_passages() {
    // 10 m of corridor, both walls in teeth of 5 cm.
    let tooth = |i: usize, y: f32| {
        let x = i as f32 * 0.05;
        [vec2(x, y), vec2(x, y + 0.05), vec2(x + 0.025, y + 0.05), vec2(x + 0.025, y)]
    };
    let below = (0..200).flat_map(|i| tooth(i, 0.0));
    let above = (0..200).rev().flat_map(|i| tooth(i, 1.0).into_iter().rev());
    let map = Map::from_loops(vec![below.chain(above).collect()]).unwrap();
    let graph = map.tunnel_graph().unwrap();
    check(&map, &graph);
    assert_eq!((kinds(&graph), graph.edges.len()), ([2, 0, 0, 0], 1));
}

#[test]
fn a_map_turned_by_a_right_angle_has_the_same_graph() {
    let shapes = [super::oracle::rooms(3, 9), super::oracle::rooms(8, 9), super::oracle::pillars(5)];
    for loops in shapes {
        let turned = loops.iter().map(|corners| corners.iter().map(|p| p.perp()).collect()).collect();
        let [here, there] = [loops, turned].map(|loops| {
            let map = Map::from_loops(loops).unwrap();
            let graph = map.tunnel_graph().unwrap();
            check(&map, &graph);
            let length_m: f64 = graph.edges.iter().map(|edge| edge.length_m).sum();
            (kinds(&graph), graph.edges.len(), length_m)
        });
        assert_eq!((here.0, here.1), (there.0, there.1));
        assert!((here.2 - there.2).abs() < 0.01 * here.2, "{} {}", here.2, there.2);
    }
}
