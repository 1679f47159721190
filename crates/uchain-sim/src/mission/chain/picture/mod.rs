//! Pictures of a chain: a run on one page, and a plan.

mod everywhere;
mod losses;
mod places;
mod plan;
mod region;
mod tunnel;

use kuva::render::render::Scene;

use super::{Course, History, Plan, Summary};
use crate::draw::{
    DrawError, FIGURE_WIDTH, LEFT, LINE, LONGEST, LONGEST_HEADLINE, Panel, Picture, TEXT_LABEL, TEXT_LARGE,
    panel, raster, wrapped,
};
pub use everywhere::everywhere_png;
use losses::Losses;
use places::Places;
use tunnel::Tunnel;

/// One run on one page, as a PNG 1400 px wide. Above: the loss of every link over time (solid = as the filter sees it,
/// dashed = true, dots = as measured), the threshold `s_min`, the launches (after Laclau 2021, Fig. 4D); with more than six
/// UAVs in small boxes. Below: the whole tunnel at equal aspect with tracks, links coloured by loss against `s_min`, and every
/// UAV's number; where they flew once more, if that is a small part of it. Its axes are in the map file's own frame.
///
/// # Errors
/// [`DrawError::Raster`].
pub fn run_png(course: &Course, history: &History, summary: &Summary) -> Result<Vec<u8>, DrawError> {
    raster(&run_scene(course, history, summary))
}

/// The same, as a drawing too.
///
/// # Errors
/// [`DrawError::Raster`].
pub fn run_picture(course: &Course, history: &History, summary: &Summary) -> Result<Picture, DrawError> {
    Picture::of(&run_scene(course, history, summary))
}

fn run_scene(course: &Course, history: &History, summary: &Summary) -> Scene {
    let losses = Losses::new(course, history, summary);
    // The seed of a sweep's run is a long number.
    let lines = wrapped(&headline(summary), LONGEST_HEADLINE);
    let top = 26.0 + LINE * lines.len().saturating_sub(1) as f64 + losses.above();
    let boxes = losses.panels(top);
    let tunnel = Tunnel::new(course, history, summary);
    let maps = tunnel.panels(boxes.last().map_or(top, Panel::bottom) + 66.0);

    let mut scene = Scene::new(FIGURE_WIDTH, maps.last().map_or(top, Panel::bottom) + 44.0);
    for (i, line) in lines.iter().enumerate() {
        panel::text(&mut scene, (LEFT, 20.0 + LINE * i as f64), TEXT_LARGE, line);
    }
    losses.draw(&mut scene, &boxes);
    tunnel.draw(&mut scene, &maps);
    scene
}

/// A plan on one page, as a PNG 1400 px wide. Above: the map with base, goal, the relays where they are best and their links
/// coloured by what is left to `s_min`; the way in once more, if that is a small part of it. Below: relays needed, loss of the
/// worst link of the best chain, and time, each against the depth of the head. The scenario's name stands above all, with the
/// `answer` below it.
///
/// # Errors
/// [`DrawError::Raster`].
pub fn plan_png(course: &Course, plan: &Plan, answer: &str) -> Result<Vec<u8>, DrawError> {
    let lines = wrapped(answer, LONGEST);
    let places = Places::new(course, plan);
    let maps = places.panels(50.0 + LINE * lines.len() as f64);
    let sheet = plan::Sheet::new(plan, maps.last().map_or(50.0, Panel::bottom) + 58.0);
    let mut scene = Scene::new(FIGURE_WIDTH, sheet.bottom() + 44.0);
    panel::text(&mut scene, (sheet.left(), 18.0), TEXT_LARGE, &plan.scenario);
    for (i, line) in lines.iter().enumerate() {
        panel::text(&mut scene, (sheet.left(), 36.0 + LINE * i as f64), TEXT_LABEL, line);
    }
    places.draw(&mut scene, &maps);
    sheet.draw(&mut scene);
    raster(&scene)
}

fn headline(summary: &Summary) -> String {
    use std::fmt::Write as _;
    let Summary { scenario, seed, verdict, .. } = summary;
    let mut line = format!("{scenario}, seed {seed}: {}: {verdict}", verdict.outcome().word());
    if let Some(spread_db) = summary.spread_db {
        // Writing to a String cannot fail.
        let _ = write!(line, "; spread {spread_db:.1} dB at the end");
    }
    let contacts = summary.wall_contacts + summary.uav_contacts;
    if contacts > 0 {
        let _ = write!(line, "; {contacts} contact{}", if contacts == 1 { "" } else { "s" });
    }
    line
}

#[cfg(test)]
mod tests;
