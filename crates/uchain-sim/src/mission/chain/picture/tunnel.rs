//! The whole tunnel with the UAVs' tracks and links, at equal aspect; where they flew once more, if that is a small part.

use glam::DVec2;
use kuva::render::{color::Color, render::Scene};

use super::{
    losses::thinned,
    region::{MARGIN_M, Region, WORTH_IT, outline, square},
};
use crate::draw::{
    TEXT_LABEL,
    colour::{self, FREE, GREY, INK},
    dots::{self, Somebody},
    ground,
    name::legend,
    panel::{Panel, dot, rule, text, unclip},
};
use crate::mission::chain::{Course, Frame, History, Summary, UavFrame};

/// From one box to the next.
const GAP: f64 = 66.0;
/// Thickness of a link; tracks are seen on it.
const LINK: f64 = 5.0;
/// Pattern of a link on which nothing is heard.
const LOST: Option<&str> = Some("3 10");

/// What the lower part shows. Coordinates are in the map file's own frame (m).
pub(crate) struct Tunnel<'a> {
    course: &'a Course,
    frames: Vec<&'a Frame>,
    last: Option<&'a Frame>,
    flown: usize,
}

impl<'a> Tunnel<'a> {
    pub(crate) fn new(course: &'a Course, history: &'a History, summary: &Summary) -> Self {
        Self {
            course,
            frames: thinned(&history.frames),
            last: history.frames.last(),
            flown: summary.launches_s.len().max(1),
        }
    }

    /// The whole tunnel, and where somebody was, if that is a small part of it.
    pub(crate) fn panels(&self, top: f64) -> Vec<Panel> {
        let spawns = self.course.spawns.iter().map(|spawn| spawn.at);
        let fixed = || spawns.clone().chain([self.course.base]).map(|at| self.shown(at.as_dvec2()));
        let flown = || self.frames.iter().flat_map(|frame| &frame.uavs).filter_map(|uav| self.place(uav));
        let (low, high) = self.course.map.bounds();
        let corners = [low, high].into_iter().map(|at| self.shown(at.as_dvec2()));
        // Who is blown through a wall is still to be seen.
        let whole = Region::around(corners.chain(fixed()).chain(flown()), 0.0);
        let near = Region::around(fixed().chain(flown()), MARGIN_M);
        let mut panels = vec![whole.panel(top)];
        if whole.scale().1 > WORTH_IT * near.scale().1 {
            panels.push(near.panel(panels[0].bottom() + GAP));
        }
        panels
    }

    pub(crate) fn draw(&self, scene: &mut Scene, panels: &[Panel]) {
        for (panel, title) in panels.iter().zip(["the whole tunnel", "where they flew"]) {
            panel.clip(scene);
            ground::paint(scene, panel, &self.course.map);
            panels.iter().skip(1).for_each(|near| outline(scene, panel, near));
            self.links(scene, panel);
            for i in (0..self.flown).rev() {
                // Tracks run over each other: that of the head is the thinnest, on top.
                let width = 1.1 + 0.5 * i.min(4) as f64;
                panel.line(scene, self.track(i), &colour::of_uav(i), width);
            }
            square(scene, self.on_page(panel, self.course.base.as_dvec2()));
            dots::draw(scene, panel, &self.everybody(panel));
            unclip(scene);
            panel.axes(scene, "x (m)", "y (m)");
            if panels.len() > 1 {
                text(scene, (panel.left(), panel.top() - 7.0), TEXT_LABEL, title);
            }
        }
        if let Some(first) = panels.first() {
            self.legend(scene, first);
        }
    }

    /// Links at the end, by loss against the threshold.
    fn links(&self, scene: &mut Scene, panel: &Panel) {
        let Some(frame) = self.last else { return };
        let place = |uav: usize| self.place(frame.uavs.get(uav)?).map(|at| panel.at(at.x, at.y));
        let base = self.on_page(panel, self.course.base.as_dvec2());
        let behind = frame.links.iter().skip(1).map(|link| place(link.uav)).chain([Some(base)]);
        for (link, behind) in frame.links.iter().zip(behind) {
            let (Some(front), Some(behind)) = (place(link.uav), behind) else { continue };
            let colour =
                self.s_min_db().map_or(GREY, |s_min_db| colour::of_link(link.true_db.into(), s_min_db));
            let is_lost = link.is_heard(self.course.scenario.link.lost_s) == Some(false);
            rule(scene, front, behind, &colour, LINK, LOST.filter(|_| is_lost));
        }
    }

    /// `None` where every signal launches.
    fn s_min_db(&self) -> Option<f64> {
        Some(f64::from(self.course.scenario.takeoff.s_min_db)).filter(|s_min_db| *s_min_db > 0.0)
    }

    /// Where a UAV flew; `None` while it was on the ground.
    fn track(&self, index: usize) -> impl Iterator<Item = Option<(f64, f64)>> {
        self.frames.iter().map(move |frame| {
            let uav = frame.uavs.get(index).filter(|uav| uav.airborne)?;
            self.place(uav).map(|at| (at.x, at.y))
        })
    }

    /// Where everybody is at the end.
    fn everybody(&self, panel: &Panel) -> Vec<Somebody> {
        let uavs = self.last.map(|frame| frame.uavs.as_slice()).unwrap_or_default();
        let one = |(number, uav): (usize, &UavFrame)| {
            let at = self.place(uav)?;
            Some(Somebody { number, at: panel.at(at.x, at.y), in_the_air: uav.airborne })
        };
        uavs.iter().enumerate().filter_map(one).collect()
    }

    fn legend(&self, scene: &mut Scene, panel: &Panel) {
        let spot = legend(scene, panel, 0, "base");
        square(scene, spot);
        let spot = legend(scene, panel, 1, "UAV at the end");
        dot(scene, spot, 5.0, &colour::of_uav(1), &INK);
        let spot = legend(scene, panel, 2, "on the ground");
        dot(scene, spot, 2.5, &FREE, &INK);
        let mut row = 3;
        let mut line = |words: &str, colour: &Color, width: f64, dash| {
            let (x, y) = legend(scene, panel, row, words);
            rule(scene, (x - 9.0, y), (x + 9.0, y), colour, width, dash);
            row += 1;
        };
        line("track", &colour::of_uav(0), 1.1, None);
        if let Some(s_min_db) = self.s_min_db() {
            for (words, worse_db) in [("or better", -20.0), ("(s_min)", 0.0), ("or worse", 20.0)] {
                let loss_db = s_min_db + worse_db;
                line(&format!("{loss_db} dB {words}"), &colour::of_link(loss_db, s_min_db), LINK, None);
            }
        } else {
            line("link", &GREY, LINK, None);
        }
        line("nothing heard", &GREY, LINK, LOST);
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
