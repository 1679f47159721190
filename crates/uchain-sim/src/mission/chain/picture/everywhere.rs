//! The map, coloured by the relays that each place needs.

use std::collections::BTreeMap;

use glam::DVec2;
use kuva::render::{
    color::Color,
    render::{Primitive, Scene},
};

use super::{
    places::scale_bar,
    region::{Region, square},
};
use crate::draw::{
    DrawError, FIGURE_WIDTH, LEFT, LINE, LONGEST_HEADLINE, TEXT_LARGE,
    colour::{self, GREY, WALL},
    ground,
    name::legend,
    panel::{self, Panel, unclip},
    raster, wrapped,
};
use crate::mission::chain::{Course, Everywhere};

/// Most lines of the legend.
const ENTRIES: u32 = 12;

/// The map as a PNG 1400 px wide, each place that can be reached coloured by the relays that a head there needs, grey where no
/// number is enough. They stand on the shortest way to it.
///
/// # Errors
/// [`DrawError::Raster`].
pub fn everywhere_png(course: &Course, everywhere: &Everywhere) -> Result<Vec<u8>, DrawError> {
    let most = everywhere.relays_most().unwrap_or_default();
    let title = format!(
        "{}: relays that each place needs, with links of at most {} dB",
        course.scenario.name, course.scenario.takeoff.s_min_db
    );
    let lines = wrapped(&title, LONGEST_HEADLINE);
    let offset = DVec2::from(course.map.offset_m());
    let (low, high) = course.map.bounds();
    let region = Region::around([low, high].into_iter().map(|at| at.as_dvec2() + offset), 0.0);
    let panel = region.panel(34.0 + LINE * lines.len() as f64);
    let mut scene = Scene::new(FIGURE_WIDTH, panel.bottom() + 44.0);
    for (i, line) in lines.iter().enumerate() {
        panel::text(&mut scene, (LEFT, 20.0 + LINE * i as f64), TEXT_LARGE, line);
    }
    panel.clip(&mut scene);
    ground::paint(&mut scene, &panel, &course.map);
    cells(&mut scene, &panel, course, everywhere, most);
    outlines(&mut scene, &panel, course);
    let base = course.base.as_dvec2() + offset;
    let base = panel.at(base.x, base.y);
    square(&mut scene, base);
    scale_bar(&mut scene, &panel, &[base]);
    unclip(&mut scene);
    panel.axes(&mut scene, "x (m)", "y (m)");
    key(&mut scene, &panel, most);
    raster(&scene)
}

/// Walls over what is coloured.
fn outlines(scene: &mut Scene, panel: &Panel, course: &Course) {
    for walls in course.map.loops() {
        let corners: Vec<(f64, f64)> =
            walls.iter().map(|wall| ground::on_page(panel, &course.map, wall.a.as_dvec2())).collect();
        scene.add(ground::area(&corners, None, WALL, 0.6, None));
    }
}

/// Neighbours of one colour in a row are one rectangle.
fn cells(scene: &mut Scene, panel: &Panel, course: &Course, everywhere: &Everywhere, most: u32) {
    let (low, _) = course.map.bounds();
    let (low, cell_m) = (low.as_dvec2() + DVec2::from(course.map.offset_m()), f64::from(everywhere.cell_m));
    let mut rows: BTreeMap<i32, Vec<(i32, Option<u32>)>> = BTreeMap::new();
    for cell in &everywhere.cells {
        let [column, row] = cell.column_and_row;
        rows.entry(row).or_default().push((column, cell.relays));
    }
    for (row, mut columns) in rows {
        columns.sort_unstable();
        for run in columns.chunk_by(|a, b| a.0 + 1 == b.0 && a.1 == b.1) {
            let (Some(first), Some(last)) = (run.first(), run.last()) else { continue };
            let corner = |column: i32, row: i32| {
                panel.at(low.x + f64::from(column) * cell_m, low.y + f64::from(row) * cell_m)
            };
            let ((left, bottom), (right, top)) = (corner(first.0, row), corner(last.0 + 1, row + 1));
            scene.add(Primitive::Rect {
                x: left,
                y: top,
                // A hair more: no seams between neighbours.
                width: right - left + 0.2,
                height: bottom - top + 0.2,
                fill: of_relays(first.1, most),
                stroke: None,
                stroke_width: None,
                opacity: None,
            });
        }
    }
}

/// From blue, no relay, over yellow to vermilion, the most.
fn of_relays(relays: Option<u32>, most: u32) -> Color {
    let Some(relays) = relays else { return GREY };
    colour::of_link(40.0 * f64::from(relays) / f64::from(most.max(1)) - 20.0, 0.0)
}

fn key(scene: &mut Scene, panel: &Panel, most: u32) {
    let spot = legend(scene, panel, 0, "base");
    square(scene, spot);
    let every = (most / ENTRIES).max(1) + u32::from(most > ENTRIES);
    let mut row = 1;
    let mut entry = |words: &str, fill: Color| {
        let (x, y) = legend(scene, panel, row, words);
        scene.add(Primitive::Rect {
            x: x - 9.0,
            y: y - 5.0,
            width: 18.0,
            height: 10.0,
            fill,
            stroke: None,
            stroke_width: None,
            opacity: None,
        });
        row += 1;
    };
    for relays in (0..=most).filter(|relays| relays % every == 0) {
        let words = if relays == 1 { "1 relay".to_owned() } else { format!("{relays} relays") };
        entry(&words, of_relays(Some(relays), most));
    }
    entry("out of reach", GREY);
}
