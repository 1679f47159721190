//! Time-of-flight distances: four diagonal sensors, each the nearest return in its field of view.

use core::f32::consts::FRAC_PI_4;

use glam::Vec2;
use uchain_core::{
    bounded,
    chain::{TOF_RANGE_M, Tof},
};

use super::rays::Rays;
use crate::{seed::Stream, world::World};

uchain_core::params! {
    /// ToF sensor, VL53L1x by default (Laclau 2021, §6.2).
    #[derive(serde::Serialize, serde::Deserialize)]
    #[serde(default, deny_unknown_fields)]
    pub struct TofParams {
        /// Range (m); no return within it reads just this, and centering takes such a reading for no wall.
        /// - Source: Laclau 2021, §6.2
        pub range_m: f32 = TOF_RANGE_M, in 0.1..=100.0;
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

/// The beams of a UAV's four sensors in its own frame, worked out once.
///
/// NW looks the opposite way of SE and NE that of SW, ray by ray: two lines hold four rays.
#[derive(Debug, Clone)]
pub struct TofBeams {
    range_m: f32,
    /// Unit vectors: a ray of NW, which SE looks against, and one of NE, which SW looks against.
    lines: Vec<[Vec2; 2]>,
}

impl TofBeams {
    /// The beams of sensors with these parameters.
    pub fn new(params: &TofParams) -> Self {
        let line = |mount_rad: f32, k: u32| {
            let share = if params.rays == 1 { 0.0 } else { k as f32 / (params.rays - 1) as f32 - 0.5 };
            let (sin, cos) = libm::sincosf(mount_rad + share * params.field_of_view_rad);
            Vec2::new(cos, sin)
        };
        let lines = (0..params.rays).map(|k| [line(FRAC_PI_4, k), line(-FRAC_PI_4, k)]).collect();
        Self { range_m: params.range_m, lines }
    }

    /// How near the centre of a disc of this radius must be to be seen at all (m).
    pub fn reach_m(&self, radius_m: f32) -> f32 {
        self.range_m + radius_m
    }

    /// Exact distances to walls and to discs of one radius, from a place and a unit vector of the body's x axis.
    pub fn read(
        &self,
        rays: &impl Rays,
        from: Vec2,
        forward: Vec2,
        discs: impl Iterator<Item = Vec2>,
        radius_m: f32,
    ) -> Tof {
        let lines = self.lines.iter().map(|pair| pair.map(|line| line.rotate(forward)));
        let mut nearest_m = rays.fan(from, lines.clone(), self.range_m);
        for disc in discs {
            for pair in lines.clone() {
                for (nearest_m, line) in nearest_m.iter_mut().zip(pair) {
                    meet_disc(disc - from, radius_m, line, nearest_m);
                }
            }
        }
        let [[nw_m, se_m], [ne_m, sw_m]] = nearest_m;
        Tof { nw_m, ne_m, sw_m, se_m }
    }
}

/// Exact distances of one UAV: walls and the other UAVs in the air.
pub fn read_tof(rays: &impl Rays, world: &World, uav: usize, beams: &TofBeams) -> Tof {
    let body = &world.bodies()[uav];
    let others = world.others_near(uav, beams.reach_m(world.radius_m()));
    beams.read(rays, body.at, body.forward(), others, world.radius_m())
}

/// Takes up where a line of unit direction meets a disc `to` away, ahead or behind. From within the disc that is at 0.
fn meet_disc(to: Vec2, radius_m: f32, line: Vec2, [ahead_m, behind_m]: &mut [f32; 2]) {
    let (along_m, aside_m) = (line.dot(to), line.perp_dot(to));
    let half_chord_sq = radius_m * radius_m - aside_m * aside_m;
    if half_chord_sq >= 0.0 {
        let meets_m = (along_m.abs() - half_chord_sq.sqrt()).max(0.0);
        let nearest_m = if along_m >= 0.0 { ahead_m } else { behind_m };
        *nearest_m = nearest_m.min(meets_m);
    }
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
            let (noise, dropout) = (self.stream.draw_normal(), self.stream.uniform());
            if dropout < self.params.dropout || exact_m >= self.params.range_m {
                return self.params.range_m;
            }
            bounded(exact_m + self.params.noise_m * noise.value(), 0.0, self.params.range_m)
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
