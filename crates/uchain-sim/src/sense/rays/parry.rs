//! Rays by parry.

use glam::Vec2;
use parry2d::{
    query::{Ray, RayCast},
    shape::Polyline,
};

use super::Rays;
use crate::map::Map;

/// Rays by parry's bounding-volume tree.
#[derive(Debug)]
pub struct ParryRays {
    walls: Option<Polyline>,
}

impl ParryRays {
    /// Rays in the walls of a map.
    pub fn new(map: &Map) -> Self {
        let corners: Vec<Vec2> = map.walls().iter().flat_map(|wall| [wall.a, wall.b]).collect();
        let edges: Vec<[u32; 2]> = (0..map.walls().len() as u32).map(|i| [2 * i, 2 * i + 1]).collect();
        Self { walls: (!edges.is_empty()).then(|| Polyline::new(corners, Some(edges))) }
    }
}

impl Rays for ParryRays {
    fn cast(&self, from: Vec2, direction: Vec2, range_m: f32) -> f32 {
        self.walls
            .as_ref()
            .and_then(|walls| walls.cast_local_ray(&Ray::new(from, direction), range_m, true))
            .unwrap_or(range_m)
    }
}
