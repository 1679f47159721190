//! Ways along the graph, and trees of them.

use super::*;
use crate::map::{Vertex, corridor};

fn checked_tree(map: &Map, graph: &TunnelGraph, from: Vec2) -> super::super::WayTree {
    let tree = graph.tree(map, from);
    for (index, &parent) in tree.parent.iter().enumerate() {
        match parent.map(|parent| parent as usize) {
            None => assert_eq!((index, tree.at[0], tree.depth_m[0]), (0, from, 0.0)),
            Some(parent) => {
                assert!(parent < index);
                let step_m = tree.at[parent].distance(tree.at[index]);
                assert!((tree.depth_m[index] - tree.depth_m[parent] - f64::from(step_m)).abs() < 1e-6);
                assert!(step_m <= 0.2501 && map.sees(tree.at[parent], tree.at[index]));
            }
        }
        assert!((tree.clearance_m[index] - map.clearance_m(tree.at[index])).abs() < 1e-6);
    }
    tree
}

#[test]
fn a_tree_reaches_everything_by_ways_hardly_longer_than_the_shortest() {
    for seed in 0..6 {
        let map = Map::from_loops(super::oracle::rooms(300 + seed, 10)).unwrap();
        let graph = map.tunnel_graph().unwrap();
        let from = graph.nodes[0].at;
        let tree = checked_tree(&map, &graph, from);
        let from_base = map.geodesic(from).unwrap();
        for (&at, &depth_m) in tree.at.iter().zip(&tree.depth_m) {
            let shortest_m = f64::from(from_base.distance_m(&map, at).unwrap());
            assert!(depth_m > shortest_m - 1e-3, "{at}: {depth_m} {shortest_m}");
            assert!(depth_m < 1.35 * shortest_m + 3.0, "map {seed}: {at}: {depth_m} {shortest_m}");
        }
        let near = super::super::near::Near::new(&tree.at);
        for node in &graph.nodes {
            assert!(tree.at.iter().any(|at| at.distance(node.at) < 0.3), "{} is not in the tree", node.at);
            assert!(near.seen_from(&map, node.at, 0.0).is_some());
        }
    }
}

#[test]
fn on_a_ring_the_tree_goes_both_ways_round_to_the_far_side() {
    let corner = |x, y| Vertex { x, y, bend_radius_m: 2.0 };
    let (map, line) =
        corridor(&[corner(0.0, 0.0), corner(20.0, 0.0), corner(20.0, 20.0), corner(0.0, 20.0)], 2.0, true)
            .unwrap();
    let graph = map.tunnel_graph().unwrap();
    for start_m in [1.0, 23.0, 61.5] {
        let tree = checked_tree(&map, &graph, line.at(start_m).0);
        let deepest_m = tree.depth_m.iter().copied().fold(0.0, f64::max);
        assert!(
            (deepest_m - f64::from(line.length_m()) / 2.0).abs() < 0.6,
            "{deepest_m} {}",
            line.length_m()
        );
        let leaves = (0..tree.at.len()).filter(|&i| !tree.parent.contains(&Some(i as u32))).count();
        assert_eq!(leaves, 2);
    }
}

#[test]
fn a_way_begins_and_ends_where_it_was_asked_for_and_keeps_to_the_middle() {
    let corner = |x, y| Vertex { x, y, bend_radius_m: 0.0 };
    let (map, line) =
        corridor(&[corner(0.0, 0.0), corner(30.0, 0.0), corner(30.0, 20.0)], 2.0, false).unwrap();
    let graph = map.tunnel_graph().unwrap();
    let (from, to) = (vec2(1.5, 0.7), vec2(29.3, 18.5));
    let way = graph.way(&map, from, to).unwrap();
    assert!(way.at(0.0).0 == from && way.at(way.length_m()).0.distance(to) < 1e-5);
    for i in 0..=200 {
        let (at, _) = way.at(2.0 + (way.length_m() - 4.0) * i as f32 / 200.0);
        let off_m = line.at(line.project(at)).0.distance(at);
        assert!(off_m < if at.distance(vec2(30.0, 0.0)) < 2.5 { 0.8 } else { 0.05 }, "{at}: {off_m}");
    }
    let back = graph.way(&map, to, from).unwrap();
    assert!((back.length_m() - way.length_m()).abs() < 0.5, "{} {}", back.length_m(), way.length_m());
    assert!(graph.way(&map, from, vec2(10.0, 5.0)).is_none(), "the end is in rock");
    assert!(graph.tree(&map, vec2(10.0, 5.0)).at.is_empty());
}

#[test]
fn in_a_wide_room_the_way_between_two_places_in_sight_is_straight() {
    let map = Map::from_loops(vec![rectangle(0.0, 0.0, 20.0, 20.0)]).unwrap();
    let graph = map.tunnel_graph().unwrap();
    let way = graph.way(&map, vec2(2.0, 2.0), vec2(18.0, 2.5)).unwrap();
    assert!((way.length_m() - 16.008).abs() < 0.01, "{}", way.length_m());
}

#[test]
fn whoever_needs_more_room_goes_round_a_narrow_passage() {
    // A ring of passages 2 m wide; on the short side a gap of 0.3 m.
    let pillar = vec![vec2(2.0, 2.0), vec2(18.0, 2.0), vec2(18.0, 8.0), vec2(2.0, 8.0)];
    let stub = [vec2(10.0, 0.0), vec2(10.2, 0.0), vec2(10.2, 1.7), vec2(10.0, 1.7)];
    let mut outer = rectangle(0.0, 0.0, 20.0, 10.0);
    outer.splice(1..1, [stub[0], stub[3], stub[2], stub[1]]);
    let map = Map::from_loops(vec![outer, pillar]).unwrap();
    let graph = map.tunnel_graph().unwrap();
    check(&map, &graph);
    let (from, to) = (vec2(8.0, 1.0), vec2(12.0, 1.0));
    assert!(graph.way(&map, from, to).unwrap().length_m() < 6.0);
    let round_m = graph.way_for(&map, from, to, 0.2).unwrap().length_m();
    assert!((round_m - 44.0).abs() < 6.0, "{round_m}");
    assert!(graph.way_for(&map, from, to, 1.5).is_none());
}
