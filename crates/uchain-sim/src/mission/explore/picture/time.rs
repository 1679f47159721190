//! Coverage over time.

use kuva::render::render::Scene;

use super::Sheet;
use crate::draw::{
    colour::{self, GREY, INK},
    name::{Ending, name_ends},
    panel::{Panel, caption, rule, unclip},
};

impl Sheet<'_> {
    pub(crate) fn draw_time(&self, scene: &mut Scene, panel: &Panel) {
        panel.axes(scene, "time (s)", "reachable ground seen (%)");
        let deep = colour::of_uav(1);
        let summary = self.summary;
        panel.clip(scene);
        panel.line(scene, self.steps(), &deep, 1.8);
        let times = [
            ("T50", summary.coverage_t50_s),
            ("T90", summary.coverage_t90_s),
            ("T100", summary.coverage_t100_s),
        ];
        // Not every share comes to be seen, and of an exploration that goes on nobody knows yet.
        let known = || times.into_iter().filter_map(|(name, at_s)| Some((name, at_s?)));
        for (_, at_s) in known() {
            let (x, _) = panel.at(at_s, 0.0);
            rule(scene, (x, panel.top()), (x, panel.bottom()), &GREY, 1.0, Some("4 4"));
        }
        unclip(scene);
        let mut free_from = f64::NEG_INFINITY;
        for (name, at_s) in known() {
            let (x, _) = panel.at(at_s, 0.0);
            // Two that nearly meet are named once.
            if x >= free_from {
                caption(scene, (x, panel.top() - 4.0), name, &INK);
                free_from = x + 32.0;
            }
        }
        let end = self.steps().flatten().last().map(|(x, y)| panel.at(x, y));
        let ending = end.map(|at| Ending { at, words: "seen".to_owned(), colour: deep });
        name_ends(scene, panel, ending.into_iter().collect());
    }

    /// Coverage holds until the next node.
    fn steps(&self) -> impl Iterator<Item = Option<(f64, f64)>> {
        let mut before = 0.0;
        let end = self.survey.curve.last().map(|(_, share)| (self.summary.sim_s, *share));
        self.survey.curve.iter().copied().chain(end).flat_map(move |(time_s, share)| {
            let was = std::mem::replace(&mut before, share);
            [Some((time_s, 100.0 * was)), Some((time_s, 100.0 * share))]
        })
    }
}
