//! A corridor of one width along a centre line.

use std::path::Path;

use glam::{DVec2, Vec2};
use serde::{Deserialize, Serialize};
use uchain_core::bounded;

use super::{COORDINATE_MAX_M, Fault, Format, MapFormat, is_no_file};
use crate::map::{
    CentreLine, FARTHEST_M, MOST_WALLS, Map, MapError,
    tunnel::centre_line::{Shape, unit},
};

pub(super) const FORMAT: Format = Format {
    table: "map.corridor",
    name: "corridor of one width",
    keys: CorridorConfig::KEYS,
    ends: &[],
    sniff: is_no_file,
};

uchain_core::params! {
    /// A corridor of one width along a centre line.
    #[derive(Serialize, Deserialize)]
    #[serde(deny_unknown_fields)]
    pub struct CorridorConfig {
        /// Corners of the centre line: `[x, y]` (m), or `[x, y, r]` with a bend of radius r there (m).
        #[schemars(schema_with = "super::shape::corners")]
        pub centre_line_m: Vec<Vec<f64>>;
        /// Free width, wall to wall (m).
        pub width_m: f64, in 0.1..=100.0;
        /// Whether the last corner joins the first again.
        #[serde(default)]
        pub closed: bool;
    }
}

impl MapFormat for CorridorConfig {
    fn legal(&self) -> Result<(), Fault> {
        self.check()?;
        for (i, corner) in self.centre_line_m.iter().enumerate() {
            let key = format!("centre_line_m.{i}");
            if !(2..=3).contains(&corner.len()) {
                let got = format!("{} numbers", corner.len());
                return Err(Fault { key, got, expected: "must be [x, y] or [x, y, r]".to_owned() });
            }
            for (j, &value_m) in corner.iter().enumerate() {
                let low_m = if j == 2 { 0.0 } else { -COORDINATE_MAX_M };
                Fault::range(&format!("{key}.{j}"), value_m, low_m, COORDINATE_MAX_M)?;
            }
        }
        Ok(())
    }

    /// Around the place, which is the base: there `f32` is finest, wherever the scenario's own frame has its origin.
    fn lay(&self, _: &Path, [x_m, y_m]: [f64; 2]) -> Result<(Map, Option<CentreLine>), MapError> {
        let around = |x_m: f64, y_m: f64| {
            let corner = |numbers: &Vec<f64>| Vertex {
                x: numbers.first().copied().unwrap_or_default() - x_m,
                y: numbers.get(1).copied().unwrap_or_default() - y_m,
                bend_radius_m: numbers.get(2).copied().unwrap_or_default(),
            };
            let corners: Vec<Vertex> = self.centre_line_m.iter().map(corner).collect();
            corridor(&corners, self.width_m, self.closed)
        };
        match around(x_m, y_m) {
            Ok((map, line)) => Ok((map.with_offset_m([x_m, y_m]), Some(line))),
            // What is wrong is said in the scenario's own coordinates.
            Err(cause) => Err(around(0.0, 0.0).err().unwrap_or(cause)),
        }
    }
}

/// Most corners of a centre line.
const MOST_CORNERS: usize = 10_000;
/// How far a wall's chords may lie from the true arc (m); the promise is 1 mm, rounding to f32 takes some.
const SAGITTA_M: f64 = 0.9e-3;
/// An inner arc smaller than this is a point (m).
const POINT_M: f64 = 1e-4;
/// A turn this small is none (rad).
const STRAIGHT_RAD: f64 = 1e-9;

/// A corner of a centre line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vertex {
    /// x (m).
    pub x: f64,
    /// y (m).
    pub y: f64,
    /// Radius of the bend that rounds the corner off (m); 0 is a sharp corner with mitred walls. The two ends of
    /// an open line have no bend: theirs is not used.
    pub bend_radius_m: f64,
}

/// A corridor of free width `width_m` (0.1 to 100 m) along a centre line, and that line.
///
/// An open corridor ends in straight caps; a closed one is a ring with an outer and an inner wall. Curved walls
/// keep within 1 mm of the true arc.
///
/// # Errors
/// A width out of range; a coordinate or radius that is not a number; fewer than 2 corners (3 if closed) or more
/// than 10,000; a leg too short for the bends or mitres at its ends; a bend tighter than half the width; walls
/// that cross or touch because the corridor runs into itself; too many walls.
pub fn corridor(centre_line: &[Vertex], width_m: f64, closed: bool) -> Result<(Map, CentreLine), MapError> {
    if !(0.1..=100.0).contains(&width_m) {
        return Err(MapError::Range { what: "width_m", got: width_m, low: 0.1, high: 100.0 });
    }
    let (got, least) = (centre_line.len(), if closed { 3 } else { 2 });
    if !(least..=MOST_CORNERS).contains(&got) {
        return Err(MapError::Count { what: "corners of the centre line", got, least, most: MOST_CORNERS });
    }
    for (index, &Vertex { x, y, bend_radius_m }) in centre_line.iter().enumerate() {
        let most = f64::from(FARTHEST_M);
        if !(x.abs() <= most && y.abs() <= most) {
            return Err(MapError::Coordinate { index, x, y, most });
        }
        if !(0.0..=most).contains(&bend_radius_m) {
            return Err(MapError::Range { what: "bend_radius_m", got: bend_radius_m, low: 0.0, high: most });
        }
    }
    let corners = corners_of(centre_line, width_m, closed)?;
    let mut builder =
        Builder { half_m: width_m / 2.0, left: Vec::new(), right: Vec::new(), line: CentreLine::new(closed) };
    builder.build(&corners)?;
    let Builder { mut left, mut right, line, .. } = builder;
    let loops = if closed {
        vec![left, right]
    } else {
        right.reverse();
        left.append(&mut right);
        vec![left]
    };
    let map = Map::from_loops(loops)?;
    match map.first_crossing() {
        Some(at) => Err(MapError::WallsCross { x: f64::from(at.x), y: f64::from(at.y) }),
        None => Ok((map, line)),
    }
}

/// A corner with the legs that meet there. At an end of an open line both are the one leg.
struct Corner {
    at: DVec2,
    radius_m: f64,
    /// Unit vectors along the leg that arrives and the leg that leaves.
    arrive: DVec2,
    leave: DVec2,
    /// Length of the leg that leaves (m); 0 at the end.
    leg_m: f64,
    /// How much of each leg the corner takes up (m).
    setback_m: f64,
    /// Angle from `arrive` to `leave`, positive to the left (rad).
    turn_rad: f64,
}

fn corners_of(centre_line: &[Vertex], width_m: f64, closed: bool) -> Result<Vec<Corner>, MapError> {
    let count = centre_line.len();
    let at = |index: usize| centre_line.get(index % count).map_or(DVec2::NAN, |v| DVec2::new(v.x, v.y));
    let legs = if closed { count } else { count - 1 };
    let mut directions = Vec::with_capacity(legs);
    for leg in 0..legs {
        let along = at(leg + 1) - at(leg);
        let Some(direction) = along.try_normalize() else {
            return Err(MapError::LegTooShort { leg, length_m: 0.0, needed_m: 0.0 });
        };
        directions.push(direction);
    }
    let mut corners = Vec::with_capacity(count);
    for (index, vertex) in centre_line.iter().enumerate() {
        let arrive = directions[(index + legs - 1) % legs];
        let leave = directions[index % legs];
        let (arrive, leave) = match index {
            0 if !closed => (leave, leave),
            _ if !closed && index + 1 == count => (arrive, arrive),
            _ => (arrive, leave),
        };
        let (sine, cosine) = (arrive.perp_dot(leave), arrive.dot(leave));
        let turn_rad = libm::atan2(sine, cosine);
        let bends = turn_rad.abs() > STRAIGHT_RAD;
        let radius_m = if bends { vertex.bend_radius_m } else { 0.0 };
        let least_m = width_m / 2.0;
        if radius_m > 0.0 && radius_m < least_m {
            return Err(MapError::BendTooTight { corner: index, bend_radius_m: radius_m, least_m });
        }
        let setback_m = if bends { radius_m.max(least_m) * tan_of_half(sine, cosine) } else { 0.0 };
        let leg_m = if index < legs { at(index).distance(at(index + 1)) } else { 0.0 };
        corners.push(Corner { at: at(index), radius_m, arrive, leave, leg_m, setback_m, turn_rad });
    }
    for leg in 0..legs {
        let length_m = corners[leg].leg_m;
        let next = (leg + 1) % count;
        let turns_back = |&corner: &usize| !corners[corner].setback_m.is_finite();
        if let Some(corner) = [leg, next].into_iter().find(turns_back) {
            let DVec2 { x, y } = at(corner);
            return Err(MapError::TurnsBack { corner, x, y });
        }
        let needed_m = corners[leg].setback_m + corners[next].setback_m;
        if needed_m > length_m * (1.0 + 1e-9) {
            return Err(MapError::LegTooShort { leg, length_m, needed_m });
        }
    }
    Ok(corners)
}

/// Tangent of half a turn, from its sine and cosine; infinite for a turn right back.
fn tan_of_half(sine: f64, cosine: f64) -> f64 {
    if cosine > -1.0 { sine.abs() / (1.0 + cosine) } else { f64::INFINITY }
}

struct Builder {
    half_m: f64,
    left: Vec<Vec2>,
    right: Vec<Vec2>,
    line: CentreLine,
}

impl Builder {
    fn build(&mut self, corners: &[Corner]) -> Result<(), MapError> {
        for (corner, next) in corners.iter().zip(corners.iter().skip(1).chain(corners)) {
            if corner.radius_m > 0.0 {
                self.bend(corner);
            } else {
                self.mitre(corner);
            }
            let got = self.left.len() + self.right.len();
            if got > MOST_WALLS {
                return Err(MapError::Count {
                    what: "walls of the corridor",
                    got,
                    least: 3,
                    most: MOST_WALLS,
                });
            }
            if corner.leg_m > 0.0 {
                let trim = |corner: &Corner| if corner.radius_m > 0.0 { corner.setback_m } else { 0.0 };
                let from = corner.at + corner.leave * trim(corner);
                let length_m = corner.leg_m - trim(corner) - trim(next);
                self.line.push(Shape::Straight { from, direction: corner.leave }, length_m);
            }
        }
        Ok(())
    }

    fn mitre(&mut self, corner: &Corner) {
        let normals = corner.arrive.perp() + corner.leave.perp();
        let out = normals * (self.half_m / (1.0 + corner.arrive.dot(corner.leave)));
        self.left.push((corner.at + out).as_vec2());
        self.right.push((corner.at - out).as_vec2());
    }

    fn bend(&mut self, corner: &Corner) {
        let side = libm::copysign(1.0, corner.turn_rad);
        let start = corner.at - corner.arrive * corner.setback_m;
        let centre = start + corner.arrive.perp() * (side * corner.radius_m);
        let outward = -corner.arrive.perp() * side;
        let start_rad = libm::atan2(outward.y, outward.x);
        let outer_m = corner.radius_m + self.half_m;
        let chord_rad = 2.0 * libm::acos(1.0 - (SAGITTA_M / outer_m).min(1.0));
        // Flat arcs of the largest radius have chords of 1e-4 rad; the limit is never met by a real bend.
        let chords = bounded((corner.turn_rad.abs() / chord_rad).ceil() as usize, 1, 65_536);
        let inner_m = corner.radius_m - self.half_m;
        let inner_m = if inner_m < POINT_M { 0.0 } else { inner_m };
        let (left_m, right_m) = if side > 0.0 { (inner_m, outer_m) } else { (outer_m, inner_m) };
        for chord in 0..=chords {
            let ray = unit(start_rad + corner.turn_rad * chord as f64 / chords as f64);
            self.left.push((centre + ray * left_m).as_vec2());
            self.right.push((centre + ray * right_m).as_vec2());
        }
        let arc = Shape::Arc { centre, radius_m: corner.radius_m, start_rad, turn_rad: corner.turn_rad };
        self.line.push(arc, corner.radius_m * corner.turn_rad.abs());
    }
}
