//! Packets that were not heard: by chance, or because they lost too much.

use serde::Serialize;
use uchain_core::bounded;

use super::places::Place;

/// By how much a limit has to explain the losses better than chance (twice the logarithm): 1 % of chi squared with two degrees of
/// freedom.
const BETTER: f64 = 9.21;
/// A logistic curve is this much wider than a normal one of the same slope.
const LOGISTIC: f64 = 1.702;
/// Bins of losses (dB), and packets that one has to have to be told of.
const BIN_DB: f64 = 0.5;
const SHOWN_DB: f64 = 5.0;
const SHOWN_LEAST: f64 = 10.0;

/// What became of the packets.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PacketLoss {
    /// Sent, as far as the log tells.
    pub sent: usize,
    /// Heard.
    pub heard: usize,
    /// Share that is lost whatever the loss (1).
    pub random: f64,
    /// Loss at which half of the others is lost (dB); `None` where losses do not depend on it.
    pub limit_db: Option<f64>,
    /// Width of the change: the share goes from 12 to 88 % within four of them (dB).
    pub width_db: Option<f64>,
    /// Share that was not heard (1) against the loss that is to be expected at the place.
    pub rates: Vec<Rate>,
}

/// Packets of places of about one loss.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Rate {
    /// Middle of the losses (dB).
    pub loss_db: f64,
    /// Packets sent.
    pub sent: f64,
    /// Share of them that was not heard (1), and its 95 % interval after Wilson.
    pub per: f64,
    /// Lower end of it.
    pub low: f64,
    /// Upper end of it.
    pub high: f64,
}

/// How packets are lost: heard with `(1 - p) / (1 + exp((loss - limit) / width))`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Curve {
    pub(super) random: f64,
    pub(super) limit_db: f64,
    pub(super) width_db: f64,
}

fn normal(z: f64) -> f64 {
    0.5 * libm::erfc(-z / std::f64::consts::SQRT_2)
}

impl Curve {
    /// Share that is lost of packets whose loss scatters about a mean, and its first two derivatives by the mean.
    fn lost(&self, mean_db: f64, sigma_db: f64) -> [f64; 3] {
        let s = libm::hypot(sigma_db, LOGISTIC * self.width_db).max(1e-3);
        let z = (self.limit_db - mean_db) / s;
        let density = libm::exp(-0.5 * z * z) / (s * (2.0 * std::f64::consts::PI).sqrt());
        let heard = 1.0 - self.random;
        [(1.0 - heard * normal(z)).max(1e-12), heard * density, heard * density * z / s]
    }

    fn heard(&self, loss_db: f64) -> f64 {
        ((1.0 - self.random) / (1.0 + libm::exp((loss_db - self.limit_db) / self.width_db))).max(1e-12)
    }
}

/// Readings in bins, and the packets of each place with the loss that is to be expected there.
pub(super) struct Counted {
    readings: Vec<(f64, f64)>,
    lost: Vec<(f64, f64)>,
    greatest_db: f64,
}

impl Counted {
    pub(super) fn new(readings_db: impl Iterator<Item = f64>, places: &[Place], expected_db: &[f64]) -> Self {
        let mut bins = std::collections::BTreeMap::<i64, f64>::new();
        let mut greatest_db = f64::NEG_INFINITY;
        for reading_db in readings_db {
            greatest_db = greatest_db.max(reading_db);
            *bins.entry((reading_db / BIN_DB).round() as i64).or_default() += 1.0;
        }
        let readings = bins.into_iter().map(|(bin, count)| (bin as f64 * BIN_DB, count)).collect();
        let lost = places.iter().zip(expected_db).filter(|(place, _)| place.lost > 0.0);
        Self {
            readings,
            lost: lost.map(|(place, expected_db)| (*expected_db, place.lost)).collect(),
            greatest_db,
        }
    }

    /// The curve by which the packets were lost; `None` where chance alone explains it as well.
    pub(super) fn curve(&self, sigma_db: f64) -> Option<Curve> {
        let (heard, lost) = (sum(&self.readings), sum(&self.lost));
        if lost < 3.0 || heard < 3.0 {
            return None;
        }
        let share = lost / (heard + lost);
        let chance = heard * libm::log(1.0 - share) + lost * libm::log(share);
        let curve_of = |x: [f64; 3]| Curve {
            random: 1.0 / (1.0 + libm::exp(-x[0])),
            limit_db: x[1],
            width_db: libm::exp(bounded(x[2], -3.0, 3.0)),
        };
        let minus = |x: [f64; 3]| {
            let curve = curve_of(x);
            let heard: f64 =
                self.readings.iter().map(|(db, count)| count * libm::log(curve.heard(*db))).sum();
            let lost: f64 =
                self.lost.iter().map(|(db, count)| count * libm::log(curve.lost(*db, sigma_db)[0])).sum();
            -heard - lost
        };
        let starts =
            [[-4.0, self.greatest_db, -1.0], [libm::log(share / (1.0 - share)), self.greatest_db, 0.0]];
        let (best, value) = starts
            .map(|start| simplex(start, [1.0, -3.0, 0.7], &minus))
            .into_iter()
            .min_by(|a, b| a.1.total_cmp(&b.1))?;
        (2.0 * (-value - chance) > BETTER).then(|| curve_of(best))
    }

    /// What became of them.
    pub(super) fn told(&self, places: &[Place], expected_db: &[f64], curve: Option<Curve>) -> PacketLoss {
        let (heard, lost) = (sum(&self.readings), sum(&self.lost));
        let mut bins = std::collections::BTreeMap::<i64, (f64, f64)>::new();
        for (place, expected_db) in places.iter().zip(expected_db) {
            let bin = bins.entry((expected_db / SHOWN_DB).floor() as i64).or_default();
            bin.0 += place.heard + place.lost;
            bin.1 += place.lost;
        }
        let rate = |(bin, (sent, lost)): (i64, (f64, f64))| {
            let (per, z) = (lost / sent, 1.96);
            let wide = 1.0 + z * z / sent;
            let middle = (per + z * z / (2.0 * sent)) / wide;
            let half = z * (per * (1.0 - per) / sent + z * z / (4.0 * sent * sent)).sqrt() / wide;
            let loss_db = (bin as f64 + 0.5) * SHOWN_DB;
            Rate { loss_db, sent, per, low: (middle - half).max(0.0), high: (middle + half).min(1.0) }
        };
        let rates = bins.into_iter().filter(|(_, (sent, _))| *sent >= SHOWN_LEAST).map(rate).collect();
        PacketLoss {
            sent: (heard + lost) as usize,
            heard: heard as usize,
            random: curve.map_or(lost / (heard + lost).max(1.0), |curve| curve.random),
            limit_db: curve.map(|curve| curve.limit_db),
            width_db: curve.map(|curve| curve.width_db),
            rates: if lost > 0.0 { rates } else { Vec::new() },
        }
    }
}

fn sum(counts: &[(f64, f64)]) -> f64 {
    counts.iter().map(|(_, count)| count).sum()
}

/// Least of a function of three numbers, by a simplex that shrinks.
fn simplex(start: [f64; 3], steps: [f64; 3], of: &dyn Fn([f64; 3]) -> f64) -> ([f64; 3], f64) {
    let with = |x: [f64; 3]| {
        let value = of(x);
        (x, if value.is_finite() { value } else { f64::INFINITY })
    };
    let mut corners: Vec<([f64; 3], f64)> = vec![with(start)];
    for axis in 0..3 {
        let mut x = start;
        x[axis] += steps[axis];
        corners.push(with(x));
    }
    for _ in 0..200 {
        corners.sort_by(|a, b| a.1.total_cmp(&b.1));
        let worst = corners[3];
        if worst.1 - corners[0].1 < 1e-4 {
            break;
        }
        let middle: [f64; 3] =
            std::array::from_fn(|i| (corners[0].0[i] + corners[1].0[i] + corners[2].0[i]) / 3.0);
        let toward = |far: f64| with(std::array::from_fn(|i| middle[i] + far * (worst.0[i] - middle[i])));
        let reflected = toward(-1.0);
        if reflected.1 < corners[0].1 {
            let expanded = toward(-2.0);
            corners[3] = if expanded.1 < reflected.1 { expanded } else { reflected };
        } else if reflected.1 < corners[2].1 {
            corners[3] = reflected;
        } else {
            let contracted = toward(if reflected.1 < worst.1 { -0.5 } else { 0.5 });
            if contracted.1 < worst.1.min(reflected.1) {
                corners[3] = contracted;
            } else {
                let best = corners[0].0;
                for corner in corners.iter_mut().skip(1) {
                    *corner = with(std::array::from_fn(|i| f64::midpoint(best[i], corner.0[i])));
                }
            }
        }
    }
    corners.sort_by(|a, b| a.1.total_cmp(&b.1));
    corners[0]
}

/// Lets packets that were not heard say what they know of each place: that they lost more than what is heard there. Each counts
/// as a part of a packet, at a loss beyond the limit (Laplace's approximation of a Tobit).
pub(super) fn count_lost(places: &mut [Place], expected_db: &[f64], curve: &Curve, sigma_db: f64) {
    const LEAST: f64 = 1e-3;
    for (place, &expected_db) in places.iter_mut().zip(expected_db) {
        place.forget_lost();
        if place.lost == 0.0 {
            continue;
        }
        let [share, first, second] = curve.lost(expected_db, sigma_db);
        let slope = place.lost * first / share;
        let bend = place.lost * (first * first / (share * share) - second / share);
        let counts = bend * sigma_db * sigma_db;
        // One that must have been lost says nothing.
        if counts.is_nan() || counts < LEAST {
            continue;
        }
        let counts = counts.min(place.lost);
        let off_db = (slope * sigma_db * sigma_db / counts).min(20.0);
        let level_db = expected_db + off_db;
        // Of a packet that was not heard, the square of its noise is to be expected so large; the level above is part of it.
        let square = sigma_db * sigma_db * (1.0 + sigma_db * sigma_db * second / share);
        place.imputed = place.lost;
        place.imputed_squares = place.lost * square - counts * off_db * off_db;
        place.weight = place.heard + counts;
        place.level_db = (place.heard * place.loss_db + counts * level_db) / place.weight;
    }
}
