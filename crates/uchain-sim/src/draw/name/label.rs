//! Names of lines, at their right ends.

use kuva::render::{color::Color, render::Scene};

use crate::draw::panel::{Panel, TEXT_SMALL, rule, text};

/// Least distance between two names.
const ROW: f64 = 12.0;
/// Longest name (letters).
const NAME_MAX: usize = 17;
/// From the box to the names; what leads there has room.
const ASIDE: f64 = 14.0;

/// Where a line ends on the page, and what it is called.
pub(crate) struct Ending {
    pub(crate) at: (f64, f64),
    pub(crate) words: String,
    pub(crate) colour: Color,
}

/// Writes the names right of a box, as near to the ends of their lines as they fit below each other.
pub(crate) fn name_ends(scene: &mut Scene, panel: &Panel, mut endings: Vec<Ending>) {
    endings.retain(|ending| ending.at.0.is_finite() && ending.at.1.is_finite());
    // What ends outside is not seen; its name is at the edge.
    for ending in &mut endings {
        ending.at.1 = ending.at.1.max(panel.top()).min(panel.bottom());
    }
    endings.sort_by(|a, b| a.at.1.total_cmp(&b.at.1));
    let wanted: Vec<f64> = endings.iter().map(|ending| ending.at.1).collect();
    for (ending, y) in endings.iter().zip(apart(&wanted)) {
        let (x, from_y) = ending.at;
        let right = panel.right();
        // A line that ends early is led to the edge.
        if x < right - 1.0 {
            rule(scene, (x, from_y), (right, from_y), &ending.colour, 0.6, Some("1 3"));
        }
        rule(scene, (right, from_y), (right + ASIDE - 3.0, y), &ending.colour, 1.6, None);
        text(scene, (right + ASIDE, y + 3.5), TEXT_SMALL, &short(&ending.words));
    }
}

fn short(words: &str) -> String {
    if words.chars().count() <= NAME_MAX {
        return words.to_owned();
    }
    words.chars().take(NAME_MAX - 1).chain(['…']).collect()
}

/// Sorted heights, moved as little as they have to be to lie a row apart: those that are too near share their mean.
fn apart(wanted: &[f64]) -> Vec<f64> {
    // Each group: how many, and the sum of where its first one would be.
    let mut groups: Vec<(usize, f64)> = Vec::new();
    let middle = |(count, sum): (usize, f64)| sum / count as f64;
    for (i, y) in wanted.iter().enumerate() {
        groups.push((1, y - ROW * i as f64));
        while let [.., a, b] = groups[..]
            && middle(a) > middle(b)
        {
            groups.truncate(groups.len() - 2);
            groups.push((a.0 + b.0, a.1 + b.1));
        }
    }
    let firsts = groups.iter().flat_map(|group| std::iter::repeat_n(middle(*group), group.0));
    firsts.enumerate().map(|(i, first)| first + ROW * i as f64).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_lie_a_row_apart_and_no_farther_off_than_they_must() {
        let is_near = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-9);
        assert!(is_near(&apart(&[10.0, 50.0, 90.0]), &[10.0, 50.0, 90.0]));
        assert!(is_near(&apart(&[50.0, 50.0, 50.0]), &[38.0, 50.0, 62.0]));
        let crowded = apart(&[50.0, 51.0, 52.0, 53.0, 100.0]);
        assert!(crowded.windows(2).all(|pair| pair[1] - pair[0] > ROW - 1e-9), "{crowded:?}");
        assert!((crowded[4] - 100.0).abs() < 1e-9);
    }
}
