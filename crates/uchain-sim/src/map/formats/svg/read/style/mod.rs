//! How an element is painted: what of its style makes rock, walls or free space of it.

pub(super) mod css;

use svgtypes::Paint;

use super::lengths::{Viewport, length};
use crate::map::drawing::reading::rings::FillRule;

/// What a fill or a stroke shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Ink {
    Nothing,
    /// The colour of paper: covers, but draws nothing.
    White,
    Colour,
}

/// What an element inherits, and hands on to those within it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Style {
    fill: Ink,
    fill_opacity: f64,
    pub(super) fill_rule: FillRule,
    stroke: Ink,
    stroke_opacity: f64,
    /// In the element's own units.
    pub(super) stroke_width: f64,
    is_visible: bool,
    /// Not inherited: whether the element and all within it are left out.
    pub(super) is_gone: bool,
    /// Not inherited: the stroke is as wide as on paper, whatever the transform.
    pub(super) keeps_width: bool,
}

impl Default for Style {
    /// Black areas without a stroke.
    fn default() -> Self {
        Self {
            fill: Ink::Colour,
            fill_opacity: 1.0,
            fill_rule: FillRule::NonZero,
            stroke: Ink::Nothing,
            stroke_opacity: 1.0,
            stroke_width: 1.0,
            is_visible: true,
            is_gone: false,
            keeps_width: false,
        }
    }
}

impl Style {
    /// What is handed on to the elements within.
    pub(super) fn handed_on(self) -> Self {
        Self { is_gone: false, keeps_width: false, ..self }
    }

    pub(super) fn fill(&self) -> Ink {
        if self.fill_opacity > 0.0 { self.fill } else { Ink::Nothing }
    }

    pub(super) fn stroke(&self) -> Ink {
        if self.stroke_opacity > 0.0 && self.stroke_width > 0.0 { self.stroke } else { Ink::Nothing }
    }

    pub(super) fn is_hidden(&self) -> bool {
        self.is_gone || !self.is_visible
    }

    /// Takes one property; a value that means nothing leaves what was.
    pub(super) fn take(&mut self, name: &str, value: &str, viewport: Viewport) {
        match name {
            "fill" => ink(value, &mut self.fill),
            "stroke" => ink(value, &mut self.stroke),
            "fill-opacity" => share(value, &mut self.fill_opacity),
            "stroke-opacity" => share(value, &mut self.stroke_opacity),
            "fill-rule" if value == "evenodd" => self.fill_rule = FillRule::EvenOdd,
            "fill-rule" if value == "nonzero" => self.fill_rule = FillRule::NonZero,
            "stroke-width" => {
                if let Some(width) = length(value, viewport.diagonal()).filter(|width| *width >= 0.0) {
                    self.stroke_width = width;
                }
            }
            "visibility" if matches!(value, "hidden" | "collapse") => self.is_visible = false,
            "visibility" if value == "visible" => self.is_visible = true,
            "display" => self.is_gone |= value == "none",
            "opacity" => {
                let mut opacity = 1.0;
                share(value, &mut opacity);
                self.is_gone |= opacity <= 0.0;
            }
            "vector-effect" => self.keeps_width = value == "non-scaling-stroke",
            _ => {}
        }
    }
}

/// Names of properties that count here, for elements carry others by the dozen.
pub(super) fn counts(name: &str) -> bool {
    matches!(
        name,
        "fill"
            | "stroke"
            | "fill-opacity"
            | "stroke-opacity"
            | "fill-rule"
            | "stroke-width"
            | "visibility"
            | "display"
            | "opacity"
            | "vector-effect"
    )
}

fn ink(value: &str, ink: &mut Ink) {
    *ink = match Paint::from_str(value) {
        Ok(Paint::None) => Ink::Nothing,
        Ok(Paint::Color(colour)) if colour.alpha == 0 => Ink::Nothing,
        Ok(Paint::Color(colour)) if [colour.red, colour.green, colour.blue] == [255; 3] => Ink::White,
        Ok(Paint::Inherit) | Err(_) => return,
        Ok(_) => Ink::Colour,
    };
}

/// `0.5` or `50%`.
fn share(value: &str, share: &mut f64) {
    let number = match value.strip_suffix('%') {
        Some(percent) => percent.trim().parse().map(|percent: f64| percent / 100.0),
        None => value.parse(),
    };
    if let Ok(number) = number {
        *share = number;
    }
}
