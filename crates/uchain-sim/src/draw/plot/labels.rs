//! Names beside places, none over another one.

use kuva::render::{
    color::Color,
    render::{Primitive, Scene, TextAnchor},
};

use crate::draw::{
    colour::FREE,
    panel::{LETTER, Panel, TEXT_SMALL},
};

/// Height of a name, and its distance from its place.
const HEIGHT: f64 = 11.0;
const ASIDE: f64 = 5.0;
/// Longest name (letters).
const LONGEST: usize = 40;
/// Side of the boxes in which taken room is looked up.
const CELL: f64 = 64.0;

/// A box on the page: its least and its greatest corner.
type Room = [(f64, f64); 2];

/// What is taken of a panel.
pub(super) struct Labels {
    low: (f64, f64),
    high: (f64, f64),
    cols: usize,
    taken: Vec<Vec<Room>>,
}

impl Labels {
    pub(super) fn new(panel: &Panel) -> Self {
        let (low, high) = ((panel.left(), panel.top()), (panel.right(), panel.bottom()));
        let count = |from: f64, to: f64| ((to - from) / CELL) as usize + 1;
        let (cols, rows) = (count(low.0, high.0), count(low.1, high.1));
        Self { low, high, cols, taken: vec![Vec::new(); cols * rows] }
    }

    /// Nothing is written there any more.
    pub(super) fn take(&mut self, low: (f64, f64), high: (f64, f64)) {
        for cell in self.cells(low, high) {
            self.taken[cell].push([low, high]);
        }
    }

    /// Writes a name right of a place, else left, above or below; whether there was room.
    pub(super) fn put(&mut self, scene: &mut Scene, (x, y): (f64, f64), name: &str, colour: &Color) -> bool {
        let words: String = name.chars().take(LONGEST).collect();
        let width = LETTER * words.chars().count() as f64;
        let low = [
            (x + ASIDE, y - HEIGHT / 2.0),
            (x - ASIDE - width, y - HEIGHT / 2.0),
            (x - width / 2.0, y - ASIDE - HEIGHT),
            (x - width / 2.0, y + ASIDE),
        ];
        let place = low.into_iter().find(|&(x, y)| self.is_free((x, y), (x + width, y + HEIGHT)));
        let Some((x, y)) = place else { return false };
        self.take((x, y), (x + width, y + HEIGHT));
        scene.add(Primitive::Rect {
            x: x - 1.0,
            y,
            width: width + 2.0,
            height: HEIGHT,
            fill: FREE,
            stroke: None,
            stroke_width: None,
            opacity: Some(0.75),
        });
        scene.add(Primitive::Text {
            x,
            y: y + HEIGHT - 2.0,
            content: words,
            size: TEXT_SMALL,
            anchor: TextAnchor::Start,
            rotate: None,
            bold: false,
            color: Some(colour.clone()),
        });
        true
    }

    fn is_free(&self, low: (f64, f64), high: (f64, f64)) -> bool {
        let is_inside =
            low.0 >= self.low.0 && low.1 >= self.low.1 && high.0 <= self.high.0 && high.1 <= self.high.1;
        let meets = |[a, b]: &Room| a.0 < high.0 && low.0 < b.0 && a.1 < high.1 && low.1 < b.1;
        is_inside && self.cells(low, high).all(|cell| !self.taken[cell].iter().any(meets))
    }

    /// The boxes that a box touches.
    fn cells(&self, low: (f64, f64), high: (f64, f64)) -> impl Iterator<Item = usize> + use<> {
        let (cols, rows) = (self.cols, self.taken.len() / self.cols);
        let index = |at: f64, from: f64, count: usize| (((at - from) / CELL) as usize).min(count - 1);
        let (left, right) = (index(low.0, self.low.0, cols), index(high.0, self.low.0, cols));
        let (top, bottom) = (index(low.1, self.low.1, rows), index(high.1, self.low.1, rows));
        (top..=bottom).flat_map(move |row| (left..=right).map(move |col| row * cols + col))
    }
}
