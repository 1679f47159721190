//! What is free, of all that is drawn.

use geo::{
    Area, BooleanOps, BoundingRect, Buffer, LineString, MultiPolygon, Polygon,
    algorithm::buffer::{BufferStyle, LineCap, LineJoin},
    unary_union,
};

use super::Outside;
use crate::map::{Import, MapError, RemarkKind};

/// Thinnest wall (m): a line without thickness is that thick.
const THINNEST_M: f64 = 0.01;
/// Smallest angle between two pieces of a wall whose corner is drawn out to a point (rad): about 29 degrees.
const SHARPEST_RAD: f64 = 0.5;
/// Share of the faces of all walls that look into enclosed areas, from which on the rest is taken for rock. A closed line has
/// half of its faces inside; where the outer wall is open, next to none are.
const ENCLOSED: f64 = 0.3;

/// The area of a wall along a line.
pub(super) fn thick(line: &LineString, thickness_m: f64) -> MultiPolygon {
    let style = BufferStyle::new(thickness_m.max(THINNEST_M) / 2.0)
        .line_cap(LineCap::Butt)
        .line_join(LineJoin::Miter(SHARPEST_RAD));
    line.buffer_with_style(style)
}

/// Free areas that neither cross nor overlap, without the solid ones.
pub(super) fn free(
    drawn: &[Polygon],
    solids: &[(Polygon, Option<usize>)],
    outside: Outside,
    import: &mut Import,
) -> Result<MultiPolygon, MapError> {
    let rock = unary_union(solids.iter().map(|(polygon, _)| polygon));
    let free = if drawn.is_empty() { beside(&rock, outside, import) } else { unary_union(drawn) };
    let free = if rock.0.is_empty() || drawn.is_empty() { free } else { free.difference(&rock) };
    if free.unsigned_area() > 0.0 {
        return Ok(free);
    }
    let what = if drawn.is_empty() {
        "free areas: nothing is enclosed by walls, nor drawn as free"
    } else {
        "free areas that no rock covers"
    };
    Err(MapError::Count { what, got: 0, least: 1, most: super::MOST_CORNERS })
}

/// Length of all walls of some areas (m).
fn faces_m(areas: &MultiPolygon) -> f64 {
    let rings = areas.iter().flat_map(|area| std::iter::once(area.exterior()).chain(area.interiors()));
    rings.flat_map(LineString::lines).map(|line| libm::hypot(line.dx(), line.dy())).sum()
}

/// What is free where only rock is drawn.
fn beside(rock: &MultiPolygon, outside: Outside, import: &mut Import) -> MultiPolygon {
    let Some(around) = rock.bounding_rect() else { return MultiPolygon::new(Vec::new()) };
    let holes = rock.iter().flat_map(Polygon::interiors).map(|hole| Polygon::new(hole.clone(), Vec::new()));
    // Rock may stand in a hole of other rock.
    let holes: Vec<Polygon> = holes.collect();
    let enclosed = unary_union(&holes).difference(rock);
    let share = faces_m(&enclosed) / faces_m(rock);
    let is_rock = match outside {
        Outside::Rock => true,
        Outside::Free => false,
        Outside::Auto => share >= ENCLOSED,
    };
    if outside == Outside::Auto {
        let percent = (100.0 * share).round();
        let what = if is_rock { "rock" } else { "free up to the box around the drawing" };
        import.say(
            RemarkKind::Guessed,
            1,
            format!("outside: {percent} % of all faces of walls look into what they enclose, so what lies beyond is {what} (key outside)"),
        );
    }
    if is_rock { enclosed } else { MultiPolygon::new(vec![around.to_polygon()]).difference(rock) }
}
