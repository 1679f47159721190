//! The graph of random maps against a slow search over small cells: how wide the widest way between two places is.

use super::*;
use crate::map::raster::{cells::Cells, to_map};

/// A number at random, 0 to 1, of the oldest kind (Lehmer 1951).
fn random(seed: u32) -> impl FnMut() -> f32 {
    let mut state = u64::from(seed) * 2_654_435_761 % 2_147_483_647 + 1;
    move || {
        state = state * 48_271 % 2_147_483_647;
        state as f32 / 2_147_483_647.0
    }
}

/// Rooms of many sizes, each joined to the one before by a passage round a corner, on cells of 0.5 m.
pub(super) fn rooms(seed: u32, count: usize) -> Vec<Vec<Vec2>> {
    const SIDE: usize = 60;
    let mut random = random(seed);
    let mut below = |most: usize| (random() * most as f32) as usize;
    let mut free = vec![false; SIDE * SIDE];
    let mut carve = |x: [usize; 2], y: [usize; 2]| {
        for row in y[0].min(y[1])..=y[0].max(y[1]) {
            for col in x[0].min(x[1])..=x[0].max(x[1]) {
                free[row * SIDE + col] = true;
            }
        }
    };
    let mut before: Option<[usize; 2]> = None;
    for _ in 0..count {
        let (x, y) = (2 + below(SIDE - 12), 2 + below(SIDE - 12));
        let (wide, high, passage) = (1 + below(8), 1 + below(8), below(3));
        carve([x, x + wide], [y, y + high]);
        if let Some([from_x, from_y]) = before {
            carve([from_x, x], [from_y, from_y + passage]);
            carve([x, x + passage], [from_y, y]);
        }
        before = Some([x, y]);
    }
    let map = to_map(&Cells::new(SIDE, free), 0.5, 0.0, |corner| corner * 0.5, |_| unreachable!()).unwrap();
    map.loops().map(|walls| walls.iter().map(|wall| wall.a).collect()).collect()
}

/// A hall of 12 × 12 m with pillars of three to seven corners.
pub(super) fn pillars(seed: u32) -> Vec<Vec<Vec2>> {
    let mut random = random(seed);
    let mut loops = vec![rectangle(0.0, 0.0, 12.0, 12.0)];
    for cell in 0..36 {
        if random() < 0.3 {
            continue;
        }
        let middle = vec2((cell % 6) as f32, (cell / 6) as f32) * 2.0 + 1.0;
        let corners = 3 + (random() * 5.0) as usize;
        let turn_rad = random() * 6.0;
        let corner = |i: usize| {
            let angle_rad = turn_rad + i as f32 * std::f32::consts::TAU / corners as f32;
            middle + Vec2::from_angle(angle_rad) * (0.3 + 0.65 * random())
        };
        loops.push((0..corners).map(corner).collect());
    }
    loops
}

/// Whoever stands for the group of a cell; the way there gets shorter each time.
fn root(group: &mut [usize], mut cell: usize) -> usize {
    while group[cell] != cell {
        group[cell] = group[group[cell]];
        cell = group[cell];
    }
    cell
}

/// The room that the widest way between two places leaves at its narrowest (m), over cells so wide (m): the cells are let
/// in from the widest on until the two places are joined.
fn widest_way_m(map: &Map, cell_m: f32, ends: [Vec2; 2]) -> f32 {
    let (low, high) = map.bounds();
    let size = ((high - low) / cell_m).ceil();
    let (cols, rows) = (size.x as usize, size.y as usize);
    let middle = |cell: usize| low + (vec2((cell % cols) as f32, (cell / cols) as f32) + 0.5) * cell_m;
    let room_m: Vec<f32> = (0..cols * rows)
        .map(|cell| if map.in_rock(middle(cell)) { -1.0 } else { map.clearance_m(middle(cell)) })
        .collect();
    let mut order: Vec<usize> = (0..room_m.len()).filter(|&cell| room_m[cell] > 0.0).collect();
    order.sort_by(|&p, &q| room_m[q].total_cmp(&room_m[p]));
    let cell_at = |at: Vec2| {
        let cell = (at - low) / cell_m;
        cell.y as usize * cols + cell.x as usize
    };
    let ends = ends.map(cell_at);
    let mut group: Vec<usize> = (0..room_m.len()).collect();
    let mut open = vec![false; room_m.len()];
    for cell in order {
        open[cell] = true;
        let (x, y) = (cell % cols, cell / cols);
        let around = [
            (x > 0).then(|| cell - 1),
            (x + 1 < cols).then(|| cell + 1),
            (y > 0).then(|| cell - cols),
            (y + 1 < rows).then(|| cell + cols),
        ];
        for other in around.into_iter().flatten().filter(|&other| open[other]) {
            if map.sees(middle(cell), middle(other)) {
                let (p, q) = (root(&mut group, cell), root(&mut group, other));
                group[p] = q;
            }
        }
        if ends.iter().all(|&end| open[end]) && root(&mut group, ends[0]) == root(&mut group, ends[1]) {
            return room_m[cell];
        }
    }
    0.0
}

/// The same over the graph.
fn widest_on_graph_m(map: &Map, graph: &TunnelGraph, ends: [Vec2; 2]) -> f32 {
    let fits = |radius_m: f32| graph.way_for(map, ends[0], ends[1], radius_m).is_some();
    let (mut low_m, mut high_m) = (0.0, map.clearance_m(ends[0]).min(map.clearance_m(ends[1])));
    if !fits(low_m) {
        return 0.0;
    }
    for _ in 0..14 {
        let middle_m = f32::midpoint(low_m, high_m);
        if fits(middle_m) {
            low_m = middle_m;
        } else {
            high_m = middle_m;
        }
    }
    low_m
}

#[test]
fn between_any_two_places_the_widest_way_is_on_the_graph() {
    const CELL_M: f32 = 0.06;
    let maps = (0..5).map(|seed| pillars(100 + seed)).chain((0..5).map(|seed| rooms(200 + seed, 8)));
    let (mut compared, mut narrow) = (0, 0);
    for (number, loops) in maps.enumerate() {
        let map = Map::from_loops(loops).unwrap();
        let graph = map.tunnel_graph().unwrap();
        check(&map, &graph);
        let mut random = random(number as u32);
        for _ in 0..5 {
            let [from, to] = [(); 2].map(|()| graph.nodes[(random() * graph.nodes.len() as f32) as usize].at);
            let (expected_m, got_m) =
                (widest_way_m(&map, CELL_M, [from, to]), widest_on_graph_m(&map, &graph, [from, to]));
            // Narrower than the graph's least, cells may still find a way.
            if expected_m > 0.05 || got_m > 0.05 {
                // Between two samples a wall may come a little nearer than it does to them.
                let within_m = 1.5 * CELL_M + 0.05 * expected_m;
                assert!(
                    (expected_m - got_m).abs() < within_m,
                    "map {number}: {from} {to}: {expected_m} {got_m}"
                );
            }
            compared += 1;
            narrow += usize::from(expected_m < 0.3);
        }
    }
    assert!(compared == 50 && narrow > 3, "{narrow} of {compared} pairs");
}

#[test]
fn the_oracle_sees_a_gap_that_is_closed() {
    let open = map_of(&[
        (0.0, 0.0),
        (4.0, 0.0),
        (4.0, 0.8),
        (4.2, 0.8),
        (4.2, 0.0),
        (8.0, 0.0),
        (8.0, 2.0),
        (0.0, 2.0),
    ]);
    let ends = [vec2(1.0, 1.0), vec2(7.0, 1.0)];
    assert!((widest_way_m(&open, 0.04, ends) - 0.6).abs() < 0.05);
    let narrow = map_of(&[
        (0.0, 0.0),
        (4.0, 0.0),
        (4.0, 1.6),
        (4.2, 1.6),
        (4.2, 0.0),
        (8.0, 0.0),
        (8.0, 2.0),
        (0.0, 2.0),
    ]);
    assert!((widest_way_m(&narrow, 0.04, ends) - 0.2).abs() < 0.05);
}

#[test]
fn walls_that_cross_and_touch_anyhow_make_no_panic() {
    for seed in 0..60 {
        let mut random = random(1_000 + seed);
        let loops: Vec<Vec<Vec2>> = (0..4)
            .map(|_| {
                (0..3 + (random() * 9.0) as usize).map(|_| vec2(random() * 5.0, random() * 5.0)).collect()
            })
            .collect();
        // On a lattice walls run over each other and corners meet.
        let lattice = loops.iter().map(|corners| corners.iter().map(|p| p.round()).collect()).collect();
        for loops in [loops.clone(), lattice] {
            let Ok(map) = Map::from_loops(loops) else { continue };
            let graph = map.tunnel_graph().unwrap();
            check(&map, &graph);
            assert!(map.numbers(&graph, 0.06).free_area_m2 >= 0.0);
        }
    }
}
