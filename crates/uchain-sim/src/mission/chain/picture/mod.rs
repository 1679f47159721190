//! Pictures of a chain: a run on one page, and a plan.

mod losses;
mod plan;
mod tunnel;

use kuva::render::render::Scene;

use super::{Course, History, Plan, Summary};
use crate::draw::{
    DrawError, FIGURE_WIDTH, LINE, LONGEST, LONGEST_HEADLINE, Panel, Picture, TEXT_LABEL, TEXT_LARGE, panel,
    raster, wrapped,
};
use losses::Losses;
use tunnel::Tunnel;

/// One run on one page, as a PNG 1400 px wide. Above: the loss of every link over time (solid = true,
/// thin = as the filter sees it), the threshold `s_min`, the launches (after Laclau 2021, Fig. 4D).
/// Below: the map at equal aspect, cropped to where the UAVs flew, with their tracks; its axes are in
/// the map file's own frame.
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
    let top = 42.0 + LINE * lines.len().saturating_sub(1) as f64;
    let losses_panel = Panel::new(top, losses.height(), losses.x_range(), losses.y_range());
    let tunnel = Tunnel::new(course, history, summary);
    let tunnel_panel = tunnel.panel(losses_panel.bottom() + 58.0);

    let mut scene = Scene::new(FIGURE_WIDTH, tunnel_panel.bottom() + 44.0);
    for (i, line) in lines.iter().enumerate() {
        panel::text(&mut scene, (losses_panel.left(), 20.0 + LINE * i as f64), TEXT_LARGE, line);
    }
    losses.draw(&mut scene, &losses_panel);
    tunnel.draw(&mut scene, &tunnel_panel);
    scene
}

/// A plan on one page, as a PNG 1400 px wide: relays needed, loss of the worst link of the best chain, and time,
/// each against the depth of the head. The scenario's name stands above, with the `answer` below it.
///
/// # Errors
/// [`DrawError::Raster`].
pub fn plan_png(plan: &Plan, answer: &str) -> Result<Vec<u8>, DrawError> {
    let lines = wrapped(answer, LONGEST);
    let sheet = plan::Sheet::new(plan, 34.0 + LINE * lines.len() as f64);
    let mut scene = Scene::new(FIGURE_WIDTH, sheet.bottom() + 44.0);
    panel::text(&mut scene, (sheet.left(), 18.0), TEXT_LARGE, &plan.scenario);
    for (i, line) in lines.iter().enumerate() {
        panel::text(&mut scene, (sheet.left(), 36.0 + LINE * i as f64), TEXT_LABEL, line);
    }
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
