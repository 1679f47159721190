//! What is in a box of axes, drawn and in words.

use kuva::render::{color::Color, render::Scene};

use super::{Axes, Mark, Stroke};
use crate::{
    analyse::Estimate,
    draw::{
        colour::{self, GREY, INK},
        panel::{Panel, dot, legend, rule},
    },
};

/// Most colours.
const COLOURS: usize = 8;
/// Half of the width of a distribution's box, in units of the axis.
const HALF_BOX: f64 = 0.28;

/// The value below which a share of sorted values lies.
fn quantile(sorted: &[f64], share: f64) -> f64 {
    let place = share * sorted.len().saturating_sub(1) as f64;
    let at = |index: f64| sorted.get(index as usize).copied().unwrap_or(f64::NAN);
    let (low, high) = (at(place.floor()), at(place.ceil()));
    low + (place - place.floor()) * (high - low)
}

impl Mark {
    pub(super) fn name(&self) -> &str {
        match self {
            Self::Line { name, .. } | Self::Estimates { name, .. } | Self::Level { name, .. } => name,
            Self::Distribution { .. } => "",
        }
    }

    /// Its points in words: series, x, y, low, high.
    pub(super) fn rows(&self, axes: &Axes) -> Vec<[String; 5]> {
        // No more digits than every computer agrees on.
        let number = |value: f64| format!("{value:.6}");
        let word = |x: f64| match axes.words.get((x.round() as usize).wrapping_sub(1)) {
            Some(word) => word.clone(),
            None => number(x),
        };
        let row = |series: &str, x: f64, y: f64| {
            [series.to_owned(), word(x), number(y), String::new(), String::new()]
        };
        match self {
            Self::Line { name, points, .. } => points.iter().map(|(x, y)| row(name, *x, *y)).collect(),
            Self::Estimates { name, points, .. } => points
                .iter()
                .map(|(x, estimate)| {
                    let (low, high) = estimate.interval();
                    [name.clone(), word(*x), number(estimate.mean), number(low), number(high)]
                })
                .collect(),
            Self::Distribution { at, values, .. } => {
                values.iter().map(|value| row(&word(*at), *at, *value)).collect()
            }
            Self::Level { .. } => Vec::new(),
        }
    }

    /// Has a row of the legend.
    pub(super) fn is_explained(&self) -> bool {
        !self.name().is_empty() && !matches!(self, Self::Line { stroke: Stroke::Light, .. })
    }

    fn ink(&self) -> Color {
        match self {
            Self::Line { colour, stroke: Stroke::Light, .. } => colour::of_estimate(*colour, COLOURS),
            Self::Line { colour, .. }
            | Self::Estimates { colour, .. }
            | Self::Distribution { colour, .. } => colour::of_uav(*colour, COLOURS),
            Self::Level { .. } => INK,
        }
    }

    /// What must be seen of it.
    pub(super) fn points(&self) -> Vec<(Option<f64>, f64)> {
        match self {
            Self::Line { points, .. } => points.iter().map(|(x, y)| (Some(*x), *y)).collect(),
            Self::Estimates { points, .. } => {
                let ends =
                    |(x, y): &(f64, Estimate)| <[f64; 2]>::from(y.interval()).map(|end| (Some(*x), end));
                points.iter().flat_map(ends).collect()
            }
            Self::Distribution { at, values, .. } => values.iter().map(|y| (Some(*at), *y)).collect(),
            Self::Level { y, .. } => vec![(None, *y)],
        }
    }

    pub(super) fn draw(&self, scene: &mut Scene, panel: &Panel) {
        let ink = self.ink();
        match self {
            Self::Line { stroke, points, .. } => {
                let on_page = || points.iter().map(|(x, y)| panel.at(*x, *y));
                match stroke {
                    Stroke::Dashed => dashed(scene, on_page(), &ink),
                    Stroke::Solid => panel.line(scene, points.iter().copied().map(Some), &ink, 1.3),
                    Stroke::Light => panel.line(scene, points.iter().copied().map(Some), &ink, 0.8),
                }
            }
            Self::Estimates { points, .. } => {
                panel.line(scene, points.iter().map(|(x, y)| Some((*x, y.mean))), &ink, 1.4);
                for (x, estimate) in points {
                    let (low, high) = estimate.interval();
                    rule(scene, panel.at(*x, low), panel.at(*x, high), &ink, 1.2, None);
                    for end in [low, high] {
                        let (x, y) = panel.at(*x, end);
                        rule(scene, (x - 3.0, y), (x + 3.0, y), &ink, 1.2, None);
                    }
                    dot(scene, panel.at(*x, estimate.mean), 2.6, &ink, &ink);
                }
            }
            Self::Distribution { at, values, .. } => distribution(scene, panel, *at, values, &ink),
            Self::Level { y, .. } => {
                let (_, y) = panel.at(0.0, *y);
                rule(scene, (panel.left(), y), (panel.right(), y), &ink, 1.0, Some("6 4"));
            }
        }
    }

    pub(super) fn explain(&self, scene: &mut Scene, panel: &Panel, row: usize) {
        let (x, y) = legend(scene, panel, row, self.name());
        let dash = match self {
            Self::Level { .. } => Some("6 4"),
            Self::Line { stroke: Stroke::Dashed, .. } => Some("5 3"),
            _ => None,
        };
        rule(scene, (x - 8.0, y), (x + 8.0, y), &self.ink(), 1.8, dash);
    }
}

/// A line of dashes. The raster's own pattern begins anew at every point, and dense points leave none of it.
fn dashed(scene: &mut Scene, mut points: impl Iterator<Item = (f64, f64)>, ink: &Color) {
    const ON: f64 = 5.0;
    const PERIOD: f64 = 8.0;
    let Some(mut at) = points.next() else { return };
    let mut along = 0.0;
    for to in points {
        let (dx, dy) = (to.0 - at.0, to.1 - at.1);
        let length = libm::hypot(dx, dy);
        if !length.is_finite() {
            continue;
        }
        let mut done = 0.0;
        while done < length {
            let phase = (along + done) % PERIOD;
            let is_on = phase < ON;
            // Never less than a bit, or rounding stops it.
            let step = (if is_on { ON } else { PERIOD } - phase).max(0.01).min(length - done);
            let place = |share: f64| (at.0 + dx * share / length, at.1 + dy * share / length);
            if is_on {
                rule(scene, place(done), place(done + step), ink, 1.7, None);
            }
            done += step;
        }
        (along, at) = (along + length, to);
    }
}

fn distribution(scene: &mut Scene, panel: &Panel, at: f64, values: &[f64], ink: &Color) {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    if sorted.is_empty() {
        return;
    }
    let [low, first, middle, third, high] = [0.0, 0.25, 0.5, 0.75, 1.0].map(|share| quantile(&sorted, share));
    let mut line = |a: (f64, f64), b: (f64, f64), width| {
        rule(scene, panel.at(a.0, a.1), panel.at(b.0, b.1), ink, width, None);
    };
    let (left, right) = (at - HALF_BOX, at + HALF_BOX);
    for y in [first, third] {
        line((left, y), (right, y), 1.3);
    }
    for x in [left, right] {
        line((x, first), (x, third), 1.3);
    }
    line((left, middle), (right, middle), 2.6);
    line((at, low), (at, first), 1.0);
    line((at, third), (at, high), 1.0);
    for (i, value) in values.iter().enumerate() {
        // Side by side, so that equal ones show.
        let aside = (i % 9) as f64 / 9.0 - 0.45;
        dot(scene, panel.at(at + 0.4 * aside, *value), 1.4, &GREY, &GREY);
    }
}
