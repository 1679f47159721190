//! Segments and the exact predicates every map query rests on.

use glam::{DVec2, Vec2};
use robust::{Coord, orient2d};
use uchain_core::bounded;

/// A straight piece of wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    /// One end (m).
    pub a: Vec2,
    /// The other end (m).
    pub b: Vec2,
}

impl Segment {
    /// Distance from `p` to the nearest point of the segment (m).
    pub fn distance_m(&self, p: Vec2) -> f32 {
        distance_squared(self.a.as_dvec2(), self.b.as_dvec2(), p.as_dvec2()).sqrt() as f32
    }

    /// The same wall in pieces of at most this length (m), end to end; itself if it is no longer.
    pub(super) fn pieces(&self, most_m: f64) -> impl Iterator<Item = [Vec2; 2]> + use<> {
        let (a, b) = self.ends();
        let count = (a.distance(b) / most_m).ceil().max(1.0);
        let at = move |piece: u32| a.lerp(b, f64::from(piece) / count).as_vec2();
        (0..count as u32).map(move |piece| [at(piece), at(piece + 1)])
    }

    pub(super) fn ends(&self) -> (DVec2, DVec2) {
        (self.a.as_dvec2(), self.b.as_dvec2())
    }
}

/// Twice the signed area of the triangle `a b c` (m²). Its sign is exact: positive when `c` is left of `a → b`.
pub(super) fn orient(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    let coord = |p: DVec2| Coord { x: p.x, y: p.y };
    orient2d(coord(a), coord(b), coord(c))
}

pub(super) fn distance_squared(a: DVec2, b: DVec2, p: DVec2) -> f64 {
    let along = b - a;
    let length_squared = along.length_squared();
    let t = if length_squared > 0.0 { bounded((p - a).dot(along) / length_squared, 0.0, 1.0) } else { 0.0 };
    (a + along * t).distance_squared(p)
}

/// Whether `p`, known to lie on the line through `a` and `b`, lies between them (ends included).
pub(super) fn between(a: DVec2, b: DVec2, p: DVec2) -> bool {
    let (low, high) = (a.min(b), a.max(b));
    low.x <= p.x && p.x <= high.x && low.y <= p.y && p.y <= high.y
}

/// Whether the closed segments `a b` and `c d` share a point. Exact.
pub(super) fn touch((a, b): (DVec2, DVec2), (c, d): (DVec2, DVec2)) -> bool {
    if a.max(b).cmplt(c.min(d)).any() || c.max(d).cmplt(a.min(b)).any() {
        return false;
    }
    let (ca, cb) = (orient(c, d, a), orient(c, d, b));
    let (ac, ad) = (orient(a, b, c), orient(a, b, d));
    if opposite(ca, cb) && opposite(ac, ad) {
        return true;
    }
    (ca == 0.0 && between(c, d, a))
        || (cb == 0.0 && between(c, d, b))
        || (ac == 0.0 && between(a, b, c))
        || (ad == 0.0 && between(a, b, d))
}

/// Whether two orientations are strictly on opposite sides.
pub(super) fn opposite(s: f64, t: f64) -> bool {
    (s > 0.0 && t < 0.0) || (s < 0.0 && t > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wall_is_cut_only_if_it_is_too_long_and_its_pieces_make_it_whole() {
        let wall = |x: f32, y: f32| Segment { a: Vec2::new(-3.7, 2.1), b: Vec2::new(x, y) };
        for (wall, count) in
            [(wall(5.0, 5.0), 1), (wall(-3.7, 2.1), 1), (wall(9e4, -8.1e4), 473), (wall(0.0, 300.0), 2)]
        {
            let pieces: Vec<[Vec2; 2]> = wall.pieces(256.0).collect();
            assert_eq!(pieces.len(), count);
            assert_eq!((pieces[0][0], pieces[count - 1][1]), (wall.a, wall.b));
            assert!(pieces.windows(2).all(|pair| pair[0][1] == pair[1][0]));
            assert!(pieces.iter().all(|[a, b]| a.distance(*b) < 256.1));
        }
    }
}
