//! Delaunay triangulation of places, one place at a time (Lawson 1977: walk to the triangle, split it, flip edges).
//!
//! Every decision is the exact sign of a determinant, so that any places will do: in a row, on a circle, twice the
//! same. No place has to be known beforehand but a box around all of them.

use glam::DVec2;
use robust::{Coord, incircle};

use crate::map::geometry::orient;

/// No triangle.
const NONE: u32 = u32::MAX;

/// Triangles over places in a box, none with another place inside its circumcircle.
#[derive(Debug)]
pub(super) struct Delaunay {
    places: Vec<DVec2>,
    /// Counter-clockwise.
    corners: Vec<[u32; 3]>,
    /// Across the edge opposite each corner.
    across: Vec<[u32; 3]>,
    /// Where the last search ended.
    last: u32,
}

impl Delaunay {
    /// The box alone, in two triangles: its corners are the places 0 to 3.
    pub(super) fn new(low: DVec2, high: DVec2) -> Self {
        let places = vec![low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)];
        let (corners, across) = (vec![[0, 1, 2], [0, 2, 3]], vec![[NONE, 1, NONE], [NONE, NONE, 0]]);
        Self { places, corners, across, last: 0 }
    }

    pub(super) fn places(&self) -> &[DVec2] {
        &self.places
    }

    /// The corners of every triangle, and the triangles across the edges opposite to them.
    pub(super) fn triangles(&self) -> impl Iterator<Item = ([u32; 3], [Option<u32>; 3])> {
        let across = |sides: &[u32; 3]| sides.map(|side| (side != NONE).then_some(side));
        self.corners.iter().zip(&self.across).map(move |(&corners, sides)| (corners, across(sides)))
    }

    /// The corners of a triangle.
    pub(super) fn corners(&self, triangle: usize) -> [u32; 3] {
        self.corners.get(triangle).copied().unwrap_or([0; 3])
    }

    pub(super) fn count(&self) -> usize {
        self.corners.len()
    }

    /// Middle and radius of a triangle's circumcircle; not finite for a triangle that is flat to `f64`.
    pub(super) fn circle(&self, triangle: usize) -> (DVec2, f64) {
        let [a, b, c] = self.corners(triangle).map(|corner| self.at(corner));
        let (b, c) = (b - a, c - a);
        let (bb, cc) = (b.length_squared(), c.length_squared());
        let out = DVec2::new(bb * c.y - cc * b.y, cc * b.x - bb * c.x) / (2.0 * b.perp_dot(c));
        (a + out, out.length())
    }

    fn at(&self, place: u32) -> DVec2 {
        self.places.get(place as usize).copied().unwrap_or(DVec2::NAN)
    }

    /// Takes in a place and notes the triangles that are new or changed. `false` for one outside the box, or there
    /// already.
    pub(super) fn insert(&mut self, place: DVec2, changed: &mut Vec<u32>) -> bool {
        let (low, high) = (self.at(0), self.at(2));
        if !(place.cmpgt(low).all() && place.cmplt(high).all()) {
            return false;
        }
        let Some(triangle) = self.find(place) else { return false };
        let corners = self.corners[triangle as usize];
        if corners.iter().any(|&corner| self.at(corner) == place) {
            return false;
        }
        let new = self.places.len() as u32;
        self.places.push(place);
        let side = (0..3).find(|&i| {
            let (a, b) = (corners[(i + 1) % 3], corners[(i + 2) % 3]);
            orient(self.at(a), self.at(b), place) == 0.0
        });
        let mut open = match side {
            Some(side) => self.split_edge(triangle, side, new),
            None => self.split_triangle(triangle, new),
        };
        changed.extend(&open);
        while let Some(triangle) = open.pop() {
            if let Some(other) = self.flip(triangle, new) {
                open.extend([triangle, other]);
                changed.push(other);
            }
        }
        self.last = triangle;
        true
    }

    /// Walks to the triangle that a place lies in. On a Delaunay triangulation the walk never comes back (Devillers 2001).
    fn find(&self, place: DVec2) -> Option<u32> {
        let mut here = self.last;
        for _ in 0..=self.corners.len() {
            let corners = self.corners[here as usize];
            let beyond = (0..3).find(|&i| {
                let (a, b) = (corners[(i + 1) % 3], corners[(i + 2) % 3]);
                orient(self.at(a), self.at(b), place) < 0.0
            });
            match beyond.map(|side| self.across[here as usize][side]) {
                None => return Some(here),
                Some(NONE) => return None,
                Some(next) => here = next,
            }
        }
        None
    }

    fn add(&mut self, corners: [u32; 3], across: [u32; 3]) -> u32 {
        self.corners.push(corners);
        self.across.push(across);
        self.corners.len() as u32 - 1
    }

    fn set(&mut self, triangle: u32, corners: [u32; 3], across: [u32; 3]) {
        self.corners[triangle as usize] = corners;
        self.across[triangle as usize] = across;
    }

    /// Tells a triangle who is across one of its edges now.
    fn tell(&mut self, triangle: u32, before: u32, now: u32) {
        if triangle != NONE {
            for side in &mut self.across[triangle as usize] {
                if *side == before {
                    *side = now;
                    return;
                }
            }
        }
    }

    /// A triangle becomes three around a place in it.
    fn split_triangle(&mut self, triangle: u32, new: u32) -> Vec<u32> {
        let [a, b, c] = self.corners[triangle as usize];
        let [bc, ca, ab] = self.across[triangle as usize];
        let second = self.add([new, c, a], [ca, NONE, triangle]);
        let third = self.add([new, a, b], [ab, triangle, second]);
        self.across[second as usize][1] = third;
        self.set(triangle, [new, b, c], [bc, second, third]);
        self.tell(ca, triangle, second);
        self.tell(ab, triangle, third);
        vec![triangle, second, third]
    }

    /// The two triangles beside an edge become four around a place on it; one becomes two at the rim.
    fn split_edge(&mut self, triangle: u32, side: usize, new: u32) -> Vec<u32> {
        let turned = |of: [u32; 3], by: usize| [of[by % 3], of[(by + 1) % 3], of[(by + 2) % 3]];
        let [a, b, c] = turned(self.corners[triangle as usize], side);
        let [other, ca, ab] = turned(self.across[triangle as usize], side);
        // `new` lies between b and c; a is opposite.
        let second = self.add([new, c, a], [ca, triangle, NONE]);
        self.set(triangle, [new, a, b], [ab, NONE, second]);
        self.tell(ca, triangle, second);
        if other == NONE {
            return vec![triangle, second];
        }
        let back = (0..3).find(|&i| self.across[other as usize][i] == triangle).unwrap_or(0);
        let [d, _, _] = turned(self.corners[other as usize], back);
        let [_, bd, dc] = turned(self.across[other as usize], back);
        // Seen from the other side the edge runs from c to b.
        let fourth = self.add([new, d, c], [dc, second, other]);
        self.set(other, [new, b, d], [bd, fourth, triangle]);
        self.tell(dc, other, fourth);
        self.across[triangle as usize][1] = other;
        self.across[second as usize][2] = fourth;
        vec![triangle, second, other, fourth]
    }

    /// Flips the edge opposite a place if the corner beyond it lies in the triangle's circumcircle; the other triangle.
    fn flip(&mut self, triangle: u32, place: u32) -> Option<u32> {
        let corner = self.corners[triangle as usize].iter().position(|&corner| corner == place)?;
        let turned = |of: [u32; 3], by: usize| [of[by % 3], of[(by + 1) % 3], of[(by + 2) % 3]];
        let [p, a, b] = turned(self.corners[triangle as usize], corner);
        let [other, bp, pa] = turned(self.across[triangle as usize], corner);
        if other == NONE {
            return None;
        }
        let back = self.across[other as usize].iter().position(|&side| side == triangle)?;
        let [q, _, _] = turned(self.corners[other as usize], back);
        let [_, aq, qb] = turned(self.across[other as usize], back);
        let coord = |place: u32| {
            let DVec2 { x, y } = self.at(place);
            Coord { x, y }
        };
        if incircle(coord(p), coord(a), coord(b), coord(q)) <= 0.0 {
            return None;
        }
        // p a b and q b a become p a q and p q b.
        self.set(triangle, [p, a, q], [aq, other, pa]);
        self.set(other, [p, q, b], [qb, bp, triangle]);
        self.tell(aq, other, triangle);
        self.tell(bp, triangle, other);
        Some(other)
    }
}
