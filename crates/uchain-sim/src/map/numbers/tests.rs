//! Numbers of maps that can be worked out by hand.

use glam::{Vec2, vec2};

use crate::map::{Map, Vertex, corridor};

fn rectangle(x0: f32, y0: f32, x1: f32, y1: f32) -> Vec<Vec2> {
    vec![vec2(x0, y0), vec2(x1, y0), vec2(x1, y1), vec2(x0, y1)]
}

fn close(got: f64, expected: f64, within: f64) -> bool {
    (got - expected).abs() <= within
}

#[test]
fn areas_are_exact_whatever_stands_in_what_and_which_way_the_loops_run() {
    let mut island = rectangle(3.0, 3.0, 7.0, 7.0);
    island.reverse();
    // A room, rock in it, a chamber within that rock, a pillar in the chamber; a speck right of the rock; a room apart.
    let loops = vec![
        rectangle(0.0, 0.0, 10.0, 10.0),
        island,
        rectangle(4.0, 4.0, 6.0, 6.0),
        rectangle(4.5, 4.5, 5.0, 5.0),
        rectangle(8.0, 4.0, 8.5, 4.5),
        rectangle(20.0, 0.0, 21.0, 2.0),
    ];
    let map = Map::from_loops(loops).unwrap();
    assert_eq!(map.free_areas_m2(), [100.0 - 16.0 - 0.25, 4.0 - 0.25, 2.0]);
}

#[test]
fn a_corridor_has_the_area_length_and_width_it_was_built_with() {
    let vertex = |x, y, bend_radius_m| Vertex { x, y, bend_radius_m };
    let (map, line) =
        corridor(&[vertex(0.0, 0.0, 0.0), vertex(30.0, 0.0, 3.0), vertex(30.0, 20.0, 0.0)], 2.0, false)
            .unwrap();
    let map = map.with_offset_m([1000.0, 0.0]);
    let numbers = map.numbers(&map.tunnel_graph().unwrap(), 0.06);
    let length_m = f64::from(line.length_m());
    assert!(close(numbers.free_area_m2, 2.0 * length_m, 0.01), "{numbers:?}");
    assert!(close(numbers.length_m, length_m - 2.0, 0.1), "{numbers:?}");
    let widths = numbers.width_m.unwrap();
    assert!(
        [widths.min, widths.p10, widths.median, widths.p90, widths.max].iter().all(|&w| close(w, 2.0, 0.05)),
        "{widths:?}"
    );
    assert_eq!((numbers.pieces, numbers.passages, numbers.dead_ends), (1, 1, 2));
    assert_eq!((numbers.junctions, numbers.loops, numbers.largest_share), (0, 0, 1.0));
    assert_eq!((numbers.too_narrow_m, numbers.too_narrow_for_a_star_m), (0.0, 0.0));
    assert!(numbers.narrowest.unwrap().at_m[0] > 999.0);
}

#[test]
fn what_is_too_narrow_is_said_in_metres_of_passage_and_with_the_worst_place() {
    // Two rooms of 4 × 4 m; 3 m of passage 0.8 m wide between them, its last metre only 0.2 m wide.
    let walls = [
        (0.0, 0.0),
        (4.0, 0.0),
        (4.0, 1.6),
        (6.0, 1.6),
        (6.0, 1.9),
        (7.0, 1.9),
        (7.0, 0.0),
        (11.0, 0.0),
        (11.0, 4.0),
        (7.0, 4.0),
        (7.0, 2.1),
        (6.0, 2.1),
        (6.0, 2.4),
        (4.0, 2.4),
        (4.0, 4.0),
        (0.0, 4.0),
    ];
    let map = Map::from_loops(vec![walls.iter().map(|&(x, y)| vec2(x, y)).collect()]).unwrap();
    let numbers = map.numbers(&map.tunnel_graph().unwrap(), 0.06);
    assert!(close(numbers.uav_needs_m, 0.22, 1e-6) && close(numbers.too_narrow_m, 1.0, 0.1), "{numbers:?}");
    assert!(
        close(numbers.star_needs_m, 0.9, 1e-6) && close(numbers.too_narrow_for_a_star_m, 3.6, 0.15),
        "{numbers:?}"
    );
    let narrowest = numbers.narrowest.unwrap();
    assert!(close(narrowest.width_m, 0.2, 1e-3) && close(narrowest.at_m[0], 6.5, 0.51), "{narrowest:?}");
    assert!(close(narrowest.at_m[1], 2.0, 0.01), "{narrowest:?}");
}

#[test]
fn a_block_of_streets_has_as_many_ways_round_as_blocks() {
    let mut loops = vec![rectangle(0.0, 0.0, 13.0, 10.0)];
    for (x, y) in [(1.0, 1.0), (5.0, 1.0), (9.0, 1.0), (1.0, 6.0), (5.0, 6.0), (9.0, 6.0)] {
        loops.push(rectangle(x, y, x + 3.0, y + 3.0));
    }
    let map = Map::from_loops(loops).unwrap();
    let numbers = map.numbers(&map.tunnel_graph().unwrap(), 0.06);
    assert_eq!((numbers.loops, numbers.junctions, numbers.dead_ends, numbers.pieces), (6, 8, 0, 1));
}
