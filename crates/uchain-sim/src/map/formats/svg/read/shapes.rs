//! Paths and the basic shapes as lines in metres.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::{DAffine2, DVec2};
use roxmltree::Node;
use svgtypes::{PathParser, PathSegment, PointsParser};

use super::lengths::{Viewport, length};
use crate::map::drawing::reading::curve::Line;

/// How an element is laid out: from its own units to metres.
#[derive(Debug, Clone, Copy)]
pub(super) struct Layout {
    pub(super) to_metres: DAffine2,
    pub(super) viewport: Viewport,
    /// How far a straight piece may lie from its curve (m).
    pub(super) within_m: f64,
    /// Most corners that there may be.
    pub(super) most: usize,
}

/// The lines of an element, and whether its data are damaged from some place on.
#[derive(Debug, Default)]
pub(super) struct Drawn {
    pub(super) lines: Vec<Line>,
    pub(super) is_damaged: bool,
}

/// What a basic shape or a path draws; `None` for what is neither.
pub(super) fn drawn(node: Node, tag: &str, layout: &Layout) -> Option<Drawn> {
    let Viewport { size } = layout.viewport;
    let at = |name: &str, whole: f64| node.attribute(name).and_then(|text| length(text, whole));
    let x = |name: &str| at(name, size.x).unwrap_or(0.0);
    let y = |name: &str| at(name, size.y).unwrap_or(0.0);
    let mut drawn = Drawn::default();
    match tag {
        "path" => drawn = path(node.attribute("d").unwrap_or_default(), layout),
        "rect" => {
            let (low, size) = (DVec2::new(x("x"), y("y")), DVec2::new(x("width"), y("height")));
            let (rx, ry) = (at("rx", layout.viewport.size.x), at("ry", layout.viewport.size.y));
            let round = DVec2::new(rx.or(ry).unwrap_or(0.0), ry.or(rx).unwrap_or(0.0));
            if size.cmpgt(DVec2::ZERO).all() {
                drawn.lines.push(rectangle(low, size, round.max(DVec2::ZERO).min(size / 2.0), layout));
            }
        }
        "circle" | "ellipse" => {
            let radius = at("r", layout.viewport.diagonal());
            let radii = DVec2::new(radius.unwrap_or_else(|| x("rx")), radius.unwrap_or_else(|| y("ry")));
            if radii.cmpgt(DVec2::ZERO).all() {
                let mut line = Line { closed: true, ..Line::default() };
                turn(&mut line, DVec2::new(x("cx"), y("cy")), radii, (0.0, TAU), layout);
                line.points.pop();
                drawn.lines.push(line);
            }
        }
        "line" => {
            let ends = [DVec2::new(x("x1"), y("y1")), DVec2::new(x("x2"), y("y2"))];
            let points = ends.map(|end| layout.to_metres.transform_point2(end)).into();
            drawn.lines.push(Line { points, closed: false });
        }
        "polyline" | "polygon" => {
            let points = PointsParser::from(node.attribute("points").unwrap_or_default());
            let points = points
                .take(layout.most + 1)
                .map(|(x, y)| layout.to_metres.transform_point2(DVec2::new(x, y)));
            drawn.lines.push(Line { points: points.collect(), closed: tag == "polygon" });
        }
        _ => return None,
    }
    Some(drawn)
}

/// A piece of an ellipse that stands upright.
fn turn(line: &mut Line, centre: DVec2, radii: DVec2, (from, sweep): (f64, f64), layout: &Layout) {
    let place = layout.to_metres * DAffine2::from_scale_angle_translation(radii, 0.0, centre);
    line.arc(&place, from, sweep, layout.within_m);
}

fn rectangle(low: DVec2, size: DVec2, round: DVec2, layout: &Layout) -> Line {
    let mut line = Line { closed: true, ..Line::default() };
    let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
    for (corner, from) in corners.into_iter().zip([PI, 3.0 * FRAC_PI_2, 0.0, FRAC_PI_2]) {
        let at = low + size * DVec2::from(corner);
        if round.cmpgt(DVec2::ZERO).all() {
            let centre = at + round * (DVec2::ONE - 2.0 * DVec2::from(corner));
            turn(&mut line, centre, round, (from, FRAC_PI_2), layout);
        } else {
            line.to(layout.to_metres.transform_point2(at));
        }
    }
    line
}

/// Where a path's pen is, in its own units.
#[derive(Default)]
struct Pen {
    at: DVec2,
    start: DVec2,
    /// The last control point, for curves that go on smoothly.
    cubic: Option<DVec2>,
    quadratic: Option<DVec2>,
}

/// Up to where it is damaged, as browsers draw it.
fn path(data: &str, layout: &Layout) -> Drawn {
    let mut drawn = Drawn::default();
    let mut line = Line::default();
    let mut pen = Pen::default();
    let mut corners = 0;
    for segment in PathParser::from(data) {
        let Ok(segment) = segment else {
            drawn.is_damaged = true;
            break;
        };
        match segment {
            PathSegment::MoveTo { abs, x, y } => {
                pen = pen.moved(abs, x, y);
                pen.start = pen.at;
                corners += line.points.len();
                drawn.lines.extend(finished(&mut line));
                line.to(layout.to_metres.transform_point2(pen.at));
            }
            PathSegment::ClosePath { .. } => {
                line.closed = true;
                corners += line.points.len();
                drawn.lines.extend(finished(&mut line));
                pen = Pen { at: pen.start, start: pen.start, ..Pen::default() };
            }
            _ => {
                if line.points.is_empty() {
                    line.to(layout.to_metres.transform_point2(pen.at));
                }
                pen = pen.drawn(segment, &mut line, layout);
            }
        }
        if corners + line.points.len() > layout.most {
            break;
        }
    }
    drawn.lines.extend(finished(&mut line));
    drawn
}

fn finished(line: &mut Line) -> Option<Line> {
    let line = std::mem::take(line);
    (line.points.len() > 1).then_some(line)
}

impl Pen {
    fn place(&self, abs: bool, x: f64, y: f64) -> DVec2 {
        let at = DVec2::new(x, y);
        if abs { at } else { self.at + at }
    }

    fn moved(&self, abs: bool, x: f64, y: f64) -> Self {
        Self { at: self.place(abs, x, y), start: self.start, cubic: None, quadratic: None }
    }

    fn drawn(&self, segment: PathSegment, line: &mut Line, layout: &Layout) -> Self {
        let metres = |p: DVec2| layout.to_metres.transform_point2(p);
        let mirrored = |control: Option<DVec2>| control.map_or(self.at, |control| 2.0 * self.at - control);
        let (end, cubic, quadratic) = match segment {
            PathSegment::HorizontalLineTo { abs, x } => {
                (DVec2::new(if abs { x } else { self.at.x + x }, self.at.y), None, None)
            }
            PathSegment::VerticalLineTo { abs, y } => {
                (DVec2::new(self.at.x, if abs { y } else { self.at.y + y }), None, None)
            }
            PathSegment::LineTo { abs, x, y } => (self.place(abs, x, y), None, None),
            PathSegment::CurveTo { abs, x1, y1, x2, y2, x, y } => {
                let (first, second, end) =
                    (self.place(abs, x1, y1), self.place(abs, x2, y2), self.place(abs, x, y));
                line.cubic(metres(first), metres(second), metres(end), layout.within_m);
                (end, Some(second), None)
            }
            PathSegment::SmoothCurveTo { abs, x2, y2, x, y } => {
                let (second, end) = (self.place(abs, x2, y2), self.place(abs, x, y));
                line.cubic(metres(mirrored(self.cubic)), metres(second), metres(end), layout.within_m);
                (end, Some(second), None)
            }
            PathSegment::Quadratic { abs, x1, y1, x, y } => {
                let (control, end) = (self.place(abs, x1, y1), self.place(abs, x, y));
                line.quadratic(metres(control), metres(end), layout.within_m);
                (end, None, Some(control))
            }
            PathSegment::SmoothQuadratic { abs, x, y } => {
                let (control, end) = (mirrored(self.quadratic), self.place(abs, x, y));
                line.quadratic(metres(control), metres(end), layout.within_m);
                (end, None, Some(control))
            }
            PathSegment::EllipticalArc { abs, rx, ry, x_axis_rotation, large_arc, sweep, x, y } => {
                let end = self.place(abs, x, y);
                let radii = DVec2::new(rx, ry).abs();
                if let Some((place, from, turn)) =
                    arc(self.at, end, radii, x_axis_rotation.to_radians(), large_arc, sweep)
                {
                    line.points.pop();
                    line.arc(&(layout.to_metres * place), from, turn, layout.within_m);
                    line.points.pop();
                }
                (end, None, None)
            }
            PathSegment::MoveTo { .. } | PathSegment::ClosePath { .. } => (self.at, None, None),
        };
        if cubic.is_none() && quadratic.is_none() {
            line.to(metres(end));
        }
        Self { at: end, start: self.start, cubic, quadratic }
    }
}

/// An arc by its ends as a piece of the unit circle, laid out; `None` where it is a straight line. SVG 1.1, F.6.5 and F.6.6.
fn arc(
    from: DVec2,
    to: DVec2,
    radii: DVec2,
    tilt_rad: f64,
    large: bool,
    sweep: bool,
) -> Option<(DAffine2, f64, f64)> {
    if !radii.cmpgt(DVec2::ZERO).all() || from == to {
        return None;
    }
    let tilt = DVec2::new(libm::cos(tilt_rad), libm::sin(tilt_rad));
    let upright = |p: DVec2| DVec2::new(tilt.dot(p), tilt.perp_dot(p));
    // On a unit circle half of the chord is shorter than one, or else the radii are too small and grow.
    let half = upright((from - to) / 2.0) / radii;
    let grown = radii * half.length().max(1.0);
    let half = half / half.length().max(1.0);
    let aside = (1.0 / half.length_squared() - 1.0).max(0.0).sqrt();
    let centre = half.perp() * if large == sweep { aside } else { -aside };
    let (start, end) = (half - centre, -half - centre);
    let from_rad = libm::atan2(start.y, start.x);
    let mut turn = libm::atan2(start.perp_dot(end), start.dot(end));
    if sweep && turn < 0.0 {
        turn += TAU;
    } else if !sweep && turn > 0.0 {
        turn -= TAU;
    }
    let middle = from.midpoint(to) + tilt.rotate(centre * grown);
    Some((DAffine2::from_cols(tilt * grown.x, tilt.perp() * grown.y, middle), from_rad, turn))
}
