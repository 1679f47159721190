//! Lines between what is below 0 and what is not, by marching squares.

use std::collections::BTreeMap;

use glam::DVec2;
use uchain_core::bounded;

/// How near to a lattice point a line may cross an edge (cells): no two loops touch.
const MARGIN: f64 = 0.02;
/// What is not listed.
const OUTSIDE: f64 = 1.0;

/// An edge of the lattice: from this row and column one cell east, or one cell north.
type Edge = (i32, i32, bool);

/// Closed loops around everything below 0, which lies on their left, in cells. `values` are by row and column.
pub(super) fn isolines(values: &BTreeMap<(i32, i32), f64>) -> Vec<Vec<DVec2>> {
    let value = |row: i32, col: i32| values.get(&(row, col)).copied().unwrap_or(OUTSIDE);
    let mut next: BTreeMap<Edge, Edge> = BTreeMap::new();
    for &(row, col) in values.keys() {
        // Squares are listed by their lower left corner; what is below 0 has neighbours on all sides in the list.
        let [sw, se, ne, nw] =
            [(0, 0), (0, 1), (1, 1), (1, 0)].map(|(up, on)| value(row + up, col + on) < 0.0);
        let (south, north) = ((row, col, true), (row + 1, col, true));
        let (west, east) = ((row, col, false), (row, col + 1, false));
        let corners = [sw, se, ne, nw];
        // Where a corner differs from the one before it, counter-clockwise, the line crosses the edge between them.
        let edges = [west, south, east, north];
        for corner in 0..4 {
            // From the edge after the last free corner of a run to the edge before its first one.
            let before = (corner + 3) % 4;
            if corners[corner] && !corners[before] {
                let mut last = corner;
                while corners[(last + 1) % 4] {
                    last = (last + 1) % 4;
                }
                next.insert(edges[(last + 1) % 4], edges[corner]);
            }
        }
    }
    let mut loops = Vec::new();
    while let Some((&first, _)) = next.first_key_value() {
        let mut corners = Vec::new();
        let mut edge = first;
        while let Some(following) = next.remove(&edge) {
            corners.push(crossing(edge, &value));
            edge = following;
        }
        loops.push(corners);
    }
    loops
}

/// Where the line crosses an edge (cells).
fn crossing((row, col, is_east): Edge, value: &impl Fn(i32, i32) -> f64) -> DVec2 {
    let at = DVec2::new(f64::from(col), f64::from(row));
    let (step, far) = if is_east { (DVec2::X, value(row, col + 1)) } else { (DVec2::Y, value(row + 1, col)) };
    let near = value(row, col);
    at + step * bounded(near / (near - far), MARGIN, 1.0 - MARGIN)
}
