//! A map in the parts that drawings are made of.

use glam::DVec2;

use crate::map::{Map, Material};

/// How far behind a wall the piece of rock reaches that says what the wall is made of (m).
const FACE_M: f64 = 0.004;

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
                let across = (b - a).perp().normalize_or_zero() * FACE_M;
                let middle = a.midpoint(b);
                let is_rock = |at: &DVec2| map.in_rock_f64(*at);
                if let Some(behind) = [middle + across, middle - across].into_iter().find(is_rock) {
                    self.rock.push(Rock { rings: vec![vec![a, b, behind]], material: Some(material) });
                }
            }
            first += walls.len();
        }
    }
}
