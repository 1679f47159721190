//! Where the relays of a plan stand, on the map.

use glam::DVec2;
use kuva::render::render::{Primitive, Scene};

use super::region::{Region, WORTH_IT, outline, square};
use crate::draw::{
    TEXT_LABEL, colour,
    colour::{FREE, GREY, INK},
    dots::{self, Somebody},
    ground,
    name::legend,
    panel::{Panel, caption, dot, round_step, rule, text, unclip},
};
use crate::mission::chain::{Course, Plan};

/// From one box to the next.
const GAP: f64 = 66.0;
/// Thickness of a link, and of the way.
const LINK: f64 = 4.0;
const WAY: f64 = 1.0;
/// Least room around the relays (m).
const MARGIN_M: f64 = 2.0;
/// Most points of the way that are drawn, and most relays with a number.
const WAY_POINTS: usize = 600;
const NUMBERS: usize = 60;
/// Margins that the legend shows (dB).
const MARGINS_DB: [f64; 3] = [20.0, 10.0, 0.0];

/// The map with the way in, base, goal, relays and links.
pub(crate) struct Places<'a> {
    course: &'a Course,
    plan: &'a Plan,
    way: Vec<DVec2>,
}

impl<'a> Places<'a> {
    pub(crate) fn new(course: &'a Course, plan: &'a Plan) -> Self {
        let goal_m = plan.rows.last().map_or(0.0, |row| row.depth_m);
        let point = |k: usize| {
            let tunnel = course.tunnel.as_ref()?;
            let (at, _) = tunnel.at(goal_m * k as f64 / (WAY_POINTS - 1) as f64);
            Some(at.as_dvec2() + DVec2::from(course.map.offset_m()))
        };
        Self { course, plan, way: (0..WAY_POINTS).filter_map(point).collect() }
    }

    /// The whole map, and the way in if that is a small part of it.
    pub(crate) fn panels(&self, top: f64) -> Vec<Panel> {
        let (low, high) = self.course.map.bounds();
        let offset = DVec2::from(self.course.map.offset_m());
        let corners = [low, high].into_iter().map(|at| at.as_dvec2() + offset);
        let whole = Region::around(corners, 0.0);
        let base = DVec2::from(self.plan.assumptions.map.base_m);
        let near = Region::around(self.way.iter().copied().chain([base]), MARGIN_M);
        let mut panels = vec![whole.panel(top)];
        if whole.scale().1 > WORTH_IT * near.scale().1 {
            panels.push(near.panel(panels[0].bottom() + GAP));
        }
        panels
    }

    pub(crate) fn draw(&self, scene: &mut Scene, panels: &[Panel]) {
        for (panel, title) in panels.iter().zip(["the whole map", "the way in"]) {
            panel.clip(scene);
            ground::paint(scene, panel, &self.course.map);
            panels.iter().skip(1).for_each(|near| outline(scene, panel, near));
            panel.line(scene, self.way.iter().map(|at| Some((at.x, at.y))), &GREY, WAY);
            self.links(scene, panel);
            let [x, y] = self.plan.assumptions.map.base_m;
            square(scene, panel.at(x, y));
            if let Some([x, y]) = self.plan.head_m {
                goal(scene, panel.at(x, y));
            }
            self.relays(scene, panel);
            scale_bar(scene, panel, &self.marks(panel));
            unclip(scene);
            panel.axes(scene, "x (m)", "y (m)");
            if panels.len() > 1 {
                text(scene, (panel.left(), panel.top() - 7.0), TEXT_LABEL, title);
            }
        }
        if let Some(first) = panels.first() {
            Self::legend(scene, first);
        }
    }

    /// What a scale bar is not to hide.
    fn marks(&self, panel: &Panel) -> Vec<(f64, f64)> {
        let base = DVec2::from(self.plan.assumptions.map.base_m);
        self.way.iter().chain([&base]).map(|at| panel.at(at.x, at.y)).collect()
    }

    /// From head to base, by what is left to the limit.
    fn links(&self, scene: &mut Scene, panel: &Panel) {
        let s_min_db = self.plan.s_min_db;
        let mut front = self.plan.head_m;
        let mut link = |from: [f64; 2], to: [f64; 2], loss_db| {
            let [from, to] = [from, to].map(|[x, y]| panel.at(x, y));
            rule(scene, from, to, &colour::of_link(loss_db, s_min_db), LINK, None);
        };
        for place in &self.plan.places {
            let here = [place.x_m, place.y_m];
            if let Some(front) = front {
                link(front, here, place.front_db);
            }
            front = Some(here);
        }
        let base = self.plan.assumptions.map.base_m;
        let last_db = match self.plan.places.last() {
            Some(last) => Some(last.link_db),
            None => self.plan.rows.last().and_then(|row| row.bottleneck_db),
        };
        if let (Some(front), Some(last_db)) = (front, last_db) {
            link(front, base, last_db);
        }
    }

    fn relays(&self, scene: &mut Scene, panel: &Panel) {
        let somebody = |place: &crate::mission::chain::Place| Somebody {
            number: place.relay,
            at: panel.at(place.x_m, place.y_m),
            in_the_air: true,
        };
        let all: Vec<Somebody> = self.plan.places.iter().map(somebody).collect();
        if all.len() <= NUMBERS {
            dots::draw(scene, panel, &all);
            return;
        }
        for one in &all {
            dot(scene, one.at, 1.5, &colour::of_uav(1), &INK);
        }
        let every = round_step(all.len() as f64, NUMBERS / 3).max(1.0) as usize;
        let named: Vec<Somebody> =
            all.into_iter().filter(|one| one.number == 1 || one.number.is_multiple_of(every)).collect();
        dots::draw(scene, panel, &named);
    }

    fn legend(scene: &mut Scene, panel: &Panel) {
        let spot = legend(scene, panel, 0, "base");
        square(scene, spot);
        let spot = legend(scene, panel, 1, "head at its goal");
        goal(scene, spot);
        let spot = legend(scene, panel, 2, "relay");
        dot(scene, spot, 5.0, &colour::of_uav(1), &INK);
        let (x, y) = legend(scene, panel, 3, "way in");
        rule(scene, (x - 9.0, y), (x + 9.0, y), &GREY, WAY, None);
        for (row, margin_db) in (4..).zip(MARGINS_DB) {
            let (x, y) = legend(scene, panel, row, &format!("{margin_db} dB margin"));
            let colour = colour::of_link(-margin_db, 0.0);
            rule(scene, (x - 9.0, y), (x + 9.0, y), &colour, LINK, None);
        }
    }
}

/// Where the head is to go.
fn goal(scene: &mut Scene, (x, y): (f64, f64)) {
    const ARM: f64 = 6.0;
    for (width, colour) in [(5.0, FREE), (2.5, colour::of_uav(0))] {
        rule(scene, (x - ARM, y - ARM), (x + ARM, y + ARM), &colour, width, None);
        rule(scene, (x - ARM, y + ARM), (x + ARM, y - ARM), &colour, width, None);
    }
}

/// A round length in a corner where it hides no mark: the lower left one, else another.
pub(super) fn scale_bar(scene: &mut Scene, panel: &Panel, marks: &[(f64, f64)]) {
    const WIDE: f64 = 12.0;
    const HIGH: f64 = 22.0;
    let ((low, _), (high, _)) = panel.ranges();
    let length_m = round_step(high - low, 8);
    let length = panel.at(low + length_m, 0.0).0 - panel.at(low, 0.0).0;
    let (left, right) = (panel.left() + 6.0, panel.right() - 6.0 - length - WIDE);
    let (lower, upper) = (panel.bottom() - 4.0 - HIGH, panel.top() + 4.0);
    let corners = [(left, lower), (right, lower), (left, upper), (right, upper)];
    let is_free = |&(x, y): &(f64, f64)| {
        let hides = |at: &(f64, f64)| {
            (x - 8.0..x + length + WIDE + 8.0).contains(&at.0) && (y - 8.0..y + HIGH + 8.0).contains(&at.1)
        };
        !marks.iter().any(hides)
    };
    let (x, y) = corners.into_iter().find(is_free).unwrap_or(corners[0]);
    scene.add(Primitive::Rect {
        x,
        y,
        width: length + WIDE,
        height: HIGH,
        fill: FREE,
        stroke: None,
        stroke_width: None,
        opacity: Some(0.8),
    });
    let (x, y, ink) = (x + WIDE / 2.0, y + HIGH - 6.0, INK);
    rule(scene, (x, y), (x + length, y), &ink, 2.0, None);
    rule(scene, (x, y - 3.0), (x, y + 3.0), &ink, 1.5, None);
    rule(scene, (x + length, y - 3.0), (x + length, y + 3.0), &ink, 1.5, None);
    caption(scene, (x + length / 2.0, y - 5.0), &format!("{length_m} m"), &ink);
}
