//! From areas to wall loops that neither touch nor have edges of no length.

use std::collections::BTreeMap;

use geo::{
    Area, Buffer, LineString, MultiPolygon, Orient, Polygon,
    algorithm::buffer::{BufferStyle, LineJoin},
    orient::Direction,
};
use glam::{DVec2, Vec2};

use crate::map::{Import, MapError, RemarkKind};

/// By how much areas shrink that touch (m).
const SHRINK_M: f64 = 4e-4;
/// How far corners that lie in one place are drawn apart, each into the free space at its own (m).
const APART_M: f64 = 4e-4;
/// Areas smaller than this are none (m²), nor are those narrower than this on the whole (m).
const SLIVER_M2: f64 = 1e-4;
const SLIVER_M: f64 = 1e-3;

/// A little less of every area.
pub(super) fn shrunk(free: &MultiPolygon) -> MultiPolygon {
    free.buffer_with_style(BufferStyle::new(-SHRINK_M).line_join(LineJoin::Miter(0.5)))
}

/// The loops around all areas, and around what stands in them.
pub(super) fn loops(
    free: &MultiPolygon,
    snap_m: f64,
    import: &mut Import,
) -> Result<Vec<Vec<Vec2>>, MapError> {
    let mut slivers = 0;
    let mut snapped = 0;
    let mut loops: Vec<Vec<DVec2>> = Vec::new();
    for area in &free.orient(Direction::Default) {
        if is_sliver(area) {
            slivers += 1;
            continue;
        }
        let outline = corners(area.exterior(), snap_m, &mut snapped);
        if outline.len() < 3 {
            slivers += 1;
            continue;
        }
        loops.push(outline);
        for hole in area.interiors() {
            let hole = corners(hole, snap_m, &mut snapped);
            if hole.len() >= 3 {
                loops.push(hole);
            } else {
                slivers += 1;
            }
        }
    }
    import.say(RemarkKind::Dropped, slivers, "areas: slivers, narrower than 1 mm or smaller than 1 cm²");
    import.say(RemarkKind::Merged, snapped, format!("corners: nearer to the one before than {snap_m} m"));
    if loops.is_empty() {
        let what = "free areas larger than a sliver";
        return Err(MapError::Count { what, got: 0, least: 1, most: super::MOST_CORNERS });
    }
    let moved = draw_apart(&mut loops);
    import.say(
        RemarkKind::Separated,
        moved,
        "corners where walls touch: drawn apart by less than a millimetre",
    );
    let rounded = |corners: Vec<DVec2>| corners.iter().map(|at| at.as_vec2()).collect();
    Ok(loops.into_iter().map(rounded).collect())
}

fn is_sliver(area: &Polygon) -> bool {
    let length_m: f64 = area.exterior().lines().map(|line| DVec2::new(line.dx(), line.dy()).length()).sum();
    let area_m2 = area.unsigned_area();
    area_m2 < SLIVER_M2 || area_m2 < SLIVER_M * length_m / 2.0
}

/// The corners of a loop, each once, none nearer to the one before than `snap_m`.
fn corners(line: &LineString, snap_m: f64, snapped: &mut usize) -> Vec<DVec2> {
    let all: Vec<DVec2> = line.coords().map(|at| DVec2::new(at.x, at.y)).collect();
    let open = all
        .split_last()
        .map_or(&all[..], |(last, rest)| if rest.first() == Some(last) { rest } else { &all });
    let mut kept: Vec<DVec2> = Vec::with_capacity(open.len());
    for &at in open {
        let far_enough = kept.last().is_none_or(|last| last.distance(at) > snap_m);
        if far_enough {
            kept.push(at);
        } else {
            *snapped += 1;
        }
    }
    while kept.len() > 3
        && kept.first().zip(kept.last()).is_some_and(|(first, last)| first.distance(*last) <= snap_m)
    {
        kept.pop();
        *snapped += 1;
    }
    kept
}

/// Draws corners that lie in one place apart; says how many there were. Free space is on the left of every loop.
fn draw_apart(loops: &mut [Vec<DVec2>]) -> usize {
    // The places as they will be rounded; both zeros are one place.
    let bits = |value: f64| u64::from((value as f32 + 0.0).to_bits());
    let place = |at: DVec2| bits(at.x) | bits(at.y) << 32;
    let mut times: BTreeMap<u64, usize> = BTreeMap::new();
    for &at in loops.iter().flatten() {
        *times.entry(place(at)).or_default() += 1;
    }
    let mut moved = 0;
    for corners in loops {
        let before: Vec<DVec2> = corners.clone();
        for (i, at) in corners.iter_mut().enumerate() {
            if times.get(&place(*at)).is_none_or(|&times| times < 2) {
                continue;
            }
            let (last, next) =
                (before[(i + before.len() - 1) % before.len()], before[(i + 1) % before.len()]);
            let (arriving, leaving) = ((*at - last).normalize_or_zero(), (next - *at).normalize_or_zero());
            let inward = (arriving.perp() + leaving.perp()).normalize_or_zero();
            // A corner of free space draws back into it, the tip of a rock draws back from it.
            let back = if arriving.perp_dot(leaving) < 0.0 { -inward } else { inward };
            *at += back * APART_M;
            moved += 1;
        }
    }
    moved
}
