//! Words right of a map, below each other, each with its mark.

use kuva::render::render::Scene;

use crate::draw::panel::{Panel, TEXT_SMALL, text};

/// Distance between two lines.
const ROW: f64 = 15.0;
/// Longest name in a legend (letters).
const NAME_MAX: usize = 17;

/// A line of a legend: its text, cut where there is no room; the mark is drawn left of it by the caller, around the point returned.
pub(crate) fn legend(scene: &mut Scene, panel: &Panel, row: usize, content: &str) -> (f64, f64) {
    let (x, y) = (panel.right() + 6.0, panel.top() + 7.0 + row as f64 * ROW);
    let fits = content.chars().count() <= NAME_MAX;
    let cut = || content.chars().take(NAME_MAX - 1).chain(['…']).collect();
    text(scene, (x + 21.0, y + 3.5), TEXT_SMALL, &if fits { content.to_owned() } else { cut() });
    (x + 8.0, y)
}
