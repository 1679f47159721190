//! A small world: walls as lines, and what a scan of exact cones returns there.

use std::f64::consts::TAU;

use uchain_core::{
    bounded,
    explore::{ExploreParams, Point},
};

/// A place (m).
pub(crate) type At = [f64; 2];

/// A wall from one place to another.
pub(crate) type Wall = [At; 2];

/// Walls, and places to start from.
#[derive(Debug, Clone, Default)]
pub(crate) struct World {
    pub(crate) walls: Vec<Wall>,
    pub(crate) starts: Vec<At>,
}

pub(crate) fn exact(p: Point) -> At {
    [f64::from(p.x_m), f64::from(p.y_m)]
}

fn less(a: At, b: At) -> At {
    [a[0] - b[0], a[1] - b[1]]
}

fn dot(a: At, b: At) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn cross(a: At, b: At) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

pub(crate) fn distance_m(a: At, b: At) -> f64 {
    let d = less(a, b);
    dot(d, d).sqrt()
}

/// The point of a segment that is nearest to a place.
fn nearest_on(p: At, [a, b]: Wall) -> At {
    let along = less(b, a);
    let share = bounded(dot(less(p, a), along) / dot(along, along), 0.0, 1.0);
    [a[0] + share * along[0], a[1] + share * along[1]]
}

/// Distance between two segments (m).
fn segments_m(a: Wall, b: Wall) -> f64 {
    let side = |w: Wall, p: At| cross(less(w[1], w[0]), less(p, w[0]));
    if side(a, b[0]) * side(a, b[1]) < 0.0 && side(b, a[0]) * side(b, a[1]) < 0.0 {
        return 0.0;
    }
    let ends = [(a[0], b), (a[1], b), (b[0], a), (b[1], a)];
    ends.into_iter().map(|(p, w)| distance_m(p, nearest_on(p, w))).fold(f64::INFINITY, f64::min)
}

/// Distance along a ray of unit direction to a wall grown by r (m).
fn ray_m(p: At, unit: At, wall: Wall, r_m: f64) -> Option<f64> {
    let disc = |centre: At| {
        let to = less(centre, p);
        let along = dot(to, unit);
        let half2 = r_m * r_m - (dot(to, to) - along * along);
        (half2 >= 0.0 && along >= 0.0).then(|| (along - half2.sqrt()).max(0.0))
    };
    let along = less(wall[1], wall[0]);
    let length = dot(along, along).sqrt();
    let normal = [-along[1] / length, along[0] / length];
    let side = |sign: f64| {
        let from = [wall[0][0] + sign * r_m * normal[0], wall[0][1] + sign * r_m * normal[1]];
        let slope = cross(unit, along);
        let to = less(from, p);
        let (t, share) = (cross(to, along) / slope, cross(to, unit) / slope);
        (slope != 0.0 && t >= 0.0 && (0.0..=1.0).contains(&share)).then_some(t)
    };
    [disc(wall[0]), disc(wall[1]), side(1.0), side(-1.0)].into_iter().flatten().reduce(f64::min)
}

impl World {
    /// A rectangle of four walls.
    pub(crate) fn hall(width_m: f64, depth_m: f64) -> Self {
        let corners = [[0.0, 0.0], [width_m, 0.0], [width_m, depth_m], [0.0, depth_m]];
        let walls = (0..4).map(|i| [corners[i], corners[(i + 1) % 4]]).collect();
        Self { walls, starts: Vec::new() }
    }

    /// One more wall, with gaps of so much at so many metres along it.
    pub(crate) fn wall(mut self, from: At, to: At, doors: &[(f64, f64)]) -> Self {
        let length_m = distance_m(from, to);
        let at = |m: f64| [0, 1].map(|i| from[i] + (to[i] - from[i]) * m / length_m);
        let mut begin = 0.0;
        for &(door, width_m) in doors {
            self.walls.push([at(begin), at(door)]);
            begin = door + width_m;
        }
        self.walls.push([at(begin), at(length_m)]);
        self.walls.retain(|[a, b]| distance_m(*a, *b) > 1e-9);
        self
    }

    /// A block of four walls.
    pub(crate) fn block(self, [x, y]: At, [width_m, depth_m]: [f64; 2]) -> Self {
        let (right, top) = (x + width_m, y + depth_m);
        [[[x, y], [right, y]], [[right, y], [right, top]], [[right, top], [x, top]], [[x, top], [x, y]]]
            .into_iter()
            .fold(self, |world, [from, to]| world.wall(from, to, &[]))
    }

    /// A square pillar.
    pub(crate) fn pillar(self, corner: At, side_m: f64) -> Self {
        self.block(corner, [side_m, side_m])
    }

    pub(crate) fn starts(mut self, starts: &[At]) -> Self {
        self.starts = starts.to_vec();
        self
    }

    /// Per sector the exact distance to the nearest point of the grown walls in its cone, none beyond the range.
    ///
    /// A grown wall is convex, so its distance along a ray has one valley over the ray's angle: its least value in a
    /// cone is in the direction of its nearest point, or else at an edge of the cone.
    pub(crate) fn scan(&self, from: Point, params: &ExploreParams) -> Vec<Option<f32>> {
        let (p, r_m, range_m) = (exact(from), f64::from(params.r_body_m), f64::from(params.r_s_m));
        let width = TAU / f64::from(params.sectors);
        let in_cone = |k: u16, wall: Wall| {
            let to = less(nearest_on(p, wall), p);
            let far_m = dot(to, to).sqrt();
            if far_m <= r_m {
                return Some(0.0);
            }
            let angle = libm::atan2(to[1], to[0]).rem_euclid(TAU);
            let (begin, end) = (f64::from(k) * width, f64::from(k + 1) * width);
            if (begin..=end).contains(&angle) {
                return Some(far_m - r_m);
            }
            let edge = |angle: f64| ray_m(p, [libm::cos(angle), libm::sin(angle)], wall, r_m);
            [edge(begin), edge(end)].into_iter().flatten().reduce(f64::min)
        };
        let nearest = |k| self.walls.iter().filter_map(|&wall| in_cone(k, wall)).reduce(f64::min);
        (0..params.sectors).map(|k| nearest(k).filter(|&m| m <= range_m).map(|m| m as f32)).collect()
    }

    /// Distance of a straight flight from the nearest wall (m).
    pub(crate) fn clear_m(&self, from: At, to: At) -> f64 {
        self.walls.iter().map(|&wall| segments_m([from, to], wall)).fold(f64::INFINITY, f64::min)
    }

    /// Share of the places a robot can come to from the first start that lie within the range and in line of sight
    /// of a node.
    pub(crate) fn coverage(&self, nodes: &[Point], params: &ExploreParams) -> f64 {
        let cell_m = 0.05;
        let body_m = f64::from(params.r_body_m);
        let cell = |p: At| p.map(|v| (v / cell_m).floor() as i64);
        let centre = |c: [i64; 2]| c.map(|v| (v as f64 + 0.5) * cell_m);
        let mut free = std::collections::BTreeSet::new();
        let mut open = vec![cell(self.starts[0])];
        while let Some(at) = open.pop() {
            if self.clear_m(centre(at), centre(at)) >= body_m && free.insert(at) {
                let [x, y] = at;
                open.extend([[x + 1, y], [x - 1, y], [x, y + 1], [x, y - 1]]);
            }
        }
        let nodes: Vec<At> = nodes.iter().copied().map(exact).collect();
        let range_m = f64::from(params.r_s_m);
        let seen = |p: At| nodes.iter().any(|&n| distance_m(n, p) <= range_m && self.clear_m(n, p) > 0.0);
        free.iter().filter(|&&c| seen(centre(c))).count() as f64 / free.len() as f64
    }
}

/// The instrument itself, against rays so dense that nothing slips between them.
#[test]
fn a_scan_of_exact_cones_is_never_longer_than_dense_rays_and_hardly_shorter() {
    let world = World::hall(3.0, 2.0).wall([1.5, 0.0], [1.5, 2.0], &[(0.6, 1.0)]).pillar([0.6, 1.2], 0.3);
    let params = ExploreParams { r_s_m: 4.0, ..ExploreParams::default() };
    for place in [[0.4, 0.4], [1.2, 1.1], [1.5, 1.1], [2.4, 1.7]] {
        let from = Point { x_m: place[0] as f32, y_m: place[1] as f32 };
        for (k, seen_m) in world.scan(from, &params).into_iter().enumerate() {
            let ray = |i: usize| {
                let angle = (k as f64 + i as f64 / 2000.0) * TAU / 18.0;
                let unit = [libm::cos(angle), libm::sin(angle)];
                let each = world.walls.iter().filter_map(|&wall| ray_m(exact(from), unit, wall, 0.1));
                each.fold(f64::INFINITY, f64::min)
            };
            let rays_m = (0..=2000).map(ray).fold(f64::INFINITY, f64::min);
            let seen_m = f64::from(seen_m.expect("walls all around"));
            assert!(
                seen_m <= rays_m + 1e-6 && seen_m > rays_m - 1e-3,
                "{place:?}, sector {k}: {seen_m} {rays_m}"
            );
        }
    }
}
