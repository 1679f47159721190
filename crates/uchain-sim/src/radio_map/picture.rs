//! The losses of a map in colours, with the line at which a relay's link ends; the losses along a tunnel as a line.

use glam::DVec2;
use kuva::render::render::{Primitive, Scene};
use uchain_core::bounded;

use super::{LossAlong, LossMap};
use crate::{
    draw::{
        DrawError, FIGURE_WIDTH, LEFT, LINE, LONGEST_HEADLINE, TEXT_LARGE,
        colour::{self, INK, WALL},
        ground,
        name::legend,
        panel::{self, BOX_WIDTH, Panel, rule, unclip},
        raster, wrapped,
    },
    map::Map,
};

/// Lowest and highest box.
const HEIGHTS: (f64, f64) = (120.0, 480.0);
/// Room around the map, of its longer side.
const MARGIN: f64 = 0.04;
/// Losses that the legend names, against the limit (dB).
const NAMED_DB: [f64; 5] = [-20.0, -10.0, 0.0, 10.0, 20.0];

impl LossMap {
    /// The map as a PNG 1400 px wide: blue where a link is good, vermilion where it is bad, and a line where it loses as much
    /// as it may.
    ///
    /// # Errors
    /// [`DrawError::Raster`].
    pub fn png(&self, map: &Map, name: &str) -> Result<Vec<u8>, DrawError> {
        let title = format!(
            "{name}: loss from {:.2}, {:.2}; the line is at {} dB, the limit of a link",
            self.from_m[0], self.from_m[1], self.limit_db
        );
        let lines = wrapped(&title, LONGEST_HEADLINE);
        let panel = Self::panel(map, 34.0 + LINE * lines.len() as f64);
        let mut scene = Scene::new(FIGURE_WIDTH, panel.bottom() + 44.0);
        for (i, line) in lines.iter().enumerate() {
            panel::text(&mut scene, (LEFT, 20.0 + LINE * i as f64), TEXT_LARGE, line);
        }
        panel.clip(&mut scene);
        ground::paint(&mut scene, &panel, map);
        self.cells(&mut scene, &panel);
        for walls in map.loops() {
            let corners: Vec<(f64, f64)> =
                walls.iter().map(|wall| ground::on_page(&panel, map, wall.a.as_dvec2())).collect();
            scene.add(ground::area(&corners, None, WALL, 0.6, None));
        }
        self.contour(&mut scene, &panel);
        square(&mut scene, panel.at(self.from_m[0], self.from_m[1]));
        unclip(&mut scene);
        panel.axes(&mut scene, "x (m)", "y (m)");
        let from = legend(&mut scene, &panel, 0, "from here");
        square(&mut scene, from);
        for (row, against_db) in NAMED_DB.iter().enumerate() {
            let loss_db = self.limit_db + against_db;
            let (x, y) = legend(&mut scene, &panel, row + 1, &format!("{loss_db} dB"));
            scene.add(rectangle((x - 9.0, y - 5.0), (18.0, 10.0), colour::of_link(loss_db, self.limit_db)));
        }
        raster(&scene)
    }

    fn panel(map: &Map, top: f64) -> Panel {
        let offset = DVec2::from(map.offset_m());
        let (low, high) = map.bounds();
        let (low, high) = (low.as_dvec2() + offset, high.as_dvec2() + offset);
        let margin = (MARGIN * (high - low).max_element()).max(0.1);
        let size = high - low + 2.0 * margin;
        let height = bounded(BOX_WIDTH * size.y / size.x, HEIGHTS.0, HEIGHTS.1);
        let m_per_unit = (size.x / BOX_WIDTH).max(size.y / height);
        let (middle, half) = ((low + high) / 2.0, DVec2::new(BOX_WIDTH, height) * m_per_unit / 2.0);
        let (low, high) = (middle - half, middle + half);
        Panel::new(top, height, (low.x, high.x), (low.y, high.y)).without_grid()
    }

    /// Neighbours of nearly one loss in a row are one rectangle.
    fn cells(&self, scene: &mut Scene, panel: &Panel) {
        let shade = |loss_db: Option<f32>| loss_db.map(|loss_db| (2.0 * f64::from(loss_db)).round() as i64);
        for row in 0..self.size[1] {
            let mut start = 0;
            while start < self.size[0] {
                let Some(own) = shade(self.at(start, row)) else {
                    start += 1;
                    continue;
                };
                let mut end = start + 1;
                while end < self.size[0] && shade(self.at(end, row)) == Some(own) {
                    end += 1;
                }
                let ((left, bottom), (right, top)) =
                    (self.corner(panel, start, row), self.corner(panel, end, row + 1));
                // A hair more: no seams between neighbours.
                let size = (right - left + 0.2, bottom - top + 0.2);
                scene.add(rectangle((left, top), size, colour::of_link(0.5 * own as f64, self.limit_db)));
                start = end;
            }
        }
    }

    fn corner(&self, panel: &Panel, column: usize, row: usize) -> (f64, f64) {
        panel.at(self.low_m[0] + column as f64 * self.cell_m, self.low_m[1] + row as f64 * self.cell_m)
    }

    /// Sides of cells that have the limit between them.
    fn contour(&self, scene: &mut Scene, panel: &Panel) {
        let is_within = |column: usize, row: usize| {
            self.at(column, row).map(|loss_db| f64::from(loss_db) <= self.limit_db)
        };
        for row in 0..self.size[1] {
            for column in 0..self.size[0] {
                let Some(own) = is_within(column, row) else { continue };
                if is_within(column + 1, row).is_some_and(|other| other != own) {
                    let ends = (self.corner(panel, column + 1, row), self.corner(panel, column + 1, row + 1));
                    rule(scene, ends.0, ends.1, &INK, 1.2, None);
                }
                if is_within(column, row + 1).is_some_and(|other| other != own) {
                    let ends = (self.corner(panel, column, row + 1), self.corner(panel, column + 1, row + 1));
                    rule(scene, ends.0, ends.1, &INK, 1.2, None);
                }
            }
        }
    }
}

impl LossAlong {
    /// The losses over the depth as a PNG 1400 px wide.
    ///
    /// # Errors
    /// [`DrawError::Raster`].
    pub fn png(&self, name: &str) -> Result<Vec<u8>, DrawError> {
        let panel_of = |values: &dyn Fn(&super::Along) -> f64| {
            let all = self.points.iter().map(values);
            all.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), value| (l.min(value), h.max(value)))
        };
        let (low_db, high_db) = panel_of(&|point| point.loss_db);
        let (low_db, high_db) = (low_db.min(self.limit_db) - 3.0, high_db.max(self.limit_db) + 3.0);
        let (_, depth_m) = panel_of(&|point| point.depth_m);
        let title =
            format!("{name}: loss from {:.2}, {:.2} along the tunnel", self.from_m[0], self.from_m[1]);
        let lines = wrapped(&title, LONGEST_HEADLINE);
        let top = 34.0 + LINE * lines.len() as f64;
        let panel = Panel::new(top, 260.0, (0.0, depth_m.max(0.1)), (low_db, high_db));
        let mut scene = Scene::new(FIGURE_WIDTH, panel.bottom() + 44.0);
        for (i, line) in lines.iter().enumerate() {
            panel::text(&mut scene, (LEFT, 20.0 + LINE * i as f64), TEXT_LARGE, line);
        }
        panel.axes(&mut scene, "depth (m)", "loss (dB)");
        panel.clip(&mut scene);
        crate::draw::loss::threshold(&mut scene, &panel, self.limit_db);
        let values = self.points.iter().map(|point| Some((point.depth_m, point.loss_db)));
        panel.line(&mut scene, values, &colour::of_uav(1), 1.8);
        unclip(&mut scene);
        let ending = crate::draw::loss::threshold_ending(&panel, self.limit_db);
        crate::draw::name::name_ends(&mut scene, &panel, vec![ending]);
        raster(&scene)
    }
}

fn rectangle((x, y): (f64, f64), (width, height): (f64, f64), fill: kuva::render::color::Color) -> Primitive {
    Primitive::Rect { x, y, width, height, fill, stroke: None, stroke_width: None, opacity: None }
}

/// The mark of the place that is looked from.
fn square(scene: &mut Scene, (x, y): (f64, f64)) {
    scene.add(rectangle((x - 4.5, y - 4.5), (9.0, 9.0), INK));
}
