//! Time-of-flight distances: four diagonal sensors, each the nearest return in its field of view.

use core::f32::consts::FRAC_PI_4;

use glam::Vec2;
use parry2d::{
    query::{Ray, RayCast},
    shape::Polyline,
};
use uchain_core::chain::Tof;

use crate::{map::Map, seed::Stream, world::World};

uchain_core::params! {
    /// ToF sensor, VL53L1x by default (Laclau 2021, §6.2).
    #[derive(serde::Serialize, serde::Deserialize)]
    #[serde(default, deny_unknown_fields)]
    pub struct TofParams {
        /// Range (m); no return within it reads just this. Must equal `center.tof_range_m`.
        /// - Source: Laclau 2021, §6.2
        pub range_m: f32 = 2.0, in 0.1..=100.0;
        /// Field of view (rad); the default is 27°.
        /// - Source: data sheet of the VL53L1x
        pub field_of_view_rad: f32 = 0.471_238_9, in 0.0..=3.0;
        /// Rays over the field of view; a reading is the shortest of them.
        /// - Source: ours
        pub rays: u32 = 5, in 1..=64;
        /// Time between two readings (s); a multiple of the tick, 0.05 s.
        /// - Source: the authors' simulator (10 Hz)
        pub period_s: f32 = 0.1, in 0.05..=10.0;
        /// Standard deviation of a reading (m).
        /// - Source: ours
        pub noise_m: f32 = 0.01, in 0.0..=1.0;
        /// Share of readings that drop out and read `range_m` (1).
        /// - Source: ours
        pub dropout: f32 = 0.01, in 0.0..=1.0;
    }
}

/// Distances along rays to walls.
pub trait Rays {
    /// Distance to the first wall (m), at most `range_m`.
    fn cast(&self, from: Vec2, direction: Vec2, range_m: f32) -> f32;
}

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

/// Exact distances of one UAV: walls and the other UAVs in the air.
pub fn read_tof(rays: &impl Rays, world: &World<'_>, uav: usize, params: &TofParams) -> Tof {
    let bodies = world.bodies();
    let body = &bodies[uav];
    let reach_m = params.range_m + world.radius_m();
    let in_the_way = |(i, other): (usize, &crate::world::Body)| {
        let near = other.at.distance_squared(body.at) < reach_m * reach_m;
        (i != uav && other.airborne && near).then_some(other.at)
    };
    // Mostly none: an empty list costs no allocation.
    let others: Vec<Vec2> = bodies.iter().enumerate().filter_map(in_the_way).collect();
    let forward = body.forward();
    let sensor = |mount_rad: f32| {
        let mut nearest_m = params.range_m;
        for k in 0..params.rays {
            let share = if params.rays == 1 { 0.0 } else { k as f32 / (params.rays - 1) as f32 - 0.5 };
            let (sin, cos) = libm::sincosf(mount_rad + share * params.field_of_view_rad);
            let direction = forward * cos + forward.perp() * sin;
            nearest_m = nearest_m.min(rays.cast(body.at, direction, nearest_m));
            for &other in &others {
                nearest_m = nearest_m.min(disc_hit(body.at, direction, other, world.radius_m()));
            }
        }
        nearest_m
    };
    Tof {
        nw_m: sensor(FRAC_PI_4),
        ne_m: sensor(-FRAC_PI_4),
        sw_m: sensor(3.0 * FRAC_PI_4),
        se_m: sensor(-3.0 * FRAC_PI_4),
    }
}

/// Distance along a ray of unit direction to a disc; infinity without a hit.
fn disc_hit(from: Vec2, direction: Vec2, centre: Vec2, radius_m: f32) -> f32 {
    let to = centre - from;
    let along = to.dot(direction);
    let aside_sq = to.length_squared() - along * along;
    let half_chord_sq = radius_m * radius_m - aside_sq;
    if half_chord_sq < 0.0 || along < 0.0 {
        return f32::INFINITY;
    }
    (along - half_chord_sq.sqrt()).max(0.0)
}

/// Measured instead of exact distances.
#[derive(Debug, Clone)]
pub struct TofNoise {
    stream: Stream,
    params: TofParams,
}

impl TofNoise {
    /// The sensors of one robot.
    pub fn new(stream: Stream, params: TofParams) -> Self {
        Self { stream, params }
    }

    /// Noise and drop-outs on exact distances. A sensor that sees nothing has no noise.
    pub fn apply(&mut self, exact: Tof) -> Tof {
        let mut measure = |exact_m: f32| {
            // Drawn in any case, so that what is seen moves nobody's draws.
            let (noise, dropout) = (self.stream.normal(), self.stream.uniform());
            if dropout < self.params.dropout || exact_m >= self.params.range_m {
                return self.params.range_m;
            }
            (exact_m + self.params.noise_m * noise).clamp(0.0, self.params.range_m)
        };
        Tof {
            nw_m: measure(exact.nw_m),
            ne_m: measure(exact.ne_m),
            sw_m: measure(exact.sw_m),
            se_m: measure(exact.se_m),
        }
    }
}

#[cfg(test)]
mod tests;
