//! The page of a map: how large it is, its scale, its grid.

use glam::DVec2;
use kuva::render::render::{Primitive, Scene, TextAnchor};
use uchain_core::bounded;

use crate::{
    draw::{
        colour::{GREY, INK},
        ground::free_area_m2,
        panel::{LETTER, Panel, TEXT_LABEL, TEXT_SMALL, round_step, rule},
    },
    map::Map,
};

/// Length of the longer side of the map: at least, and at most (units of the page; a unit is two pixels).
const LONG: (f64, f64) = (620.0, 2400.0);
/// Largest area of the map.
const MOST_AREA: f64 = 4.0e6;
/// A passage is to be so wide, if there is room.
const PASSAGE: f64 = 8.0;
/// Least sides of the box that holds the map.
const LEAST: (f64, f64) = (260.0, 90.0);
/// Room beside the map, of its longer side, and at least (units).
const RIM: f64 = 0.03;
const TOP: f64 = 44.0;
/// Room below the box for numbers, the name of the axis and the scale.
const BELOW: f64 = 62.0;

/// Where a map lies on its page.
pub(super) struct Sheet {
    pub(super) panel: Panel,
    page_width: f64,
    /// Units of the page per metre.
    scale: f64,
    /// Distance between two lines of the grid across and up (m).
    steps_m: [f64; 2],
}

impl Sheet {
    /// A page for a map and places around it, in the map file's own frame (m).
    pub(super) fn new(map: &Map, marks: &[[f64; 2]]) -> Self {
        let (low, high) = map.bounds();
        let offset = DVec2::from(map.offset_m());
        let (low, high) = (low.as_dvec2() + offset, high.as_dvec2() + offset);
        // A mark far off would make the map tiny; it is drawn no farther off than the map is large.
        let far = (high - low).max_element();
        let is_near = |at: &DVec2| at.cmpge(low - far).all() && at.cmple(high + far).all();
        let near = marks.iter().map(|&at| DVec2::from(at)).filter(is_near);
        let (low, high) = near.fold((low, high), |(low, high), at| (low.min(at), high.max(at)));
        let size = (high - low).max(DVec2::splat(1e-3));
        let long_m = size.max_element();
        let wall_m: f64 = map.walls().iter().map(|wall| f64::from(wall.a.distance(wall.b))).sum();
        let passage_m = (2.0 * free_area_m2(map) / wall_m).max(1e-6);
        let most = (LONG.1 / long_m).min((MOST_AREA / (size.x * size.y)).sqrt());
        let scale = (LONG.0 / long_m).max((PASSAGE / passage_m).min(most));
        let rim_m = (RIM * long_m).max(8.0 / scale).min(40.0 / scale);
        let box_size = (size + 2.0 * rim_m).max(DVec2::new(LEAST.0, LEAST.1) / scale);
        let middle = (low + high) / 2.0;
        let (low, high) = (middle - box_size / 2.0, middle + box_size / 2.0);

        let longest = [low.y, high.y, low.x, high.x].map(|at| format!("{at:.0}").len()).into_iter().max();
        let longest = longest.unwrap_or(1);
        // Numbers have room for their digits and for two decimals.
        let digits = LETTER * (longest + 3) as f64;
        let most_lines = (box_size.max_element() * scale / (digits + 24.0).max(60.0)) as usize;
        let step_m = round_step(box_size.max_element(), most_lines.max(2));
        // A map so thin that hardly a line crosses it has finer ones that way.
        let step_of = |side_m: f64, least: f64| {
            if side_m >= 2.0 * step_m {
                step_m
            } else {
                round_step(side_m, ((side_m * scale / least) as usize).max(2))
            }
        };
        let steps_m = [step_of(box_size.x, digits + 24.0), step_of(box_size.y, 26.0)];
        let left = digits + 12.0;
        let right = left + box_size.x * scale;
        let page_width = right + 0.5 * digits + 12.0;
        let panel = Panel::on_page(
            page_width,
            (left, right),
            TOP,
            box_size.y * scale,
            (low.x, high.x),
            (low.y, high.y),
        );
        Self { panel, page_width, scale, steps_m }
    }

    pub(super) fn width(&self) -> f64 {
        self.page_width
    }

    /// Where text below the map starts.
    pub(super) fn below(&self) -> f64 {
        self.panel.bottom() + BELOW + 12.0
    }

    /// Thickness of walls: a line, but finer on a map of many.
    pub(super) fn wall(&self) -> f64 {
        bounded(0.08 * self.scale, 0.4, 1.0)
    }

    /// A place in words, as exactly as it can be read off and typed.
    pub(super) fn coordinates(&self, [x, y]: [f64; 2]) -> String {
        let decimals = if self.scale > 20.0 { 2 } else { 1 };
        format!("{x:.decimals$},{y:.decimals$}")
    }

    /// Lines at round coordinates.
    pub(super) fn grid(&self, scene: &mut Scene) {
        let ((x0, y0), (x1, y1)) = self.panel.ranges();
        for x in multiples(x0, x1, self.steps_m[0]) {
            rule(scene, self.panel.at(x, y0), self.panel.at(x, y1), &GREY, 0.35, None);
        }
        for y in multiples(y0, y1, self.steps_m[1]) {
            rule(scene, self.panel.at(x0, y), self.panel.at(x1, y), &GREY, 0.35, None);
        }
    }

    /// The box with its numbers, names of the axes and the scale.
    pub(super) fn frame(&self, scene: &mut Scene) {
        let panel = &self.panel;
        let ((x0, y0), (x1, y1)) = panel.ranges();
        let corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1), (x0, y0)];
        for pair in corners.windows(2) {
            rule(scene, panel.at(pair[0].0, pair[0].1), panel.at(pair[1].0, pair[1].1), &INK, 1.0, None);
        }
        let [across, up] = self.steps_m.map(|step_m| (-libm::log10(step_m).floor()).max(0.0) as usize);
        for x in multiples(x0, x1, self.steps_m[0]) {
            let (at, _) = panel.at(x, y0);
            rule(scene, (at, panel.bottom()), (at, panel.bottom() + 4.0), &INK, 1.0, None);
            word(scene, (at, panel.bottom() + 16.0), TEXT_SMALL, TextAnchor::Middle, &number(x, across));
        }
        for y in multiples(y0, y1, self.steps_m[1]) {
            let (_, at) = panel.at(x0, y);
            rule(scene, (panel.left() - 4.0, at), (panel.left(), at), &INK, 1.0, None);
            word(scene, (panel.left() - 7.0, at + 3.5), TEXT_SMALL, TextAnchor::End, &number(y, up));
        }
        word(scene, (panel.left(), panel.top() - 7.0), TEXT_LABEL, TextAnchor::Middle, "y (m)");
        word(scene, (panel.right(), panel.bottom() + 31.0), TEXT_LABEL, TextAnchor::End, "x (m)");
        self.scale_bar(scene);
    }

    /// A bar of a round length, and what it stands for.
    fn scale_bar(&self, scene: &mut Scene) {
        let wanted_m = ((self.panel.right() - self.panel.left()) / 4.0).min(180.0) / self.scale;
        let length_m = round_step(wanted_m / 2.5, 1);
        let (x, y) = (self.panel.left(), self.panel.bottom() + 38.0);
        let end = x + length_m * self.scale;
        rule(scene, (x, y), (end, y), &INK, 3.0, None);
        let cell = if length_m < 1.0 { format!("{length_m:.2}") } else { format!("{length_m:.0}") };
        word(scene, (end + 6.0, y + 3.5), TEXT_LABEL, TextAnchor::Start, &format!("{cell} m"));
    }
}

/// Multiples of a step between two numbers; exact where they are far from 0.
fn multiples(low: f64, high: f64, step: f64) -> impl Iterator<Item = f64> {
    let (first, last) = ((low / step).ceil(), (high / step).floor());
    let count = bounded(last - first, -1.0, 1000.0) as i64 + 1;
    (0..count).map(move |index| (first + index as f64) * step)
}

pub(super) fn number(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    // Nobody reads a minus before nothing.
    if text.trim_start_matches('-').chars().all(|c| c == '0' || c == '.') {
        text.trim_start_matches('-').to_owned()
    } else {
        text
    }
}

fn word(scene: &mut Scene, (x, y): (f64, f64), size: u32, anchor: TextAnchor, content: &str) {
    scene.add(Primitive::Text {
        x,
        y,
        content: content.to_owned(),
        size,
        anchor,
        rotate: None,
        bold: false,
        color: Some(INK),
    });
}
