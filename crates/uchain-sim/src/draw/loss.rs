//! How losses over time are drawn, wherever they are: what the filter makes of a link, what is true, what is measured.

use kuva::render::{
    color::Color,
    render::{PathData, Primitive, Scene},
};

use super::{
    colour::{self, FREE, GREY, INK},
    name::{Ending, key::Entry},
    panel::{Panel, rule},
};

/// What is known of a link's loss.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Known {
    /// Each sample as measured: dots.
    Raw,
    /// As the filter sees it: a solid line.
    Filtered,
    /// Without noise: dashed.
    True,
}

/// Thickness of a solid line, and of a dashed one.
const SOLID: f64 = 2.0;
const DASHED: f64 = 1.4;
/// Thickness of the light edge of dashes.
const HALO: f64 = 2.4;
/// Length of a dash, and of a dash with the gap that follows.
const ON: f64 = 5.0;
const PERIOD: f64 = 8.0;
/// Radius and opacity of a dot.
const DOT: f64 = 1.2;
const DOT_OPACITY: f64 = 0.35;
/// Pattern of the threshold's line.
const THRESHOLD: &str = "1 4";

/// Draws one series of a UAV's link; a gap wherever a value is missing.
pub(crate) fn series(
    scene: &mut Scene,
    panel: &Panel,
    known: Known,
    uav: usize,
    values: impl Iterator<Item = Option<(f64, f64)>>,
) {
    let ink = colour::of_uav(uav);
    match known {
        Known::Filtered => panel.line(scene, values, &ink, SOLID),
        Known::True => {
            // Seen on the solid line of the same colour, too.
            let values: Vec<Option<(f64, f64)>> = values.collect();
            dashed_line(scene, panel, values.iter().copied(), &FREE, HALO);
            dashed_line(scene, panel, values.into_iter(), &ink, DASHED);
        }
        Known::Raw => {
            let (cx, cy) = values.flatten().map(|(x, y)| panel.at(x, y)).unzip();
            scene.add(dots(cx, cy, ink));
        }
    }
}

/// A dashed line through values; a gap wherever a value is missing.
pub(crate) fn dashed_line(
    scene: &mut Scene,
    panel: &Panel,
    values: impl Iterator<Item = Option<(f64, f64)>>,
    ink: &Color,
    width: f64,
) {
    let mut points = Vec::new();
    for value in values.chain([None]) {
        match value {
            Some((x, y)) => points.push(panel.at(x, y)),
            None => dashed(scene, std::mem::take(&mut points).into_iter(), ink, width),
        }
    }
}

/// A line across the box at the threshold of a launch.
pub(crate) fn threshold(scene: &mut Scene, panel: &Panel, s_min_db: f64) {
    let (_, y) = panel.at(0.0, s_min_db);
    rule(scene, (panel.left(), y), (panel.right(), y), &GREY, 1.2, Some(THRESHOLD));
}

/// The threshold's name, at the end of its line.
pub(crate) fn threshold_ending(panel: &Panel, s_min_db: f64) -> Ending {
    let (_, y) = panel.at(0.0, s_min_db);
    Ending { at: (panel.right(), y), words: threshold_words(s_min_db), colour: GREY }
}

fn threshold_words(s_min_db: f64) -> String {
    format!("s_min {s_min_db} dB")
}

/// The threshold in a key, where boxes are too narrow for its name.
pub(crate) fn threshold_entry(s_min_db: f64) -> Entry {
    Entry::new(&threshold_words(s_min_db), move |scene, (x, y)| {
        rule(scene, (x - 9.0, y), (x + 9.0, y), &GREY, 1.2, Some(THRESHOLD));
    })
}

/// How lines are told apart, of those that are drawn.
pub(crate) fn entries(drawn: &[Known]) -> Vec<Entry> {
    let words = [(Known::Filtered, "filtered"), (Known::True, "true"), (Known::Raw, "raw, as measured")];
    let drawn = words.into_iter().filter(|(known, _)| drawn.contains(known));
    drawn
        .map(|(known, words)| {
            Entry::new(words, move |scene, (x, y)| match known {
                Known::Filtered => rule(scene, (x - 9.0, y), (x + 9.0, y), &INK, SOLID, None),
                Known::True => dashed(scene, [(x - 9.0, y), (x + 9.0, y)].into_iter(), &INK, DASHED),
                Known::Raw => scene.add(dots(
                    [-8.0, -4.0, 0.0, 4.0, 8.0].map(|aside| x + aside).to_vec(),
                    [1.0, -2.0, 2.0, -1.0, 0.5].map(|aside| y + aside).to_vec(),
                    INK,
                )),
            })
        })
        .collect()
}

fn dots(cx: Vec<f64>, cy: Vec<f64>, fill: Color) -> Primitive {
    let fill_opacity = Some(DOT_OPACITY);
    Primitive::CircleBatch { cx, cy, r: DOT, fill, fill_opacity, stroke: None, stroke_width: None }
}

/// Dashes along points of the page. The raster's own pattern begins anew at every point, and dense points leave none of it.
fn dashed(scene: &mut Scene, mut points: impl Iterator<Item = (f64, f64)>, ink: &Color, width: f64) {
    use std::fmt::Write as _;
    let Some(mut at) = points.next() else { return };
    let (mut d, mut along, mut is_down) = (String::new(), 0.0, false);
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
            let ((x, y), (end_x, end_y)) = (place(done), place(done + step));
            // Writing to a String cannot fail.
            if is_on && !is_down {
                let _ = write!(d, "M{x:.1} {y:.1}");
            }
            if is_on {
                let _ = write!(d, "L{end_x:.1} {end_y:.1}");
            }
            is_down = is_on;
            done += step;
        }
        (along, at) = (along + length, to);
    }
    if !d.is_empty() {
        let path = PathData {
            d,
            fill: None,
            stroke: ink.clone(),
            stroke_width: width,
            opacity: None,
            stroke_dasharray: None,
        };
        scene.add(Primitive::Path(Box::new(path)));
    }
}
