//! Smooth noise over the plane.

use glam::DVec2;

use crate::seed::Stream;

/// Noise between -1 and 1 that changes over about a unit of length.
pub(super) struct Noise {
    key: u64,
}

/// Wavelengths, in units, and shares. The steepest slope, 3/2 of two over a wavelength, each by its share, is 2.6: passages
/// whose width varies by half of it along a unit still have one wall on either side.
const OCTAVES: [(f64, f64); 2] = [(1.5, 0.7), (0.75, 0.3)];

impl Noise {
    pub(super) fn new(stream: &mut Stream) -> Self {
        Self { key: u64::from(stream.bits()) << 32 | u64::from(stream.bits()) }
    }

    pub(super) fn at(&self, p: DVec2) -> f64 {
        let octave = |(index, (wavelength, share)): (usize, &(f64, f64))| {
            share * self.smooth(p / *wavelength, index as u64)
        };
        OCTAVES.iter().enumerate().map(octave).sum()
    }

    /// Between the values at the four lattice points around a place.
    fn smooth(&self, p: DVec2, octave: u64) -> f64 {
        let corner = p.floor();
        let ease = p - corner;
        let ease = ease * ease * (3.0 - 2.0 * ease);
        let (x, y) = (corner.x as i64, corner.y as i64);
        let value = |dx, dy| self.value(x + dx, y + dy, octave);
        let mix = |a: f64, b: f64, share: f64| a + share * (b - a);
        mix(mix(value(0, 0), value(1, 0), ease.x), mix(value(0, 1), value(1, 1), ease.x), ease.y)
    }

    /// From -1 to 1, by the bits of the place alone (the mixer of `SplitMix64`).
    fn value(&self, x: i64, y: i64, octave: u64) -> f64 {
        let mut z = self.key;
        for part in [x.cast_unsigned(), y.cast_unsigned(), octave] {
            z = (z ^ part).wrapping_add(0x9e37_79b9_7f4a_7c15);
            z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            z ^= z >> 31;
        }
        (z >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}
