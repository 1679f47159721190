//! The middle of a corridor, measured along its length.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, Vec2};
use uchain_core::bounded;

/// The middle of a corridor: straights and arcs, end to end.
///
/// An abscissa is the distance along it from its start (m).
#[derive(Debug, Clone, PartialEq)]
pub struct CentreLine {
    pieces: Vec<Piece>,
    length_m: f64,
    closed: bool,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Piece {
    start_m: f64,
    length_m: f64,
    shape: Shape,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::map) enum Shape {
    Straight {
        from: DVec2,
        /// Unit vector.
        direction: DVec2,
    },
    Arc {
        centre: DVec2,
        radius_m: f64,
        /// Direction from the centre to where the arc starts (rad).
        start_rad: f64,
        /// Angle turned through, positive to the left (rad).
        turn_rad: f64,
    },
}

impl CentreLine {
    pub(in crate::map) fn new(closed: bool) -> Self {
        Self { pieces: Vec::new(), length_m: 0.0, closed }
    }

    pub(in crate::map) fn push(&mut self, shape: Shape, length_m: f64) {
        if length_m > 0.0 {
            self.pieces.push(Piece { start_m: self.length_m, length_m, shape });
            self.length_m += length_m;
        }
    }

    /// Straights from point to point; equal points in a row count once.
    pub(in crate::map) fn through(points: &[DVec2]) -> Self {
        let mut line = Self::new(false);
        for (&from, &to) in points.iter().zip(points.iter().skip(1)) {
            if let Some(direction) = (to - from).try_normalize() {
                line.push(Shape::Straight { from, direction }, from.distance(to));
            }
        }
        line
    }

    /// Its length (m).
    pub fn length_m(&self) -> f32 {
        self.length_m as f32
    }

    /// [`Self::length_m`] without rounding.
    pub(in crate::map) fn length_f64_m(&self) -> f64 {
        self.length_m
    }

    /// Whether it is a ring.
    pub fn is_closed(&self) -> bool {
        self.closed
    }

    /// The point (m) and the heading (rad, counter-clockwise from x, within ±π) at an abscissa (m). A ring goes
    /// round and round; an open line ends at its ends.
    pub fn at(&self, abscissa_m: f32) -> (Vec2, f32) {
        let (point, heading_rad) = self.at_f64(f64::from(abscissa_m));
        (point.as_vec2(), heading_rad as f32)
    }

    /// [`Self::at`] without rounding.
    pub(in crate::map) fn at_f64(&self, abscissa_m: f64) -> (DVec2, f64) {
        let along_m = if self.closed {
            abscissa_m.rem_euclid(self.length_m)
        } else {
            bounded(abscissa_m, 0.0, self.length_m)
        };
        let index = self.pieces.partition_point(|piece| piece.start_m <= along_m).saturating_sub(1);
        let Some(piece) = self.pieces.get(index) else { return (DVec2::NAN, f64::NAN) };
        let within_m = (along_m - piece.start_m).min(piece.length_m);
        let (point, heading_rad) = match piece.shape {
            Shape::Straight { from, direction } => {
                (from + direction * within_m, libm::atan2(direction.y, direction.x))
            }
            Shape::Arc { centre, radius_m, start_rad, turn_rad } => {
                let angle = start_rad + turn_rad * within_m / piece.length_m;
                (centre + unit(angle) * radius_m, angle + libm::copysign(PI / 2.0, turn_rad))
            }
        };
        (point, wrapped(heading_rad))
    }

    /// The abscissa of the centre line's point nearest to `p` (m); of equally near ones the first.
    pub fn project(&self, p: Vec2) -> f32 {
        self.project_f64(p.as_dvec2()) as f32
    }

    /// [`Self::project`] without rounding.
    pub(in crate::map) fn project_f64(&self, p: DVec2) -> f64 {
        let mut best = (f64::INFINITY, 0.0);
        for piece in &self.pieces {
            let (distance_m, within_m) = piece.nearest(p);
            if distance_m < best.0 {
                best = (distance_m, piece.start_m + within_m);
            }
        }
        best.1
    }
}

impl Piece {
    /// Distance from `p` (m), and how far along the piece its nearest point lies (m).
    fn nearest(&self, p: DVec2) -> (f64, f64) {
        match self.shape {
            Shape::Straight { from, direction } => {
                let within_m = bounded((p - from).dot(direction), 0.0, self.length_m);
                ((from + direction * within_m).distance(p), within_m)
            }
            Shape::Arc { centre, radius_m, start_rad, turn_rad } => {
                let out = p - centre;
                // Measured from the middle of the arc, an angle beyond ±half the turn belongs to an end.
                let middle = start_rad + turn_rad / 2.0;
                let off = wrapped(libm::atan2(out.y, out.x) - middle);
                let half = turn_rad.abs() / 2.0;
                let off = bounded(off, -half, half);
                let share = 0.5 + off / turn_rad;
                let nearest = centre + unit(middle + off) * radius_m;
                (nearest.distance(p), bounded(share, 0.0, 1.0) * self.length_m)
            }
        }
    }
}

pub(in crate::map) fn unit(angle_rad: f64) -> DVec2 {
    DVec2::new(libm::cos(angle_rad), libm::sin(angle_rad))
}

/// An angle within ±π.
fn wrapped(angle_rad: f64) -> f64 {
    (angle_rad + PI).rem_euclid(TAU) - PI
}
