//! The map with the UAVs' tracks, at equal aspect.

use glam::DVec2;
use kuva::render::render::{Primitive, Scene};
use uchain_core::bounded;

use super::losses::thinned;
use crate::draw::{
    colour::{self, FREE, INK},
    ground,
    panel::{BOX_WIDTH, Panel, dot, legend, rule, unclip},
};
use crate::mission::chain::{Course, Frame, History, Summary, UavFrame};

/// Lowest and highest box.
const HEIGHTS: (f64, f64) = (120.0, 360.0);
/// Least room around the tracks (m), and as a share of their size.
const MARGIN_M: f64 = 0.8;
const MARGIN_SHARE: f64 = 0.04;

/// What the lower panel shows. Coordinates are in the map file's own frame (m).
pub(crate) struct Tunnel<'a> {
    course: &'a Course,
    frames: Vec<&'a Frame>,
    last: Option<&'a Frame>,
    flown: usize,
    low_m: DVec2,
    high_m: DVec2,
}

impl<'a> Tunnel<'a> {
    pub(crate) fn new(course: &'a Course, history: &'a History, summary: &Summary) -> Self {
        let frames = thinned(&history.frames);
        let mut tunnel = Self {
            course,
            frames,
            last: history.frames.last(),
            flown: summary.launches_s.len().max(1),
            low_m: DVec2::INFINITY,
            high_m: DVec2::NEG_INFINITY,
        };
        tunnel.frame_region();
        tunnel
    }

    /// Crops to the base and to wherever somebody was, plus a margin.
    fn frame_region(&mut self) {
        let spawns = self.course.spawns.iter().map(|spawn| spawn.at);
        let fixed = spawns.chain([self.course.base]).map(|at| self.shown(at.as_dvec2()));
        let flown = self.frames.iter().flat_map(|frame| &frame.uavs).filter_map(|uav| self.place(uav));
        let (mut low, mut high) = (self.low_m, self.high_m);
        for at in fixed.chain(flown) {
            (low, high) = (low.min(at), high.max(at));
        }
        let margin_m = (MARGIN_SHARE * (high - low).max_element()).max(MARGIN_M);
        (self.low_m, self.high_m) = (low - margin_m, high + margin_m);
    }

    /// The panel whose box has the region's own shape, so that a metre is as long across as up.
    pub(crate) fn panel(&self, top: f64) -> Panel {
        let size_m = self.high_m - self.low_m;
        let height = bounded(BOX_WIDTH * size_m.y / size_m.x, HEIGHTS.0, HEIGHTS.1);
        let m_per_unit = (size_m.x / BOX_WIDTH).max(size_m.y / height);
        let middle = (self.low_m + self.high_m) / 2.0;
        let half = DVec2::new(BOX_WIDTH, height) * m_per_unit / 2.0;
        let (low, high) = (middle - half, middle + half);
        Panel::new(top, height, (low.x, high.x), (low.y, high.y)).without_grid()
    }

    pub(crate) fn draw(&self, scene: &mut Scene, panel: &Panel) {
        panel.clip(scene);
        ground::paint(scene, panel, &self.course.map);
        for i in (0..self.flown).rev() {
            panel.line(scene, self.track(i), &colour::of_uav(i, self.flown), 1.4);
        }
        let (x, y) = self.on_page(panel, self.course.base.as_dvec2());
        square(scene, (x, y));
        self.uavs(scene, panel);
        unclip(scene);
        panel.axes(scene, "x (m)", "y (m)");
        self.legend(scene, panel);
    }

    /// Where a UAV flew; `None` while it was on the ground.
    fn track(&self, index: usize) -> impl Iterator<Item = Option<(f64, f64)>> {
        self.frames.iter().map(move |frame| {
            let uav = frame.uavs.get(index).filter(|uav| uav.airborne)?;
            self.place(uav).map(|at| (at.x, at.y))
        })
    }

    /// Where everybody is at the end: a full dot in the air, an empty one on the ground.
    fn uavs(&self, scene: &mut Scene, panel: &Panel) {
        let uavs = self.last.map(|frame| frame.uavs.as_slice()).unwrap_or_default();
        for (i, uav) in uavs.iter().enumerate().rev() {
            let Some(at) = self.place(uav) else { continue };
            let spot = panel.at(at.x, at.y);
            if uav.airborne {
                dot(scene, spot, 4.0, &colour::of_uav(i, self.flown), &INK);
            } else {
                dot(scene, spot, 2.5, &FREE, &INK);
            }
        }
    }

    fn legend(&self, scene: &mut Scene, panel: &Panel) {
        let spot = legend(scene, panel, 0, "base");
        square(scene, spot);
        let (x, y) = legend(scene, panel, 1, "track");
        rule(scene, (x - 8.0, y), (x + 8.0, y), &colour::of_uav(0, 1), 1.4, None);
        let spot = legend(scene, panel, 2, "at the end");
        dot(scene, spot, 4.0, &colour::of_uav(0, 1), &INK);
        if self.last.is_some_and(|frame| frame.uavs.iter().any(|uav| !uav.airborne)) {
            let spot = legend(scene, panel, 3, "on the ground");
            dot(scene, spot, 2.5, &FREE, &INK);
        }
    }

    /// A place of the map frame in the map file's own.
    fn shown(&self, at: DVec2) -> DVec2 {
        at + DVec2::from(self.course.map.offset_m())
    }

    fn place(&self, uav: &UavFrame) -> Option<DVec2> {
        let at = DVec2::new(f64::from(uav.x_m), f64::from(uav.y_m));
        at.is_finite().then(|| self.shown(at))
    }

    fn on_page(&self, panel: &Panel, at: DVec2) -> (f64, f64) {
        let at = self.shown(at);
        panel.at(at.x, at.y)
    }
}

/// The base's mark.
fn square(scene: &mut Scene, (x, y): (f64, f64)) {
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
