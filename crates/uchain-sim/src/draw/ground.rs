//! Rock, free space and walls of a map.

use glam::DVec2;
use kuva::render::{
    color::Color,
    render::{PathData, Primitive, Scene},
};

use super::{
    colour::{FREE, ROCK, WALL},
    panel::Panel,
};
use crate::map::{Map, Segment};

/// A place of the map frame on the page; the axes are in the map file's own frame.
pub(crate) fn on_page(panel: &Panel, map: &Map, at: DVec2) -> (f64, f64) {
    let at = at + DVec2::from(map.offset_m());
    panel.at(at.x, at.y)
}

/// Paints the box of a panel. Loops are painted from the largest to the smallest.
pub(crate) fn paint(scene: &mut Scene, panel: &Panel, map: &Map) {
    paint_lined(scene, panel, map, 1.0);
}

/// The same with walls so thick (units of the page).
pub(crate) fn paint_lined(scene: &mut Scene, panel: &Panel, map: &Map, thickness: f64) {
    scene.add(Primitive::Rect {
        x: panel.left(),
        y: panel.top(),
        width: panel.right() - panel.left(),
        height: panel.bottom() - panel.top(),
        fill: ROCK,
        stroke: None,
        stroke_width: None,
        opacity: None,
    });
    let mut loops: Vec<(f64, &[Segment])> =
        map.loops().map(|walls| (doubled_area_m2(walls), walls)).collect();
    loops.sort_by(|a, b| b.0.abs().total_cmp(&a.0.abs()));
    for (doubled_area_m2, walls) in loops {
        let fill = if is_free_inside(map, doubled_area_m2, walls) { FREE } else { ROCK };
        let corners: Vec<(f64, f64)> =
            walls.iter().map(|wall| on_page(panel, map, wall.a.as_dvec2())).collect();
        scene.add(area(&corners, Some(fill), WALL, thickness, None));
    }
}

/// How much free space a map has (m²).
pub(crate) fn free_area_m2(map: &Map) -> f64 {
    let area = |walls: &[Segment]| {
        let doubled_area_m2 = doubled_area_m2(walls);
        let side = if is_free_inside(map, doubled_area_m2, walls) { 0.5 } else { -0.5 };
        side * doubled_area_m2.abs()
    };
    map.loops().map(area).sum::<f64>().max(0.0)
}

/// A closed line through places of the page, perhaps filled.
pub(crate) fn area(
    corners: &[(f64, f64)],
    fill: Option<Color>,
    stroke: Color,
    stroke_width: f64,
    opacity: Option<f64>,
) -> Primitive {
    use std::fmt::Write as _;
    let mut d = String::with_capacity(16 * corners.len());
    for (i, (x, y)) in corners.iter().enumerate() {
        // Writing to a String cannot fail.
        let _ = write!(d, "{}{x:.2} {y:.2} ", if i == 0 { 'M' } else { 'L' });
    }
    d.push('Z');
    Primitive::Path(Box::new(PathData { d, fill, stroke, stroke_width, opacity, stroke_dasharray: None }))
}

/// What lies on the inner side of a loop, told from a point next to its longest wall.
fn is_free_inside(map: &Map, doubled_area_m2: f64, walls: &[Segment]) -> bool {
    let length = |wall: &&Segment| wall.a.distance_squared(wall.b);
    let Some(wall) = walls.iter().max_by(|a, b| length(a).total_cmp(&length(b))) else { return false };
    let to_left = (wall.b - wall.a).perp().normalize_or_zero() * 0.002;
    let inward = if doubled_area_m2 > 0.0 { to_left } else { -to_left };
    !map.in_rock(wall.a.midpoint(wall.b) + inward)
}

/// Positive when the loop runs counter-clockwise.
fn doubled_area_m2(walls: &[Segment]) -> f64 {
    walls.iter().map(|wall| wall.a.as_dvec2().perp_dot(wall.b.as_dvec2())).sum()
}
