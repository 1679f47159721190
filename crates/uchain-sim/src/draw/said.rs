//! What a drawing says, for tests: box by box.

use kuva::render::{
    color::Color,
    render::{Primitive, Scene},
};

use super::colour::ROCK;

/// How something is drawn: what it is, its colour, its thickness or radius, how much of it is seen.
pub(crate) type Style = (&'static str, Color, f64, Option<f64>);

/// A box of axes.
#[derive(Default)]
pub(crate) struct Said {
    /// What is painted with rock is a map.
    pub(crate) is_map: bool,
    /// Lines, dashes and dots, in order.
    pub(crate) styles: Vec<Style>,
    /// Words inside.
    pub(crate) words: Vec<String>,
    /// Words after it, its names of lines among them.
    pub(crate) after: Vec<String>,
}

impl Said {
    /// Lines of this thickness.
    pub(crate) fn lines(&self, width: f64) -> usize {
        self.styles.iter().filter(|style| style.0 == "line" && style.2 == width).count()
    }

    /// Names of lines that begin with a word.
    pub(crate) fn names(&self, word: &str) -> Vec<&str> {
        self.after.iter().map(String::as_str).filter(|name| name.starts_with(word)).collect()
    }

    /// Numbers that stand inside, ranges written out.
    pub(crate) fn numbers(&self) -> Vec<usize> {
        let one = |part: &str| match part.split_once('–') {
            Some((first, last)) => first.parse().ok().zip(last.parse().ok()),
            None => part.parse().ok().map(|number| (number, number)),
        };
        let parts = self.words.iter().flat_map(|words| words.split(", "));
        let mut numbers: Vec<usize> =
            parts.filter_map(one).flat_map(|(a, b): (usize, usize)| a..=b).collect();
        numbers.sort_unstable();
        numbers
    }
}

/// All boxes of a drawing.
pub(crate) fn boxes(scene: &Scene) -> Vec<Said> {
    let (mut boxes, mut is_inside): (Vec<Said>, bool) = (Vec::new(), false);
    for element in &scene.elements {
        match element {
            Primitive::ClipStart { .. } => {
                boxes.push(Said::default());
                is_inside = true;
            }
            Primitive::ClipEnd => is_inside = false,
            _ => {}
        }
        let Some(last) = boxes.last_mut() else { continue };
        match element {
            Primitive::Text { content, .. } if is_inside => last.words.push(content.clone()),
            Primitive::Text { content, .. } => last.after.push(content.clone()),
            Primitive::Rect { fill, .. } if is_inside => last.is_map |= *fill == ROCK,
            Primitive::PolyLine { stroke, stroke_width, .. } if is_inside => {
                last.styles.push(("line", stroke.clone(), *stroke_width, None));
            }
            Primitive::Path(path) if is_inside && path.fill.is_none() => {
                last.styles.push(("dashes", path.stroke.clone(), path.stroke_width, path.opacity));
            }
            Primitive::CircleBatch { r, fill, fill_opacity, .. } if is_inside => {
                last.styles.push(("dots", fill.clone(), *r, *fill_opacity));
            }
            _ => {}
        }
    }
    boxes
}

/// All words of a drawing.
pub(crate) fn words(scene: &Scene) -> Vec<&str> {
    let words = scene.elements.iter().filter_map(|element| match element {
        Primitive::Text { content, .. } => Some(content.as_str()),
        _ => None,
    });
    words.collect()
}
