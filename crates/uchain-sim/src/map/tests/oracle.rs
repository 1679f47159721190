//! Random maps against slow answers that share no code with the fast ones.
//!
//! Corners lie on a coarse lattice, so that lines through corners, along walls and over doubled walls are common.

use glam::{DVec2, Vec2, vec2};
use proptest::prelude::*;
use uchain_core::bounded;

use super::rectangle;
use crate::map::{Map, Vertex, corridor};

/// What two places closer than this have in common: the same place (m).
const SAME_M: f64 = 1e-9;

fn cross(a: DVec2, b: DVec2, p: DVec2) -> f64 {
    (b - a).perp_dot(p - a)
}

fn off_wall_m(map: &Map, p: DVec2) -> f64 {
    let off = |(a, b): (DVec2, DVec2)| {
        let t = bounded((p - a).dot(b - a) / (b - a).length_squared(), 0.0, 1.0);
        p.distance(a + (b - a) * t)
    };
    map.walls().iter().map(|wall| off((wall.a.into(), wall.b.into()))).fold(f64::INFINITY, f64::min)
}

/// Even-odd over every wall, with the ray to the left.
fn slow_in_rock(map: &Map, p: DVec2) -> bool {
    let hits = map.walls().iter().filter(|wall| {
        let (a, b): (DVec2, DVec2) = (wall.a.into(), wall.b.into());
        let (low, high) = if a.y < b.y { (a, b) } else { (b, a) };
        low.y <= p.y && p.y < high.y && cross(low, high, p) < 0.0
    });
    off_wall_m(map, p) > SAME_M && hits.count() % 2 == 0
}

/// Cuts the line wherever it may change sides, and asks the middle of each piece.
fn slow_fraction(map: &Map, a: DVec2, b: DVec2) -> f64 {
    let along = b - a;
    let mut cuts = vec![0.0, 1.0];
    for wall in map.walls() {
        let (u, v): (DVec2, DVec2) = (wall.a.into(), wall.b.into());
        let turn = along.perp_dot(v - u);
        if turn.abs() > SAME_M {
            cuts.push((u - a).perp_dot(v - u) / turn);
        } else {
            cuts.extend([u, v].map(|p| (p - a).dot(along) / along.length_squared()));
        }
    }
    cuts.retain(|t| (0.0..=1.0).contains(t));
    cuts.sort_by(f64::total_cmp);
    let pieces =
        cuts.windows(2).filter(|piece| slow_in_rock(map, a + along * f64::midpoint(piece[0], piece[1])));
    pieces.map(|piece| piece[1] - piece[0]).filter(|share| *share > SAME_M).sum()
}

fn slow_sees(map: &Map, a: DVec2, b: DVec2) -> bool {
    let struck = map.walls().iter().any(|wall| {
        let (u, v): (DVec2, DVec2) = (wall.a.into(), wall.b.into());
        cross(a, b, u) * cross(a, b, v) < 0.0 && cross(u, v, a) * cross(u, v, b) < 0.0
    });
    !struck && slow_fraction(map, a, b) < 1e-7
}

fn lattice() -> impl Strategy<Value = Vec2> {
    (-2_i8..=14, -2_i8..=14).prop_map(|(x, y)| vec2(f32::from(x), f32::from(y)) / 2.0)
}

fn loops() -> impl Strategy<Value = Vec<Vec<Vec2>>> {
    let corner = (0_i8..=6, 0_i8..=6).prop_map(|(x, y)| vec2(f32::from(x), f32::from(y)));
    prop::collection::vec(prop::collection::vec(corner, 3..12), 1..4)
}

/// A room with a pillar of whole-metre corners in some of its twelve bays.
fn pillars() -> impl Strategy<Value = Map> {
    let bay = prop::option::weighted(0.8, (0_u8..3, 0_u8..3, 1_u8..3, 1_u8..3));
    prop::collection::vec(bay, 12).prop_map(|bays| {
        let mut loops = vec![rectangle(0.0, 0.0, 21.0, 16.0)];
        for (index, bay) in bays.iter().enumerate() {
            let Some((x, y, width, height)) = *bay else { continue };
            let corner =
                vec2((index % 4 * 5 + 1) as f32 + f32::from(x), (index / 4 * 5 + 1) as f32 + f32::from(y));
            loops.push(rectangle(
                corner.x,
                corner.y,
                corner.x + f32::from(width),
                corner.y + f32::from(height),
            ));
        }
        Map::from_loops(loops).unwrap()
    })
}

/// Centre lines of two to eight corners, some with bends.
fn centre_lines() -> impl Strategy<Value = (Vec<Vertex>, f64)> {
    let leg = (2.0_f64..12.0, -2.2_f64..2.2, prop::option::of(1.0_f64..3.0));
    (prop::collection::vec(leg, 1..8), 0.4_f64..3.0).prop_map(|(legs, width_m)| {
        let mut line = vec![Vertex { x: 0.0, y: 0.0, bend_radius_m: 0.0 }];
        let (mut at, mut heading_rad) = (DVec2::ZERO, 0.0);
        for (length_m, turn_rad, bend) in legs {
            heading_rad += turn_rad;
            at += DVec2::new(libm::cos(heading_rad), libm::sin(heading_rad)) * length_m;
            line.push(Vertex { x: at.x, y: at.y, bend_radius_m: bend.unwrap_or(0.0) * width_m / 2.0 });
        }
        (line, width_m)
    })
}

proptest! {
    #[test]
    fn rock_sight_and_clearance_agree_with_the_slow_answers(
        loops in loops(),
        points in prop::collection::vec(lattice(), 12),
    ) {
        let Ok(map) = Map::from_loops(loops) else { return Ok(()) };
        for &a in &points {
            prop_assert_eq!(map.in_rock(a), slow_in_rock(&map, a.into()), "{}", a);
            prop_assert!((f64::from(map.clearance_m(a)) - off_wall_m(&map, a.into())).abs() < 1e-5);
            for &b in &points {
                if a == b {
                    continue;
                }
                let expected = slow_fraction(&map, a.into(), b.into());
                prop_assert!((f64::from(map.rock_fraction(a, b)) - expected).abs() < 1e-6, "{} {} {}", a, b, expected);
                prop_assert_eq!(map.rock_fraction(a, b).to_bits(), map.rock_fraction(b, a).to_bits());
                prop_assert_eq!(map.sees(a, b), slow_sees(&map, a.into(), b.into()), "{} {}", a, b);
            }
        }
    }

    #[test]
    fn a_corridor_is_free_from_wall_to_wall_all_along_its_centre_line(
        (line, width_m) in centre_lines(),
        (share, side) in (0.0_f32..1.0, -1.0_f32..1.0),
        queries in prop::collection::vec((-15.0_f32..30.0, -30.0_f32..30.0), 4),
    ) {
        let Ok((map, centre)) = corridor(&line, width_m, false) else { return Ok(()) };
        let abscissa_m = share * centre.length_m();
        let (p, heading_rad) = centre.at(abscissa_m);
        let left = Vec2::new(-libm::sinf(heading_rad), libm::cosf(heading_rad));
        let half_m = width_m as f32 / 2.0;
        prop_assert!(!map.in_rock(p + left * side * (half_m - 0.002)));
        prop_assert!(map.clearance_m(p) <= half_m + 0.001);
        prop_assert!((centre.project(p) - abscissa_m).abs() < 1e-3);
        for q in queries {
            let expected = slow_fraction(&map, p.into(), Vec2::from(q).into());
            let got = f64::from(map.rock_fraction(p, q.into()));
            prop_assert!((got - expected).abs() < 1e-6, "{} {:?}: {} {}", p, q, got, expected);
        }
    }

    #[test]
    fn tunnel_distances_agree_with_all_pairs_over_every_corner(map in pillars(), ends in prop::collection::vec(lattice(), 4)) {
        let mut nodes: Vec<Vec2> = ends.into_iter().map(|p| p + vec2(4.0, 4.0)).collect();
        let count = nodes.len();
        nodes.extend(map.walls().iter().map(|wall| wall.a));
        let edge = |p: Vec2, q: Vec2| {
            let seen = p == q && !slow_in_rock(&map, p.into()) || p != q && slow_sees(&map, p.into(), q.into());
            if seen { DVec2::from(p).distance(q.into()) } else { f64::INFINITY }
        };
        let mut all: Vec<Vec<f64>> = nodes.iter().map(|&p| nodes.iter().map(|&q| edge(p, q)).collect()).collect();
        for via in 0..nodes.len() {
            let onward = all[via].clone();
            for row in &mut all {
                let reach_m = row[via];
                row.iter_mut().zip(&onward).for_each(|(d, onward_m)| *d = d.min(reach_m + onward_m));
            }
        }
        for from in 0..count {
            let Ok(geodesic) = map.geodesic(nodes[from]) else {
                prop_assert!(slow_in_rock(&map, nodes[from].into()));
                continue;
            };
            for to in 0..count {
                let got_m = geodesic.distance_m(&map, nodes[to]).map_or(f64::INFINITY, f64::from);
                let expected_m = all[from][to];
                prop_assert!(got_m == expected_m || (got_m - expected_m).abs() < 1e-4, "{} {}: {} {}", nodes[from], nodes[to], got_m, expected_m);
            }
        }
    }
}
