//! A map as an SVG drawing: one unit is a metre, the page is at 1:100.

use std::fmt::Write as _;

use glam::DVec2;

use super::parts::{Parts, Rock};
use crate::map::Map;

/// Paper around the map (m).
const MARGIN_M: f64 = 1.0;

/// The map as an SVG drawing, for Inkscape or a browser, and for `[map.svg]`, which reads every wall again within a millimetre.
/// Layers are called by what is on them: free space, rock by its material, places. Where the map lies in its file's frame, and how
/// it was read, is kept.
#[must_use]
pub fn write_svg(map: &Map) -> String {
    let (low, high) = map.bounds();
    let (low, high) = (low.as_dvec2() - MARGIN_M, high.as_dvec2() + MARGIN_M);
    let size = high - low;
    let page = Page { low, high };
    let [x, y] = map.offset_m();
    let parts = Parts::of(map);
    let mut text = String::new();
    let about = map.import().about_deg.map(|[lon, lat]| format!(" data-uchain-about-deg=\"{lon} {lat}\""));
    let _ = write!(
        text,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" width=\"{}mm\" \
         height=\"{}mm\" viewBox=\"0 0 {} {}\" data-uchain-unit-m=\"1\" data-uchain-origin-m=\"{} {}\"{}>\n<desc>{}</desc>\n",
        10.0 * size.x,
        10.0 * size.y,
        size.x,
        size.y,
        low.x + x,
        low.y + y,
        about.unwrap_or_default(),
        escaped(&told(map)),
    );
    let _ = write!(
        text,
        "<g id=\"background\" inkscape:groupmode=\"layer\" inkscape:label=\"background\"><rect width=\"{}\" height=\"{}\" \
         fill=\"#999\"/></g>\n<g id=\"free\" inkscape:groupmode=\"layer\" inkscape:label=\"free\" fill=\"#fff\">\n",
        size.x, size.y
    );
    for outline in &parts.free {
        let _ = writeln!(text, "<path d=\"{}\"/>", page.path(std::slice::from_ref(outline)));
    }
    text.push_str("</g>\n");
    rock(&mut text, &page, &parts);
    let _ = writeln!(
        text,
        "<g id=\"places\" inkscape:groupmode=\"layer\" inkscape:label=\"places\" fill=\"#c00\">"
    );
    for place in map.places() {
        let at = page.place(map.to_local(place.at_m).as_dvec2());
        let height =
            place.height_m.map(|height_m| format!(" data-height-m=\"{height_m}\"")).unwrap_or_default();
        let name = escaped(&place.name);
        let _ = writeln!(
            text,
            "<circle cx=\"{:.5}\" cy=\"{:.5}\" r=\"0.2\"{height}><title>{name}</title></circle>",
            at.x, at.y
        );
    }
    text.push_str("</g>\n</svg>\n");
    text
}

/// A layer for each material, and one for rock of none.
fn rock(text: &mut String, page: &Page, parts: &Parts) {
    let mut rest: Vec<&Rock> = parts.rock.iter().collect();
    while let Some(first) = rest.first() {
        let material = first.material;
        let (own, others): (Vec<&Rock>, Vec<&Rock>) = rest.iter().partition(|rock| rock.material == material);
        rest = others;
        let words = material.map(|material| {
            let name = escaped(&material.name);
            let loss =
                material.loss_db.map(|loss_db| format!(" data-loss-db=\"{loss_db}\"")).unwrap_or_default();
            (format!(" {name}"), format!(" data-material=\"{name}\"{loss}"))
        });
        let (label, data) = words.unwrap_or_default();
        let _ = writeln!(
            text,
            "<g class=\"rock\" inkscape:groupmode=\"layer\" inkscape:label=\"rock{label}\"{data} fill=\"#999\" fill-rule=\"evenodd\">"
        );
        for rock in own {
            let _ = writeln!(text, "<path d=\"{}\"/>", page.path(&rock.rings));
        }
        text.push_str("</g>\n");
    }
}

/// How the map was read, in a line.
fn told(map: &Map) -> String {
    let import = map.import();
    let remarks: Vec<String> = import.remarks.iter().map(ToString::to_string).collect();
    let of = if import.format.is_empty() { String::new() } else { format!(", read as {}", import.format) };
    let remarks = if remarks.is_empty() { String::new() } else { format!(": {}", remarks.join("; ")) };
    format!("A map of uchain in metres{of}{remarks}")
}

struct Page {
    low: DVec2,
    high: DVec2,
}

impl Page {
    fn place(&self, at: DVec2) -> DVec2 {
        DVec2::new(at.x - self.low.x, self.high.y - at.y)
    }

    fn path(&self, rings: &[Vec<DVec2>]) -> String {
        let mut data = String::new();
        for ring in rings {
            for (index, &at) in ring.iter().enumerate() {
                let at = self.place(at);
                let _ = write!(data, "{}{:.5},{:.5}", if index == 0 { "M" } else { " " }, at.x, at.y);
            }
            data.push('Z');
        }
        data
    }
}

/// Text as XML takes it: what XML has no words for is a question mark.
fn escaped(text: &str) -> String {
    let mut escaped = String::new();
    for letter in text.chars() {
        match letter {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => escaped.push('?'),
            c => escaped.push(c),
        }
    }
    escaped
}
