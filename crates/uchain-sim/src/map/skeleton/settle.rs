//! From the mesh's places to a line with few, well in the middle.

use glam::DVec2;

use crate::map::Map;

/// Spacing of a line's places, as a share of the room there. Each then lies in the free circle around the one before.
const SPACING: f64 = 0.7;
/// Steps of the mesh shorter than this are not divided (m).
const SHORTEST_M: f64 = 0.01;
/// A place between two is kept where it has less room than this share of theirs.
const NARROWER: f64 = 0.97;
/// How far a place may move across the line, as a share of its room.
const ACROSS: f64 = 0.4;
/// Narrowings of the interval in the search for the middle.
const NARROWINGS: usize = 8;
/// Passes that smooth the line: each moves a place halfway to the middle of its neighbours.
const PASSES: usize = 2;
/// By how much of its room smoothing may change the room of a place: narrow places stay where they are.
const ROOM_CHANGE: f64 = 0.02;

/// The line that was given, its ends where they were, its places about 0.7 of their room apart and in the middle; or as it
/// was given, where that would leave free space.
pub(super) fn settle(map: &Map, rough: &[DVec2]) -> Vec<DVec2> {
    let line = sparse(map, rough);
    let mut settled = line.clone();
    centre(map, &mut settled);
    smooth(map, &mut settled);
    [settled, line].into_iter().find(|line| is_free(map, line)).unwrap_or_else(|| rough.to_vec())
}

fn is_free(map: &Map, line: &[DVec2]) -> bool {
    line.windows(2).all(|pair| map.sees(pair[0].as_vec2(), pair[1].as_vec2()))
}

/// Places along a line, none farther from the one before than the room there allows, and its narrow places.
fn sparse(map: &Map, rough: &[DVec2]) -> Vec<DVec2> {
    let (Some(&first), Some(&last)) = (rough.first(), rough.last()) else { return Vec::new() };
    let room_m = |at: DVec2| map.clearance_f64_m(at);
    let mut line = vec![first];
    let (mut here, mut since_m, mut before_m) = (first, 0.0, room_m(first));
    // The narrowest place since the last one that was kept, and its room.
    let mut narrowest = (first, f64::INFINITY);
    for &next in &rough[1..] {
        let next_m = room_m(next);
        loop {
            let leg_m = here.distance(next);
            if leg_m < SHORTEST_M || since_m + leg_m <= SPACING * next_m.min(before_m) {
                (here, since_m) = (next, since_m + leg_m);
                if next_m < narrowest.1 {
                    narrowest = (next, next_m);
                }
                break;
            }
            let step_m = (SPACING * before_m - since_m).min(leg_m / 2.0);
            if step_m > SHORTEST_M / 4.0 || since_m == 0.0 {
                here = here.lerp(next, step_m / leg_m);
            }
            let here_m = room_m(here);
            if narrowest.1 < NARROWER * before_m.min(here_m) {
                line.push(narrowest.0);
            }
            line.push(here);
            (since_m, before_m, narrowest) = (0.0, here_m, (here, f64::INFINITY));
        }
    }
    if narrowest.1 < NARROWER * before_m.min(room_m(last)) {
        line.push(narrowest.0);
    }
    line.push(last);
    line
}

/// Moves every inner place across the line to where the nearest wall is farthest.
fn centre(map: &Map, line: &mut [DVec2]) {
    let before = line.to_vec();
    for (place, around) in line.iter_mut().skip(1).zip(before.windows(3)) {
        let Some(across) = (around[2] - around[0]).perp().try_normalize() else { continue };
        let here_m = map.clearance_f64_m(*place);
        let room_m = |across_m: f64| map.clearance_f64_m(*place + across * across_m);
        let (mut low_m, mut high_m) = (-ACROSS * here_m, ACROSS * here_m);
        for _ in 0..NARROWINGS {
            let (left_m, right_m) = (low_m + 0.4 * (high_m - low_m), low_m + 0.6 * (high_m - low_m));
            if room_m(left_m) < room_m(right_m) {
                low_m = left_m;
            } else {
                high_m = right_m;
            }
        }
        let moved_m = f64::midpoint(low_m, high_m);
        if room_m(moved_m) > here_m {
            *place += across * moved_m;
        }
    }
}

/// Pulls every inner place toward the middle of its neighbours, as long as that leaves it its room.
fn smooth(map: &Map, line: &mut [DVec2]) {
    let rooms_m: Vec<f64> = line.iter().map(|&place| map.clearance_f64_m(place)).collect();
    for _ in 0..PASSES {
        for i in 1..line.len().saturating_sub(1) {
            let moved = 0.5 * line[i] + 0.25 * (line[i - 1] + line[i + 1]);
            if (map.clearance_f64_m(moved) - rooms_m[i]).abs() <= ROOM_CHANGE * rooms_m[i] {
                line[i] = moved;
            }
        }
    }
}
