//! Maps drawn by hand: wall loops in metres.

use glam::{DVec2, Vec2};

use super::{FARTHEST_M, Map, MapError};

/// A map from closed wall loops, in the drawing's own frame (m). The map frame's origin is the middle of the drawing;
/// [`Map::to_local`] converts.
///
/// ```
/// use uchain_sim::map::drawn;
/// let room = vec![[10.0, 0.0], [14.0, 0.0], [14.0, 4.0], [10.0, 4.0]];
/// let pillar = vec![[11.0, 1.0], [11.0, 2.0], [12.0, 2.0], [12.0, 1.0]];
/// let map = drawn(&[room, pillar]).unwrap();
/// assert!(map.in_rock(map.to_local([11.5, 1.5])) && !map.in_rock(map.to_local([13.0, 3.0])));
/// ```
///
/// # Errors
/// Those of [`Map::from_loops`]; walls that cross or touch other than end to end along their loop.
pub fn drawn(loops: &[Vec<[f64; 2]>]) -> Result<Map, MapError> {
    let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    for (index, &[x, y]) in loops.iter().flatten().enumerate() {
        // Also for a drawing far from its own origin, where only its size counts.
        if !(x.is_finite() && y.is_finite()) {
            return Err(MapError::Coordinate { index, x, y, most: f64::from(FARTHEST_M) });
        }
        (low, high) = (low.min(DVec2::new(x, y)), high.max(DVec2::new(x, y)));
    }
    let middle = if low.is_finite() { (low + high) / 2.0 } else { DVec2::ZERO };
    let place = |&[x, y]: &[f64; 2]| (DVec2::new(x, y) - middle).as_vec2();
    let placed: Vec<Vec<Vec2>> = loops.iter().map(|corners| corners.iter().map(place).collect()).collect();
    let map = Map::from_loops(placed)?.with_offset_m(middle.into());
    match map.first_crossing() {
        None => Ok(map),
        Some(at) => {
            let at = at.as_dvec2() + middle;
            Err(MapError::WallsCross { x: at.x, y: at.y })
        }
    }
}
