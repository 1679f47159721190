//! The page: how large it is in metres, and where its corner lies.

use glam::{DAffine2, DVec2};

use super::lengths::{PX_PER_INCH, Viewport, laid_over, length, view_box};
use crate::map::{Import, RemarkKind, formats::SvgConfig};

/// A drawing that says no scale is 1:100.
const SCALE: f64 = 100.0;
/// Edges shorter than this are drawn together, unless a key says otherwise (m).
const SNAP_M: f64 = 0.01;

/// The page that everything stands on.
pub(super) struct Page {
    /// Metres of a px of the page.
    pub(super) px_m: f64,
    pub(super) to_metres: DAffine2,
    pub(super) viewport: Viewport,
    pub(super) snap_m: f64,
}

impl Page {
    pub(super) fn of(root: roxmltree::Node, config: &SvgConfig, import: &mut Import) -> Result<Self, String> {
        let view = view_box(root.attribute("viewBox"));
        let whole = view.map_or(DVec2::new(300.0, 150.0), |view| DVec2::new(view.w, view.h));
        let side = |name: &str, whole: f64| {
            let said = root.attribute(name).filter(|text| !text.trim_end().ends_with('%'));
            said.and_then(|text| length(text, 0.0)).filter(|px| *px > 0.0).unwrap_or(whole)
        };
        let size = DVec2::new(side("width", whole.x), side("height", whole.y));
        let laid = view
            .map_or(DAffine2::IDENTITY, |view| laid_over(&view, size, root.attribute("preserveAspectRatio")));
        let units = laid.matrix2.x_axis.x;
        let numbers = |name: &str| {
            let text = root.attribute(name).unwrap_or_default();
            text.split_whitespace()
                .map(|number| number.parse().ok().filter(|n: &f64| n.is_finite()))
                .collect::<Option<Vec<f64>>>()
        };
        let own_m = match numbers("data-uchain-unit-m").as_deref() {
            Some(&[unit_m]) if unit_m > 0.0 => Some(unit_m),
            _ => None,
        };
        let paper_m = 0.0254 / PX_PER_INCH;
        let (px_m, kind, why) = match (config.width_m, config.unit_m, config.scale) {
            (Some(width_m), ..) => (width_m / size.x, RemarkKind::Read, "by width_m".to_owned()),
            (_, Some(unit_m), _) => (unit_m / units, RemarkKind::Read, "by unit_m".to_owned()),
            (.., Some(scale)) => (paper_m * scale, RemarkKind::Read, format!("1:{scale} by scale")),
            _ if own_m.is_some() => {
                (own_m.unwrap_or(1.0) / units, RemarkKind::Read, "as the file says".to_owned())
            }
            _ => (
                paper_m * SCALE,
                RemarkKind::Guessed,
                format!("1:{SCALE} for want of the key scale, unit_m or width_m"),
            ),
        };
        let size_m = size * px_m;
        if !(px_m > 0.0 && size_m.is_finite() && units > 0.0) {
            return Err(format!(
                "a page of {} × {} m; expected numbers: look at width, height and viewBox",
                size_m.x, size_m.y
            ));
        }
        let unit_m = units * px_m;
        let said =
            format!("scale, {why}: 1 unit is {unit_m:.4} m, the page {:.1} × {:.1} m", size_m.x, size_m.y);
        import.say(kind, 1, said);
        import.about_deg = match numbers("data-uchain-about-deg").as_deref() {
            Some(&[lon, lat]) if lon.abs() <= 180.0 && lat.abs() <= 90.0 => Some([lon, lat]),
            _ => None,
        };
        let corner = match numbers("data-uchain-origin-m").as_deref() {
            Some(&[x, y]) => DVec2::new(x, y),
            _ => DVec2::ZERO,
        };
        // The page's lower left corner is the origin, y runs up.
        let up = DAffine2::from_scale_angle_translation(
            DVec2::new(px_m, -px_m),
            0.0,
            corner + DVec2::new(0.0, size_m.y),
        );
        let viewport = Viewport { size: view.map_or(size, |view| DVec2::new(view.w, view.h)) };
        let snap_m = config.snap_m.unwrap_or(if own_m.is_some() { 0.0 } else { SNAP_M });
        Ok(Self { px_m, to_metres: up * laid, viewport, snap_m })
    }
}
