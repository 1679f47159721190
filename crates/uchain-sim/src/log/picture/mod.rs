//! A replay on one page: losses, imbalance, speeds, distances and turns over time, with overrides as bands behind them.

mod bands;
mod boxes;

use kuva::render::{color::Color, render::Scene};

use super::{Replay, Step};
use crate::draw::{
    DrawError, FIGURE_WIDTH, LEFT, LINE, LONGEST_HEADLINE, Panel, TEXT_LARGE,
    colour::{self, GREY, INK},
    loss::{self, Known},
    name::{
        Ending,
        key::{self, Entry},
        name_ends,
    },
    panel::{name_axes, rule, text, unclip},
    raster, wrapped,
};
use bands::Bands;
use boxes::{Curve, Graph, How, graphs};

/// From the bottom of a box to the top of the next one: the numbers of its axis.
const GAP: f64 = 26.0;
/// Pattern of a launch.
const LAUNCH: Option<&str> = Some("1.5 3");
/// Later than this since its own beginning a clock tells the date: a picture counts from the first row (s).
const DATE_S: f64 = 1.0e6;
/// Thickness of a line that another one lies on, of a thick one, and of a thin one.
const WIDE: f64 = 3.2;
const THICK: f64 = 1.4;
const THIN: f64 = 0.9;

impl Replay {
    /// The replay on one page, as a PNG 1400 px wide. From above: losses of both links (solid = as the filter sees them, dots = as
    /// measured), their imbalance, the forward speed wished, allowed and asked for, distances, lateral speed and yaw rate,
    /// as far as the log has anything to show there. Bands behind are overrides; the log's own commands are dashed. `label` is what the
    /// headline calls the log.
    ///
    /// # Errors
    /// [`DrawError::Raster`].
    pub fn png(&self, label: &str) -> Result<Vec<u8>, DrawError> {
        raster(&self.scene(label))
    }

    pub(super) fn scene(&self, label: &str) -> Scene {
        let graphs = graphs(self);
        let bands = Bands::of(&self.steps);
        let from_s = if self.summary.start_s.abs() > DATE_S { self.summary.start_s } else { 0.0 };
        let entries = entries(&graphs, &bands, self.summary.launch_s.is_some());
        let lines = wrapped(&headline(self, label), LONGEST_HEADLINE);
        let below_title = 26.0 + LINE * lines.len().saturating_sub(1) as f64;
        let mut top = below_title + key::height(&entries, LEFT) + 18.0;
        let (start_s, end_s) = (self.summary.start_s - from_s, self.summary.end_s - from_s);
        let time_s = (start_s, end_s.max(start_s + 1.0));
        let mut panels = Vec::new();
        for graph in &graphs {
            let panel = Panel::new(top, graph.height, time_s, graph.range);
            top = panel.bottom() + GAP;
            panels.push(panel);
        }
        let mut scene = Scene::new(FIGURE_WIDTH, top - GAP + 44.0);
        for (i, line) in lines.iter().enumerate() {
            text(&mut scene, (LEFT, 20.0 + LINE * i as f64), TEXT_LARGE, line);
        }
        key::draw(&mut scene, (LEFT - 8.0, below_title), &entries);
        for (graph, panel) in graphs.iter().zip(&panels) {
            panel.grid(&mut scene);
            name_axes(&mut scene, panel, panel, "", graph.label);
            panel.clip(&mut scene);
            bands.draw(&mut scene, panel, from_s);
            self.launch(&mut scene, panel, from_s);
            if let Some((level, _)) = &graph.level {
                loss::threshold(&mut scene, panel, *level);
            }
            graph.curves.iter().for_each(|curve| curve.draw(&mut scene, panel, from_s));
            unclip(&mut scene);
            name_ends(&mut scene, panel, graph.endings(panel, from_s));
        }
        if let Some(last) = panels.last() {
            let time = if from_s == 0.0 { "time (s)" } else { "time since the first row (s)" };
            name_axes(&mut scene, last, last, time, "");
        }
        scene
    }

    fn launch(&self, scene: &mut Scene, panel: &Panel, from_s: f64) {
        if let Some(launch_s) = self.summary.launch_s {
            let (x, _) = panel.at(launch_s - from_s, 0.0);
            rule(scene, (x, panel.top()), (x, panel.bottom()), &GREY, 1.0, LAUNCH);
        }
    }
}

fn headline(replay: &Replay, label: &str) -> String {
    let summary = &replay.summary;
    let span_s = summary.end_s - summary.start_s;
    let (role, place, decisions) = (summary.role, summary.place, summary.decisions);
    let gaps = match summary.gaps {
        0 => String::new(),
        1 => "; 1 gap".to_owned(),
        gaps => format!("; {gaps} gaps"),
    };
    format!(
        "{label}: what a {role} at place {place} would have asked for, {span_s:.0} s, {decisions} decisions{gaps}"
    )
}

fn entries(graphs: &[Graph], bands: &Bands, has_launched: bool) -> Vec<Entry> {
    let curves = || graphs.iter().flat_map(|graph| &graph.curves);
    let is_drawn = |known: &Known| curves().any(|curve| curve.how == How::Loss(*known));
    let mut entries =
        loss::entries(&[Known::Filtered, Known::Raw].into_iter().filter(is_drawn).collect::<Vec<_>>());
    if has_launched {
        entries.push(Entry::new("launch", |scene, (x, y)| {
            rule(scene, (x, y - 6.0), (x, y + 6.0), &GREY, 1.0, LAUNCH);
        }));
    }
    if curves().any(|curve| curve.how == How::Dashed) {
        entries.push(Entry::new("asked for in the log", |scene, (x, y)| {
            rule(scene, (x - 9.0, y), (x + 9.0, y), &INK, THICK, Some("4 3"));
        }));
    }
    entries.extend(bands.entries());
    entries
}

impl Curve {
    fn ink(&self) -> Color {
        if self.how == How::Thin { colour::light_of_uav(self.colour) } else { colour::of_uav(self.colour) }
    }

    fn draw(&self, scene: &mut Scene, panel: &Panel, from_s: f64) {
        let values = self.points.iter().map(|point| point.map(|(time_s, value)| (time_s - from_s, value)));
        match self.how {
            How::Loss(known) => loss::series(scene, panel, known, self.colour, values),
            How::Dashed => loss::dashed_line(scene, panel, values, &self.ink(), THICK),
            How::Wide => panel.line(scene, values, &self.ink(), WIDE),
            How::Thick => panel.line(scene, values, &self.ink(), THICK),
            How::Thin => panel.line(scene, values, &self.ink(), THIN),
        }
    }
}

impl Graph {
    /// Names at the ends of its lines.
    fn endings(&self, panel: &Panel, from_s: f64) -> Vec<Ending> {
        let named =
            self.curves.iter().filter(|curve| curve.how != How::Loss(Known::Raw) && !curve.name.is_empty());
        let ending = |curve: &Curve| {
            let (time_s, value) = curve.points.last().copied()??;
            let words = curve.name.to_owned();
            Some(Ending { at: panel.at(time_s - from_s, value), words, colour: curve.ink() })
        };
        let level = self.level.iter().filter(|(_, words)| !words.is_empty()).map(|(level, words)| {
            let (_, y) = panel.at(0.0, *level);
            Ending { at: (panel.right(), y), words: words.clone(), colour: GREY }
        });
        named.filter_map(ending).chain(level).collect()
    }
}
