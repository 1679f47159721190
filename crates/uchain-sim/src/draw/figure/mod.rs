//! Figures of papers: boxes of axes below each other, with lines, estimates and distributions.

mod mark;

use kuva::render::render::Scene;

pub use super::loss::Known;
use super::{
    DrawError, LINE, LONGEST, LONGEST_HEADLINE, Picture, loss,
    name::{key, name_ends},
    panel::{FIGURE_WIDTH, LEFT, Panel, TEXT_LABEL, TEXT_LARGE, text, unclip, widened},
    wrapped,
};
use crate::analyse::Estimate;

/// From the bottom of a box of axes to the top of the next one.
const GAP: f64 = 66.0;

/// Boxes of axes below each other.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Stands above all.
    pub title: String,
    /// From above.
    pub axes: Vec<Axes>,
}

/// One box of axes.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Axes {
    /// Stands above it.
    pub title: String,
    /// Name of the horizontal axis.
    pub x: String,
    /// Name of the vertical axis.
    pub y: String,
    /// Words at 1, 2, 3 and so on of the horizontal axis; numbers if there are none.
    pub words: Vec<String>,
    /// Height of the box (px of the SVG; less than 60 counts as 60).
    pub height: f64,
    /// Places that are shown in any case, so that boxes may have the same axes.
    pub shown: Option<[(f64, f64); 2]>,
    /// What is in it.
    pub marks: Vec<Mark>,
}

/// How a line is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stroke {
    /// Thick.
    Solid,
    /// Thin and light, in the background.
    Light,
    /// Dashed.
    Dashed,
}

/// Something in a box of axes. What has a name has it at its right end.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Mark {
    /// A line through points.
    Line {
        /// At its end and among the points.
        name: String,
        /// Number of the colour.
        colour: usize,
        /// How.
        stroke: Stroke,
        /// Its points.
        points: Vec<(f64, f64)>,
    },
    /// What is known of the loss of the link toward the base of a UAV, over time, as every picture draws it.
    Loss {
        /// Among the points.
        name: String,
        /// Whose link.
        uav: usize,
        /// What of it.
        known: Known,
        /// Its points.
        points: Vec<(f64, f64)>,
    },
    /// Means on a line, each with its 95 % interval.
    Estimates {
        /// At its end.
        name: String,
        /// Number of the colour.
        colour: usize,
        /// Where, and what.
        points: Vec<(f64, Estimate)>,
    },
    /// Median, quartiles, extremes, and every value as a dot.
    Distribution {
        /// Number of the colour.
        colour: usize,
        /// Where on the horizontal axis.
        at: f64,
        /// The values.
        values: Vec<f64>,
    },
    /// A thin line right across, as at the threshold of a launch.
    Level {
        /// At its end.
        name: String,
        /// Where.
        y: f64,
    },
}

/// Draws a figure.
///
/// # Errors
/// [`DrawError::Raster`].
pub fn figure(figure: &Figure) -> Result<Picture, DrawError> {
    Picture::of(&scene(figure))
}

pub(crate) fn scene(figure: &Figure) -> Scene {
    let marks = || figure.axes.iter().flat_map(|axes| &axes.marks);
    let is_drawn =
        |known: &Known| marks().any(|mark| matches!(mark, Mark::Loss { known: of, .. } if of == known));
    let drawn: Vec<Known> = [Known::Filtered, Known::True, Known::Raw].into_iter().filter(is_drawn).collect();
    let (titles, entries) = (wrapped(&figure.title, LONGEST_HEADLINE), loss::entries(&drawn));
    let (left, below_title) = (LEFT - 8.0, 26.0 + LINE * titles.len().saturating_sub(1) as f64);
    let mut top = below_title + key::height(&entries, left) + 24.0;
    let mut panels: Vec<Panel> = Vec::new();
    for axes in &figure.axes {
        let (mut x_range, y_range) = ranges(axes);
        if !axes.words.is_empty() {
            x_range = (0.4, axes.words.len() as f64 + 0.6);
        }
        let panel = Panel::new(top, axes.height.max(60.0), x_range, y_range);
        let panel = match &axes.words {
            words if !words.is_empty() => panel.with_words(words.clone()),
            _ if axes.counts() => panel.with_x_step(1.0),
            _ => panel,
        };
        top = panel.bottom() + GAP;
        panels.push(panel);
    }
    let notes: Vec<String> = notes(&marks).iter().flat_map(|note| wrapped(note, LONGEST)).collect();
    let below = top - GAP + if notes.is_empty() { 44.0 } else { 58.0 };
    let mut scene = Scene::new(FIGURE_WIDTH, below + LINE * notes.len() as f64);
    for (axes, panel) in figure.axes.iter().zip(&panels) {
        text(&mut scene, (panel.left(), panel.top() - 8.0), TEXT_LABEL, &axes.title);
        panel.axes(&mut scene, &axes.x, &axes.y);
        panel.clip(&mut scene);
        axes.marks.iter().for_each(|mark| mark.draw(&mut scene, panel));
        unclip(&mut scene);
        let endings = axes.marks.iter().filter_map(|mark| mark.ending(panel, &axes.marks)).collect();
        name_ends(&mut scene, panel, endings);
    }
    for (i, title) in titles.iter().enumerate() {
        text(&mut scene, (LEFT, 20.0 + LINE * i as f64), TEXT_LARGE, title);
    }
    key::draw(&mut scene, (left, below_title), &entries);
    for (i, note) in notes.iter().enumerate() {
        text(&mut scene, (LEFT, below + LINE * i as f64), TEXT_LABEL, note);
    }
    scene
}

/// What stands below: what bars and boxes mean.
fn notes<'a, I: Iterator<Item = &'a Mark>>(marks: &impl Fn() -> I) -> Vec<String> {
    let mut notes = Vec::new();
    let estimates = || {
        marks().flat_map(|mark| match mark {
            Mark::Estimates { points, .. } => points.as_slice(),
            _ => &[],
        })
    };
    if estimates().any(|(_, estimate)| estimate.half_width.is_some()) {
        let is_cut = |estimate: &Estimate| {
            estimate.is_never_negative && estimate.half_width.is_some_and(|half| half > estimate.mean)
        };
        let cut = if estimates().any(|(_, estimate)| is_cut(estimate)) {
            ", cut at 0, below which no mean is"
        } else {
            ""
        };
        notes.push(format!("Dots are means, bars their 95 % intervals by Student's t{cut}."));
    }
    if marks().any(|mark| matches!(mark, Mark::Distribution { .. })) {
        notes.push("Boxes are medians, quartiles and extremes; every dot is a run.".to_owned());
    }
    notes
}

impl Axes {
    /// Few whole numbers are counts; nothing lies between them.
    fn counts(&self) -> bool {
        const MOST: f64 = 12.0;
        let xs = || self.marks.iter().flat_map(Mark::points).filter_map(|(x, _)| x);
        let (low, high) = xs().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
        xs().all(|x| x.fract() == 0.0) && high - low <= MOST
    }
}

impl Figure {
    /// Every point of every box: its box, its series, x, y, and the ends of y's interval where it has one.
    pub fn points(&self) -> Vec<[String; 6]> {
        let mut rows = Vec::new();
        for (number, axes) in self.axes.iter().enumerate() {
            let place = if axes.title.is_empty() { axes.y.clone() } else { axes.title.clone() };
            let place = if place.is_empty() { number.to_string() } else { place };
            for mark in &axes.marks {
                rows.extend(
                    mark.rows(axes)
                        .into_iter()
                        .map(|[series, x, y, low, high]| [place.clone(), series, x, y, low, high]),
                );
            }
        }
        rows
    }
}

/// Room for all marks, and a little more.
fn ranges(axes: &Axes) -> ((f64, f64), (f64, f64)) {
    let shown = || axes.shown.iter().flatten().map(|(x, y)| (Some(*x), *y));
    let points = || axes.marks.iter().flat_map(Mark::points).chain(shown());
    let x = widened(points().filter_map(|(x, _)| x), 0.02);
    let (low, high) = widened(points().map(|(_, y)| y), 0.07);
    // Of what is never below 0 the axis says nothing below it, but for room for dots that lie there.
    let is_below = low < 0.0 && points().any(|(_, y)| y < 0.0);
    (x, (if is_below { low } else { low.max(-0.07 * high.abs()) }, high))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draw::said;

    #[test]
    fn an_axis_of_counts_has_no_number_below_0() {
        let has_minus = |counts: &[f64]| {
            let estimate = |count: &f64| Estimate::of_never_negative(&[*count, 0.0, 0.0]);
            let places = (10..).map(f64::from);
            let points = places.zip(counts.iter().filter_map(estimate)).collect();
            let marks = vec![Mark::Estimates { name: String::new(), colour: 0, points }];
            let drawn = Figure { title: String::new(), axes: vec![Axes { marks, ..Axes::default() }] };
            said::words(&scene(&drawn)).iter().any(|words| words.starts_with('-'))
        };
        assert!(!has_minus(&[0.0]));
        assert!(!has_minus(&[0.0, 1.0, 9.0]));
        assert!(has_minus(&[0.0, -9.0]), "what is below 0 is shown");
    }
}
