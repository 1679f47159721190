//! One exploration on one page.

mod graph;
mod stars;
mod states;
mod time;

use glam::DVec2;
use kuva::render::render::Scene;
use uchain_core::bounded;

use crate::draw::{
    DrawError, LINE, LONGEST_HEADLINE, Picture,
    panel::{self, BOX_WIDTH, FIGURE_WIDTH, Panel, TEXT_LABEL, TEXT_LARGE},
    raster, wrapped,
};
use crate::mission::explore::{ExploreHistory, ExploreSummary, Site, Survey};

pub use states::states_png;

/// Lowest and highest box of a map.
const HEIGHTS: (f64, f64) = (160.0, 620.0);
/// Room around the map, as a share of its size.
const MARGIN_SHARE: f64 = 0.02;
/// Height of the box over time.
const TIME_HEIGHT: f64 = 150.0;

/// What is drawn.
struct Sheet<'a> {
    site: &'a Site,
    history: &'a ExploreHistory,
    survey: &'a Survey,
    summary: &'a ExploreSummary,
}

/// One exploration on one page, as a PNG 1400 px wide (after Kim 2021, Fig. 9). Above: the map with the stars of all
/// nodes, frontiers that are left, each robot's way and start, and what nobody saw. Middle: nodes and roadmap. Below:
/// coverage over time. The axes are in the frame of the map's file or scenario.
///
/// # Errors
/// [`DrawError::Raster`].
pub fn explore_png(
    site: &Site,
    history: &ExploreHistory,
    survey: &Survey,
    summary: &ExploreSummary,
) -> Result<Vec<u8>, DrawError> {
    raster(&Sheet { site, history, survey, summary }.scene())
}

/// The same, as a drawing too.
///
/// # Errors
/// [`DrawError::Raster`].
pub fn explore_picture(
    site: &Site,
    history: &ExploreHistory,
    survey: &Survey,
    summary: &ExploreSummary,
) -> Result<Picture, DrawError> {
    Picture::of(&Sheet { site, history, survey, summary }.scene())
}

impl Sheet<'_> {
    fn scene(&self) -> Scene {
        let lines = wrapped(&headline(self.summary), LONGEST_HEADLINE);
        let more = LINE * lines.len().saturating_sub(1) as f64;
        let above = self.panel(64.0 + more);
        let middle = self.panel(above.bottom() + 52.0);
        let below = self.time_panel(middle.bottom() + 58.0);
        let mut scene = Scene::new(FIGURE_WIDTH, below.bottom() + 44.0);
        for (i, line) in lines.iter().enumerate() {
            panel::text(&mut scene, (above.left(), 20.0 + LINE * i as f64), TEXT_LARGE, line);
        }
        panel::text(&mut scene, (above.left(), 38.0 + more), TEXT_LABEL, &self.figures());
        self.draw_stars(&mut scene, &above);
        self.draw_graph(&mut scene, &middle);
        self.draw_time(&mut scene, &below);
        scene
    }

    fn figures(&self) -> String {
        let summary = self.summary;
        format!(
            "{} iterations, {:.0} s, {:.1} m per robot, {} nodes, {:.2} % seen",
            summary.iterations,
            summary.sim_s,
            summary.distance_mean_m(),
            summary.nodes.iter().sum::<u32>(),
            100.0 * summary.coverage,
        )
    }

    /// A box of the map's own shape, so that a metre is as long across as up.
    fn panel(&self, top: f64) -> Panel {
        let (low, high) = self.site.map.bounds();
        let offset = DVec2::from(self.site.map.offset_m());
        let (low, high) = (low.as_dvec2() + offset, high.as_dvec2() + offset);
        let size_m = (high - low) * (1.0 + 2.0 * MARGIN_SHARE);
        let height = bounded(BOX_WIDTH * size_m.y / size_m.x, HEIGHTS.0, HEIGHTS.1);
        let m_per_unit = (size_m.x / BOX_WIDTH).max(size_m.y / height);
        let half = DVec2::new(BOX_WIDTH, height) * m_per_unit / 2.0;
        let middle = (low + high) / 2.0;
        let (low, high) = (middle - half, middle + half);
        Panel::new(top, height, (low.x, high.x), (low.y, high.y)).without_grid()
    }

    fn time_panel(&self, top: f64) -> Panel {
        Panel::new(top, TIME_HEIGHT, (0.0, self.summary.sim_s.max(1.0)), (0.0, 105.0)).with_y_step(25.0)
    }

    fn robots(&self) -> usize {
        self.history.ways_m.len()
    }
}

fn headline(summary: &ExploreSummary) -> String {
    let ExploreSummary { scenario, seed, robots, verdict, strategy, .. } = summary;
    let s = if *robots == 1 { "" } else { "s" };
    let (strategy, word) = (strategy.word(), verdict.outcome().word());
    format!("{scenario}, seed {seed}, {strategy}, {robots} robot{s}: {word}: {verdict}")
}
