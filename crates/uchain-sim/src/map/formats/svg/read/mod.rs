//! An SVG drawing as walls, rock and free space. Elements are walked here and not by a library that draws, for those drop what
//! counts here: the names of layers, classes, and what is hidden; and their coordinates are of 32 bits.

mod counts;
mod lengths;
mod page;
mod paint;
mod scan;
mod shapes;
mod style;
#[cfg(test)]
mod tests;
mod walk;

use std::{collections::BTreeMap, path::Path};

use roxmltree::{Document, ParsingOptions};

use self::{
    counts::Counts,
    page::Page,
    style::{Style, css::Sheet},
    walk::{Around, SVG, Walk},
};
use super::SvgConfig;
use crate::map::{Import, Map, MapError, drawing::Drawing, raster};

/// Most nodes that the parser may make: elements, texts and comments.
const MOST_NODES: u32 = 400_000;
/// The map of a file.
pub(super) fn of_file(file: &Path, config: &SvgConfig) -> Result<Map, MapError> {
    let bytes =
        raster::read(file, scan::MOST_BYTES).map_err(|why| MapError::Read { file: file.to_owned(), why })?;
    svg_in_memory(file, &bytes, config)
}

/// An SVG drawing in memory as a map; `file` is what messages call it, whatever the file of `config` is.
///
/// # Errors
/// What is no SVG drawing, or one too large, with the place, what was expected and what helps; nothing is drawn that leaves free
/// space.
pub fn svg_in_memory(file: &Path, bytes: &[u8], config: &SvgConfig) -> Result<Map, MapError> {
    let drawing = read(bytes, config).map_err(|why| MapError::Read { file: file.to_owned(), why })?;
    drawing.into_map()
}

/// A drawing by its bytes, or what is wrong with it.
fn read(bytes: &[u8], config: &SvgConfig) -> Result<Drawing, String> {
    if bytes.starts_with(&[0x1f, 0x8b]) {
        return Err("it is compressed (.svgz); expected text: unpack it, or save it as plain SVG".into());
    }
    let text = std::str::from_utf8(bytes).map_err(|error| {
        format!("no text in UTF-8 from byte {} on; expected an SVG drawing", error.valid_up_to())
    })?;
    let text = text.trim_start_matches('\u{feff}');
    scan::scan(text)?;
    let options = ParsingOptions { allow_dtd: true, nodes_limit: MOST_NODES, ..ParsingOptions::default() };
    let document = Document::parse_with_options(text, options).map_err(|error| format!("no XML: {error}"))?;
    let root = document.root_element();
    if root.tag_name().name() != "svg" || !matches!(root.tag_name().namespace(), None | Some(SVG)) {
        return Err(format!("its root is <{}>; expected <svg>", root.tag_name().name()));
    }
    let mut import = Import::of(super::FORMAT.name);
    let page = Page::of(root, config, &mut import)?;
    let mut sheet = Sheet::default();
    let mut ids = BTreeMap::new();
    for node in root.descendants().filter(roxmltree::Node::is_element) {
        if node.tag_name().name() == "style" {
            node.children().filter_map(|text| text.text()).try_for_each(|text| sheet.take(text))?;
        }
        if let Some(id) = node.attribute("id") {
            ids.entry(id).or_insert(node);
        }
    }
    let counts = Counts { rules: sheet.strange, ..Counts::default() };
    let drawing = Drawing { outside: config.outside, snap_m: page.snap_m, import, ..Drawing::default() };
    let (px_m, curve_m, wall_m) = (page.px_m, config.curve_m, config.wall_m);
    let mut walk = Walk { ids, sheet, drawing, counts, visits: 0, corners: 0, px_m, curve_m, wall_m };
    walk.root(root, &page)?;
    let Walk { mut drawing, counts, .. } = walk;
    if drawing.free.is_empty() && drawing.solids.is_empty() && drawing.walls.is_empty() {
        return Err(counts.nothing());
    }
    counts.say(&mut drawing.import, config.wall_m);
    Ok(drawing)
}

impl<'a, 'input> Walk<'a, 'input> {
    fn root(&mut self, root: roxmltree::Node<'a, 'input>, page: &Page) -> Result<(), String> {
        let (to_metres, viewport) = (page.to_metres, page.viewport);
        let around =
            Around { to_metres, viewport, style: Style::default(), kind: None, material: None, depth: 0 };
        let around = self.entered(root, "svg", &around);
        self.children(root, &around)
    }
}
