//! Lines that meet end to end as one: walls are drawn line by line in CAD programs, and meet at corners.

use std::collections::BTreeMap;

use glam::DVec2;

use crate::map::drawing::reading::curve::Line;

/// A line, where it is drawn, and how wide.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Piece<'a> {
    pub(super) line: Line,
    pub(super) layer: &'a str,
    pub(super) width_m: f64,
}

/// A place at which lines of one layer and width end, and those ends: the piece, and whether it is its last point.
struct Node {
    at: DVec2,
    ends: Vec<(usize, bool)>,
}

/// Joins lines of one layer and width wherever exactly two of their ends are nearer to each other than `within_m`.
pub(super) fn joined(pieces: Vec<Piece>, within_m: f64) -> Vec<Piece> {
    let (nodes, at_ends) = nodes(&pieces, within_m.max(1e-9));
    let mut left: Vec<Option<Piece>> = pieces.into_iter().map(Some).collect();
    let mut joined = Vec::new();
    for first in 0..left.len() {
        let Some(mut piece) = left[first].take() else { continue };
        if let Some([start, end]) = at_ends[first] {
            // Onward from its end; if that does not lead round, also from its start.
            let end = follow(&mut piece, (first, true), end, &nodes, &at_ends, &mut left);
            if end == start && nodes[start].ends.len() == 2 && piece.line.points.len() > 2 {
                piece.line.closed = true;
                piece.line.points.pop();
            } else {
                piece.line.points.reverse();
                follow(&mut piece, (first, false), start, &nodes, &at_ends, &mut left);
                piece.line.points.reverse();
            }
        }
        joined.push(piece);
    }
    joined
}

/// Adds what follows, as long as exactly one line does; says at which node that ends.
fn follow<'a>(
    piece: &mut Piece<'a>,
    mut came: (usize, bool),
    mut node: usize,
    nodes: &[Node],
    at_ends: &[Option<[usize; 2]>],
    left: &mut [Option<Piece<'a>>],
) -> usize {
    while let [a, b] = nodes[node].ends[..] {
        let (next, is_last) = if a == came { b } else { a };
        let Some(mut more) = left[next].take() else { break };
        if is_last {
            more.line.points.reverse();
        }
        piece.line.points.extend_from_slice(&more.line.points[1..]);
        let Some(ends) = at_ends[next] else { break };
        came = (next, !is_last);
        node = ends[usize::from(!is_last)];
    }
    node
}

/// The nodes, and for each open piece those of its start and its end.
fn nodes(pieces: &[Piece], within_m: f64) -> (Vec<Node>, Vec<Option<[usize; 2]>>) {
    let mut nodes: Vec<Node> = Vec::new();
    let mut cells: BTreeMap<(&str, u64, i64, i64), Vec<usize>> = BTreeMap::new();
    let mut at_ends = Vec::with_capacity(pieces.len());
    for (index, Piece { line, layer, width_m }) in pieces.iter().enumerate() {
        let (Some(&start), Some(&end), false) = (line.points.first(), line.points.last(), line.closed) else {
            at_ends.push(None);
            continue;
        };
        let own = [(start, false), (end, true)].map(|(at, is_last)| {
            let cell = (at / within_m).floor();
            let (column, row) = (cell.x as i64, cell.y as i64);
            let around = (-1..=1)
                .flat_map(|x| (-1..=1).map(move |y| (column.saturating_add(x), row.saturating_add(y))));
            let key = |(x, y)| (*layer, width_m.to_bits(), x, y);
            let mut known = around.filter_map(|place| cells.get(&key(place))).flatten();
            let near = known.find(|&&node| nodes[node].at.distance(at) <= within_m).copied();
            let node = near.unwrap_or_else(|| {
                nodes.push(Node { at, ends: Vec::new() });
                cells.entry(key((column, row))).or_default().push(nodes.len() - 1);
                nodes.len() - 1
            });
            nodes[node].ends.push((index, is_last));
            node
        });
        at_ends.push(Some(own));
    }
    (nodes, at_ends)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn piece(layer: &'static str, points: &[(f64, f64)]) -> Piece<'static> {
        let points = points.iter().map(|&at| at.into()).collect();
        Piece { line: Line { points, closed: false }, layer, width_m: 0.1 }
    }

    #[test]
    fn lines_that_meet_two_by_two_are_one_and_come_round_if_they_do() {
        let square = [
            ((0.0, 0.0), (4.0, 0.0)),
            ((4.0, 3.0), (4.0, 0.001)),
            ((4.0, 3.0), (0.0, 3.0)),
            ((0.0, 0.0), (0.0, 3.0)),
        ];
        let lines: Vec<Piece> = square.iter().map(|&(a, b)| piece("a", &[a, b])).collect();
        let one = joined(lines.clone(), 0.01);
        assert!(one.len() == 1 && one[0].line.closed && one[0].line.points.len() == 4, "{one:?}");
        let open = joined(lines[1..].to_vec(), 0.01);
        assert!(open.len() == 1 && !open[0].line.closed && open[0].line.points.len() == 4, "{open:?}");
        assert_eq!(joined(lines, 1e-4).len(), 1, "apart by a millimetre: one, but open");
    }

    #[test]
    fn where_three_lines_meet_or_layers_differ_nothing_is_joined() {
        let star = [(1.0, 0.0), (0.0, 1.0), (-1.0, -1.0)].map(|end| piece("a", &[(0.0, 0.0), end]));
        assert_eq!(joined(star.to_vec(), 0.01).len(), 3);
        let two = [piece("a", &[(0.0, 0.0), (1.0, 0.0)]), piece("b", &[(1.0, 0.0), (2.0, 0.0)])];
        assert_eq!(joined(two.to_vec(), 0.01).len(), 2);
        let there_and_back = [piece("a", &[(0.0, 0.0), (1.0, 0.0)]), piece("a", &[(1.0, 0.0), (0.0, 0.0)])];
        assert_eq!(joined(there_and_back.to_vec(), 0.01).len(), 1);
        let to_itself = [piece("a", &[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 0.0)])];
        let round = joined(to_itself.to_vec(), 0.01);
        assert!(round[0].line.closed && round[0].line.points.len() == 3, "{round:?}");
        assert!(joined(Vec::new(), 0.0).is_empty());
    }
}
