//! The map with stars, frontiers, ways and what nobody saw.

use std::f64::consts::TAU;

use glam::{DVec2, Vec2};
use kuva::render::{
    color::Color,
    render::{Primitive, Scene},
};
use uchain_core::bounded;

use super::Sheet;
use crate::{
    draw::{
        colour::{self, FREE, INK},
        dots::{self, Somebody},
        ground::{self, area, on_page},
        name::legend,
        panel::{Panel, dot, rule, unclip},
    },
    mission::explore::{ExploreHistory, NodeFrame},
};

/// Arcs that are frontiers.
const FRONTIER: Color = Color::Rgb(0xb0, 0x43, 0x8a);
/// What nobody saw.
const UNSEEN: Color = Color::Rgb(0x3a, 0x3a, 0x3a);
/// Outlines of stars.
const STAR: Color = Color::Rgb(0xb8, 0xc4, 0xd0);
/// The inside of stars, one on another.
const STAR_FILL: Color = Color::Rgb(0x9d, 0xbf, 0xe0);
/// Radius of a star on the page from which on all is drawn at full thickness.
const STAR_WIDE: f64 = 30.0;
/// Points of an arc.
const POINTS: usize = 5;

impl Sheet<'_> {
    pub(crate) fn draw_stars(&self, scene: &mut Scene, panel: &Panel) {
        panel.clip(scene);
        ground::paint(scene, panel, &self.site.map);
        for node in &self.history.nodes {
            let outline: Vec<(f64, f64)> =
                (0..node.sectors.len()).flat_map(|k| self.arc(panel, node, k)).collect();
            scene.add(area(&outline, Some(STAR_FILL), STAR, 0.5, Some(0.16)));
        }
        for node in &self.history.nodes {
            let outline = (0..node.sectors.len()).flat_map(|k| self.arc(panel, node, k));
            scene.add(line(outline.collect(), &STAR, 0.5));
        }
        self.unseen(scene, panel);
        let robots = self.robots();
        for (i, way) in self.history.ways_m.iter().enumerate() {
            let points = way.iter().map(|&at| self.at(panel, at)).collect();
            // Ways run over each other: the later is the thinner.
            let width = 1.2 + 0.6 * (robots - 1 - i).min(5) as f64;
            scene.add(line(points, &colour::of_uav(i), self.fine(panel) * width));
        }
        let mut frontiers = 0;
        for node in &self.history.nodes {
            let reach = |k: usize| node.sectors.get(k).map_or(0.0, |sector| f64::from(sector.r_m));
            for k in ExploreHistory::frontiers(node).filter(|&k| reach(k) > 0.0) {
                scene.add(line(self.arc(panel, node, k).collect(), &FRONTIER, 3.0));
                frontiers += 1;
            }
        }
        self.draw_robots(scene, panel);
        unclip(scene);
        panel.axes(scene, "x (m)", "y (m)");
        explain(scene, panel, frontiers);
    }

    /// Every robot's start, and the robot with its number where it ended.
    pub(crate) fn draw_robots(&self, scene: &mut Scene, panel: &Panel) {
        let ways = || self.history.ways_m.iter().enumerate();
        for (i, way) in ways() {
            if let Some(&start) = way.first() {
                dot(scene, self.at(panel, start), 4.0, &FREE, &colour::of_uav(i));
            }
        }
        let ended = ways().filter_map(|(number, way)| {
            Some(Somebody { number, at: self.at(panel, *way.last()?), in_the_air: true })
        });
        dots::draw(scene, panel, &ended.collect::<Vec<_>>());
    }

    /// Thickness of what is drawn, against that on a map on which stars are large (1).
    pub(crate) fn fine(&self, panel: &Panel) -> f64 {
        let from = self.at(panel, [0.0, 0.0]).0;
        let star = self.at(panel, [self.site.scenario.params.r_s_m, 0.0]).0 - from;
        bounded(star / STAR_WIDE, 0.3, 1.0)
    }

    fn at(&self, panel: &Panel, at: [f32; 2]) -> (f64, f64) {
        on_page(panel, &self.site.map, Vec2::from(at).as_dvec2())
    }

    /// The arc that bounds a sector, on the page.
    fn arc(&self, panel: &Panel, node: &NodeFrame, k: usize) -> impl Iterator<Item = (f64, f64)> {
        let (count, r_m) = (node.sectors.len() as f64, node.sectors.get(k).map_or(0.0, |s| f64::from(s.r_m)));
        let (from, map) = (Vec2::from(node.believed_m).as_dvec2(), &self.site.map);
        let places: Vec<(f64, f64)> = (0..=POINTS)
            .map(|i| {
                let (sin, cos) = libm::sincos((k as f64 + i as f64 / POINTS as f64) * TAU / count);
                on_page(panel, map, from + DVec2::new(cos, sin) * r_m)
            })
            .collect();
        places.into_iter()
    }

    /// Cells side by side in a row are one rectangle.
    fn unseen(&self, scene: &mut Scene, panel: &Panel) {
        /// Onto the next row, or a line of light is left between them.
        const OVERLAP: f64 = 0.4;
        let (ground, coverage) = (self.site.ground(), &self.survey.coverage);
        let [cols, rows] = ground.cells().size();
        let left = |index: usize| ground.is_reachable(index) && !coverage.has_seen(index);
        let half = DVec2::splat(f64::from(ground.cells().cell_m()) / 2.0);
        for row in 0..rows {
            let mut col = 0;
            while col < cols {
                let from = row * cols + col;
                let run = (col..cols).take_while(|other| left(row * cols + other)).count();
                col += run.max(1);
                if run == 0 {
                    continue;
                }
                let low = ground.cells().middle_of(from).as_dvec2() - half;
                let high = ground.cells().middle_of(from + run - 1).as_dvec2() + half;
                let ((x, bottom), (right, y)) =
                    (on_page(panel, &self.site.map, low), on_page(panel, &self.site.map, high));
                scene.add(square((x, y), right - x, bottom - y + OVERLAP));
            }
        }
    }
}

fn explain(scene: &mut Scene, panel: &Panel, frontiers: usize) {
    let spot = legend(scene, panel, 0, "robot at the end");
    dot(scene, spot, 5.0, &colour::of_uav(0), &INK);
    let (x, y) = legend(scene, panel, 1, "its way");
    rule(scene, (x - 8.0, y), (x + 8.0, y), &colour::of_uav(0), 1.8, None);
    let spot = legend(scene, panel, 2, "its start");
    dot(scene, spot, 4.0, &FREE, &colour::of_uav(0));
    let (x, y) = legend(scene, panel, 3, "star");
    let corners = [(x - 7.0, y - 5.0), (x + 7.0, y - 5.0), (x + 7.0, y + 5.0), (x - 7.0, y + 5.0)];
    scene.add(area(&corners, Some(FREE), STAR, 0.5, None));
    scene.add(area(&corners, Some(STAR_FILL), STAR, 0.5, Some(0.4)));
    let (x, y) = legend(scene, panel, 4, if frontiers > 0 { "frontier left" } else { "frontier (none)" });
    rule(scene, (x - 8.0, y), (x + 8.0, y), &FRONTIER, 3.0, None);
    let (x, y) = legend(scene, panel, 5, "reachable,");
    scene.add(square((x - 5.0, y - 5.0), 10.0, 10.0));
    legend(scene, panel, 6, "not seen");
}

fn line(points: Vec<(f64, f64)>, stroke: &Color, stroke_width: f64) -> Primitive {
    Primitive::PolyLine { points, stroke: stroke.clone(), stroke_width, stroke_dasharray: None }
}

fn square((x, y): (f64, f64), width: f64, height: f64) -> Primitive {
    Primitive::Rect { x, y, width, height, fill: UNSEEN, stroke: None, stroke_width: None, opacity: None }
}
