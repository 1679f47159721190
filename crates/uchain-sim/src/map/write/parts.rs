//! A map in the parts that drawings are made of.

use glam::DVec2;

use crate::map::{Map, Material};

/// How far behind a wall the piece of rock reaches that says what the wall is made of, less where the rock is thinner (m).
const FACE_M: [f64; 3] = [4e-3, 2e-3, 1e-3];
/// No face is deeper than this share of its length: in the corner between two walls it stays within the rock.
const FACE_SHARE: f64 = 0.1;

/// Free areas, the rock that stands in them, and what walls are made of. Places are in the map frame (m).
#[derive(Debug, Default)]
pub(super) struct Parts<'a> {
    /// Loops that no other surrounds.
    pub(super) free: Vec<Vec<DVec2>>,
    pub(super) rock: Vec<Rock<'a>>,
}

/// A piece of rock: its outline, and the free areas within it.
#[derive(Debug)]
pub(super) struct Rock<'a> {
    pub(super) rings: Vec<Vec<DVec2>>,
    pub(super) material: Option<&'a Material>,
}

impl<'a> Parts<'a> {
    pub(super) fn of(map: &'a Map) -> Self {
        let around = map.loops_around();
        let corners =
            |walls: &[crate::map::Segment]| walls.iter().map(|wall| wall.a.as_dvec2()).collect::<Vec<_>>();
        let loops: Vec<Vec<DVec2>> = map.loops().map(corners).collect();
        let mut parts = Self::default();
        // Where each loop of rock is in `rock`.
        let mut rock_of: Vec<Option<usize>> = vec![None; loops.len()];
        for (index, around) in around.iter().enumerate() {
            if around.is_empty() {
                parts.free.push(loops[index].clone());
            } else if around.len() % 2 == 1 {
                rock_of[index] = Some(parts.rock.len());
                let material = map.material_of_loop(index);
                parts.rock.push(Rock { rings: vec![loops[index].clone()], material });
            }
        }
        for (index, own) in around.iter().enumerate() {
            // Free space within a rock is a hole of the innermost one around it, the one that most surround.
            if own.len() % 2 == 0 {
                let inmost = own.iter().copied().max_by_key(|&other| around[other].len());
                if let Some(rock) = inmost.and_then(|other| rock_of[other]) {
                    parts.rock[rock].rings.push(loops[index].clone());
                }
            }
        }
        parts.faces(map, &around);
        parts
    }

    /// A sliver behind every wall whose material no piece of rock says.
    fn faces(&mut self, map: &'a Map, around: &[Vec<usize>]) {
        let mut first = 0;
        for (index, walls) in map.loops().enumerate() {
            let said = around[index].len() % 2 == 1 && map.material_of_loop(index).is_some();
            for (wall, segment) in walls.iter().enumerate() {
                let Some(material) = map.material_of_wall(first + wall).filter(|_| !said) else { continue };
                let (a, b) = segment.ends();
                let (middle, across) = (a.midpoint(b), (b - a).perp().normalize_or_zero());
                let deepest_m = FACE_SHARE * a.distance(b);
                let depths = FACE_M.into_iter().map(|depth_m| depth_m.min(deepest_m));
                let mut faces = depths.flat_map(|depth_m| [across * depth_m, -across * depth_m]);
                let is_free_of_space = |across: &DVec2| {
                    let quarters = [a.midpoint(middle), middle, middle.midpoint(b)];
                    let depths = [0.5, 1.0, 0.5];
                    quarters
                        .into_iter()
                        .zip(depths)
                        .all(|(at, share)| map.is_rock_behind(at, share * *across))
                };
                if let Some(across) = faces.find(is_free_of_space) {
                    self.rock
                        .push(Rock { rings: vec![vec![a, b, middle + across]], material: Some(material) });
                }
            }
            first += walls.len();
        }
    }
}
