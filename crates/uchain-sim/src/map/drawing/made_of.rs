//! Which material each wall is the face of.

use geo::{BoundingRect, Contains, Point, Polygon, Rect};

use crate::map::Map;

/// How far behind a wall its material is looked for, nearer where the rock is thinner (m).
const BEHIND_M: [f64; 2] = [2e-3, 4e-4];
/// Most looks at a box around a piece, over all walls: half a second.
const MOST_LOOKS: usize = 200_000_000;

/// For each wall the number of its material; none where nothing is drawn behind it.
pub(super) fn made_of(map: &Map, solids: &[(Polygon, Option<usize>)]) -> Vec<Option<u16>> {
    let pieces: Vec<(Rect, &Polygon, u16)> = solids
        .iter()
        .filter_map(|(polygon, material)| {
            Some((polygon.bounding_rect()?, polygon, u16::try_from((*material)?).ok()?))
        })
        .collect();
    if pieces.len().saturating_mul(map.walls.len()) > MOST_LOOKS {
        return Vec::new();
    }
    let material = |wall: &crate::map::Segment| {
        let (a, b) = wall.ends();
        let (face, across) = (a.midpoint(b), (b - a).perp().normalize_or_zero());
        BEHIND_M.into_iter().flat_map(|behind_m| [across * behind_m, -across * behind_m]).find_map(|across| {
            if !map.is_rock_behind(face, across) {
                return None;
            }
            let at = face + across;
            let at = Point::new(at.x, at.y);
            // What is drawn last lies on top.
            let mut behind = pieces.iter().rev().filter(|(around, _, _)| around.contains(&at));
            behind.find(|(_, piece, _)| piece.contains(&at)).map(|(_, _, material)| *material)
        })
    };
    map.walls.iter().map(material).collect()
}
