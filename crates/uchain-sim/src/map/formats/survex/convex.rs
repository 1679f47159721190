//! Convex outlines in plan: the discs and hulls that passages are made of.

use uchain_core::bounded;

/// A place or a direction in plan (m).
pub(super) type Plan = [f64; 2];

/// Thinnest wall between two passages that are kept apart (m).
const THINNEST_M: f64 = 0.01;
/// Cosines of multiples of 30 degrees; sines are three further on.
const TWELFTHS: [f64; 12] = {
    const H: f64 = 0.866_025_403_784_438_6;
    [1.0, H, 0.5, 0.0, -0.5, -H, -1.0, -H, -0.5, 0.0, 0.5, H]
};

/// From one place to another: a unit vector, and how far; along x where both are one place.
pub(super) fn along(from: Plan, to: Plan) -> (Plan, f64) {
    let [x, y] = [to[0] - from[0], to[1] - from[1]];
    let length_m = libm::hypot(x, y);
    if length_m < 1e-9 { ([1.0, 0.0], 0.0) } else { ([x / length_m, y / length_m], length_m) }
}

/// Twelve corners around a place, one of them in this direction; so the width across it is exact.
pub(super) fn disc(middle: Plan, radius_m: f64, [x, y]: Plan) -> impl Iterator<Item = Plan> {
    (0..12).map(move |corner| {
        let [cos, sin] = [TWELFTHS[corner], TWELFTHS[(corner + 9) % 12]].map(|part| part * radius_m);
        [middle[0] + cos * x - sin * y, middle[1] + cos * y + sin * x]
    })
}

/// The convex outline around points, counter-clockwise.
pub(super) fn hull(mut points: Vec<Plan>) -> Vec<Plan> {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let mut outline: Vec<Plan> = Vec::new();
    for back in [false, true] {
        let start = outline.len();
        for at in 0..points.len() {
            let point = points[if back { points.len() - 1 - at } else { at }];
            while let &[.., a, b] = outline.get(start..).unwrap_or_default() {
                if turn(a, b, point) > 0.0 {
                    break;
                }
                outline.pop();
            }
            outline.push(point);
        }
        // The last corner starts the other half.
        outline.pop();
    }
    outline
}

/// Twice the area of a triangle, positive counter-clockwise.
fn turn(a: Plan, b: Plan, c: Plan) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Least and greatest coordinates.
pub(super) fn bounds(outline: &[Plan]) -> [Plan; 2] {
    let mut bounds = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
    for point in outline {
        for axis in 0..2 {
            bounds[0][axis] = bounds[0][axis].min(point[axis]);
            bounds[1][axis] = bounds[1][axis].max(point[axis]);
        }
    }
    bounds
}

/// Whether two convex outlines leave no wall between them: no line along an edge of one has the other beyond it.
pub(super) fn overlap(a: &[Plan], b: &[Plan]) -> bool {
    !apart(a, b) && !apart(b, a)
}

fn apart(a: &[Plan], b: &[Plan]) -> bool {
    a.iter().zip(a.iter().cycle().skip(1)).any(|(&from, &to)| {
        let (edge, length_m) = along(from, to);
        length_m > 0.0
            && b.iter().all(|point| {
                let out_m = edge[1] * (point[0] - from[0]) - edge[0] * (point[1] - from[1]);
                out_m >= THINNEST_M
            })
    })
}

/// Where two lines in plan come nearest to each other: how far along each, 0 to 1.
pub(super) fn nearest(a: [Plan; 2], b: [Plan; 2]) -> [f64; 2] {
    let [ax, ay] = [a[1][0] - a[0][0], a[1][1] - a[0][1]];
    let [bx, by] = [b[1][0] - b[0][0], b[1][1] - b[0][1]];
    let [x, y] = [b[0][0] - a[0][0], b[0][1] - a[0][1]];
    let across = ax * by - ay * bx;
    if across != 0.0 {
        let both = [(x * by - y * bx) / across, (x * ay - y * ax) / across];
        if both.iter().all(|share| (0.0..=1.0).contains(share)) {
            return both;
        }
    }
    // They do not cross: an end of one is nearest.
    let ends = [0.0, 1.0].into_iter().flat_map(|end| {
        let from = |line: [Plan; 2]| [0, 1].map(|axis| line[0][axis] + end * (line[1][axis] - line[0][axis]));
        [[end, share(b, from(a))], [share(a, from(b)), end]]
    });
    let apart_m = |[on_a, on_b]: [f64; 2]| libm::hypot(x + on_b * bx - on_a * ax, y + on_b * by - on_a * ay);
    ends.min_by(|&p, &q| apart_m(p).total_cmp(&apart_m(q))).unwrap_or_default()
}

/// How far along a line it comes nearest to a point.
fn share(line: [Plan; 2], point: Plan) -> f64 {
    let ([x, y], length_m) = along(line[0], line[1]);
    let along_m = x * (point[0] - line[0][0]) + y * (point[1] - line[0][1]);
    if length_m > 0.0 { bounded(along_m / length_m, 0.0, 1.0) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_passage_is_as_wide_as_its_ends_say() {
        let (direction, length_m) = along([0.0, 0.0], [3.0, 4.0]);
        assert_eq!((direction, length_m), ([0.6, 0.8], 5.0));
        let corners = disc([0.0, 0.0], 1.0, direction).chain(disc([3.0, 4.0], 1.0, direction)).collect();
        let outline = hull(corners);
        assert_eq!(outline.len(), 14);
        let across = |point: &Plan| point[1] * 0.6 - point[0] * 0.8;
        assert!(outline.iter().all(|point| across(point).abs() < 1.0 + 1e-12));
        assert!(outline.iter().filter(|point| (across(point).abs() - 1.0).abs() < 1e-12).count() == 4);
    }

    #[test]
    fn outlines_overlap_where_no_wall_is_left() {
        let square = |x: f64| vec![[x, 0.0], [x + 1.0, 0.0], [x + 1.0, 1.0], [x, 1.0]];
        assert!(overlap(&square(0.0), &square(0.9)) && overlap(&square(0.0), &square(1.005)));
        assert!(!overlap(&square(0.0), &square(1.02)));
        let inside = vec![[0.4, 0.4], [0.6, 0.4], [0.5, 0.6]];
        assert!(overlap(&square(0.0), &inside) && overlap(&inside, &square(0.0)));
    }

    #[test]
    fn lines_are_nearest_where_they_cross_or_at_an_end() {
        assert_eq!(nearest([[0.0, 0.0], [4.0, 0.0]], [[1.0, -1.0], [1.0, 3.0]]), [0.25, 0.25]);
        assert_eq!(nearest([[0.0, 0.0], [4.0, 0.0]], [[2.0, 1.0], [2.0, 3.0]]), [0.5, 0.0]);
        assert_eq!(nearest([[0.0, 0.0], [0.0, 0.0]], [[1.0, -1.0], [1.0, 1.0]]), [0.0, 0.5]);
        assert_eq!(nearest([[0.0, 0.0], [0.0, 0.0]], [[1.0, 0.0], [1.0, 0.0]]), [0.0, 0.0]);
    }
}
