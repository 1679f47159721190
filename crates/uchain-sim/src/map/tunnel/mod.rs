//! Depth: how far along the middle of the tunnel a place lies from the base.

pub(super) mod centre_line;
mod path;
mod route;
mod settle;
#[cfg(test)]
mod tests;

use glam::Vec2;
use uchain_core::bounded;

pub use centre_line::CentreLine;

/// A centre line seen from the base. Depth 0 is the base, depth grows in the direction the chain goes, up to
/// [`Tunnel::length_m`].
#[derive(Debug, Clone, PartialEq)]
pub struct Tunnel {
    line: CentreLine,
    /// The base's abscissa (m).
    base_m: f64,
    /// +1 where the chain goes toward larger abscissae, −1 toward smaller ones.
    sign: f64,
    length_m: f64,
}

impl Tunnel {
    /// The tunnel that starts at the point of `line` nearest to `base` and goes the way that is nearer to
    /// `heading_rad` (counter-clockwise from x); a ring is gone round once.
    pub fn new(line: CentreLine, base: Vec2, heading_rad: f32) -> Self {
        let base_m = line.project_f64(base.as_dvec2());
        let (_, tangent_rad) = line.at_f64(base_m);
        let along = libm::cos(f64::from(heading_rad) - tangent_rad);
        let sign = if along < 0.0 { -1.0 } else { 1.0 };
        let total_m = line.length_f64_m();
        let length_m = match (line.is_closed(), sign < 0.0) {
            (true, _) => total_m,
            (false, true) => base_m,
            (false, false) => total_m - base_m,
        };
        Self { line, base_m, sign, length_m }
    }

    /// The same tunnel, given up beyond this depth (m).
    #[must_use]
    pub fn until(mut self, depth_m: f64) -> Self {
        self.length_m = bounded(depth_m, 0.0, self.length_m);
        self
    }

    /// Its line, whole.
    pub fn line(&self) -> &CentreLine {
        &self.line
    }

    /// Greatest depth (m).
    pub fn length_m(&self) -> f64 {
        self.length_m
    }

    /// The point (m) on the line at a depth (m), and the heading deeper into the tunnel (rad, counter-clockwise
    /// from x). An open line ends at its ends.
    pub fn at(&self, depth_m: f64) -> (Vec2, f32) {
        let (point, tangent_rad) = self.line.at_f64(self.base_m + self.sign * depth_m);
        let heading_rad = if self.sign < 0.0 { tangent_rad + std::f64::consts::PI } else { tangent_rad };
        (point.as_vec2(), heading_rad as f32)
    }

    /// Depth of the line's point nearest to `p` (m): negative behind the base; on a ring from 0 up to its length.
    pub fn depth_m(&self, p: Vec2) -> f64 {
        let depth_m = self.sign * (self.line.project_f64(p.as_dvec2()) - self.base_m);
        if self.line.is_closed() { depth_m.rem_euclid(self.line.length_f64_m()) } else { depth_m }
    }
}
