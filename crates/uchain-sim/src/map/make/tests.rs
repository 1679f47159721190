//! What is made is what was wished for.

use std::hash::Hasher as _;

use glam::{IVec2, Vec2};
use proptest::prelude::*;
use twox_hash::XxHash64;

use super::*;
use crate::map::{CellGrid, NodeKind};

fn wish(kind: Kind, seed: u64) -> Wish {
    Wish { kind, seed, extent: None, width_m: None, roughness: None }
}

fn digest(made: &Made) -> u64 {
    let mut hasher = XxHash64::with_seed(0);
    for wall in made.map.walls() {
        for number in [wall.a.x, wall.a.y, wall.b.x, wall.b.y] {
            hasher.write_u32(number.to_bits());
        }
    }
    for number in made.map.offset_m().into_iter().chain(made.base_m).chain(made.goal_m) {
        hasher.write_u64(number.to_bits());
    }
    hasher.finish()
}

#[test]
fn the_same_wish_gives_the_same_bits_for_ever_and_another_seed_another_map() {
    let digests =
        KINDS.map(|kind| format!("{} {:016x}", kind.name(), digest(&wish(kind, 1).make().unwrap())));
    assert_eq!(
        digests,
        [
            "tunnel bf517fc844249e31",
            "cave 615b8d7e9c2063d8",
            "maze 9df10e6b84813f05",
            "rooms e53164de59721f0e",
            "room-and-pillar e091b19997d880c0",
            "branching c0e53d4edec4a22c"
        ]
    );
    for kind in KINDS {
        let of_seed = |seed| digest(&wish(kind, seed).make().unwrap());
        assert!(of_seed(1) == of_seed(1) && of_seed(1) != of_seed(2), "{}", kind.name());
    }
}

#[test]
fn wishes_that_mean_nothing_or_too_much_are_refused_in_words() {
    let refused = |wish: Wish| wish.make().unwrap_err().to_string();
    let sized = |kind, extent| refused(Wish { extent: Some(extent), ..wish(kind, 1) });
    assert_eq!(sized(Kind::Maze, Extent::Length(9.0)), "a maze has no length; it has a size");
    assert_eq!(sized(Kind::Tunnel, Extent::Size([9.0, 9.0])), "a tunnel has no size; it has a length");
    assert_eq!(sized(Kind::Tunnel, Extent::Length(9.0)), "length_m = 9: must lie in 10..=20000");
    assert_eq!(sized(Kind::Rooms, Extent::Size([9.0, f64::NAN])), "size_m = NaN: must lie in 4..=5000");
    assert!(sized(Kind::Cave, Extent::Size([4000.0, 4000.0])).contains("squares of the width"));
    let rough = Wish { roughness: Some(0.1), ..wish(Kind::Rooms, 1) };
    assert_eq!(refused(rough), "a rooms has no roughness; its walls are straight");
    let wide = Wish { width_m: Some(0.1), ..wish(Kind::Cave, 1) };
    assert_eq!(refused(wide), "width_m = 0.1: must lie in 0.2..=50");
    let rough = Wish { roughness: Some(0.6), ..wish(Kind::Cave, 1) };
    assert_eq!(refused(rough), "roughness = 0.6: must lie in 0..=0.5");
}

#[test]
fn ten_kilometres_of_mine_and_of_tunnel_are_made_with_few_walls() {
    for kind in [Kind::Branching, Kind::Tunnel] {
        let long = Wish { extent: Some(Extent::Length(10_000.0)), width_m: Some(3.0), ..wish(kind, 5) };
        let made = long.make().unwrap();
        assert!((made.length_m - 10_000.0).abs() < 10.0, "{} m", made.length_m);
        assert!((1000..20_000).contains(&made.map.walls().len()), "{} walls", made.map.walls().len());
    }
}

#[test]
fn galleries_that_end_in_a_corner_are_as_wide_in_the_graph_as_they_are_made() {
    for seed in 1..=6 {
        let made = wish(Kind::Branching, seed).make().unwrap();
        let graph = made.map.tunnel_graph().unwrap();
        let dead = graph.nodes.iter().filter(|node| node.kind == NodeKind::DeadEnd);
        let narrowest_m = dead
            .flat_map(|node| &node.edges)
            .map(|&edge| graph.edges[edge].narrowest_m)
            .fold(f32::INFINITY, f32::min);
        assert!(f64::from(narrowest_m) > 0.4 * made.width_m, "{seed}: {narrowest_m} of {} m", made.width_m);
    }
}

/// Cells of free space that a body of this radius fits into, and those of them that it reaches from a place.
fn fits_and_reached(map: &Map, from_m: [f64; 2], radius_m: f32, cell_m: f32) -> (usize, Vec<Vec2>) {
    let (low, high) = map.bounds();
    let cells = CellGrid::new(low, cell_m, ((high - low) / cell_m).ceil().as_ivec2() + IVec2::ONE);
    let fits = |index: usize| {
        let at = cells.middle_of(index);
        !map.in_rock(at) && map.clearance_m(at) >= radius_m
    };
    let mut open: Vec<bool> = (0..cells.count()).map(fits).collect();
    let count = open.iter().filter(|open| **open).count();
    let nearest = (0..cells.count()).filter(|index| open[*index]).min_by(|a, b| {
        let apart = |index: usize| cells.middle_of(index).distance(map.to_local(from_m));
        apart(*a).total_cmp(&apart(*b))
    });
    let reached = cells.take_connected(nearest.unwrap(), &mut open);
    (count, reached.into_iter().map(|index| cells.middle_of(index)).collect())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn free_space_is_one_piece_widths_hold_and_walls_do_not_cross(
        kind in prop::sample::select(KINDS.to_vec()), seed: u64, width_m in 0.5..6.0_f64,
        length in 6.0..80.0_f64, size in (10.0..20.0_f64, 10.0..20.0_f64), roughness in 0.0..=0.5_f64,
    ) {
        let extent = match kind {
            Kind::Tunnel | Kind::Branching => Extent::Length(length * width_m),
            _ => Extent::Size([size.0 * width_m, size.1 * width_m]),
        };
        let is_rough = matches!(kind, Kind::Tunnel | Kind::Branching | Kind::Cave);
        let roughness = is_rough.then_some(roughness);
        let made = Wish { kind, seed, extent: Some(extent), width_m: Some(width_m), roughness }.make().unwrap();
        let map = &made.map;
        prop_assert_eq!(map.first_crossing(), None);

        // Nothing is cut off from the base.
        let cell_m = width_m as f32 / 12.0;
        let (count, reached) = fits_and_reached(map, made.base_m, 0.0, cell_m);
        prop_assert_eq!(count, reached.len());
        // What is as wide as the narrowest passage, but for a tenth and half a cell, gets from the base to the goal.
        let narrowest_m = width_m * (1.0 - roughness.unwrap_or(0.0));
        let radius_m = (0.45 * narrowest_m) as f32 - cell_m;
        let (_, reached) = fits_and_reached(map, made.base_m, radius_m.max(0.0), cell_m);
        let (base, goal) = (map.to_local(made.base_m), map.to_local(made.goal_m));
        let is_there = |place: Vec2| reached.iter().any(|at| at.distance(place) < 3.0 * cell_m);
        prop_assert!(is_there(base) && is_there(goal), "base {base} goal {goal}");
        for place in [base, goal] {
            prop_assert!(!map.in_rock(place) && f64::from(map.clearance_m(place)) > 0.4 * narrowest_m);
        }
        prop_assert!(made.way_m >= f64::from(base.distance(goal)) - 0.02);
    }
}
