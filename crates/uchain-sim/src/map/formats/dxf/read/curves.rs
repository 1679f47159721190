//! The line that an entity draws.

use std::f64::consts::TAU;

use glam::{DAffine2, DVec2};

use super::entity::Opened;
use crate::map::drawing::reading::curve::Line;

/// Straight pieces of a spline between two knots.
const PER_SPAN: u32 = 16;
/// Highest degree of a spline that is read.
const HIGHEST: usize = 25;

/// The line, and its width in units (0: none is said); `None` for an entity of another kind.
pub(super) fn line_of(
    entity: &Opened,
    vertices: &[Opened],
    to_metres: &DAffine2,
    within_m: f64,
    most: usize,
) -> Option<(Line, f64)> {
    let seen = *to_metres * entity.seen();
    let mut width = 0.0;
    let line = match entity.kind {
        "LINE" => {
            let ends = [entity.place(10)?, entity.place(11)?];
            Line { points: ends.map(|end| to_metres.transform_point2(end)).into(), closed: false }
        }
        "LWPOLYLINE" => {
            width = entity.number(43).unwrap_or(0.0);
            bulged(&entity.places(10, 42), entity.flags(70) & 1 != 0, &seen, within_m, most)
        }
        "POLYLINE" => {
            let flags = entity.flags(70);
            // Meshes of polygons are surfaces, not lines.
            if flags & (16 | 64) != 0 {
                return None;
            }
            width = entity.number(40).unwrap_or(0.0);
            // What only controls a curve is not on it.
            let on_it = vertices.iter().filter(|vertex| vertex.flags(70) & 16 == 0);
            let places =
                on_it.filter_map(|vertex| Some((vertex.place(10)?, vertex.number(42).unwrap_or(0.0))));
            let frame = if flags & 8 == 0 { seen } else { *to_metres };
            bulged(&places.collect::<Vec<_>>(), flags & 1 != 0, &frame, within_m, most)
        }
        "ARC" | "CIRCLE" => {
            let radius = DVec2::splat(entity.number(40)?);
            let round = DAffine2::from_scale_angle_translation(radius, 0.0, entity.place(10)?);
            let (from, to) = (entity.number(50).unwrap_or(0.0), entity.number(51).unwrap_or(360.0));
            let whole = entity.kind == "CIRCLE";
            let ends = if whole { (0.0, TAU) } else { (from.to_radians(), to.to_radians()) };
            turned(&(seen * round), ends, whole, within_m)
        }
        "ELLIPSE" => {
            let (centre, long) = (entity.place(10)?, entity.place(11)?);
            let short = long.perp() * entity.number(40)? * entity.number(230).map_or(1.0, f64::signum);
            let ends = (entity.number(41).unwrap_or(0.0), entity.number(42).unwrap_or(TAU));
            let whole = (ends.1 - ends.0 - TAU).abs() < 1e-6;
            turned(&(*to_metres * DAffine2::from_cols(long, short, centre)), ends, whole, within_m)
        }
        "SPLINE" => spline(entity, to_metres, most)?,
        _ => return None,
    };
    Some((line, width))
}

/// Corners with bulges between them.
fn bulged(places: &[(DVec2, f64)], closed: bool, frame: &DAffine2, within_m: f64, most: usize) -> Line {
    let mut line = Line { points: Vec::with_capacity(places.len() + 1), closed };
    // A frame the other way round turns arcs the other way.
    let sense = if frame.matrix2.determinant() < 0.0 { -1.0 } else { 1.0 };
    let at =
        |index: usize| places.get(index % places.len().max(1)).map(|&(at, _)| frame.transform_point2(at));
    let legs = if closed { places.len() } else { places.len().saturating_sub(1) };
    line.points.extend(at(0));
    for (index, &(_, bulge)) in places.iter().enumerate().take(legs) {
        if let Some(end) = at(index + 1) {
            line.bulge(bulge * sense, end, within_m);
        }
        if line.points.len() > most {
            break;
        }
    }
    if closed {
        line.points.pop();
    }
    line
}

/// A piece of an ellipse, counter-clockwise from one angle to another.
fn turned(place: &DAffine2, (from, to): (f64, f64), whole: bool, within_m: f64) -> Line {
    let mut line = Line { points: Vec::new(), closed: whole };
    let sweep = if whole { TAU } else { (to - from).rem_euclid(TAU) };
    line.arc(place, from, if sweep > 0.0 { sweep } else { TAU }, within_m);
    if whole {
        line.points.pop();
    }
    line
}

/// A B-spline by its control points, or else straight through the points that it was fitted to.
fn spline(entity: &Opened, to_metres: &DAffine2, most: usize) -> Option<Line> {
    let closed = entity.flags(70) & 1 != 0;
    let control: Vec<DVec2> =
        entity.places(10, 0).into_iter().map(|(at, _)| to_metres.transform_point2(at)).collect();
    let (knots, weights) = (entity.numbers(40), entity.numbers(41));
    let degree = usize::try_from(entity.flags(71)).ok().filter(|degree| (1..=HIGHEST).contains(degree))?;
    if control.len() <= degree || knots.len() != control.len() + degree + 1 {
        let fitted: Vec<DVec2> =
            entity.places(11, 0).into_iter().map(|(at, _)| to_metres.transform_point2(at)).collect();
        return (fitted.len() > 1).then_some(Line { points: fitted, closed });
    }
    let mut line = Line { points: Vec::new(), closed };
    for span in degree..control.len() {
        let (low, high) = (knots[span], knots[span + 1]);
        if low < high {
            let last = if span + 1 == control.len() { PER_SPAN + 1 } else { PER_SPAN };
            for step in 0..last {
                let t = low + (high - low) * f64::from(step) / f64::from(PER_SPAN);
                line.to(de_boor(&control, &weights, &knots, span, degree, t));
            }
        }
        if line.points.len() > most {
            break;
        }
    }
    Some(line)
}

/// A place on a B-spline (de Boor 1972), with weights if there is one for each control point.
fn de_boor(control: &[DVec2], weights: &[f64], knots: &[f64], span: usize, degree: usize, t: f64) -> DVec2 {
    let weight = |index: usize| if weights.len() == control.len() { weights[index] } else { 1.0 };
    let mut places: Vec<(DVec2, f64)> =
        (span - degree..=span).map(|i| (control[i] * weight(i), weight(i))).collect();
    for level in 1..=degree {
        for index in (level..=degree).rev() {
            let knot = index + span - degree;
            let width = knots[knot + degree + 1 - level] - knots[knot];
            let share = if width > 0.0 { (t - knots[knot]) / width } else { 0.0 };
            let ((a, of_a), (b, of_b)) = (places[index - 1], places[index]);
            places[index] = (a.lerp(b, share), of_a + (of_b - of_a) * share);
        }
    }
    let (place, weight) = places[degree];
    place / weight
}
