//! How often the edges of a drawing cross: joining areas takes time with every crossing, and a few hundred lines can have a
//! hundred thousand.

use std::ops::ControlFlow;

use geo::{Coord, Polygon};
use glam::Vec2;

use crate::map::{
    MapError, Segment,
    geometry::{opposite, orient},
    grid::Grid,
};

/// Most crossings: so many, and so many more for each edge.
const MOST: usize = 100_000;
const MOST_AN_EDGE: usize = 4;
/// Most pairs of edges looked at: half a second.
const MOST_PAIRS: usize = 50_000_000;

/// Refuses areas whose edges cross too often. Near enough: where a pair shares several cells of the grid it counts again.
pub(super) fn few<'a>(areas: impl Iterator<Item = &'a Polygon>) -> Result<(), MapError> {
    let point = |at: Coord| Vec2::new(at.x as f32, at.y as f32);
    let rings = areas.flat_map(|area| std::iter::once(area.exterior()).chain(area.interiors()));
    let edges: Vec<Segment> = rings
        .flat_map(|ring| ring.lines())
        .map(|edge| Segment { a: point(edge.start), b: point(edge.end) })
        .filter(|edge| edge.a != edge.b)
        .collect();
    let grid = Grid::new(&edges);
    let (mut crossings, mut pairs) = (0, 0);
    let most = MOST + MOST_AN_EDGE * edges.len();
    for (index, edge) in edges.iter().enumerate() {
        let (a, b) = edge.ends();
        let flow = grid.along(a, b, |cell| {
            for &other in grid.walls_of(cell) {
                let other = other as usize;
                if other <= index {
                    continue;
                }
                pairs += 1;
                let (c, d) = edges[other].ends();
                let do_cross =
                    opposite(orient(a, b, c), orient(a, b, d)) && opposite(orient(c, d, a), orient(c, d, b));
                crossings += usize::from(do_cross);
                if crossings > most || pairs > MOST_PAIRS {
                    return ControlFlow::Break(());
                }
            }
            ControlFlow::Continue(())
        });
        if flow.is_break() {
            let what = "places where lines of the drawing cross";
            return Err(MapError::Count { what, got: crossings.max(most + 1), least: 0, most });
        }
    }
    Ok(())
}
