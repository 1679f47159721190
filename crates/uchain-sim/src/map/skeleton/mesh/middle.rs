//! The middle of free space as a mesh of fine steps: wherever the nearest walls are equally far on two sides.
//!
//! The middles of the triangles' circles are its places (Voronoi 1908); between two triangles that share an edge lies
//! everything that is equally far from the edge's two ends.

use glam::DVec2;
use smallvec::SmallVec;

use super::delaunay::Delaunay;
use crate::map::{Map, geometry::orient, skeleton::NARROWEST_M};

/// A gap between two places on the walls gets a place of its own where it is narrower than this share of both sides'.
const GAP: f64 = 0.95;
/// Sine of half the angle from which on walls are on two sides, and not the two of a corner: 120°.
const TWO_SIDES: f64 = 0.866;

/// Places in mid-space and the steps between them.
#[derive(Debug, Default)]
pub(in crate::map::skeleton) struct Middle {
    pub(in crate::map::skeleton) at: Vec<DVec2>,
    /// Distance from each place to the nearest wall (m).
    pub(in crate::map::skeleton) room_m: Vec<f64>,
    pub(in crate::map::skeleton) steps: Vec<Step>,
    /// The steps at each place.
    pub(in crate::map::skeleton) steps_at: Vec<SmallVec<[u32; 3]>>,
    /// Whether a place has been taken away.
    pub(in crate::map::skeleton) gone: Vec<bool>,
}

/// From one place to the next.
#[derive(Debug, Clone, Copy)]
pub(in crate::map::skeleton) struct Step {
    pub(in crate::map::skeleton) ends: [u32; 2],
    /// Whether, seen from each end, the walls it runs between are on two sides, and not the two of a corner.
    pub(in crate::map::skeleton) between_sides: [bool; 2],
}

impl Middle {
    pub(super) fn of(map: &Map, triangles: &Delaunay) -> Self {
        let mut middle = Self::default();
        let circles: Vec<(DVec2, f64)> =
            (0..triangles.count()).map(|triangle| triangles.circle(triangle)).collect();
        let node: Vec<Option<u32>> = circles.iter().map(|&(at, _)| middle.place(map, at)).collect();
        for (triangle, (corners, across)) in triangles.triangles().enumerate() {
            for (side, other) in across.into_iter().enumerate() {
                let Some(other) = other.map(|other| other as usize).filter(|&other| other > triangle) else {
                    continue;
                };
                let (Some(here), Some(there)) = (node[triangle], node[other]) else { continue };
                let edge = [1, 2].map(|next| triangles.places()[corners[(side + next) % 3] as usize]);
                middle.join(map, edge, [here, there], [circles[triangle], circles[other]]);
            }
        }
        middle
    }

    /// A place, if it is in free space and has room.
    fn place(&mut self, map: &Map, at: DVec2) -> Option<u32> {
        if !at.is_finite() || map.in_rock_f64(at) {
            return None;
        }
        let room_m = map.clearance_f64_m(at);
        if room_m < NARROWEST_M / 2.0 {
            return None;
        }
        self.at.push(at);
        self.room_m.push(room_m);
        self.steps_at.push(SmallVec::new());
        self.gone.push(false);
        Some(self.at.len() as u32 - 1)
    }

    /// The step between the middles of two circles over one edge, if it stays in free space and has room.
    fn join(&mut self, map: &Map, [a, b]: [DVec2; 2], ends: [u32; 2], circles: [(DVec2, f64); 2]) {
        let half_m = a.distance(b) / 2.0;
        let between_sides = circles.map(|(_, radius_m)| half_m >= TWO_SIDES * radius_m);
        let [from, to] = circles.map(|(at, _)| at);
        let rooms_m = ends.map(|end| self.room_m[end as usize]);
        let through = orient(a, b, from) * orient(a, b, to) < 0.0;
        if through && half_m < GAP * rooms_m[0].min(rooms_m[1]) {
            let Some(gap) = self.place(map, a.midpoint(b)) else { return };
            if self.sees(map, ends[0], gap) && self.sees(map, gap, ends[1]) {
                self.step(Step { ends: [ends[0], gap], between_sides: [between_sides[0], true] });
                self.step(Step { ends: [gap, ends[1]], between_sides: [true, between_sides[1]] });
            }
        } else if self.sees(map, ends[0], ends[1]) {
            self.step(Step { ends, between_sides });
        }
    }

    fn step(&mut self, step: Step) {
        let index = self.steps.len() as u32;
        self.steps.push(step);
        step.ends.iter().for_each(|&end| self.steps_at[end as usize].push(index));
    }

    /// Whether nothing lies between two places. Two discs of free space that overlap need no look.
    fn sees(&self, map: &Map, a: u32, b: u32) -> bool {
        let (a, b) = (a as usize, b as usize);
        let (p, q) = (self.at[a], self.at[b]);
        self.room_m[a] + self.room_m[b] > p.distance(q) || map.sees(p.as_vec2(), q.as_vec2())
    }

    /// How many steps lead on from a place.
    pub(in crate::map::skeleton) fn degree(&self, place: u32) -> usize {
        self.steps_at[place as usize].len()
    }

    /// Where a step leads from a place.
    pub(in crate::map::skeleton) fn beyond(&self, step: u32, place: u32) -> u32 {
        let [a, b] = self.steps[step as usize].ends;
        if a == place { b } else { a }
    }

    /// Takes a place away that only one step leads to, and that step.
    pub(in crate::map::skeleton) fn remove(&mut self, place: u32) {
        self.gone[place as usize] = true;
        let Some(step) = self.steps_at[place as usize].pop() else { return };
        let root = self.beyond(step, place);
        self.steps_at[root as usize].retain(|&mut other| other != step);
    }

    /// Places, and the steps between them, from a place along a step as far as there is only one way on. A way that comes
    /// round ends where it began.
    pub(in crate::map::skeleton) fn run(&self, from: u32, step: u32) -> (Vec<u32>, Vec<u32>) {
        let (mut places, mut steps) = (vec![from], vec![step]);
        let (mut here, mut step) = (self.beyond(step, from), step);
        loop {
            places.push(here);
            let &[first, second] = self.steps_at[here as usize].as_slice() else { return (places, steps) };
            if here == from {
                return (places, steps);
            }
            step = if first == step { second } else { first };
            steps.push(step);
            here = self.beyond(step, here);
        }
    }

    /// Length of a row of places (m).
    pub(in crate::map::skeleton) fn length_of(&self, places: &[u32]) -> f64 {
        let pairs = places.iter().zip(places.iter().skip(1));
        pairs.map(|(&a, &b)| self.at[a as usize].distance(self.at[b as usize])).sum()
    }
}
