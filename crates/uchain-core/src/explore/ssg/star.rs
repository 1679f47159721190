//! Stars: what a scan says of the surroundings of one place (Kim 2021, §4.1, Eq. 1).

use alloc::vec::Vec;
use core::f32::consts::TAU;

use super::super::Point;
use crate::bounded;

/// What bounds a sector.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Label {
    /// A return within `R_s`; −1 in Eq. 1.
    Obstacle,
    /// No return, and nothing new behind; 0 in Eq. 1.
    Free,
    /// No return, and unknown behind; 1 in Eq. 1.
    Frontier,
}

impl Label {
    /// The number that Eq. 1 gives it.
    pub fn value(self) -> i8 {
        match self {
            Self::Obstacle => -1,
            Self::Free => 0,
            Self::Frontier => 1,
        }
    }
}

/// One entry of the frontier data, `F_q(k)` in Eq. 1.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Sector {
    /// What bounds it.
    pub label: Label,
    /// Its radius `r_k` (m), 0 to `R_s`; `R_s` without a return.
    pub r_m: f32,
}

impl Sector {
    /// From what a scan returned for it, before any other star is looked at. Without a return within `R_s` it is a
    /// frontier; a return that is not finite counts as one at 0 m.
    pub fn of(return_m: Option<f32>, r_s_m: f32) -> Self {
        match return_m {
            Some(r_m) if !r_m.is_finite() => Self { label: Label::Obstacle, r_m: 0.0 },
            Some(r_m) if r_m <= r_s_m => Self { label: Label::Obstacle, r_m: r_m.max(0.0) },
            _ => Self { label: Label::Frontier, r_m: r_s_m },
        }
    }

    /// As another robot reports it: without an obstacle it reaches `R_s`, and none reaches farther.
    pub(super) fn believed(self, r_s_m: f32) -> Self {
        let r_m = if self.r_m.is_finite() { bounded(self.r_m, 0.0, r_s_m) } else { 0.0 };
        Self { r_m: if self.label == Label::Obstacle { r_m } else { r_s_m }, ..self }
    }
}

/// The directions of a star: equal sectors from the inertial x axis, counter-clockwise.
///
/// Directions are counted in half sectors: 2k is where sector k begins, 2k + 1 its middle.
#[derive(Debug, Clone, PartialEq)]
pub struct Cones {
    count: usize,
    /// Unit vector of every half sector.
    units: Vec<[f32; 2]>,
}

impl Cones {
    /// So many sectors; at least one.
    pub fn new(count: u16) -> Self {
        let count = usize::from(count.max(1));
        let mut cones = Self { count, units: Vec::new() };
        let unit = |half| {
            let angle_rad = cones.angle_rad(half);
            [libm::cosf(angle_rad), libm::sinf(angle_rad)]
        };
        cones.units = (0..2 * count).map(unit).collect();
        cones
    }

    /// Number of sectors.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Angle of a half sector from the x axis (rad), 0 to below 2π.
    pub fn angle_rad(&self, half: usize) -> f32 {
        (half % (2 * self.count)) as f32 * (TAU / (2 * self.count) as f32)
    }

    /// The point at a distance (m) along a half sector, by its number from 0; one past the last goes on from the first.
    pub fn point(&self, from: Point, half: usize, distance_m: f32) -> Point {
        let [ux, uy] = self.units.get(half % (2 * self.count)).copied().unwrap_or([1.0, 0.0]);
        Point { x_m: from.x_m + distance_m * ux, y_m: from.y_m + distance_m * uy }
    }

    /// The sector that a direction (rad) lies in, from 0; sector 0 for one that is not finite.
    pub fn facing_rad(&self, angle_rad: f32) -> usize {
        let turned = libm::fmodf(angle_rad, TAU);
        let positive = if turned < 0.0 { turned + TAU } else { turned };
        // A float to integer cast saturates, and takes NaN for 0.
        let k = libm::floorf(positive / TAU * self.count as f32) as usize;
        k.min(self.count - 1)
    }

    /// The sector of `from` in which `to` lies.
    pub fn facing(&self, from: Point, to: Point) -> usize {
        self.facing_rad(libm::atan2f(to.y_m - from.y_m, to.x_m - from.x_m))
    }
}

/// The local safe region of a node, S in Kim 2021, §4.1.
#[derive(Debug, Clone, Copy)]
pub struct Star<'a> {
    pub(super) at: Point,
    pub(super) sectors: &'a [Sector],
    pub(super) cones: &'a Cones,
    pub(super) r_s_m: f32,
}

impl Star<'_> {
    /// The sector that faces a point, `F_q(k_p)` in Eq. 8.
    pub fn facing(&self, p: Point) -> Sector {
        let blind = Sector { label: Label::Obstacle, r_m: 0.0 };
        self.sectors.get(self.cones.facing(self.at, p)).copied().unwrap_or(blind)
    }

    /// Whether a point is in it: nearer than the radius of the sector that faces it.
    pub fn contains(&self, p: Point) -> bool {
        self.holds(p, 0.0)
    }

    /// Whether a point is in it and not nearer to its edge, along its own ray, than so much.
    pub(super) fn holds(&self, p: Point, margin_m: f32) -> bool {
        // Most points are out of any sector's reach, and an arctangent costs more than a comparison.
        let d_m = self.at.distance_m(p) + margin_m;
        d_m < self.r_s_m && d_m < self.facing(p).r_m
    }
}
