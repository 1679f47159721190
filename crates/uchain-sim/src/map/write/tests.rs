//! What is written is read again, and lies where it lay.

use glam::Vec2;
use proptest::prelude::*;

use super::*;
use crate::map::{
    Map, drawn,
    make::{Extent, KINDS, Kind, Wish},
    ros_in_memory,
};

fn rectangle([x0, y0, x1, y1]: [f64; 4]) -> Vec<[f64; 2]> {
    vec![[x0, y0], [x1, y0], [x1, y1], [x0, y1]]
}

fn read_again(cells: &RosCells) -> Map {
    let yaml = cells.yaml("a.pgm");
    let of_pgm = ros_in_memory("a.yaml".as_ref(), yaml.as_bytes(), &cells.pgm(), 0.0).unwrap();
    let of_png = ros_in_memory("a.yaml".as_ref(), yaml.as_bytes(), &cells.png(), 0.0).unwrap();
    assert_eq!((of_pgm.walls(), of_pgm.offset_m()), (of_png.walls(), of_png.offset_m()));
    of_pgm
}

/// How far the walls of one map lie from those of another one at most (m), looked at every `step_m`.
fn farthest_off_m(of: &Map, from: &Map, step_m: f32) -> f32 {
    let mut most_m = 0.0_f32;
    for wall in of.walls() {
        let count = (wall.a.distance(wall.b) / step_m).ceil().max(1.0);
        for step in 0..=count as u32 {
            let at = from.to_local(of.to_file(wall.a.lerp(wall.b, step as f32 / count)));
            most_m = most_m.max(from.clearance_m(at));
        }
    }
    most_m
}

#[test]
fn walls_at_whole_cells_are_the_same_again_far_from_the_origin_too() {
    for [x, y] in [[0.0, 0.0], [-3.0, 7.5], [345_678.0, 5_678_901.5]] {
        let place = |[x0, y0, x1, y1]: [f64; 4]| rectangle([x + x0, y + y0, x + x1, y + y1]);
        let map = drawn(&[place([0.0, 0.0, 8.0, 5.0]), place([2.0, 1.0, 3.0, 4.5])]).unwrap();
        let cells = RosCells::of(&map, Some(0.25)).unwrap();
        assert_eq!((cells.size(), cells.thickened()), ([36, 24], 0));
        let again = read_again(&cells);
        assert_eq!(again.walls().len(), 8);
        assert!(farthest_off_m(&again, &map, 0.1) < 1e-5 && farthest_off_m(&map, &again, 0.1) < 1e-5);
    }
}

#[test]
fn a_wall_thinner_than_a_cell_still_keeps_two_rooms_apart() {
    // A slanted sheet of 2 cm between two rooms.
    let left = vec![[0.0, 0.0], [1.53, 0.0], [2.47, 3.0], [0.0, 3.0]];
    let right = vec![[1.55, 0.0], [4.0, 0.0], [4.0, 3.0], [2.49, 3.0]];
    let loops = [left, right].map(|corners| {
        corners.into_iter().map(|[x, y]: [f64; 2]| Vec2::new(x as f32, y as f32)).collect::<Vec<_>>()
    });
    let map = Map::from_loops(loops.into()).unwrap();
    let cells = RosCells::of(&map, Some(0.1)).unwrap();
    assert!(cells.thickened() > 10, "{}", cells.thickened());
    let again = read_again(&cells);
    assert_eq!(again.loops().count(), 2, "two rooms");
    assert!(!again.sees(again.to_local([0.5, 1.5]), again.to_local([3.5, 1.5])));
    // The cells that the middle of the sheet passes: no corner of them is farther off than their diagonal.
    assert!(farthest_off_m(&again, &map, 0.05) < 0.15);
    assert_eq!(
        RosCells::of(&map, Some(0.01)).unwrap().thickened(),
        0,
        "the control: cells fit into the sheet"
    );
}

#[test]
fn cells_that_are_too_small_or_too_large_are_refused_with_what_would_do() {
    let map = drawn(&[rectangle([0.0, 0.0, 900.0, 900.0])]).unwrap();
    let refused = |cell_m| RosCells::of(&map, Some(cell_m)).unwrap_err().to_string();
    assert!(refused(0.05).starts_with("cell_m = 0.05: must lie in 0.11"), "{}", refused(0.05));
    assert!(refused(0.0).starts_with("cell_m = 0: must lie in 0.11"), "{}", refused(0.0));
    assert!(refused(f64::NAN).starts_with("cell_m = NaN"), "{}", refused(f64::NAN));
    assert!(RosCells::of(&map, Some(0.115)).is_ok());
    assert_eq!(RosCells::of(&map, None).unwrap().cell_m(), 0.5, "16 million cells at most");
    let small = drawn(&[rectangle([0.1, 0.1, 0.4, 0.4])]).unwrap();
    assert!(RosCells::of(&small, Some(2.0)).unwrap_err().to_string().contains("no cell's middle is free"));
}

#[test]
fn a_table_of_corners_holds_the_largest_of_several_free_areas() {
    let corners = |r: [f64; 4]| rectangle(r).iter().map(|p| Vec2::new(p[0] as f32, p[1] as f32)).collect();
    let areas = [[0.0, 0.0, 2.0, 2.0], [4.0, 0.0, 9.0, 5.0], [5.0, 1.0, 6.0, 2.0]];
    let map = Map::from_loops(areas.map(corners).into()).unwrap().with_offset_m([100.0, 0.25]);
    let (text, left_out) = write_csv(&map);
    assert_eq!(left_out, 1);
    assert!(
        text.starts_with("loop,x_m,y_m\n0,104,0.25\n0,109,0.25\n") && text.contains("\n1,105,1.25\n"),
        "{text}"
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    #[test]
    fn in_cells_every_wall_lies_within_half_a_cell_of_where_it_was(
        kind in prop::sample::select(KINDS.to_vec()), seed: u64, cells_across in 6.0..14.0_f64, off in -0.5..0.5_f64,
    ) {
        let extent = match kind {
            Kind::Tunnel | Kind::Branching => Extent::Length(60.0),
            _ => Extent::Size([24.0, 20.0]),
        };
        let made = Wish { kind, seed, extent: Some(extent), width_m: Some(2.0), roughness: None }.make().unwrap();
        let [x, y] = made.map.offset_m();
        let map = made.map.with_offset_m([x + off, y - off]);
        let cell_m = 2.0 / cells_across;
        let cells = RosCells::of(&map, Some(cell_m)).unwrap();
        let again = read_again(&cells);
        // Every edge between cells parts a free middle from one in rock: a wall lies between the two, so it is no farther
        // from the edge's points than a cell's half diagonal, and the edge's middle no farther than half a cell.
        let half_m = 0.5 * cell_m as f32;
        let diagonal_m = half_m * std::f32::consts::SQRT_2 + 1e-3;
        if cells.thickened() == 0 {
            prop_assert!(farthest_off_m(&again, &map, half_m) <= diagonal_m);
        }
        for wall in again.walls() {
            let count = (wall.a.distance(wall.b) / cell_m as f32).round().max(1.0);
            for step in 0..count as u32 {
                let middle = wall.a.lerp(wall.b, (step as f32 + 0.5) / count);
                let off_m = map.clearance_m(map.to_local(again.to_file(middle)));
                prop_assert!(cells.thickened() > 0 || off_m <= half_m + 0.13 * cell_m as f32, "{off_m} m of {half_m} m");
            }
        }
    }
}
