//! From element to element, with what each hands on to those within it.

use std::collections::BTreeMap;

use glam::{DAffine2, DVec2};
use roxmltree::Node;

use super::{
    counts::Counts,
    lengths::{Viewport, laid_over, length, transform, view_box},
    scan::DEEPEST,
    style::{
        self, Style,
        css::{Sheet, declarations},
    },
};
use crate::map::drawing::{
    Drawing,
    reading::names::{Kind, kind_of, material_of_class, material_of_id, material_of_layer},
};

pub(super) const SVG: &str = "http://www.w3.org/2000/svg";
const XLINK: &str = "http://www.w3.org/1999/xlink";
pub(super) const INKSCAPE: &str = "http://www.inkscape.org/namespaces/inkscape";

/// Most elements that are drawn, those that `use` draws again among them.
const MOST_VISITS: usize = 200_000;

/// Longest name of a place or a material, in letters.
pub(super) const LONGEST_NAME: usize = 80;

/// What an element inherits.
#[derive(Debug, Clone, Copy)]
pub(super) struct Around {
    pub(super) to_metres: DAffine2,
    pub(super) viewport: Viewport,
    pub(super) style: Style,
    pub(super) kind: Option<Kind>,
    pub(super) material: Option<usize>,
    pub(super) depth: usize,
}

/// The drawing so far.
pub(super) struct Walk<'a, 'input> {
    pub(super) ids: BTreeMap<&'a str, Node<'a, 'input>>,
    pub(super) sheet: Sheet<'a>,
    pub(super) drawing: Drawing,
    pub(super) counts: Counts,
    pub(super) visits: usize,
    pub(super) corners: usize,
    /// Metres of a px of the page.
    pub(super) px_m: f64,
    pub(super) curve_m: f64,
    pub(super) wall_m: f64,
}

impl<'a, 'input> Walk<'a, 'input> {
    /// Draws an element and all within it; `linked` if a `use` names it.
    pub(super) fn visit(
        &mut self,
        node: Node<'a, 'input>,
        around: &Around,
        linked: bool,
    ) -> Result<(), String> {
        if !node.is_element() || !matches!(node.tag_name().namespace(), None | Some(SVG)) {
            return Ok(());
        }
        let tag = node.tag_name().name();
        if is_definition(tag) && !(linked && tag == "symbol") {
            return Ok(());
        }
        self.visits += 1;
        if self.visits > MOST_VISITS || around.depth > DEEPEST {
            return Err(format!(
                "more than {MOST_VISITS} elements, or more than {DEEPEST} within each other, with all that <use> draws \
                 again; expected fewer: does a <use> name what it is in? Unlink the clones"
            ));
        }
        let inner = self.entered(node, tag, around);
        if inner.style.is_gone {
            self.counts.hidden += 1;
            return Ok(());
        }
        if inner.kind == Some(Kind::Ignored) {
            self.counts.ignored += 1;
            return Ok(());
        }
        match tag {
            "g" | "a" | "switch" => self.children(node, &inner),
            "svg" | "symbol" => {
                let size = page(node, None, inner.viewport);
                let inner = inner.in_view(node, origin(node, inner.viewport), size);
                self.children(node, &inner)
            }
            "use" => self.linked(node, &inner),
            "text" => {
                self.text(node, &inner);
                Ok(())
            }
            "image" | "foreignObject" | "video" | "canvas" | "iframe" => {
                self.counts.images += 1;
                Ok(())
            }
            _ => self.shape(node, tag, &inner),
        }
    }

    pub(super) fn children(&mut self, node: Node<'a, 'input>, around: &Around) -> Result<(), String> {
        let within = Around { style: around.style.handed_on(), depth: around.depth + 1, ..*around };
        node.children().try_for_each(|child| self.visit(child, &within, false))
    }

    fn linked(&mut self, node: Node<'a, 'input>, around: &Around) -> Result<(), String> {
        let href = node.attribute("href").or_else(|| node.attribute((XLINK, "href"))).unwrap_or_default();
        let Some(&target) = href.trim().strip_prefix('#').and_then(|id| self.ids.get(id)) else {
            self.counts.links += 1;
            return Ok(());
        };
        let style = around.style.handed_on();
        let within = Around { style, depth: around.depth + 1, ..around.moved(origin(node, around.viewport)) };
        if !matches!(target.tag_name().name(), "symbol" | "svg") {
            return self.visit(target, &within, true);
        }
        // The size that the `use` gives counts, or else the target's own, or else all there is.
        let size = page(node, Some(target), around.viewport);
        let tag = target.tag_name().name();
        let entered = self.entered(target, tag, &within);
        let inner = entered.in_view(target, origin(target, around.viewport), size);
        self.visits += 1;
        self.children(target, &inner)
    }

    /// What an element makes of what it inherits: its transform, its style, what its names say.
    pub(super) fn entered(&mut self, node: Node<'a, 'input>, tag: &str, around: &Around) -> Around {
        let mut inner = *around;
        if let Some(text) = node.attribute("transform") {
            match transform(text) {
                Some(own) => inner.to_metres = around.to_metres * own,
                None => self.counts.damaged += 1,
            }
        }
        for attribute in node.attributes().filter(|attribute| style::counts(attribute.name())) {
            inner.style.take(attribute.name(), attribute.value(), around.viewport);
        }
        let class = node.attribute("class").unwrap_or_default();
        let id = node.attribute("id").unwrap_or_default();
        if !self.sheet.is_empty() {
            let said = self.sheet.of(tag, class, id);
            said.for_each(|(name, value)| inner.style.take(name, value, around.viewport));
        }
        for (name, value) in node.attribute("style").into_iter().flat_map(declarations) {
            inner.style.take(name, value, around.viewport);
        }
        let unsupported =
            ["clip-path", "mask"].iter().any(|name| node.attribute(*name).is_some_and(|text| text != "none"));
        self.counts.clipped += usize::from(unsupported);
        self.named(node, tag, id, class, &mut inner);
        inner
    }

    fn named(&mut self, node: Node<'a, 'input>, tag: &str, id: &str, class: &str, inner: &mut Around) {
        let label = node.attribute((INKSCAPE, "label")).unwrap_or_default();
        let classes = || class.split_whitespace().take(20);
        if let Some(kind) = [label, id].into_iter().chain(classes()).find_map(kind_of) {
            inner.kind = Some(kind);
        }
        let is_group = tag == "g";
        let of_name = |name| if is_group { material_of_layer(name) } else { material_of_id(name) };
        let own = node.attribute("data-material").map(str::trim).filter(|name| !name.is_empty());
        let own = own.map(|name| name.chars().take(LONGEST_NAME).collect());
        let material = own.or_else(|| of_name(label)).or_else(|| of_name(id));
        let material = material.or_else(|| classes().find_map(material_of_class));
        let loss_db = node.attribute("data-loss-db").and_then(|text| text.trim().parse().ok());
        let loss_db = loss_db.filter(|loss_db: &f32| (0.0..=1000.0).contains(loss_db));
        if material.is_some() || loss_db.is_some() {
            let name = material.unwrap_or_else(|| "unnamed".to_owned());
            inner.material = Some(self.drawing.material(&name, loss_db));
        }
    }
}

impl Around {
    fn moved(&self, by: DVec2) -> Self {
        Self { to_metres: self.to_metres * DAffine2::from_translation(by), ..*self }
    }

    /// Within the frame of an inner `svg` or of a `symbol` that is drawn.
    fn in_view(&self, node: Node, at: DVec2, size: DVec2) -> Self {
        let moved = self.moved(at);
        let Some(view) = view_box(node.attribute("viewBox")) else {
            return Self { viewport: Viewport { size }, ..moved };
        };
        let laid = laid_over(&view, size, node.attribute("preserveAspectRatio"));
        let viewport = Viewport { size: DVec2::new(view.w, view.h) };
        Self { to_metres: moved.to_metres * laid, viewport, ..moved }
    }
}

fn origin(node: Node, viewport: Viewport) -> DVec2 {
    let at = |name, whole| node.attribute(name).and_then(|text| length(text, whole)).unwrap_or(0.0);
    DVec2::new(at("x", viewport.size.x), at("y", viewport.size.y))
}

/// The size of an inner page: an element's own, or else another's, or else all there is.
fn page(node: Node, other: Option<Node>, viewport: Viewport) -> DVec2 {
    let side = |name, whole| {
        let own = node.attribute(name).or_else(|| other?.attribute(name));
        own.and_then(|text| length(text, whole)).unwrap_or(whole)
    };
    DVec2::new(side("width", viewport.size.x), side("height", viewport.size.y))
}

/// What is not drawn where it stands.
fn is_definition(tag: &str) -> bool {
    matches!(
        tag,
        "defs"
            | "symbol"
            | "clipPath"
            | "mask"
            | "marker"
            | "pattern"
            | "linearGradient"
            | "radialGradient"
            | "filter"
            | "style"
            | "script"
            | "title"
            | "desc"
            | "metadata"
            | "font"
            | "animate"
            | "set"
            | "view"
            | "cursor"
            | "stop"
    )
}
