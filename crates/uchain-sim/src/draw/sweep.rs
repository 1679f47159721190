//! A sweep: one number of the summary over one key of the scenario.

use super::{
    DrawError, Picture,
    figure::{Axes, Figure, Mark, figure},
};
use crate::analyse::Estimate;

/// Most lines in one picture.
pub const LINES_MAX: usize = super::colour::LINES_MAX;
/// Height of the box.
const HEIGHT: f64 = 250.0;

/// What stands along the horizontal axis of a picture, and what is drawn over it.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    /// Title.
    pub title: String,
    /// Name of the vertical axis, in words.
    pub metric: String,
    /// Name of the horizontal axis, in words.
    pub key: String,
    /// The lines; those past [`LINES_MAX`] are left out.
    pub lines: Vec<Line>,
}

/// Estimates that belong together.
#[derive(Debug, Clone, PartialEq)]
pub struct Line {
    /// What it is called at its end; empty if there is nothing to tell apart.
    pub name: String,
    /// Values of the key, and what came of them.
    pub points: Vec<(f64, Estimate)>,
}

/// Draws means as dots on a line, and the 95 % interval of each as a bar.
///
/// # Errors
/// [`DrawError::Raster`].
pub fn chart(chart: &Chart) -> Result<Picture, DrawError> {
    let lines = chart.lines.iter().take(LINES_MAX).enumerate();
    let marks = lines.map(|(colour, line)| Mark::Estimates {
        name: line.name.clone(),
        colour,
        points: line.points.clone(),
    });
    let axes = Axes {
        x: chart.key.clone(),
        y: chart.metric.clone(),
        height: HEIGHT,
        marks: marks.collect(),
        ..Axes::default()
    };
    figure(&Figure { title: chart.title.clone(), axes: vec![axes] })
}
