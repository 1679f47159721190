//! Places and headings over time (after Kim 2021, Fig. 15 to 17).

use std::{f64::consts::PI, ops::Range};

use kuva::render::{
    color::Color,
    render::{Primitive, Scene},
};

use uchain_core::bounded;

use super::headline;
use crate::{
    draw::{
        DrawError, LINE, LONGEST, LONGEST_HEADLINE,
        colour::{self, LINES_MAX},
        name::{
            Ending,
            key::{self, Entry},
            name_ends,
        },
        panel::{self, FIGURE_WIDTH, LEFT, Panel, TEXT_LABEL, TEXT_LARGE, unclip},
        raster, wrapped,
    },
    mission::explore::{ExploreHistory, ExploreSummary, Moment, Site},
};

/// Height of each box.
const HEIGHT: f64 = 120.0;
/// From one box to the next.
const GAP: f64 = 48.0;
/// Most robots whose numbers are written above.
const NAMED_MAX: usize = 10;
/// Most groups of robots with boxes of their own; of more robots the first are shown.
const GROUPS_MAX: usize = 4;
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
    let groups = groups(usize::from(summary.robots));
    let lines: Vec<(u32, String)> = wrapped(&headline(summary), LONGEST_HEADLINE)
        .into_iter()
        .map(|line| (TEXT_LARGE, line))
        .chain(wrapped(&figures(summary, &groups), LONGEST).into_iter().map(|line| (TEXT_LABEL, line)))
        .collect();
    let entries = [Entry::new("some robot is on another level", |scene, (x, y)| {
        scene.add(band((x - 9.0, y - 5.0), 18.0, 10.0));
    })];
    let above = 12.0 + LINE * lines.len() as f64;
    let mut top = above + key::height(&entries, LEFT) + 10.0;
    let boxes = (tracks.len() * groups.len()) as f64;
    let mut scene = Scene::new(FIGURE_WIDTH, top + boxes * (HEIGHT + GAP) + 8.0);
    for (i, (size, line)) in lines.iter().enumerate() {
        panel::text(&mut scene, (LEFT, 20.0 + LINE * i as f64), *size, line);
    }
    key::draw(&mut scene, (LEFT - 8.0, above), &entries);
    for track in &tracks {
        for group in &groups {
            let panel = Panel::new(top, HEIGHT, (0.0, summary.sim_s.max(1.0)), range(moments, track));
            let panel = match track.step {
                Some(step) => panel.with_y_step(step),
                None => panel,
            };
            draw(&mut scene, &panel, moments, track, group.clone());
            top = panel.bottom() + GAP;
        }
    }
    raster(&scene)
}

/// Robots by box: as even as may be, no more in one than can be told apart.
fn groups(robots: usize) -> Vec<Range<usize>> {
    let shown = bounded(robots, 1, GROUPS_MAX * LINES_MAX);
    let each = shown.div_ceil(shown.div_ceil(LINES_MAX));
    (0..shown).step_by(each).map(|from| from..(from + each).min(shown)).collect()
}

fn figures(summary: &ExploreSummary, groups: &[Range<usize>]) -> String {
    let list = |numbers: &mut dyn Iterator<Item = String>| numbers.collect::<Vec<_>>().join(", ");
    let nodes = list(&mut summary.nodes.iter().take(NAMED_MAX).map(u32::to_string));
    let metres = list(&mut summary.distance_m.iter().take(NAMED_MAX).map(|m| format!("{m:.2}")));
    let shown = groups.last().map_or(0, |group| group.end);
    let some = if shown < usize::from(summary.robots) {
        format!("; the first {shown} of {} robots", summary.robots)
    } else {
        String::new()
    };
    format!(
        "nodes {nodes}; flown {metres} m; {:.2} s, {:.2} s of it on other levels{some}",
        summary.sim_s, summary.mfl_s
    )
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

fn draw(scene: &mut Scene, panel: &Panel, moments: &[Moment], track: &Track<'_>, group: Range<usize>) {
    panel.axes(scene, "time (s)", track.label);
    panel.clip(scene);
    shade(scene, panel, moments);
    let mut endings = Vec::new();
    for robot in group.clone() {
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
        let width = 1.3 + 0.6 * (group.end - 1 - robot).min(4) as f64;
        if let Some((x, y)) = values.iter().flatten().last() {
            let words = format!("robot {robot}");
            endings.push(Ending { at: panel.at(*x, *y), words, colour: colour::of_uav(robot) });
        }
        panel.line(scene, values.into_iter(), &colour::of_uav(robot), width);
    }
    unclip(scene);
    name_ends(scene, panel, endings);
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn at_most_six_robots_share_a_box() {
        assert_eq!((groups(6).len(), groups(6).first()), (1, Some(&(0..6))));
        assert_eq!(groups(8), [0..4, 4..8]);
        for robots in 1..300 {
            let groups = groups(robots);
            assert!(groups.iter().all(|group| (1..=LINES_MAX).contains(&group.len())), "{groups:?}");
            assert_eq!(groups.iter().map(ExactSizeIterator::len).sum::<usize>(), robots.min(24));
        }
    }
}
