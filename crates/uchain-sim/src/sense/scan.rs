//! A range scan all around: per sector the nearest point of what a robot of some size could touch there.

use std::f64::consts::TAU;

use glam::{DVec2, Vec2};
use uchain_core::{bounded, explore::ExploreParams};

use crate::map::{Map, Segment};

/// Walls within this of touching a robot leave it no room (m); below what `f32` tells apart in a map.
const TOUCH_M: f64 = 1e-9;

/// An exact scan (Kim 2021, §4.1).
///
/// For each of the equal sectors, the first of which begins at the map's x axis: the distance to the nearest point of
/// the walls grown by `r_body_m` that lies in the *closed* cone of the sector, both edges included; nothing, if there
/// is none within `r_s_m`. A scan from within `r_body_m` of a wall returns 0 everywhere.
///
/// A grown wall is convex, so that its distance along a ray has a single valley as the ray turns: in a cone it is
/// least in the direction of the wall's nearest point, or else at one of the cone's edges. No ray is sampled.
#[derive(Debug, Clone)]
pub struct Scanner {
    r_s_m: f64,
    r_body_m: f64,
    /// Directions in which sectors begin.
    edges: Vec<DVec2>,
    /// Nearest so far, by sector (m).
    nearest_m: Vec<f64>,
}

impl Scanner {
    /// A scanner for robots that fly by these.
    pub fn new(params: &ExploreParams) -> Self {
        let count = params.sectors.max(1);
        let edge = |k| {
            let (sin, cos) = libm::sincos(TAU * f64::from(k) / f64::from(count));
            DVec2::new(cos, sin)
        };
        Self {
            r_s_m: params.r_s_m.into(),
            r_body_m: params.r_body_m.into(),
            edges: (0..count).map(edge).collect(),
            nearest_m: Vec::with_capacity(count.into()),
        }
    }

    /// Scans from a place; one distance per sector (m), each rounded toward the robot.
    pub fn scan(&mut self, map: &Map, from: Vec2, returns_m: &mut Vec<Option<f32>>) {
        self.nearest_m.clear();
        self.nearest_m.resize(self.edges.len(), f64::INFINITY);
        let (p, reach_m) = (from.as_dvec2(), self.r_s_m + self.r_body_m);
        map.each_wall_near(from, reach_m, |wall| self.look_at(p, wall));
        returns_m.clear();
        let within = |&m: &f64| (m <= self.r_s_m).then(|| toward_zero(m));
        returns_m.extend(self.nearest_m.iter().map(within));
    }

    fn look_at(&mut self, p: DVec2, wall: &Segment) {
        let stadium = Stadium::new(p, wall, self.r_body_m);
        let near_m = stadium.nearest.length() - self.r_body_m;
        if near_m > self.r_s_m {
            return;
        }
        if near_m <= TOUCH_M {
            self.nearest_m.fill(0.0);
            return;
        }
        let count = self.edges.len();
        let facing = libm::atan2(stadium.nearest.y, stadium.nearest.x) / TAU * count as f64;
        // −0.5 is half a sector before the x axis, in the last one. The cast saturates.
        let facing = (facing + if facing < 0.0 { count as f64 } else { 0.0 }) as usize % count;
        self.meet(facing, near_m);
        // Both ways round from there, for as long as a ray meets it: the angles at which one does are in one piece.
        for i in 0..count {
            let edge = (facing + count - i) % count;
            let Some(far_m) = stadium.along(self.edges[edge]) else { break };
            self.meet(edge, far_m);
            self.meet((edge + count - 1) % count, far_m);
        }
        for i in 1..=count {
            let edge = (facing + i) % count;
            let Some(far_m) = stadium.along(self.edges[edge]) else { break };
            self.meet(edge, far_m);
            self.meet((edge + count - 1) % count, far_m);
        }
    }

    fn meet(&mut self, sector: usize, far_m: f64) {
        self.nearest_m[sector] = self.nearest_m[sector].min(far_m);
    }
}

/// The largest `f32` that is not more; for what is not negative.
fn toward_zero(value: f64) -> f32 {
    let rounded = value as f32;
    if f64::from(rounded) > value { rounded.next_down() } else { rounded }
}

/// A wall grown by a radius, seen from a place outside of it.
struct Stadium {
    a: DVec2,
    along: DVec2,
    length_m: f64,
    /// The wall's own nearest point.
    nearest: DVec2,
    r_m: f64,
}

impl Stadium {
    fn new(p: DVec2, wall: &Segment, r_m: f64) -> Self {
        let (a, b) = (wall.a.as_dvec2() - p, wall.b.as_dvec2() - p);
        let length_m = a.distance(b);
        // A wall of no length is a disc.
        let along = if length_m > 0.0 { (b - a) / length_m } else { DVec2::ZERO };
        let nearest = a + along * bounded(-a.dot(along), 0.0, length_m);
        Self { a, along, length_m, nearest, r_m }
    }

    /// Distance along a ray of unit direction to the first point (m).
    fn along(&self, ray: DVec2) -> Option<f64> {
        let disc = |centre: DVec2| {
            let forward_m = centre.dot(ray);
            let half2 = self.r_m * self.r_m - (centre.length_squared() - forward_m * forward_m);
            (half2 >= 0.0 && forward_m >= 0.0).then(|| (forward_m - half2.sqrt()).max(0.0))
        };
        let side = |offset_m: f64| {
            let from = self.a + self.along.perp() * offset_m;
            let slope = ray.perp_dot(self.along);
            let (far_m, share_m) = (from.perp_dot(self.along) / slope, from.perp_dot(ray) / slope);
            (slope != 0.0 && far_m >= 0.0 && (0.0..=self.length_m).contains(&share_m)).then_some(far_m)
        };
        let hits = [disc(self.a), disc(self.a + self.along * self.length_m), side(self.r_m), side(-self.r_m)];
        hits.into_iter().flatten().reduce(f64::min)
    }
}

#[cfg(test)]
mod tests;
