//! From a way over cells to a smooth line in the middle.

use glam::DVec2;
use uchain_core::bounded;

use super::path::OPEN_M;
use crate::map::Map;

/// Rounds of moving to the middle and smoothing.
const ROUNDS: usize = 4;
/// Smoothing passes of a round: each moves a point halfway to the middle of its neighbours.
const PASSES: usize = 4;
/// Share of a point's room that smoothing leaves it.
const ROOM_KEPT: f64 = 0.8;
/// Narrowings of the interval in the search for the middle.
const NARROWINGS: usize = 8;

/// A smooth line in the middle, near a way over cells; that way itself where smoothing would leave free space.
pub(super) fn settle(map: &Map, rough: &[DVec2], cell_m: f64) -> Vec<DVec2> {
    let mut line = evenly(rough, 2.0 * cell_m);
    for _ in 0..ROUNDS {
        centre(map, &mut line);
        smooth(map, &mut line);
        line = evenly(&line, 2.0 * cell_m);
    }
    let free = line.iter().zip(line.iter().skip(1)).all(|(a, b)| map.sees(a.as_vec2(), b.as_vec2()));
    if free { line } else { rough.to_vec() }
}

/// Points about `spacing_m` apart along a line, ends included.
fn evenly(line: &[DVec2], spacing_m: f64) -> Vec<DVec2> {
    let legs = || line.iter().zip(line.iter().skip(1));
    let total_m: f64 = legs().map(|(a, b)| a.distance(*b)).sum();
    let count = (total_m / spacing_m).ceil().max(1.0);
    let step_m = total_m / count;
    let mut points = Vec::with_capacity(count as usize + 1);
    points.extend(line.first());
    let (mut before_m, mut next) = (0.0, 1.0);
    for (a, b) in legs() {
        let leg_m = a.distance(*b);
        while next < count && next * step_m <= before_m + leg_m {
            points.push(a.lerp(*b, bounded((next * step_m - before_m) / leg_m, 0.0, 1.0)));
            next += 1.0;
        }
        before_m += leg_m;
    }
    points.extend(line.last());
    points
}

fn room_m(map: &Map, p: DVec2) -> f64 {
    if map.in_rock_f64(p) { -1.0 } else { f64::from(map.clearance_m(p.as_vec2())).min(OPEN_M) }
}

/// Moves every inner point across the line to where the nearest wall is farthest. It never moves farther than that
/// wall is, so it stays in free space.
fn centre(map: &Map, line: &mut [DVec2]) {
    let before = line.to_vec();
    for (i, point) in line.iter_mut().enumerate().skip(1) {
        let (Some(&last), Some(&next)) = (before.get(i - 1), before.get(i + 1)) else { continue };
        let Some(across) = (next - last).perp().try_normalize() else { continue };
        let here_m = room_m(map, *point);
        let (mut low_m, mut high_m) = (-here_m, here_m);
        for _ in 0..NARROWINGS {
            let (left_m, right_m) = (low_m + 0.4 * (high_m - low_m), low_m + 0.6 * (high_m - low_m));
            let (left, right) =
                (room_m(map, *point + across * left_m), room_m(map, *point + across * right_m));
            // Open on both sides: nothing pushes.
            if left == right {
                (low_m, high_m) = (left_m, right_m);
            } else if left < right {
                low_m = left_m;
            } else {
                high_m = right_m;
            }
        }
        let moved = *point + across * f64::midpoint(low_m, high_m);
        if room_m(map, moved) > here_m {
            *point = moved;
        }
    }
}

/// Pulls every inner point toward the middle of its neighbours, as long as that leaves it most of its room.
fn smooth(map: &Map, line: &mut [DVec2]) {
    let least_m: Vec<f64> = line.iter().map(|&p| ROOM_KEPT * room_m(map, p)).collect();
    for _ in 0..PASSES {
        for i in 1..line.len().saturating_sub(1) {
            let moved = 0.5 * line[i] + 0.25 * (line[i - 1] + line[i + 1]);
            if room_m(map, moved) >= least_m[i] {
                line[i] = moved;
            }
        }
    }
}
