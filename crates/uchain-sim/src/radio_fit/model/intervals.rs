//! Intervals at 95 %: of the line by generalised least squares, that share and length are estimates counted in; of the noises
//! and the length by the profile of the likelihood.

use serde::Serialize;

use super::{
    likelihood::Likelihood,
    places::Place,
    search::{Fine, Surface, share_at},
};

/// By how much the likelihood may fall (twice its logarithm): the upper 5 % of chi squared with one degree of freedom.
const FALLS: f64 = 3.841_459;

/// Power of the correlation length by which its prior density, over its logarithm, falls (1).
const PRIOR: f64 = 0.5;

/// A number and its 95 % interval.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Interval {
    /// The best single number.
    pub value: f64,
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
    /// The data do not bound it below; `low` is as far as was looked.
    pub is_open_below: bool,
    /// The data do not bound it above; `high` is as far as was looked.
    pub is_open_above: bool,
}

impl Interval {
    pub(super) fn around(value: f64, half: f64) -> Self {
        Self { value, low: value - half, high: value + half, is_open_below: false, is_open_above: false }
    }

    /// Whether a number lies in it.
    pub fn holds(&self, value: f64) -> bool {
        (self.is_open_below || self.low <= value) && (self.is_open_above || value <= self.high)
    }
}

/// The line and what is known of it: loss at the reference and dB per decade, and their covariance (upper left, side, lower
/// right).
#[derive(Debug, Clone, Copy)]
pub(super) struct LineKnown {
    pub(super) line: [f64; 2],
    pub(super) covariance: [f64; 3],
}

/// The line at the best share and length; its covariance is the mean over all that the data leave open, and how far the line
/// moves with them.
pub(super) fn line(likelihood: &mut Likelihood, places: &[Place], surface: &Surface) -> LineKnown {
    let best = &surface.best;
    let line = best.at.sums.line();
    let (mut total, mut covariance, mut means, mut squares) = (0.0, [0.0; 3], [0.0; 2], [0.0; 3]);
    for node in surface.nodes.iter().chain([best]) {
        // Lengths that no walk tells from the line count for something, but not for all: by how much is chosen so that the
        // intervals of drawn logs hold the truth as often as they say (the table in docs/guide/radio-fit.md).
        let prior = -PRIOR * (node.point[1] - best.point[1]);
        let weight = libm::exp(prior - 0.5 * (node.deviance - best.deviance));
        // What is no number has no weight.
        if weight.is_nan() || weight <= 1e-12 {
            continue;
        }
        let (variance, inverse, own) =
            (node.at.variance(likelihood.free), node.at.sums.inverse(), node.at.sums.line());
        let off = [own[0] - line[0], own[1] - line[1]];
        total += weight;
        for (sum, more) in covariance.iter_mut().zip(inverse) {
            *sum += weight * variance * more;
        }
        for (sum, more) in means.iter_mut().zip(off) {
            *sum += weight * more;
        }
        for (sum, more) in squares.iter_mut().zip([off[0] * off[0], off[0] * off[1], off[1] * off[1]]) {
            *sum += weight * more;
        }
    }
    let means = means.map(|sum| sum / total);
    let moved = [means[0] * means[0], means[0] * means[1], means[1] * means[1]];
    let between = across_blocks(likelihood, places, surface);
    let covariance =
        std::array::from_fn(|i| covariance[i] / total + squares[i] / total - moved[i] + between[i]);
    LineKnown { line, covariance }
}

/// What places of different blocks have in common, which the blocks leave out: the middle of the sandwich.
fn across_blocks(likelihood: &mut Likelihood, places: &[Place], surface: &Surface) -> [f64; 3] {
    if likelihood.blocks.len() < 2 {
        return [0.0; 3];
    }
    let best = &surface.best;
    let share = share_at(best.point);
    let mut pulls: Vec<(usize, usize, [f64; 2])> = Vec::with_capacity(places.len());
    for block in 0..likelihood.blocks.len() {
        let width = likelihood.blocks[block].places.len();
        let solved = likelihood.factor(places, block, share);
        let columns = solved.solved(width);
        pulls.extend(
            solved
                .indices
                .iter()
                .zip(columns)
                .map(|((_, place), [one, decades, _])| (block, *place, [one, decades])),
        );
    }
    let mut middle = [0.0; 3];
    for (nth, (block, a, pull)) in pulls.iter().enumerate() {
        for (other_block, b, other) in pulls.iter().skip(nth + 1) {
            if block == other_block {
                continue;
            }
            let apart = places[*a].apart_m(&places[*b]) / share.length_m;
            if apart > 12.0 {
                continue;
            }
            let r = share.rho * libm::exp(-apart);
            middle[0] += 2.0 * r * pull[0] * other[0];
            middle[1] += r * (pull[0] * other[1] + pull[1] * other[0]);
            middle[2] += 2.0 * r * pull[1] * other[1];
        }
    }
    // A M A, A the inverse of the sums, in the unit of the variance.
    let [a, b, c] = best.at.sums.inverse();
    let variance = best.at.variance(likelihood.free);
    let rows = [[a, b], [b, c]];
    let of = |i: usize, j: usize| {
        let m = [[middle[0], middle[1]], [middle[1], middle[2]]];
        let mut sum = 0.0;
        for k in 0..2 {
            for l in 0..2 {
                sum += rows[i][k] * m[k][l] * rows[l][j];
            }
        }
        variance * sum
    };
    [of(0, 0).max(0.0), of(0, 1), of(1, 1).max(0.0)]
}

/// How much the logarithm of a variance may be less and more than at its best for the likelihood to fall by so much a degree of
/// freedom: `x + exp(-x) - 1 = falls`, after Newton.
fn either_way(falls: f64) -> [f64; 2] {
    let root = (2.0 * falls.max(0.0)).sqrt();
    [-1.0, 1.0].map(|side: f64| {
        let mut x = side * root;
        for _ in 0..20 {
            let (value, slope) = (x + libm::exp(-x) - 1.0 - falls, 1.0 - libm::exp(-x));
            if slope == 0.0 {
                break;
            }
            x -= value / slope;
        }
        x.abs()
    })
}

/// Intervals of the noise that is new every time, of that which stays (both dB), and of the length (m).
pub(super) fn noises(surface: &Surface, free: f64, heard: f64) -> [Interval; 3] {
    let fine = surface.fine(free);
    let lowest = fine.iter().map(|fine| fine.deviance).fold(f64::INFINITY, f64::min);
    let limit = lowest + FALLS;
    let near: Vec<&Fine> = fine.iter().filter(|fine| fine.deviance <= limit).collect();
    let best = &surface.best;
    let (share, variance) = (share_at(best.point), best.at.variance(free));
    let noise = |of_share: &dyn Fn(f64) -> f64| {
        let value = (variance * of_share(share.rho)).sqrt();
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for fine in &near {
            // The variance at its best, and by how much more or less of it the likelihood falls to the limit.
            let log = fine.log_variance + libm::log(of_share(share_at(fine.point).rho).max(1e-12));
            let [less, more] = either_way((limit - fine.deviance) / heard);
            (low, high) = (low.min(log - less), high.max(log + more));
        }
        let [low, high] = [low, high].map(|log| libm::exp(0.5 * log));
        // A noise of a hundredth of all is none.
        let low = if low < 0.02 * variance.sqrt() { 0.0 } else { low };
        Interval {
            value,
            low: low.min(value),
            high: high.max(value),
            is_open_below: false,
            is_open_above: false,
        }
    };
    let lengths = || near.iter().map(|fine| fine.point[1]);
    let value = best.point[1];
    let (low, high) = lengths().fold((value, value), |(l, h), t| (l.min(t), h.max(t)));
    let [value, low_m, high_m] = [value, low, high].map(libm::exp);
    let length = Interval {
        value,
        low: low_m,
        high: high_m,
        is_open_below: low <= surface.lengths.0 + 1e-9,
        is_open_above: high >= surface.lengths.1 - 1e-9,
    };
    [noise(&|rho| 1.0 - rho), noise(&|rho| rho), length]
}
