//! The rule by which what is drawn becomes walls, rock and free space.

use roxmltree::Node;

use super::{
    shapes::{Layout, drawn},
    style::Ink,
    walk::{Around, INKSCAPE, LONGEST_NAME, Walk},
};
use crate::map::{
    FRAME_MAX_M, Place,
    drawing::{
        MOST_CORNERS, Shape, Solid, Wall,
        reading::{curve::Line, names::Kind, passage::passage, rings::areas},
    },
};

impl<'a, 'input> Walk<'a, 'input> {
    /// One path or basic shape.
    pub(super) fn shape(&mut self, node: Node<'a, 'input>, tag: &str, around: &Around) -> Result<(), String> {
        let most = MOST_CORNERS - self.corners;
        let Around { to_metres, viewport, style, .. } = *around;
        let layout = Layout { to_metres, viewport, within_m: self.curve_m, most };
        if style.is_hidden() {
            self.counts.hidden += 1;
            return Ok(());
        }
        let Some(drawn) = drawn(node, tag, &layout) else {
            self.counts.unknown += 1;
            return Ok(());
        };
        self.counts.damaged += usize::from(drawn.is_damaged);
        let mut lines = drawn.lines;
        for line in &mut lines {
            self.checked(node, line)?;
        }
        lines.retain(|line| line.points.len() > 1);
        if around.kind == Some(Kind::Place) {
            self.place(node, &lines, node.attribute("id"));
            return Ok(());
        }
        let (fill, stroke) = (if tag == "line" { Ink::Nothing } else { style.fill() }, style.stroke());
        if fill == Ink::Nothing && stroke == Ink::Nothing {
            self.counts.unpainted += 1;
        } else if lines.is_empty() {
            self.counts.points += 1;
        } else {
            self.painted(lines, around, fill, stroke).map_err(|why| format!("{}: {why}", called(node)))?;
        }
        Ok(())
    }

    /// By its paint and by what its names say.
    fn painted(&mut self, lines: Vec<Line>, around: &Around, fill: Ink, stroke: Ink) -> Result<(), String> {
        let names_an_area = matches!(around.kind, Some(Kind::Free | Kind::Rock));
        let free = around.kind == Some(Kind::Free);
        if free && fill != Ink::Nothing {
            return self.area(lines, around, true);
        }
        if fill == Ink::Nothing && names_an_area {
            // Only outlined: what is closed is an area all the same.
            let (closed, open): (Vec<Line>, Vec<Line>) = lines.into_iter().partition(|line| line.closed);
            if !closed.is_empty() {
                self.area(closed, around, free)?;
            }
            self.stroked(open, around, free);
            return Ok(());
        }
        if fill != Ink::Colour && stroke != Ink::Colour {
            self.counts.white += 1;
            return Ok(());
        }
        if stroke == Ink::Colour {
            self.stroked(lines.clone(), around, false);
        }
        if fill == Ink::Colour { self.area(lines, around, false) } else { Ok(()) }
    }

    fn area(&mut self, lines: Vec<Line>, around: &Around, free: bool) -> Result<(), String> {
        let rings = lines.into_iter().map(|line| line.points).collect();
        let shapes = areas(rings, around.style.fill_rule)
            .ok_or("more rings within each other than can be told apart; cut it up")?;
        if free {
            self.counts.free += 1;
            self.drawing.free.extend(shapes);
        } else {
            self.counts.rock += 1;
            let material = around.material;
            self.drawing.solids.extend(shapes.into_iter().map(|shape| Solid { shape, material }));
        }
        Ok(())
    }

    /// Lines as wide as their stroke: walls, or passages.
    fn stroked(&mut self, lines: Vec<Line>, around: &Around, free: bool) {
        let grown = if around.style.keeps_width {
            self.px_m
        } else {
            around.to_metres.matrix2.determinant().abs().sqrt()
        };
        let width_m = around.style.stroke_width * grown;
        for line in lines {
            let points: Vec<[f64; 2]> = line.points.into_iter().map(Into::into).collect();
            if free {
                self.counts.free += 1;
                self.corners += 20 * points.len();
                self.drawing.free.extend::<Vec<Shape>>(passage(&points, line.closed, width_m));
            } else {
                self.counts.walls += 1;
                self.counts.thin += usize::from(width_m < self.wall_m);
                let (thickness_m, material) = (width_m.max(self.wall_m), around.material);
                self.drawing.walls.push(Wall { line: points, closed: line.closed, thickness_m, material });
            }
        }
    }

    /// Counts the corners of a line, and refuses what is no place. Corners in a row that are one count once.
    fn checked(&mut self, node: Node, line: &mut Line) -> Result<(), String> {
        self.corners += line.points.len();
        if self.corners > MOST_CORNERS {
            return Err(format!(
                "more than {MOST_CORNERS} corners; expected fewer: simplify it, or raise curve_m"
            ));
        }
        let is_far = |at: &&glam::DVec2| !(at.x.abs() <= FRAME_MAX_M && at.y.abs() <= FRAME_MAX_M);
        if let Some(at) = line.points.iter().find(is_far) {
            let (name, x, y) = (called(node), at.x, at.y);
            return Err(format!(
                "{name}: a corner at ({x:e}, {y:e}) m; expected numbers within ±{FRAME_MAX_M} m: is the scale right?"
            ));
        }
        line.points.dedup();
        Ok(())
    }

    /// A text names the place at which it begins, in a layer of places; elsewhere it is dropped.
    pub(super) fn text(&mut self, node: Node<'a, 'input>, around: &Around) {
        let first = |name: &str| {
            let own = node.descendants().find_map(|node| node.attribute(name))?;
            own.split([' ', ',']).next()?.parse::<f64>().ok()
        };
        match (around.kind, first("x"), first("y")) {
            (Some(Kind::Place), Some(x), Some(y)) if !around.style.is_hidden() => {
                let at = around.to_metres.transform_point2(glam::DVec2::new(x, y));
                let words: String =
                    node.descendants().filter_map(|node| node.text().filter(|_| node.is_text())).collect();
                self.place(node, &[Line { points: vec![at], closed: false }], Some(&words));
            }
            _ => self.counts.texts += 1,
        }
    }

    /// The middle of what is drawn is a place: called by its title, its label or else its id.
    fn place(&mut self, node: Node, lines: &[Line], own: Option<&str>) {
        let title =
            node.children().find(|child| child.tag_name().name() == "title").and_then(|title| title.text());
        let label = node.attribute((INKSCAPE, "label"));
        let name = title.or(label).or(own).unwrap_or_default().trim();
        let points = || lines.iter().flat_map(|line| &line.points);
        let low = points().fold(glam::DVec2::INFINITY, |low, &p| low.min(p));
        let high = points().fold(glam::DVec2::NEG_INFINITY, |high, &p| high.max(p));
        let at = low.midpoint(high);
        if name.is_empty() || !(at.x.abs() <= FRAME_MAX_M && at.y.abs() <= FRAME_MAX_M) {
            self.counts.points += 1;
        } else {
            let name = name.chars().take(LONGEST_NAME).collect();
            let height_m = node.attribute("data-height-m").and_then(|text| text.trim().parse().ok());
            let height_m = height_m.filter(|height_m: &f64| height_m.abs() <= FRAME_MAX_M);
            self.drawing.places.push(Place { name, at_m: at.into(), height_m });
        }
    }
}

/// What an element is called in messages.
fn called(node: Node) -> String {
    let row = node.document().text_pos_at(node.range().start).row;
    let id = node.attribute("id").map(|id| format!(" {id:?}")).unwrap_or_default();
    format!("line {row}: <{}>{id}", node.tag_name().name())
}
