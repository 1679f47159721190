//! The parts of one filled path as areas with holes: which ring is the outline of an area, and which a hole in it.

use glam::DVec2;

use crate::map::drawing::Shape;

/// Most edges that are looked at to tell which ring is within which (1): a fifth of a second.
const MOST_LOOKS: usize = 50_000_000;

/// Which places are within a path of several rings.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum FillRule {
    /// Those which its line goes around at all, counted by its direction.
    #[default]
    NonZero,
    /// Those that an odd number of rings surround.
    EvenOdd,
}

struct Ring {
    points: Vec<DVec2>,
    low: DVec2,
    high: DVec2,
    /// Twice the area, positive where it runs counter-clockwise (m²).
    area: f64,
}

/// The areas of a path; `None` if it has too many rings within each other to tell.
pub(crate) fn areas(rings: Vec<Vec<DVec2>>, rule: FillRule) -> Option<Vec<Shape>> {
    let rings: Vec<Ring> = rings.into_iter().map(Ring::new).filter(|ring| ring.area != 0.0).collect();
    let mut looks = 0;
    let mut outlines: Vec<(usize, Shape)> = Vec::new();
    let mut holes: Vec<(usize, Vec<usize>)> = Vec::new();
    for (index, ring) in rings.iter().enumerate() {
        let mut around: Vec<usize> = Vec::new();
        for (other, outer) in rings.iter().enumerate() {
            looks += 1;
            if other != index && outer.boxes(ring.points[0]) {
                looks += outer.points.len();
                // Of two rings that are the same, the second is within the first.
                if outer.surrounds(ring.points[0]) && (outer.area.abs(), index) > (ring.area.abs(), other) {
                    around.push(other);
                }
            }
            if looks > MOST_LOOKS {
                return None;
            }
        }
        let turns = |ring: &Ring| if ring.area > 0.0 { 1 } else { -1 };
        let without: i64 = match rule {
            FillRule::EvenOdd => i64::from(around.len() % 2 == 1),
            FillRule::NonZero => around.iter().map(|&other| turns(&rings[other])).sum(),
        };
        let within = match rule {
            FillRule::EvenOdd => 1 - without,
            FillRule::NonZero => without + turns(ring),
        };
        match (without != 0, within != 0) {
            (false, true) => outlines.push((index, Shape { outline: ring.corners(), holes: Vec::new() })),
            (true, false) => holes.push((index, around)),
            _ => {}
        }
    }
    for (hole, mut around) in holes {
        // The hole of the smallest area around it.
        around.sort_by(|&a, &b| rings[a].area.abs().total_cmp(&rings[b].area.abs()));
        let of =
            around.iter().find_map(|other| outlines.binary_search_by_key(other, |&(index, _)| index).ok());
        if let Some(of) = of {
            outlines[of].1.holes.push(rings[hole].corners());
        }
    }
    Some(outlines.into_iter().map(|(_, shape)| shape).collect())
}

impl Ring {
    fn new(mut points: Vec<DVec2>) -> Self {
        points.dedup();
        let low = points.iter().fold(DVec2::INFINITY, |low, &p| low.min(p));
        let high = points.iter().fold(DVec2::NEG_INFINITY, |high, &p| high.max(p));
        // About a corner of its own: far from the origin, the products would swallow the area.
        let about = points.first().copied().unwrap_or_default();
        let next = points.iter().skip(1).chain(&points);
        let area = points.iter().zip(next).map(|(&a, &b)| (a - about).perp_dot(b - about)).sum();
        Self { points, low, high, area }
    }

    fn corners(&self) -> Vec<[f64; 2]> {
        self.points.iter().map(|&p| p.into()).collect()
    }

    fn boxes(&self, p: DVec2) -> bool {
        self.low.cmple(p).all() && p.cmple(self.high).all()
    }

    fn surrounds(&self, p: DVec2) -> bool {
        let next = self.points.iter().skip(1).chain(&self.points);
        let crossed = self.points.iter().zip(next).filter(|&(a, b)| {
            (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)
        });
        crossed.count() % 2 == 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(low: f64, high: f64) -> Vec<DVec2> {
        [(low, low), (high, low), (high, high), (low, high)].map(DVec2::from).into()
    }

    fn turned(mut ring: Vec<DVec2>) -> Vec<DVec2> {
        ring.reverse();
        ring
    }

    fn counts(rings: &[Vec<DVec2>], rule: FillRule) -> Vec<usize> {
        areas(rings.to_vec(), rule).unwrap().iter().map(|shape| shape.holes.len()).collect()
    }

    #[test]
    fn a_ring_within_a_ring_is_a_hole_or_not_as_the_rule_of_filling_says() {
        let nested = [square(0.0, 9.0), square(1.0, 8.0), square(2.0, 7.0)];
        assert_eq!(counts(&nested, FillRule::EvenOdd), [1, 0], "a ring of rock and a pillar in it");
        assert_eq!(counts(&nested, FillRule::NonZero), [0], "all of one direction: one area");
        let other = [square(0.0, 9.0), turned(square(1.0, 8.0)), square(2.0, 7.0)];
        assert_eq!(counts(&other, FillRule::NonZero), [1, 0]);
        let beside = [square(0.0, 1.0), square(2.0, 3.0)];
        assert_eq!(counts(&beside, FillRule::EvenOdd), [0, 0]);
        assert_eq!(
            counts(&[square(0.0, 2.0), square(0.0, 2.0)], FillRule::EvenOdd),
            [1],
            "drawn twice: nothing is left"
        );
        assert!(counts(&[vec![DVec2::ZERO, DVec2::X], Vec::new()], FillRule::NonZero).is_empty());
    }

    #[test]
    fn a_path_with_too_many_rings_within_each_other_is_given_up_on_in_time() {
        let rings: Vec<Vec<DVec2>> =
            (0..60_000).map(|i| square(f64::from(i) * 1e-3, 200.0 - f64::from(i) * 1e-3)).collect();
        assert_eq!(areas(rings, FillRule::EvenOdd), None);
    }
}
