//! Places and headings over time (after Kim 2021, Fig. 15 to 17).

use std::f64::consts::PI;

use kuva::render::{
    color::Color,
    render::{Primitive, Scene},
};

use super::headline;
use crate::{
    draw::{
        DrawError, colour,
        panel::{self, FIGURE_WIDTH, Panel, TEXT_LABEL, TEXT_LARGE, legend, rule, unclip},
        raster,
    },
    mission::explore::{ExploreHistory, ExploreSummary, Moment, Site},
};

/// Height of each box.
const HEIGHT: f64 = 120.0;
/// Most robots named in the legend.
const NAMED_MAX: usize = 10;
/// Behind the time on other levels.
const MFL: Color = Color::Rgb(0xff, 0xe2, 0xa8);

/// One box: what it shows of a robot at a moment.
struct Track<'a> {
    label: &'static str,
    /// Values that are shown in any case.
    shown: (f64, f64),
    /// Distance of the numbers on the axis.
    step: Option<f64>,
    of: &'a dyn Fn(&Moment, usize) -> Option<f64>,
}

/// Where all robots were over time, as a PNG 1400 px wide: x, y, height and heading, a line per robot, and the time in
/// which any of them was on another level to keep clear of others. The axes are in the frame of the map's file or
/// scenario.
///
/// # Errors
/// [`DrawError::Raster`].
pub fn states_png(
    site: &Site,
    history: &ExploreHistory,
    summary: &ExploreSummary,
) -> Result<Vec<u8>, DrawError> {
    let moments = &history.states.moments;
    let place = |axis: usize| {
        let offset_m = site.map.offset_m().get(axis).copied().unwrap_or(0.0);
        move |moment: &Moment, robot: usize| {
            moment.at_m.get(robot).map(|at_m: &[f32; 3]| f64::from(at_m[axis]) + offset_m)
        }
    };
    let heading =
        |moment: &Moment, robot: usize| moment.heading_rad.get(robot).map(|rad| f64::from(*rad).to_degrees());
    let (x, y, z) = (place(0), place(1), place(2));
    let none = (f64::INFINITY, f64::NEG_INFINITY);
    let levels = [0, 2].map(|level| f64::from(site.scenario.params.height_m(level)));
    let tracks = [
        Track { label: "x (m)", shown: none, step: None, of: &x },
        Track { label: "y (m)", shown: none, step: None, of: &y },
        Track { label: "height (m)", shown: levels.into(), step: Some(0.5), of: &z },
        Track { label: "heading (degrees)", shown: (-180.0, 180.0), step: Some(90.0), of: &heading },
    ];
    let mut scene = Scene::new(FIGURE_WIDTH, 64.0 + tracks.len() as f64 * (HEIGHT + 48.0));
    let mut top = 56.0;
    for (i, track) in tracks.iter().enumerate() {
        let panel = Panel::new(top, HEIGHT, (0.0, summary.sim_s.max(1.0)), range(moments, track));
        let panel = match track.step {
            Some(step) => panel.with_y_step(step),
            None => panel,
        };
        if i == 0 {
            panel::text(&mut scene, (panel.left(), 20.0), TEXT_LARGE, &headline(summary));
            panel::text(&mut scene, (panel.left(), 38.0), TEXT_LABEL, &figures(summary));
            names(&mut scene, &panel, usize::from(summary.robots));
        }
        draw(&mut scene, &panel, moments, track);
        top = panel.bottom() + 48.0;
    }
    raster(&scene)
}

fn figures(summary: &ExploreSummary) -> String {
    let list = |numbers: &mut dyn Iterator<Item = String>| numbers.collect::<Vec<_>>().join(", ");
    let nodes = list(&mut summary.nodes.iter().take(NAMED_MAX).map(u32::to_string));
    let metres = list(&mut summary.distance_m.iter().take(NAMED_MAX).map(|m| format!("{m:.2}")));
    format!("nodes {nodes}; flown {metres} m; {:.2} s, {:.2} s of it on levels", summary.sim_s, summary.mfl_s)
}

/// The values of a box, with some room around them.
fn range(moments: &[Moment], track: &Track<'_>) -> (f64, f64) {
    let values = moments
        .iter()
        .flat_map(|moment| (0..moment.at_m.len()).filter_map(|robot| (track.of)(moment, robot)))
        .filter(|value| value.is_finite());
    let (low, high) = values.fold(track.shown, |(low, high), value| (low.min(value), high.max(value)));
    if low > high {
        return (0.0, 1.0);
    }
    let room = (0.06 * (high - low)).max(0.05);
    (low - room, high + room)
}

fn draw(scene: &mut Scene, panel: &Panel, moments: &[Moment], track: &Track<'_>) {
    panel.axes(scene, "time (s)", track.label);
    panel.clip(scene);
    shade(scene, panel, moments);
    let robots = moments.first().map_or(0, |moment| moment.at_m.len());
    for robot in 0..robots {
        let mut last: Option<f64> = None;
        let values = moments.iter().flat_map(|moment| {
            let value = (track.of)(moment, robot);
            // A heading that goes round through south is not drawn across the box.
            let jumps = last.zip(value).is_some_and(|(last, value)| (value - last).abs() > 57.0 * PI);
            last = value;
            let gap = jumps.then_some(None);
            gap.into_iter().chain([value.map(|value| (moment.time_s, value))])
        });
        let values: Vec<_> = values.collect();
        // Robots on one level fly over each other's line: the later is the thinner.
        let width = 1.3 + 0.6 * (robots - 1 - robot).min(4) as f64;
        panel.line(scene, values.into_iter(), &colour::of_uav(robot, robots), width);
    }
    unclip(scene);
}

/// What is behind the time on other levels.
fn shade(scene: &mut Scene, panel: &Panel, moments: &[Moment]) {
    let mut since: Option<f64> = None;
    let end_s = moments.last().map_or(0.0, |moment| moment.time_s);
    let changes = moments.iter().map(|moment| (moment.time_s, moment.mfl)).chain([(end_s, false)]);
    for (time_s, mfl) in changes {
        match (since, mfl) {
            (None, true) => since = Some(time_s),
            (Some(from_s), false) => {
                let ((x, _), (right, _)) = (panel.at(from_s, 0.0), panel.at(time_s, 0.0));
                scene.add(band((x, panel.top()), right - x, panel.bottom() - panel.top()));
                since = None;
            }
            _ => {}
        }
    }
}

fn band((x, y): (f64, f64), width: f64, height: f64) -> Primitive {
    Primitive::Rect { x, y, width, height, fill: MFL, stroke: None, stroke_width: None, opacity: Some(0.6) }
}

fn names(scene: &mut Scene, panel: &Panel, robots: usize) {
    let named = robots.min(NAMED_MAX);
    for i in 0..named {
        let (x, y) = legend(scene, panel, i, &format!("robot {i}"));
        rule(scene, (x - 8.0, y), (x + 8.0, y), &colour::of_uav(i, robots), 1.8, None);
    }
    let (x, y) = legend(scene, panel, named, "on levels");
    scene.add(band((x - 7.0, y - 5.0), 14.0, 10.0));
}
