//! Losses against distance with the line, and what is left of them.

use crate::{
    draw::{
        DrawError,
        figure::{Axes, Figure, Known, Mark, Stroke, figure},
    },
    radio_fit::{Fit, Residual},
};

/// Height of a box.
const HEIGHT: f64 = 170.0;
/// Links that have a colour of their own.
const COLOURS: usize = 6;
/// Points of a line.
const POINTS: usize = 80;

impl Fit {
    /// The picture as a PNG 1400 px wide: losses and the line against distance, what is left against distance, and what is left
    /// along the log, with the shadowing that stays as a line.
    ///
    /// # Errors
    /// [`DrawError::Raster`].
    pub fn png(&self) -> Result<Vec<u8>, DrawError> {
        Ok(figure(&self.figure())?.png)
    }

    fn figure(&self) -> Figure {
        let [near_m, far_m] = self.distance_m;
        let near_m = near_m.max(0.3 * self.reference_m);
        let log = |m: f64| libm::log10(m.max(1e-3));
        let (from, to) = (log(near_m), log(far_m));
        let along = |step: usize| from + (to - from) * step as f64 / POINTS as f64;
        let line = |off: f64| -> Vec<(f64, f64)> {
            (0..=POINTS)
                .map(|step| {
                    let (loss_db, error_db) = self.loss_db(libm::exp10(along(step)));
                    (along(step), loss_db + off * error_db)
                })
                .collect()
        };
        let drawn = |name: &str, stroke: Stroke, points: Vec<(f64, f64)>| Mark::Line {
            name: name.to_owned(),
            colour: 0,
            stroke,
            points,
        };
        let mut losses = self.dots(|residual| (log(residual.distance_m), residual.loss_db));
        losses.extend([
            drawn("", Stroke::Dashed, line(-1.96)),
            drawn("", Stroke::Dashed, line(1.96)),
            drawn("fit, 95 %", Stroke::Solid, line(0.0)),
        ]);
        let mut against =
            self.dots(|residual| (log(residual.distance_m), residual.loss_db - residual.line_db));
        against.push(Mark::Level { name: String::new(), y: 0.0 });
        let mut way = self.dots(|residual| (residual.sample as f64, residual.loss_db - residual.line_db));
        for link in 0..self.links.len().min(COLOURS) {
            let own = self.residuals.iter().filter(|residual| residual.link == link);
            let points = own.map(|residual| (residual.sample as f64, residual.static_db)).collect();
            let name = if self.links.len() == 1 { "stays" } else { "" };
            way.push(Mark::Line { name: name.to_owned(), colour: link + 1, stroke: Stroke::Solid, points });
        }
        way.push(Mark::Level { name: String::new(), y: 0.0 });
        let title = format!(
            "{}: exponent {:.2} ({:.2} to {:.2}), noise {:.1} dB, stays {:.1} dB over {:.1} m{}",
            self.log,
            self.alpha.value,
            self.alpha.low,
            self.alpha.high,
            self.sigma_db.value,
            self.sigma_static_db.value,
            self.correlation_m.value,
            if self.refusals.is_empty() { "" } else { ": no fit" }
        );
        let axes = |x: &str, y: &str, marks: Vec<Mark>| Axes {
            x: x.to_owned(),
            y: y.to_owned(),
            height: HEIGHT,
            marks,
            ..Axes::default()
        };
        let distance = "distance (log10 of m: 0 is 1 m, 1 is 10 m)";
        Figure {
            title,
            axes: vec![
                axes(distance, "loss (dB)", losses),
                axes(distance, "left of it (dB)", against),
                axes("packet of the log", "left of it (dB)", way),
            ],
        }
    }

    /// Packets as dots, each link in its colour.
    fn dots(&self, at: impl Fn(&Residual) -> (f64, f64)) -> Vec<Mark> {
        let links = 0..self.links.len().min(COLOURS);
        let dots = links.map(|link| {
            let own = self.residuals.iter().filter(|residual| residual.link % COLOURS == link);
            Mark::Loss {
                name: self.links.get(link).cloned().unwrap_or_default(),
                uav: link + 1,
                known: Known::Raw,
                points: own.map(&at).collect(),
            }
        });
        dots.collect()
    }
}
