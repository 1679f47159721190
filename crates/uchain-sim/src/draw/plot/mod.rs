//! A map to scale, with coordinates that can be read off and typed: `uchain map plot`.

mod labels;
mod sheet;
#[cfg(test)]
mod tests;

use kuva::render::render::{Primitive, Scene};

use super::{
    DrawError,
    colour::{self, FREE, INK},
    ground::paint_lined,
    panel::{LETTER, TEXT_LABEL, TEXT_LARGE, caption, dot, text, unclip},
    raster, wrapped,
};
use crate::map::Map;
use labels::Labels;
use sheet::Sheet;

/// Distance between two lines of text.
const LINE: f64 = 15.0;
/// Radius of a mark, and of a place.
const MARK: f64 = 7.0;
const PLACE: f64 = 2.2;

/// What is drawn on a map. All places are in the map file's own frame (m).
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Plot {
    /// Stands above.
    pub title: String,
    /// Places that somebody asks about: numbered, and described below the map.
    pub marks: Vec<[f64; 2]>,
    /// Places with names, the more important first: they are named as far as there is room.
    pub places: Vec<(String, [f64; 2])>,
    /// Ways through the map.
    pub ways: Vec<Vec<[f64; 2]>>,
    /// Ends of ways.
    pub ends: Vec<[f64; 2]>,
    /// Where ways meet.
    pub junctions: Vec<[f64; 2]>,
}

/// A place that somebody asks about.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spot {
    /// Where, in the map file's own frame (m).
    pub at_m: [f64; 2],
    /// Distance to the nearest wall (m).
    pub clearance_m: f32,
    /// Whether it lies in rock.
    pub in_rock: bool,
}

impl Spot {
    /// What the map says of a place.
    pub fn of(map: &Map, at_m: [f64; 2]) -> Self {
        let at = map.to_local(at_m);
        Self { at_m, clearance_m: map.clearance_m(at), in_rock: map.in_rock(at) }
    }

    /// In words.
    pub fn words(&self) -> String {
        let [x, y] = self.at_m;
        let lies = if self.in_rock { "in rock" } else { "free" };
        format!("({x}, {y}): {lies}, {:.2} m from the nearest wall", self.clearance_m)
    }
}

/// A picture of a map.
#[derive(Debug, Clone, PartialEq)]
pub struct PlotPicture {
    /// The picture.
    pub png: Vec<u8>,
    /// How many of the names found no room.
    pub unnamed: usize,
}

/// Draws a map, its longer side 1240 to 4800 px long: as much as its passages need to be seen.
///
/// # Errors
/// [`DrawError::Raster`].
pub fn plot(map: &Map, plot: &Plot) -> Result<PlotPicture, DrawError> {
    let (scene, unnamed) = scene(map, plot);
    Ok(PlotPicture { png: raster(&scene)?, unnamed })
}

fn scene(map: &Map, plot: &Plot) -> (Scene, usize) {
    let spots: Vec<Spot> = plot.marks.iter().map(|&at_m| Spot::of(map, at_m)).collect();
    let sheet = Sheet::new(map, &plot.marks);
    let letters = ((sheet.width() - 30.0) / LETTER) as usize;
    let notes: Vec<String> = spots
        .iter()
        .enumerate()
        .flat_map(|(i, spot)| wrapped(&format!("{}: {}", i + 1, spot.words()), letters))
        .collect();
    let below = sheet.below();
    let mut scene = Scene::new(sheet.width(), below + LINE * notes.len() as f64 + 6.0);
    let panel = &sheet.panel;
    paint_ground(&mut scene, &sheet, map);
    panel.clip(&mut scene);
    sheet.grid(&mut scene);
    let mut labels = Labels::new(panel);
    let page = |at: [f64; 2]| panel.at(at[0], at[1]);
    for way in &plot.ways {
        scene.add(Primitive::PolyLine {
            points: way.iter().map(|&at| page(at)).collect(),
            stroke: colour::of_uav(1),
            stroke_width: 1.2,
            stroke_dasharray: None,
        });
    }
    for &at in &plot.marks {
        let (x, y) = page(at);
        labels.take((x - MARK, y - MARK), (x + MARK, y + MARK));
    }
    let nodes = plot.ends.iter().map(|&at| (at, 0)).chain(plot.junctions.iter().map(|&at| (at, 1)));
    for (at, kind) in nodes.clone() {
        dot(&mut scene, page(at), PLACE + 0.6, &colour::of_uav(kind), &FREE);
    }
    for (_, at) in &plot.places {
        dot(&mut scene, page(*at), PLACE, &colour::of_uav(2), &FREE);
    }
    let mut unnamed = 0;
    for (at, kind) in nodes {
        let words = sheet.coordinates(at);
        unnamed += usize::from(!labels.put(&mut scene, page(at), &words, &colour::of_uav(kind)));
    }
    for (name, at) in &plot.places {
        unnamed += usize::from(!labels.put(&mut scene, page(*at), name, &INK));
    }
    for (i, &at) in plot.marks.iter().enumerate() {
        let (x, y) = page(at);
        dot(&mut scene, (x, y), MARK, &colour::of_uav(0), &INK);
        caption(&mut scene, (x, y + 3.5), &(i + 1).to_string(), &FREE);
    }
    unclip(&mut scene);
    sheet.frame(&mut scene);
    text(&mut scene, (panel.left(), 20.0), TEXT_LARGE, &plot.title);
    for (i, note) in notes.iter().enumerate() {
        text(&mut scene, (panel.left(), below + LINE * i as f64), TEXT_LABEL, note);
    }
    (scene, unnamed)
}

/// Rock, free space, and walls that are no thicker than what they bound allows.
fn paint_ground(scene: &mut Scene, sheet: &Sheet, map: &Map) {
    sheet.panel.clip(scene);
    paint_lined(scene, &sheet.panel, map, sheet.wall());
    unclip(scene);
}
