//! A key in a row: what marks mean that no name stands beside.

use kuva::render::render::Scene;

use crate::draw::panel::{FIGURE_WIDTH, LETTER, TEXT_SMALL, text};

/// Distance between two rows.
const ROW: f64 = 16.0;
/// From the middle of a mark to its words, and room left of it.
const ASIDE: f64 = 14.0;
/// Room between two entries.
const GAP: f64 = 18.0;

/// Draws a mark around a point.
type Draw = dyn Fn(&mut Scene, (f64, f64));

/// A mark, and what it means.
pub(crate) struct Entry {
    words: String,
    mark: Box<Draw>,
}

impl Entry {
    /// The mark is drawn around the point it is given, within 10 on either side.
    pub(crate) fn new(words: &str, mark: impl Fn(&mut Scene, (f64, f64)) + 'static) -> Self {
        Self { words: words.to_owned(), mark: Box::new(mark) }
    }

    fn width(&self) -> f64 {
        2.0 * ASIDE + LETTER * self.words.chars().count() as f64
    }
}

/// Where entries go, from a left edge on, as many in a row as there is room.
fn places(entries: &[Entry], left: f64) -> Vec<(f64, f64)> {
    let (mut x, mut row) = (left, 0.0);
    let place = |entry: &Entry| {
        let width = entry.width();
        if x > left && x + width > FIGURE_WIDTH {
            (x, row) = (left, row + 1.0);
        }
        let at = (x + ASIDE - 4.0, ROW * row);
        x += width + GAP - 10.0;
        at
    };
    entries.iter().map(place).collect()
}

/// Height of the key.
pub(crate) fn height(entries: &[Entry], left: f64) -> f64 {
    places(entries, left).last().map_or(0.0, |(_, y)| y + ROW)
}

/// Draws the key below a height of the page.
pub(crate) fn draw(scene: &mut Scene, (left, top): (f64, f64), entries: &[Entry]) {
    for (entry, (x, y)) in entries.iter().zip(places(entries, left)) {
        let y = top + y + 0.5 * ROW;
        (entry.mark)(scene, (x, y));
        text(scene, (x + ASIDE, y + 3.5), TEXT_SMALL, &entry.words);
    }
}
