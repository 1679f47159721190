//! Parts of a map on the page, at equal aspect.

use glam::DVec2;
use kuva::render::render::{Primitive, Scene};
use uchain_core::bounded;

use crate::draw::{
    colour::INK,
    panel::{BOX_WIDTH, Panel, rule},
};

/// Lowest and highest box.
const HEIGHTS: (f64, f64) = (120.0, 400.0);
/// Least room around the tracks (m), and room around tracks or map as a share of their size.
pub(super) const MARGIN_M: f64 = 0.8;
const MARGIN_SHARE: f64 = 0.04;
/// Where they flew is shown once more if that makes it so much larger.
pub(super) const WORTH_IT: f64 = 1.6;

/// A rectangle of the map file's own frame (m).
#[derive(Clone, Copy)]
pub(super) struct Region {
    pub(super) low_m: DVec2,
    pub(super) high_m: DVec2,
}

impl Region {
    pub(super) fn around(places: impl Iterator<Item = DVec2>, least_m: f64) -> Self {
        let empty = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        let (low_m, high_m) = places.fold(empty, |(low, high), at| (low.min(at), high.max(at)));
        let margin_m = (MARGIN_SHARE * (high_m - low_m).max_element()).max(least_m);
        Self { low_m: low_m - margin_m, high_m: high_m + margin_m }
    }

    /// Height of its box, and how much of the tunnel a unit of the page is (m).
    pub(super) fn scale(&self) -> (f64, f64) {
        let size_m = self.high_m - self.low_m;
        let height = bounded(BOX_WIDTH * size_m.y / size_m.x, HEIGHTS.0, HEIGHTS.1);
        (height, (size_m.x / BOX_WIDTH).max(size_m.y / height))
    }

    /// A box of its own shape, so that a metre is as long across as up.
    pub(super) fn panel(&self, top: f64) -> Panel {
        let (height, m_per_unit) = self.scale();
        let middle = (self.low_m + self.high_m) / 2.0;
        let half = DVec2::new(BOX_WIDTH, height) * m_per_unit / 2.0;
        let (low, high) = (middle - half, middle + half);
        Panel::new(top, height, (low.x, high.x), (low.y, high.y)).without_grid()
    }
}

/// Shows in one box what part of it another one shows.
pub(super) fn outline(scene: &mut Scene, whole: &Panel, near: &Panel) {
    let (low, high) = near.ranges();
    let ((left, bottom), (right, top)) = (whole.at(low.0, low.1), whole.at(high.0, high.1));
    let corners = [(left, bottom), (right, bottom), (right, top), (left, top), (left, bottom)];
    for pair in corners.windows(2) {
        rule(scene, pair[0], pair[1], &INK, 0.8, Some("3 3"));
    }
}

/// The base's mark.
pub(super) fn square(scene: &mut Scene, (x, y): (f64, f64)) {
    scene.add(Primitive::Rect {
        x: x - 4.5,
        y: y - 4.5,
        width: 9.0,
        height: 9.0,
        fill: INK,
        stroke: None,
        stroke_width: None,
        opacity: None,
    });
}
