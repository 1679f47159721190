//! Curves as straight pieces: how vector drawings are read. In `f64`, and with libm, so that a drawing is the same map on
//! every machine; kurbo takes its sines from the system.

use std::f64::consts::TAU;

use glam::{DAffine2, DVec2};

/// Most straight pieces of one curve.
const MOST_PIECES: f64 = 16_384.0;

/// A line that is being drawn: where the pen is, and what it left.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Line {
    pub(crate) points: Vec<DVec2>,
    pub(crate) closed: bool,
}

impl Line {
    /// Where the pen is; the frame's origin before it is set down.
    fn pen(&self) -> DVec2 {
        self.points.last().copied().unwrap_or_default()
    }

    pub(crate) fn to(&mut self, at: DVec2) {
        self.points.push(at);
    }

    /// A cubic Bézier curve from where the pen is; no piece is farther from it than `within_m`.
    pub(crate) fn cubic(&mut self, first: DVec2, second: DVec2, end: DVec2, within_m: f64) {
        let start = self.pen();
        // The chord's distance is at most an eighth of the second derivative times the square of a piece's share.
        let bend = (start - 2.0 * first + second).length().max((first - 2.0 * second + end).length());
        let count = pieces((0.75 * bend / within_m).sqrt());
        for piece in 1..count {
            let t = f64::from(piece) / f64::from(count);
            let s = 1.0 - t;
            self.to(s * s * s * start + 3.0 * s * s * t * first + 3.0 * s * t * t * second + t * t * t * end);
        }
        self.to(end);
    }

    /// A quadratic Bézier curve from where the pen is.
    pub(crate) fn quadratic(&mut self, control: DVec2, end: DVec2, within_m: f64) {
        let start = self.pen();
        let third = |a: DVec2| a + 2.0 / 3.0 * (control - a);
        self.cubic(third(start), third(end), end, within_m);
    }

    /// A piece of the unit circle as `place` lays it out, both ends included.
    pub(crate) fn arc(&mut self, place: &DAffine2, from_rad: f64, sweep_rad: f64, within_m: f64) {
        let radius = place.matrix2.x_axis.length().max(place.matrix2.y_axis.length());
        let step = 2.0 * libm::acos((1.0 - within_m / radius).max(0.0));
        // A circle has eight corners at least, however small.
        let count = pieces((sweep_rad.abs() / step).max(sweep_rad.abs() / (TAU / 8.0)));
        for piece in 0..=count {
            let angle = from_rad + sweep_rad * f64::from(piece) / f64::from(count);
            self.to(place.transform_point2(DVec2::new(libm::cos(angle), libm::sin(angle))));
        }
    }

    /// The arc that CAD programs write as a bulge, the tangent of a quarter of its angle, from where the pen is.
    pub(crate) fn bulge(&mut self, bulge: f64, end: DVec2, within_m: f64) {
        let start = self.pen();
        let half = (end - start) / 2.0;
        if !(bulge.abs() > 1e-9 && half.length() > 0.0) {
            return self.to(end);
        }
        let centre = start + half + half.perp() * (1.0 - bulge * bulge) / (2.0 * bulge);
        let (arm, sweep) = (start - centre, 4.0 * libm::atan(bulge));
        let place = DAffine2::from_cols(arm, arm.perp(), centre);
        self.points.pop();
        self.arc(&place, 0.0, sweep, within_m);
        self.points.pop();
        self.to(end);
    }
}

fn pieces(count: f64) -> u32 {
    // What is no number makes one piece, and is refused where the corners are checked.
    if count > MOST_PIECES { MOST_PIECES as u32 } else { (count.ceil() as u32).max(1) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_piece_of_a_circle_is_farther_from_it_than_asked_and_few_pieces_do() {
        for (radius, within) in [(1.0, 0.01), (250.0, 0.01), (0.004, 0.01)] {
            let mut line = Line::default();
            line.arc(&DAffine2::from_scale(DVec2::splat(radius)), 0.0, TAU, within);
            let sag = |pair: &[DVec2]| radius - pair[0].midpoint(pair[1]).length();
            let worst = line.points.windows(2).map(sag).fold(0.0, f64::max);
            assert!(worst <= within * 1.0001, "{radius}: {worst}");
            assert!(line.points.len() < 360 && line.points.len() >= 9, "{}", line.points.len());
        }
    }

    #[test]
    fn no_piece_of_a_bezier_curve_is_farther_from_it_than_asked() {
        let (a, b, c, d) =
            (DVec2::ZERO, DVec2::new(0.0, 9.0), DVec2::new(30.0, -20.0), DVec2::new(10.0, 3.0));
        let mut line = Line { points: vec![a], closed: false };
        line.cubic(b, c, d, 0.01);
        let at = |t: f64| {
            let s = 1.0 - t;
            s * s * s * a + 3.0 * s * s * t * b + 3.0 * s * t * t * c + t * t * t * d
        };
        let away = |p: DVec2| {
            let pairs = line.points.windows(2);
            pairs
                .map(|pair| {
                    let along = pair[1] - pair[0];
                    let share =
                        uchain_core::bounded((p - pair[0]).dot(along) / along.length_squared(), 0.0, 1.0);
                    p.distance(pair[0] + share * along)
                })
                .fold(f64::INFINITY, f64::min)
        };
        let worst = (0..=5000).map(|i| away(at(f64::from(i) / 5000.0))).fold(0.0, f64::max);
        assert!(worst <= 0.01 && worst > 0.001, "{worst}");
        assert!(line.points.len() < 100, "{}", line.points.len());
    }

    #[test]
    fn a_bulge_of_one_is_a_half_circle_to_the_right_and_of_minus_one_to_the_left() {
        for (bulge, lowest) in [(1.0, -1.0), (-1.0, 0.0)] {
            let mut line = Line { points: vec![DVec2::ZERO], closed: false };
            line.bulge(bulge, DVec2::new(2.0, 0.0), 1e-4);
            let low = line.points.iter().map(|p| p.y).fold(0.0, f64::min);
            assert!((low - lowest).abs() < 1e-3, "{bulge}: {low}");
            assert_eq!(line.points.last(), Some(&DVec2::new(2.0, 0.0)));
            assert!(line.points.iter().all(|p| (p.distance(DVec2::X) - 1.0).abs() < 1e-9));
        }
        let mut line = Line { points: vec![DVec2::ZERO], closed: false };
        line.bulge(0.0, DVec2::X, 0.01);
        assert_eq!(line.points.len(), 2, "the control");
    }
}
