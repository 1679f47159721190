//! Where the likelihood is greatest, and how far around that it is not much less.

use uchain_core::bounded;

use super::{
    likelihood::{At, Likelihood, Share},
    places::Place,
};

/// Ends of the logit of the share of the variance that stays with the place: 0.1 % and 99.9 %.
const LOGIT: (f64, f64) = (-7.0, 7.0);
/// Samples of the likelihood a side: over all, and where it counts.
const COARSE: usize = 9;
const FINE: usize = 13;
/// What lies so much lower than the best counts no more (twice the logarithm).
const FAR: f64 = 14.0;
/// How often the box is drawn closer.
const TURNED: usize = 4;
/// Samples between two samples, by interpolation.
const BETWEEN: usize = 8;
/// Steps of the search for the best, and how near it comes.
const STEPS: usize = 60;
const NEAR: f64 = 2e-3;

/// Share and length as the search has them: a logit, and a logarithm.
type Point = [f64; 2];

pub(super) fn share_at(point: Point) -> Share {
    Share { rho: 1.0 / (1.0 + libm::exp(-point[0])), length_m: libm::exp(point[1]) }
}

/// What is looked at.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bounds {
    /// Shortest and longest correlation length (m).
    pub(super) length_m: (f64, f64),
}

impl Bounds {
    fn box_of(self) -> [(f64, f64); 2] {
        [LOGIT, (libm::log(self.length_m.0), libm::log(self.length_m.1))]
    }
}

/// A point of a grid.
#[derive(Debug, Clone, Copy)]
pub(super) struct Node {
    pub(super) point: Point,
    pub(super) at: At,
    pub(super) deviance: f64,
}

/// The best, and a grid around it.
#[derive(Debug)]
pub(super) struct Surface {
    pub(super) best: Node,
    /// Row by row of the share, lengths within a row.
    pub(super) nodes: Vec<Node>,
    /// Logarithms of the shortest and the longest length that are looked at.
    pub(super) lengths: (f64, f64),
}

fn node(likelihood: &mut Likelihood, places: &[Place], point: Point) -> Node {
    let at = likelihood.at(places, share_at(point));
    let deviance = at.deviance(likelihood.free);
    Node { point, at, deviance: if deviance.is_finite() { deviance } else { f64::INFINITY } }
}

fn grid(likelihood: &mut Likelihood, places: &[Place], area: [(f64, f64); 2], side: usize) -> Vec<Node> {
    let along = |(low, high): (f64, f64), step: usize| low + (high - low) * step as f64 / (side - 1) as f64;
    let steps = (0..side).flat_map(|u| (0..side).map(move |t| (u, t)));
    steps.map(|(u, t)| node(likelihood, places, [along(area[0], u), along(area[1], t)])).collect()
}

/// The best of all, from a start or from everywhere.
pub(super) fn best(
    likelihood: &mut Likelihood,
    places: &[Place],
    bounds: Bounds,
    start: Option<Point>,
) -> Node {
    let area = bounds.box_of();
    let start = start.unwrap_or_else(|| {
        let nodes = grid(likelihood, places, area, COARSE);
        nodes
            .iter()
            .min_by(|a, b| a.deviance.total_cmp(&b.deviance))
            .map_or([0.0, area[1].0], |node| node.point)
    });
    let inside = |point: Point| std::array::from_fn(|i| bounded(point[i], area[i].0, area[i].1));
    // Nelder and Mead's simplex.
    let widths = area.map(|(low, high)| 0.5 * (high - low) / (COARSE - 1) as f64);
    let mut simplex = [start, [start[0] + widths[0], start[1]], [start[0], start[1] + widths[1]]]
        .map(|point| node(likelihood, places, inside(point)));
    for _ in 0..STEPS {
        simplex.sort_by(|a, b| a.deviance.total_cmp(&b.deviance));
        let [first, second, worst] = simplex;
        let spread =
            |i: usize| (worst.point[i] - first.point[i]).abs().max((second.point[i] - first.point[i]).abs());
        if (worst.deviance - first.deviance).abs() < NEAR && spread(0) < 0.1 && spread(1) < 0.1 {
            break;
        }
        let middle: Point = std::array::from_fn(|i| f64::midpoint(first.point[i], second.point[i]));
        let mut toward = |far: f64| {
            let point = std::array::from_fn(|i| middle[i] + far * (worst.point[i] - middle[i]));
            node(likelihood, places, inside(point))
        };
        let reflected = toward(-1.0);
        simplex[2] = if reflected.deviance < first.deviance {
            let expanded = toward(-2.0);
            if expanded.deviance < reflected.deviance { expanded } else { reflected }
        } else if reflected.deviance < second.deviance {
            reflected
        } else {
            let contracted = toward(if reflected.deviance < worst.deviance { -0.5 } else { 0.5 });
            if contracted.deviance < worst.deviance.min(reflected.deviance) {
                contracted
            } else {
                let closer = |point: Point| std::array::from_fn(|i| f64::midpoint(first.point[i], point[i]));
                simplex[1] = node(likelihood, places, closer(second.point));
                node(likelihood, places, closer(worst.point))
            }
        };
    }
    simplex.sort_by(|a, b| a.deviance.total_cmp(&b.deviance));
    simplex[0]
}

/// Share and variance over length in the place of length.
fn turn(point: Point) -> Point {
    [point[0], point[1] - point[0]]
}

/// A grid of these; lengths beyond the bounds are those at the bounds.
fn ridge(
    likelihood: &mut Likelihood,
    places: &[Place],
    area: [(f64, f64); 2],
    lengths: (f64, f64),
    side: usize,
) -> Vec<Node> {
    let along = |(low, high): (f64, f64), step: usize| low + (high - low) * step as f64 / (side - 1) as f64;
    let steps = (0..side).flat_map(|u| (0..side).map(move |v| (u, v)));
    let point = |(u, v)| {
        let logit = along(area[0], u);
        [logit, bounded(along(area[1], v) + logit, lengths.0, lengths.1)]
    };
    steps.map(|step| node(likelihood, places, point(step))).collect()
}

/// The box around all nodes of a grid that count, a cell wider on every side, within the grid's own.
fn counting(
    nodes: &[Node],
    area: [(f64, f64); 2],
    side: usize,
    best: Node,
    of: &dyn Fn(Point) -> Point,
) -> [(f64, f64); 2] {
    std::array::from_fn(|i| {
        let near = nodes.iter().filter(|node| node.deviance < best.deviance + FAR);
        let own = of(best.point)[i];
        let (low, high) =
            near.map(|node| of(node.point)[i]).fold((own, own), |(l, h), value| (l.min(value), h.max(value)));
        let cell = (area[i].1 - area[i].0) / (side - 1) as f64;
        ((low - cell).max(area[i].0), (high + cell).min(area[i].1))
    })
}

/// The best, and the likelihood around it as far as it counts.
pub(super) fn surface(
    likelihood: &mut Likelihood,
    places: &[Place],
    bounds: Bounds,
    start: Point,
) -> Surface {
    let area = bounds.box_of();
    let coarse = grid(likelihood, places, area, COARSE);
    let nearest = coarse.iter().min_by(|a, b| a.deviance.total_cmp(&b.deviance));
    let mut best_node = best(likelihood, places, bounds, Some(start));
    if let Some(other) = nearest.filter(|node| node.deviance < best_node.deviance) {
        best_node = best(likelihood, places, bounds, Some(other.point));
    }
    // A box around all that counts, a cell wider on every side; then again, as the first is coarse. Dense places tell variance
    // over length far better than either: along the logarithm of that the ridge lies straight in the box.
    let first = counting(&coarse, area, COARSE, best_node, &|point| point);
    let widest = first[0];
    let mut turned = [widest, (first[1].0 - widest.1, first[1].1 - widest.0)];
    for _ in 0..TURNED {
        let nodes = ridge(likelihood, places, turned, area[1], COARSE);
        turned = counting(&nodes, turned, COARSE, best_node, &turn);
    }
    let nodes = ridge(likelihood, places, turned, area[1], FINE);
    if let Some(other) = nodes.iter().min_by(|a, b| a.deviance.total_cmp(&b.deviance))
        && other.deviance < best_node.deviance
    {
        best_node = *other;
    }
    Surface { best: best_node, nodes, lengths: area[1] }
}

/// A point between those of the grid.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fine {
    pub(super) point: Point,
    pub(super) deviance: f64,
    /// Of the best variance.
    pub(super) log_variance: f64,
}

impl Surface {
    /// The surface on a finer grid, straight between the samples, row by row.
    pub(super) fn fine(&self, free: f64) -> Vec<Fine> {
        let side = FINE - 1;
        let steps = side * BETWEEN + 1;
        let mut all = Vec::with_capacity(steps * steps);
        for u in 0..steps {
            for t in 0..steps {
                let (row, column) = ((u / BETWEEN).min(side - 1), (t / BETWEEN).min(side - 1));
                let (a, b) =
                    (u as f64 / BETWEEN as f64 - row as f64, t as f64 / BETWEEN as f64 - column as f64);
                let corner = |down: usize, right: usize| &self.nodes[(row + down) * FINE + column + right];
                let mix = |of: &dyn Fn(&Node) -> f64| {
                    (1.0 - a) * ((1.0 - b) * of(corner(0, 0)) + b * of(corner(0, 1)))
                        + a * ((1.0 - b) * of(corner(1, 0)) + b * of(corner(1, 1)))
                };
                all.push(Fine {
                    point: [mix(&|node| node.point[0]), mix(&|node| node.point[1])],
                    deviance: mix(&|node| node.deviance),
                    log_variance: mix(&|node| libm::log(node.at.variance(free))),
                });
            }
        }
        all
    }
}

/// Bounds of the correlation length: a third of the spacing of places, and three times the extent of all.
pub(super) fn bounds(places: &[Place]) -> (Bounds, f64, f64) {
    let mut nearest: Vec<f64> = Vec::new();
    for (index, place) in places.iter().enumerate() {
        let window = places.iter().enumerate().skip(index.saturating_sub(40)).take(81);
        let others = window.filter(|(other, near)| *other != index && near.link == place.link);
        let apart_m = others.map(|(_, other)| place.apart_m(other)).fold(f64::INFINITY, f64::min);
        if apart_m.is_finite() {
            nearest.push(apart_m);
        }
    }
    nearest.sort_by(f64::total_cmp);
    let spacing_m = nearest.get(nearest.len() / 2).copied().unwrap_or(1.0).max(1e-3);
    let width = |axis: usize| {
        let along = places.iter().map(|place| place.ends_m[axis]);
        let (low, high) = along.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), m| (l.min(m), h.max(m)));
        (high - low) * (high - low)
    };
    let mut extent_m: f64 = 0.0;
    for ends in [[0, 1, 2], [3, 4, 5]] {
        // Anchors that do not move are no way: a link's own ends count.
        extent_m = extent_m.max(ends.map(width).iter().sum::<f64>().sqrt());
    }
    let extent_m = extent_m.max(2.0 * spacing_m);
    (Bounds { length_m: (spacing_m / 3.0, 3.0 * extent_m) }, spacing_m, extent_m)
}
