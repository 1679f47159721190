//! A Gaussian random field over pairs of places: the same for all time, and the same from both ends.

use std::f64::consts::TAU;

use glam::{DVec2, Vec2};

use crate::seed::{Seed, Source};

/// Plane waves of a field.
const WAVES: usize = 64;
/// Shortest wave, as a share of the correlation length, and so the finest grain of a field: the spectrum goes on for ever,
/// with less than a thousandth of the variance beyond.
const FINEST: f64 = 0.006;
/// As far from 0 as a field gets, in its standard deviations: six draws in a hundred thousand lie beyond, and are cut
/// there, so that there is a least loss.
pub(super) const MOST: f32 = 4.0;

/// Mean 0, standard deviation 1, correlation exp(−(|Δp| + |Δq|)/c) between links whose ends are moved by Δp and Δq, those
/// of other links being far away (Gudmundson 1991, at both ends).
///
/// It is a sum of waves √(2/N) Σ cos(k p + l q + φ), with k and l drawn from the spectral density of exp(−r/c) in the plane,
/// ∝ (1 + (c k)²)^(−3/2), and a uniform φ. Its sum with itself from the other end is symmetric; what is nearer than c is like
/// its own other end, and is scaled down for that.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Field {
    /// (k + l)/2 and (k − l)/2 in turns per metre, φ in turns.
    waves: Vec<(DVec2, DVec2, f64)>,
    correlation_m: f64,
}

impl Field {
    /// A field of this seed.
    pub(super) fn new(seed: Seed, correlation_m: f32) -> Self {
        let correlation_m = f64::from(correlation_m);
        let mut stream = seed.stream(0, Source::Shadowing);
        let mut wave_vector = || {
            // Within K lies the share 1 − 1/√(1 + (c K)²) of the spectrum.
            let beyond = (1.0 - f64::from(stream.uniform())).max(FINEST / TAU);
            let length = (1.0 / (beyond * beyond) - 1.0).sqrt() / (correlation_m * TAU);
            let (sin, cos) = libm::sincos(TAU * f64::from(stream.uniform()));
            length * DVec2::new(cos, sin)
        };
        let mut waves: Vec<_> = (0..WAVES).map(|_| (wave_vector(), wave_vector(), 0.0)).collect();
        for (k, l, phase) in &mut waves {
            (*k, *l) = (0.5 * (*k + *l), 0.5 * (*k - *l));
            *phase = f64::from(stream.uniform());
        }
        Self { waves, correlation_m }
    }

    /// Its value for a link between two places, within [`MOST`]: the same bits from both ends.
    pub(super) fn at(&self, p: Vec2, q: Vec2) -> f32 {
        let (p, q) = (p.as_dvec2(), q.as_dvec2());
        // cos(k p + l q + φ) + cos(k q + l p + φ), as a product.
        let (sum, difference) = (p + q, p - q);
        let waves = self.waves.iter().map(|(even, odd, phase)| {
            cos_of_turns(even.dot(sum) + phase) * cos_of_turns(odd.dot(difference))
        });
        let likeness = libm::exp(-2.0 * difference.length() / self.correlation_m);
        let scale = 2.0 * (2.0 / WAVES as f64 / (2.0 * (1.0 + likeness))).sqrt();
        let value = scale as f32 * waves.sum::<f32>();
        value.clamp(-MOST, MOST)
    }
}

/// cos 2πx of turns x. Far from the origin, and of short waves, a phase has many: whole ones are taken off before it is
/// rounded. It is even to the last bit, and an eighth of the time of `libm`'s, to 1e-6.
fn cos_of_turns(turns: f64) -> f32 {
    /// Adding it leaves no room for what is less than a turn.
    const WHOLE: f64 = 6_755_399_441_055_744.0;
    /// Of sin 2πx, as powers of x up to x¹¹ have it: within a quarter turn the next is less than 6e-8.
    const SIN: [f32; 6] = [6.283_185_5, -41.341_702, 81.605_25, -76.705_86, 42.058_693, -15.094_643];
    let rest = (turns - ((turns + WHOLE) - WHOLE)) as f32;
    let x = 0.25 - rest.abs();
    let square = x * x;
    x * SIN.iter().rev().fold(0.0, |sum, term| sum * square + term)
}

#[cfg(test)]
mod tests;
