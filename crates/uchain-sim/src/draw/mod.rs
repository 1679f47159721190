//! Pictures, and the one visual language they speak. kuva lives here only.

pub(crate) mod colour;
pub(crate) mod dots;
#[cfg(any(feature = "sweep", feature = "fit"))]
pub mod figure;
pub(crate) mod ground;
pub(crate) mod loss;
pub(crate) mod name;
pub(crate) mod panel;
pub mod plot;
#[cfg(test)]
pub(crate) mod said;
#[cfg(feature = "sweep")]
pub mod sweep;

use kuva::{RasterBackend, backend::svg::SvgBackend, render::render::Scene};

pub(crate) use panel::{FIGURE_WIDTH, LEFT, Panel, TEXT_LABEL, TEXT_LARGE};

/// Pixels of the PNG per unit of the drawing; 1400 px across.
pub(crate) const SCALE: f32 = 2.0;

/// Distance between two lines of text.
pub(crate) const LINE: f64 = 15.0;
/// Letters of a line of text, and of a headline.
pub(crate) const LONGEST: usize = 104;
pub(crate) const LONGEST_HEADLINE: usize = 86;

/// Why there is no picture.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DrawError {
    /// The picture cannot be turned into a PNG.
    #[error("cannot draw the picture: {0}")]
    Raster(String),
}

/// A picture in two forms.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// 1400 px wide.
    pub png: Vec<u8>,
    /// The same as a drawing.
    pub svg: String,
}

impl Picture {
    pub(crate) fn of(scene: &Scene) -> Result<Self, DrawError> {
        Ok(Self { png: raster(scene)?, svg: SvgBackend::new().render_scene(scene) })
    }
}

pub(crate) fn raster(scene: &Scene) -> Result<Vec<u8>, DrawError> {
    RasterBackend { scale: SCALE }.render_scene(scene).map_err(DrawError::Raster)
}

/// Lines of text of so many letters at most.
pub(crate) fn wrapped(text: &str, longest: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= longest => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}
