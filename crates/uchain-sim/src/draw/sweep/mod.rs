//! A sweep: one number of the summary over one key of the scenario.

use kuva::render::render::Scene;

use super::{
    DrawError, Picture, colour,
    panel::{FIGURE_WIDTH, Panel, TEXT_LARGE, dot, legend, rule, text, widened},
};
use crate::analyse::Estimate;

/// Most lines in one picture.
pub const LINES_MAX: usize = 8;
/// Height of the box.
const HEIGHT: f64 = 250.0;
/// Longest name in the legend (characters).
const NAME_MAX: usize = 17;

/// What stands along the horizontal axis of a picture, and what is drawn over it.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart<'a> {
    /// Title.
    pub title: String,
    /// Name of the vertical axis.
    pub metric: &'a str,
    /// Name of the horizontal axis.
    pub key: &'a str,
    /// The lines; those past [`LINES_MAX`] are left out.
    pub lines: Vec<Line>,
}

/// Estimates that belong together.
#[derive(Debug, Clone, PartialEq)]
pub struct Line {
    /// What the legend calls it; empty if there is nothing to tell apart.
    pub name: String,
    /// Values of the key, and what came of them.
    pub points: Vec<(f64, Estimate)>,
}

/// Draws means as dots on a line, and the 95 % interval of each as a bar.
///
/// # Errors
/// [`DrawError::Raster`].
pub fn chart(chart: &Chart<'_>) -> Result<Picture, DrawError> {
    let lines = || chart.lines.iter().take(LINES_MAX);
    let points = || lines().flat_map(|line| &line.points);
    let x_range = widened(points().map(|(x, _)| *x), 0.04);
    let y_range = widened(points().flat_map(|(_, y)| <[f64; 2]>::from(y.interval())), 0.08);
    let panel = Panel::new(42.0, HEIGHT, x_range, y_range);
    let mut scene = Scene::new(FIGURE_WIDTH, panel.bottom() + 48.0);
    text(&mut scene, (panel.left(), 20.0), TEXT_LARGE, &chart.title);
    panel.axes(&mut scene, chart.key, chart.metric);
    for (row, line) in lines().enumerate() {
        let ink = colour::of_uav(row, LINES_MAX);
        panel.line(&mut scene, line.points.iter().map(|(x, y)| Some((*x, y.mean))), &ink, 1.4);
        for (x, estimate) in &line.points {
            let (low, high) = estimate.interval();
            rule(&mut scene, panel.at(*x, low), panel.at(*x, high), &ink, 1.2, None);
            for end in [low, high] {
                let (x, y) = panel.at(*x, end);
                rule(&mut scene, (x - 3.0, y), (x + 3.0, y), &ink, 1.2, None);
            }
            dot(&mut scene, panel.at(*x, estimate.mean), 2.6, &ink, &ink);
        }
        if !line.name.is_empty() {
            let at = legend(&mut scene, &panel, row, &short(&line.name));
            dot(&mut scene, at, 2.6, &ink, &ink);
        }
    }
    Picture::of(&scene)
}

fn short(name: &str) -> String {
    if name.chars().count() <= NAME_MAX {
        return name.to_owned();
    }
    name.chars().take(NAME_MAX - 1).chain(['…']).collect()
}
