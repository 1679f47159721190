//! What is in a box of axes, drawn and in words.

use kuva::render::{color::Color, render::Scene};

use super::{Axes, Known, Mark, Stroke};
use crate::{
    analyse::Estimate,
    draw::{
        colour::{self, GREY},
        loss,
        name::Ending,
        panel::{Panel, dot, rule},
    },
};

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
            Self::Line { name, .. }
            | Self::Loss { name, .. }
            | Self::Estimates { name, .. }
            | Self::Level { name, .. } => name,
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
            Self::Line { name, points, .. } | Self::Loss { name, points, .. } => {
                points.iter().map(|(x, y)| row(name, *x, *y)).collect()
            }
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

    fn ink(&self) -> Color {
        match self {
            Self::Line { colour, stroke: Stroke::Light, .. } => colour::light_of_uav(*colour),
            Self::Line { colour, .. }
            | Self::Estimates { colour, .. }
            | Self::Distribution { colour, .. } => colour::of_uav(*colour),
            Self::Loss { uav, .. } => colour::of_uav(*uav),
            Self::Level { .. } => GREY,
        }
    }

    /// Its name at its right end. Of what is known of a link's loss only one has it: `all` are in the box.
    pub(super) fn ending(&self, panel: &Panel, all: &[Self]) -> Option<Ending> {
        let (at, words) = match self {
            Self::Distribution { .. } => return None,
            Self::Line { points, .. } => (*points.last()?, self.name().to_owned()),
            Self::Estimates { points, .. } => {
                let (x, estimate) = points.last()?;
                ((*x, estimate.mean), self.name().to_owned())
            }
            Self::Loss { uav, known, points, .. } => {
                let is_better = |other: &Self| matches!(other, Self::Loss { uav: u, known: k, points, .. } if u == uav && *k == Known::Filtered && !points.is_empty());
                if *known == Known::Raw || (*known == Known::True && all.iter().any(is_better)) {
                    return None;
                }
                let head = if *uav == 0 { ", head" } else { "" };
                (*points.last()?, format!("UAV {uav}{head}"))
            }
            Self::Level { y, .. } => {
                let (_, y) = panel.at(0.0, *y);
                return Some(Ending { at: (panel.right(), y), words: self.name().to_owned(), colour: GREY });
            }
        };
        (!words.is_empty()).then(|| Ending { at: panel.at(at.0, at.1), words, colour: self.ink() })
    }

    /// What must be seen of it.
    pub(super) fn points(&self) -> Vec<(Option<f64>, f64)> {
        match self {
            Self::Line { points, .. } | Self::Loss { points, .. } => {
                points.iter().map(|(x, y)| (Some(*x), *y)).collect()
            }
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
                let values = points.iter().copied().map(Some);
                match stroke {
                    Stroke::Dashed => loss::dashed_line(scene, panel, values, &ink, 1.7),
                    Stroke::Solid => panel.line(scene, values, &ink, 1.5),
                    Stroke::Light => panel.line(scene, values, &ink, 0.8),
                }
            }
            Self::Loss { uav, known, points, .. } => {
                loss::series(scene, panel, *known, *uav, points.iter().copied().map(Some));
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
            Self::Level { y, .. } => loss::threshold(scene, panel, *y),
        }
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
