//! Passages rounded out of rock: everything nearer to a line than half a width, which varies along the way.

mod branching;
mod cave;
mod isoline;
mod noise;
mod tunnel;

use std::collections::BTreeMap;

use glam::DVec2;
use uchain_core::bounded;

use super::{Kind, Made, MakeError};
use crate::{
    map::{Map, MapError, raster},
    seed::Stream,
};
use isoline::isolines;
use noise::Noise;

/// Cells across the narrowest passage.
const CELLS_ACROSS: f64 = 6.0;
/// How far a wall may lie from where it was computed, in widths, so that there are fewer of them.
const SIMPLER: f64 = 0.01;

/// A passage along a straight line, its half width changing evenly from end to end.
#[derive(Debug, Clone, Copy)]
struct Bore {
    ends: [DVec2; 2],
    half_m: [f64; 2],
}

/// What is drilled, and the way through it.
struct Drilled {
    bores: Vec<Bore>,
    base: DVec2,
    goal: DVec2,
    way_m: f64,
}

/// A tunnel or a branching mine of this length.
pub(super) fn ways(
    kind: Kind,
    length_m: f64,
    width_m: f64,
    roughness: f64,
    stream: &mut Stream,
) -> Result<Made, MakeError> {
    let noise = Noise::new(stream);
    let drilled = match kind {
        Kind::Branching => branching::drill(length_m, width_m, stream),
        _ => tunnel::drill(length_m, width_m, stream),
    };
    Ok(walled(&drilled, width_m, roughness, &noise)?)
}

/// A cave in a box of this size.
pub(super) fn cave(
    size_m: [f64; 2],
    width_m: f64,
    roughness: f64,
    stream: &mut Stream,
) -> Result<Made, MakeError> {
    let noise = Noise::new(stream);
    Ok(walled(&cave::drill(size_m, width_m, stream), width_m, roughness, &noise)?)
}

/// The walls around all bores.
fn walled(drilled: &Drilled, width_m: f64, roughness: f64, noise: &Noise) -> Result<Made, MapError> {
    let cell_m = width_m * (1.0 - roughness) / CELLS_ACROSS;
    let loops = isolines(&depths(&drilled.bores, cell_m, width_m, roughness, noise));
    let refused = |why: String| MapError::Read { file: "the map to be made".into(), why };
    let map: Map =
        raster::loops_to_map(&loops, cell_m, SIMPLER * width_m, |corner| corner * cell_m, refused)?;
    let length_m = drilled.bores.iter().map(|bore| bore.ends[0].distance(bore.ends[1])).sum();
    let (base_m, goal_m) = (drilled.base.into(), drilled.goal.into());
    Ok(Made { map, base_m, goal_m, way_m: drilled.way_m, length_m, width_m, roughness })
}

/// For the lattice points around all bores, how far they lie in rock (cells); less than 0 in free space. Points that are
/// not listed lie in rock.
fn depths(
    bores: &[Bore],
    cell_m: f64,
    width_m: f64,
    roughness: f64,
    noise: &Noise,
) -> BTreeMap<(i32, i32), f64> {
    let mut depths = BTreeMap::new();
    for bore in bores {
        let [a, b] = bore.ends;
        let reach = bore.half_m[0].max(bore.half_m[1]) * (1.0 + roughness) + 2.0 * cell_m;
        let low = ((a.min(b) - reach) / cell_m).floor().as_ivec2();
        let high = ((a.max(b) + reach) / cell_m).ceil().as_ivec2();
        let along = (b - a) / (b - a).length_squared().max(1e-12);
        for row in low.y..=high.y {
            for col in low.x..=high.x {
                let p = DVec2::new(f64::from(col), f64::from(row)) * cell_m;
                let share = bounded((p - a).dot(along), 0.0, 1.0);
                let off_m = p.distance(a.lerp(b, share));
                if off_m > reach {
                    continue;
                }
                let half_m = bore.half_m[0] + share * (bore.half_m[1] - bore.half_m[0]);
                let half_m = half_m * (1.0 + roughness * noise.at(p / width_m));
                let depth = (off_m - half_m) / cell_m;
                let known: &mut f64 = depths.entry((row, col)).or_insert(f64::INFINITY);
                *known = known.min(depth);
            }
        }
    }
    depths
}

/// A unit vector; std's sine is another one on every system.
fn heading(angle_rad: f64) -> DVec2 {
    DVec2::new(libm::cos(angle_rad), libm::sin(angle_rad))
}

/// Passages of one width through points.
fn along(points: &[DVec2], width_m: f64) -> impl Iterator<Item = Bore> {
    let bore = move |pair: &[DVec2]| Bore { ends: [pair[0], pair[1]], half_m: [0.5 * width_m; 2] };
    points.windows(2).map(bore)
}
