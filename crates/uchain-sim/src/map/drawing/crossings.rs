//! How often the edges of a drawing cross: joining areas takes time with every crossing, and a few hundred lines can have a
//! hundred thousand.

use std::ops::ControlFlow;

use glam::DVec2;

use crate::map::{
    MapError, Segment,
    geometry::{opposite, orient},
    grid::Grid,
};

/// Most crossings: so many, and so many more for each edge, but never more than a second's.
const MOST: usize = 100_000;
const MOST_AN_EDGE: usize = 2;
const MOST_IN_ALL: usize = 500_000;
/// Most pairs of edges looked at: half a second.
const MOST_PAIRS: usize = 50_000_000;

/// Refuses lines that cross too often, themselves or one another. Near enough: where a pair shares several cells of the grid it
/// counts again.
pub(super) fn few<'a>(
    lines: impl Iterator<Item = (&'a [[f64; 2]], bool)>,
    middle: DVec2,
) -> Result<(), MapError> {
    let point = |at: [f64; 2]| (DVec2::from(at) - middle).as_vec2();
    let edges: Vec<Segment> = lines
        .flat_map(|(line, closed)| {
            let last = line.last().zip(line.first()).filter(|_| closed);
            line.windows(2).map(|pair| [pair[0], pair[1]]).chain(last.map(|(&last, &first)| [last, first]))
        })
        .map(|[a, b]| Segment { a: point(a), b: point(b) })
        .filter(|edge| edge.a != edge.b)
        .collect();
    let grid = Grid::new(&edges);
    let (mut crossings, mut pairs) = (0, 0);
    let most = (MOST + MOST_AN_EDGE * edges.len()).min(MOST_IN_ALL);
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
