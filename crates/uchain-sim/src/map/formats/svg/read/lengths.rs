//! Lengths with their units, transforms, and the frame that a `viewBox` lays over a page. In `f64` throughout, for usvg's
//! `f32` knows a surveyor's coordinates to half a metre.

use glam::{DAffine2, DMat2, DVec2};
use svgtypes::{Align, AspectRatio, Length, LengthUnit, TransformListParser, TransformListToken, ViewBox};

/// Pixels of CSS in an inch: what a plain number of a page's width means.
pub(super) const PX_PER_INCH: f64 = 96.0;

/// What per cent are per cent of, in units.
#[derive(Debug, Clone, Copy)]
pub(super) struct Viewport {
    pub(super) size: DVec2,
}

impl Viewport {
    /// What the per cent of a length that is neither along x nor along y are per cent of.
    pub(super) fn diagonal(self) -> f64 {
        self.size.length() / std::f64::consts::SQRT_2
    }
}

/// A length in px; `whole` is what per cent are of. `em` counts as 16 px, for no text is read.
pub(super) fn length(text: &str, whole: f64) -> Option<f64> {
    let Length { number, unit } = text.trim().parse().ok()?;
    let px = match unit {
        LengthUnit::None | LengthUnit::Px => 1.0,
        LengthUnit::Em => 16.0,
        LengthUnit::Ex => 8.0,
        LengthUnit::In => PX_PER_INCH,
        LengthUnit::Cm => PX_PER_INCH / 2.54,
        LengthUnit::Mm => PX_PER_INCH / 25.4,
        LengthUnit::Pt => PX_PER_INCH / 72.0,
        LengthUnit::Pc => PX_PER_INCH / 6.0,
        LengthUnit::Percent => whole / 100.0,
    };
    Some(number * px).filter(|px| px.is_finite())
}

/// A list of transforms as one; `None` if it is damaged.
pub(super) fn transform(text: &str) -> Option<DAffine2> {
    let mut all = DAffine2::IDENTITY;
    for token in TransformListParser::from(text) {
        let shear = |x: f64, y: f64| DAffine2::from_mat2(DMat2::from_cols_array(&[1.0, y, x, 1.0]));
        let one = match token.ok()? {
            TransformListToken::Matrix { a, b, c, d, e, f } => DAffine2::from_cols_array(&[a, b, c, d, e, f]),
            TransformListToken::Translate { tx, ty } => DAffine2::from_translation(DVec2::new(tx, ty)),
            TransformListToken::Scale { sx, sy } => DAffine2::from_scale(DVec2::new(sx, sy)),
            TransformListToken::Rotate { angle } => turned(angle),
            TransformListToken::SkewX { angle } => shear(libm::tan(angle.to_radians()), 0.0),
            TransformListToken::SkewY { angle } => shear(0.0, libm::tan(angle.to_radians())),
        };
        all *= one;
    }
    all.is_finite().then_some(all)
}

/// A turn by so many degrees; by quarters to the last bit.
fn turned(degrees: f64) -> DAffine2 {
    let (sin, cos) = match degrees.rem_euclid(360.0) {
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        _ => (libm::sin(degrees.to_radians()), libm::cos(degrees.to_radians())),
    };
    DAffine2::from_mat2(DMat2::from_cols_array(&[cos, sin, -sin, cos]))
}

/// A `viewBox` with a size, if there is one.
pub(super) fn view_box(text: Option<&str>) -> Option<ViewBox> {
    let view = text?.parse::<ViewBox>().ok()?;
    (view.w > 0.0 && view.h > 0.0 && [view.x, view.y, view.w, view.h].iter().all(|n| n.is_finite()))
        .then_some(view)
}

/// Lays a `viewBox` over a page of a size (px), as `preserveAspectRatio` says.
pub(super) fn laid_over(view: &ViewBox, page: DVec2, aspect: Option<&str>) -> DAffine2 {
    let aspect: AspectRatio = aspect.and_then(|text| text.parse().ok()).unwrap_or_default();
    let each = page / DVec2::new(view.w, view.h);
    let scale = match (aspect.align, aspect.slice) {
        (Align::None, _) => each,
        (_, true) => DVec2::splat(each.max_element()),
        (_, false) => DVec2::splat(each.min_element()),
    };
    let spare = page - scale * DVec2::new(view.w, view.h);
    let share = match aspect.align {
        Align::None | Align::XMinYMin => DVec2::ZERO,
        Align::XMidYMin => DVec2::new(0.5, 0.0),
        Align::XMaxYMin => DVec2::new(1.0, 0.0),
        Align::XMinYMid => DVec2::new(0.0, 0.5),
        Align::XMidYMid => DVec2::new(0.5, 0.5),
        Align::XMaxYMid => DVec2::new(1.0, 0.5),
        Align::XMinYMax => DVec2::new(0.0, 1.0),
        Align::XMidYMax => DVec2::new(0.5, 1.0),
        Align::XMaxYMax => DVec2::new(1.0, 1.0),
    };
    let corner = spare * share - scale * DVec2::new(view.x, view.y);
    DAffine2::from_scale_angle_translation(scale, 0.0, corner)
}
