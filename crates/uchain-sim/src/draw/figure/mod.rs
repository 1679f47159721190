//! Figures of papers: boxes of axes below each other, with lines, estimates and distributions.

mod mark;

use kuva::render::render::Scene;

use super::{
    DrawError, Picture,
    panel::{FIGURE_WIDTH, Panel, TEXT_LABEL, TEXT_LARGE, text, unclip, widened},
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

/// Something in a box of axes. What has a name is in the legend, light lines aside.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Mark {
    /// A line through points.
    Line {
        /// In the legend and among the points.
        name: String,
        /// Number of the colour.
        colour: usize,
        /// How.
        stroke: Stroke,
        /// Its points.
        points: Vec<(f64, f64)>,
    },
    /// Means on a line, each with its 95 % interval.
    Estimates {
        /// In the legend.
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
    /// A dashed line right across.
    Level {
        /// In the legend.
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
    let (mut top, mut panels) = (58.0, Vec::new());
    for axes in &figure.axes {
        let (mut x_range, y_range) = ranges(&axes.marks);
        if !axes.words.is_empty() {
            x_range = (0.4, axes.words.len() as f64 + 0.6);
        }
        let panel = Panel::new(top, axes.height.max(60.0), x_range, y_range);
        let panel = match &axes.words {
            words if !words.is_empty() => panel.with_words(words.clone()),
            _ if axes.counts() => panel.with_whole_x(),
            _ => panel,
        };
        top = panel.bottom() + GAP;
        panels.push(panel);
    }
    let mut scene = Scene::new(FIGURE_WIDTH, top - GAP + 48.0);
    for (axes, panel) in figure.axes.iter().zip(&panels) {
        text(&mut scene, (panel.left(), panel.top() - 8.0), TEXT_LABEL, &axes.title);
        panel.axes(&mut scene, &axes.x, &axes.y);
        panel.clip(&mut scene);
        axes.marks.iter().for_each(|mark| mark.draw(&mut scene, panel));
        unclip(&mut scene);
        let named = axes.marks.iter().filter(|mark| mark.is_explained());
        named.enumerate().for_each(|(row, mark)| mark.explain(&mut scene, panel, row));
    }
    let left = panels.first().map_or(0.0, Panel::left);
    text(&mut scene, (left, 20.0), TEXT_LARGE, &figure.title);
    Picture::of(&scene)
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
fn ranges(marks: &[Mark]) -> ((f64, f64), (f64, f64)) {
    let points = || marks.iter().flat_map(Mark::points);
    let x = widened(points().filter_map(|(x, _)| x), 0.02);
    (x, widened(points().map(|(_, y)| y), 0.07))
}
