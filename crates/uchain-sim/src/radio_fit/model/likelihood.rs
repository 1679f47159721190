//! The restricted likelihood of the losses at places, the line and the total variance worked out of it (profiled).
//!
//! With `V = s² (ρ R + (1 - ρ) / n)`, R the correlation of the shadowing and n packets a place, minus twice its logarithm is
//! `(N - p) log s² + log |V / s²| + (N - K) log(1 - ρ) + (Q + SS / (1 - ρ)) / s² + log |X' (V / s²)⁻¹ X|`: N packets at K places, p
//! numbers of the line, SS the squares within places. A place where nothing was heard takes one from N - K.

use super::places::{Place, spread_m};

/// A line: loss at the reference distance (dB), and dB per decade.
pub(super) type Line = [f64; 2];

/// Sums of products of the line's columns and the losses.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Sums {
    pub(super) xx: [f64; 3],
    pub(super) xy: [f64; 2],
    pub(super) yy: f64,
    pub(super) log_det: f64,
}

impl Sums {
    pub(super) fn det(&self) -> f64 {
        self.xx[0] * self.xx[2] - self.xx[1] * self.xx[1]
    }

    /// The inverse of `X' V⁻¹ X`: upper left, side, lower right.
    pub(super) fn inverse(&self) -> [f64; 3] {
        let det = self.det();
        [self.xx[2] / det, -self.xx[1] / det, self.xx[0] / det]
    }

    pub(super) fn line(&self) -> Line {
        let [a, b, c] = self.inverse();
        [a * self.xy[0] + b * self.xy[1], b * self.xy[0] + c * self.xy[1]]
    }

    fn residual(&self) -> f64 {
        let line = self.line();
        (self.yy - line[0] * self.xy[0] - line[1] * self.xy[1]).max(0.0)
    }

    pub(super) fn add(&mut self, other: &Self) {
        for (sum, more) in self.xx.iter_mut().zip(other.xx) {
            *sum += more;
        }
        for (sum, more) in self.xy.iter_mut().zip(other.xy) {
            *sum += more;
        }
        self.yy += other.yy;
        self.log_det += other.log_det;
    }
}

/// Places of one link whose shadowing hangs together.
#[derive(Debug)]
pub(super) struct Block {
    pub(super) places: Vec<usize>,
    /// Of pairs, row by row up to the diagonal (m).
    apart_m: Vec<f64>,
}

/// What the likelihood is asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Share {
    /// Of the variance that stays with the place (1), at least 0 and less than 1.
    pub(super) rho: f64,
    /// Correlation length (m).
    pub(super) length_m: f64,
}

/// The likelihood at one share and length.
#[derive(Debug, Clone, Copy)]
pub(super) struct At {
    /// Minus twice the logarithm, but for the two terms with s².
    pub(super) fixed: f64,
    /// `Q + SS / (1 - ρ)` (dB²).
    pub(super) squares: f64,
    pub(super) sums: Sums,
}

impl At {
    /// Best total variance (dB²).
    pub(super) fn variance(&self, free: f64) -> f64 {
        (self.squares / free).max(1e-12)
    }

    /// Minus twice the log likelihood at its best total variance.
    pub(super) fn deviance(&self, free: f64) -> f64 {
        self.deviance_at(self.variance(free), free)
    }

    pub(super) fn deviance_at(&self, variance: f64, free: f64) -> f64 {
        self.fixed + free * libm::log(variance) + self.squares / variance
    }
}

/// All blocks, with room to work in.
#[derive(Debug)]
pub(super) struct Likelihood {
    pub(super) blocks: Vec<Block>,
    /// Packets heard, less the numbers of the line.
    pub(super) free: f64,
    /// `N - K`.
    within: f64,
    within_squares: f64,
    /// How far apart packets of one place lie (m).
    spread_m: f64,
    lower: Vec<f64>,
}

/// How many work out a block at once as sums: independent, so that a processor adds them side by side.
const LANES: usize = 8;

fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut lanes = [0.0; LANES];
    let (heads, tails) = (a.chunks_exact(LANES), b.chunks_exact(LANES));
    let rest: f64 = heads.remainder().iter().zip(tails.remainder()).map(|(a, b)| a * b).sum();
    for (a, b) in heads.zip(tails) {
        for lane in 0..LANES {
            lanes[lane] += a[lane] * b[lane];
        }
    }
    rest + lanes.iter().sum::<f64>()
}

impl Likelihood {
    pub(super) fn new(places: &[Place], blocks: Vec<Vec<usize>>) -> Self {
        let block = |indices: Vec<usize>| {
            let mut apart_m = Vec::with_capacity(indices.len() * (indices.len() + 1) / 2);
            for (row, a) in indices.iter().enumerate() {
                apart_m.extend(indices.iter().take(row + 1).map(|b| places[*a].apart_m(&places[*b])));
            }
            Block { places: indices, apart_m }
        };
        let largest = blocks.iter().map(Vec::len).max().unwrap_or(0);
        let mut all = Self {
            blocks: blocks.into_iter().map(block).collect(),
            free: 0.0,
            within: 0.0,
            within_squares: 0.0,
            spread_m: spread_m(places),
            lower: vec![0.0; largest * largest],
        };
        all.count(places);
        all
    }

    /// Takes in what changed of the places.
    pub(super) fn count(&mut self, places: &[Place]) {
        let heard: f64 = places.iter().map(|place| place.heard).sum();
        let counted = places.iter().filter(|place| place.weight > 0.0).count() as f64;
        let sent = heard + places.iter().map(|place| place.imputed).sum::<f64>();
        (self.free, self.within) = (sent - 2.0, sent - counted);
        let squares = |place: &Place| {
            let more = place.weight - place.heard;
            // Between those heard and those not heard at one place.
            let between = if place.heard > 0.0 && more > 0.0 {
                let off_db = (place.loss_db - place.level_db) * place.weight / more;
                place.heard * more / place.weight * off_db * off_db
            } else {
                0.0
            };
            place.squares + place.imputed_squares + between
        };
        self.within_squares = places.iter().map(squares).sum();
    }

    /// Share of the shadowing that differs within a place (1), where cells stand for places.
    fn beside(&self, share: Share) -> f64 {
        (self.spread_m / share.length_m).min(0.5)
    }

    /// The likelihood at a share and a length.
    pub(super) fn at(&mut self, places: &[Place], share: Share) -> At {
        let mut sums = Sums::default();
        for index in 0..self.blocks.len() {
            let solved = self.factor(places, index, share);
            sums.add(&solved.sums());
        }
        let white = 1.0 - share.rho + share.rho * self.beside(share);
        let fixed = sums.log_det + self.within * libm::log(white) + libm::log(sums.det().max(1e-300));
        At { fixed, squares: sums.residual() + self.within_squares / white, sums }
    }

    /// Sums of one link alone.
    pub(super) fn of_link(&mut self, places: &[Place], link: usize, share: Share) -> Sums {
        let mut sums = Sums::default();
        for index in 0..self.blocks.len() {
            let first = self.blocks[index].places.first().and_then(|place| places.get(*place));
            if first.is_some_and(|place| place.link == link) {
                sums.add(&self.factor(places, index, share).sums());
            }
        }
        sums
    }

    /// Factors a block's `V / s²` after Cholesky, and solves it for the line's columns and the losses.
    pub(super) fn factor(&mut self, places: &[Place], index: usize, share: Share) -> Solved<'_> {
        let beside = self.beside(share);
        let white = 1.0 - share.rho + share.rho * beside;
        let Self { blocks, lower, .. } = self;
        let block = &blocks[index];
        // A place that counts for nothing is no part of it.
        let mut solved = Solved {
            indices: Vec::with_capacity(block.places.len()),
            whitened: Vec::new(),
            log_det: 0.0,
            lower: &[],
        };
        let mut size = 0;
        let width = block.places.len();
        for (row, place_index) in block.places.iter().enumerate() {
            let place = &places[*place_index];
            if place.weight <= 0.0 {
                continue;
            }
            let start = row * (row + 1) / 2;
            let (done, rest) = lower.split_at_mut(size * width);
            let own = &mut rest[..width];
            for (column, (other, _)) in solved.indices.iter().enumerate() {
                let r = share.rho * libm::exp(-block.apart_m[start + *other] / share.length_m);
                let others = &done[column * width..column * width + width];
                own[column] = (r - dot(&own[..column], &others[..column])) / others[column];
            }
            let diagonal = share.rho + white / place.weight - dot(&own[..size], &own[..size]);
            let diagonal = diagonal.max(1e-12).sqrt();
            own[size] = diagonal;
            solved.log_det += 2.0 * libm::log(diagonal);
            let mut white = [1.0, place.decades, place.level_db];
            for (which, value) in white.iter_mut().enumerate() {
                let before: f64 = solved
                    .whitened
                    .iter()
                    .zip(&own[..size])
                    .map(|(w, l): (&[f64; 3], &f64)| w[which] * l)
                    .sum();
                *value = (*value - before) / diagonal;
            }
            solved.whitened.push(white);
            solved.indices.push((row, *place_index));
            size += 1;
        }
        solved.lower = &lower[..size * width];
        solved
    }
}

/// A block that was factored.
#[derive(Debug)]
pub(super) struct Solved<'a> {
    /// Row in the block, and index of the place.
    pub(super) indices: Vec<(usize, usize)>,
    /// `L⁻¹` of a column of ones, of the decades, of the losses.
    whitened: Vec<[f64; 3]>,
    log_det: f64,
    lower: &'a [f64],
}

impl Solved<'_> {
    fn sums(&self) -> Sums {
        let mut sums = Sums { log_det: self.log_det, ..Sums::default() };
        for [one, decades, loss] in &self.whitened {
            sums.xx[0] += one * one;
            sums.xx[1] += one * decades;
            sums.xx[2] += decades * decades;
            sums.xy[0] += one * loss;
            sums.xy[1] += decades * loss;
            sums.yy += loss * loss;
        }
        sums
    }

    /// `(V / s²)⁻¹` of the three columns, place by place.
    pub(super) fn solved(&self, width: usize) -> Vec<[f64; 3]> {
        let mut out = self.whitened.clone();
        for row in (0..out.len()).rev() {
            let own = &self.lower[row * width..=row * width + row];
            let value = out[row].map(|value| value / own[row]);
            out[row] = value;
            for (before, l) in out[..row].iter_mut().zip(own) {
                for which in 0..3 {
                    before[which] -= l * value[which];
                }
            }
        }
        out
    }
}
