//! One winding way.

use core::f64::consts::FRAC_PI_3;

use glam::DVec2;
use uchain_core::bounded;

use super::{Drilled, along, heading};
use crate::{map::make::between, seed::Stream};

/// Length of a straight piece (widths).
const PIECE: f64 = 1.0;
/// Most that one piece turns against the one before (rad): a bend of four widths.
const TURN_RAD: f64 = 0.25;

/// It never turns farther than 60° from its direction at the start, so it never comes back to itself.
pub(super) fn drill(length_m: f64, width_m: f64, stream: &mut Stream) -> Drilled {
    let pieces = (length_m / (PIECE * width_m)).ceil();
    let step_m = length_m / pieces;
    let (mut at, mut angle_rad, mut wanted_rad) = (DVec2::ZERO, 0.0_f64, 0.0_f64);
    let mut points = vec![at];
    let mut until = 0;
    for piece in 0..pieces as usize {
        if piece == until {
            wanted_rad = between(stream, -FRAC_PI_3, FRAC_PI_3);
            until += between(stream, 6.0, 18.0) as usize;
        }
        angle_rad += bounded(wanted_rad - angle_rad, -TURN_RAD, TURN_RAD);
        at += step_m * heading(angle_rad);
        points.push(at);
    }
    let bores = along(&points, width_m).collect();
    Drilled { bores, base: DVec2::ZERO, goal: at, way_m: length_m }
}
