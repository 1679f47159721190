mod corridor;
mod geodesic;
mod oracle;
mod queries;

use glam::{Vec2, vec2};

use super::{Map, Vertex};

fn sharp(corners: &[(f64, f64)]) -> Vec<Vertex> {
    corners.iter().map(|&(x, y)| Vertex { x, y, bend_radius_m: 0.0 }).collect()
}

fn rectangle(x0: f32, y0: f32, x1: f32, y1: f32) -> Vec<Vec2> {
    vec![vec2(x0, y0), vec2(x1, y0), vec2(x1, y1), vec2(x0, y1)]
}

/// A 10 × 6 m room with a 2 × 2 m pillar at (4, 2).
fn room_with_a_pillar() -> Map {
    Map::from_loops(vec![rectangle(0.0, 0.0, 10.0, 6.0), rectangle(4.0, 2.0, 6.0, 4.0)]).unwrap()
}
