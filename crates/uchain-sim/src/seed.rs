//! Randomness as an argument: one seed gives independent named streams (run, robot, source).

use rand_chacha::{
    ChaCha8Rng,
    rand_core::{Rng, SeedableRng},
};

/// What draws from a stream. Adding a source moves nobody else's draws.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
pub enum Source {
    /// Noise and drop-outs of the ToF sensors.
    Tof = 1,
    /// Noise of optic flow.
    Flow = 2,
    /// Packets heard from the neighbour toward the base.
    RadioBack = 3,
    /// Packets heard from the neighbour toward the head.
    RadioFront = 4,
    /// Bursts of lost packets on the link toward the base.
    BurstBack = 6,
    /// Bursts of lost packets on the link toward the head.
    BurstFront = 7,
    /// Random starts of tests and designs.
    Start = 5,
    /// Choices of an explorer.
    Choice = 8,
    /// Noise of where a robot believes it is.
    Position = 9,
    /// Seeds of the replicates of a sweep.
    Replicate = 10,
    /// Packets between two that are no neighbours in a chain.
    RadioPair = 11,
    /// Bursts of lost packets between two that are no neighbours in a chain.
    BurstPair = 12,
    /// Shapes of generated maps.
    Map = 13,
    /// Shadowing that stays in place.
    Shadowing = 14,
    /// Gains and patterns of antennas.
    Antenna = 15,
    /// By how much receivers read too much.
    Reading = 16,
}

/// Seed of one run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Seed(pub u64);

impl Seed {
    /// The stream of one robot's source; the same arguments give the same draws for ever.
    pub fn stream(self, robot: u32, source: Source) -> Stream {
        let mut key = [0_u8; 32];
        key[..8].copy_from_slice(&self.0.to_le_bytes());
        let mut rng = ChaCha8Rng::from_seed(key);
        rng.set_stream((u64::from(robot) << 8) | source as u64);
        Stream(rng)
    }

    /// The stream of what happens between two robots at one tick: a function of its arguments alone, whatever was drawn for
    /// others or before. It is one of 16 numbers; one that goes on runs into that of the next tick.
    pub fn link_stream(self, from: u16, to: u16, source: Source, tick: u64) -> Stream {
        let Stream(mut rng) = self.stream(u32::from(from) << 16 | u32::from(to), source);
        rng.set_word_pos(16 * u128::from(tick));
        Stream(rng)
    }

    /// Seed of one replicate of a sweep with this root seed: a function of the two alone, whatever is varied and however
    /// many replicates there are. It has 63 bits, so that programs without unsigned numbers can hold it as well.
    #[must_use]
    pub fn replicate(self, replicate: u64) -> Self {
        let Stream(mut rng) = self.stream(0, Source::Replicate);
        rng.set_word_pos(2 * u128::from(replicate));
        Self(rng.next_u64() >> 1)
    }
}

/// One stream of random numbers.
#[derive(Debug, Clone)]
pub struct Stream(ChaCha8Rng);

impl Stream {
    /// Uniform in [0, 1), 24 bits.
    pub fn uniform(&mut self) -> f32 {
        (self.0.next_u32() >> 8) as f32 * (1.0 / 16_777_216.0)
    }

    /// 32 uniform bits.
    pub fn bits(&mut self) -> u32 {
        self.0.next_u32()
    }

    /// A standard normal number.
    pub fn normal(&mut self) -> f32 {
        self.draw_normal().value()
    }

    /// A standard normal number, drawn now and worked out when it is wanted: noise on what turns out unseen costs
    /// little. Always two draws, whatever they are.
    pub fn draw_normal(&mut self) -> Normal {
        Normal([self.uniform(), self.uniform()])
    }
}

/// A standard normal number that has been drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Normal([f32; 2]);

impl Normal {
    /// No draw is farther from 0: one of 24 bits is 0, or at least 2⁻²⁴, and √(2 ln 2²⁴) is 5.77.
    pub const MOST: f32 = 5.8;

    /// By Box and Muller, on `libm`.
    pub fn value(self) -> f32 {
        let [u, v] = self.0;
        // 1 − u lies in (0, 1]: its logarithm is finite.
        let radius = (-2.0 * libm::logf(1.0 - u)).sqrt();
        radius * libm::cosf(core::f32::consts::TAU * v)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn streams_of_different_robots_sources_and_seeds_differ_and_equal_ones_agree() {
        let draws = |seed, robot, source| {
            let mut stream = Seed(seed).stream(robot, source);
            [(); 4].map(|()| stream.uniform())
        };
        let first = draws(1, 0, Source::Tof);
        assert_eq!(first, draws(1, 0, Source::Tof));
        for other in [draws(2, 0, Source::Tof), draws(1, 1, Source::Tof), draws(1, 0, Source::Flow)] {
            assert_ne!(first, other);
        }
    }

    #[test]
    fn what_happens_on_a_link_at_a_tick_is_drawn_from_nothing_else() {
        let draws = |from, to, source, tick| {
            let mut stream = Seed(1).link_stream(from, to, source, tick);
            [(); 16].map(|()| stream.bits())
        };
        let first = draws(3, 4, Source::RadioPair, 7);
        assert_eq!(first, draws(3, 4, Source::RadioPair, 7));
        for other in [
            draws(4, 3, Source::RadioPair, 7),
            draws(3, 5, Source::RadioPair, 7),
            draws(3, 4, Source::BurstPair, 7),
            draws(3, 4, Source::RadioPair, 8),
            draws(u16::MAX, u16::MAX, Source::RadioPair, u64::MAX >> 8),
        ] {
            assert!(first.iter().all(|draw| !other.contains(draw)), "{other:?}");
        }
        // The next tick goes on where this one ends.
        let mut on = Seed(1).link_stream(3, 4, Source::RadioPair, 6);
        for _ in 0..16 {
            on.bits();
        }
        assert_eq!(on.bits(), first[0]);
    }

    #[test]
    fn seeds_of_replicates_are_pinned_and_never_repeat_within_a_sweep() {
        let first = [0, 1, 2].map(|replicate| Seed(1).replicate(replicate).0);
        assert_eq!(first, [316_819_790_161_494_059, 6_900_507_268_339_487_691, 4_646_504_056_920_253_644]);
        let mut seeds: Vec<u64> =
            (0..100_000).map(|i| Seed(1 + i / 50_000).replicate(i % 50_000).0).collect();
        seeds.sort_unstable();
        assert!(seeds.windows(2).all(|pair| pair[0] < pair[1]));
        assert!(seeds[seeds.len() - 1] < 1 << 63);
    }

    #[test]
    fn normal_draws_have_mean_0_variance_1_and_normal_tails() {
        let mut stream = Seed(7).stream(0, Source::Start);
        let n = 200_000;
        let draws: Vec<f64> = (0..n).map(|_| f64::from(stream.normal())).collect();
        let mean = draws.iter().sum::<f64>() / f64::from(n);
        let variance = draws.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / f64::from(n);
        let beyond_2 = draws.iter().filter(|x| x.abs() > 2.0).count() as f64 / f64::from(n);
        assert!(mean.abs() < 0.01 && (variance - 1.0).abs() < 0.02, "{mean} {variance}");
        assert!((beyond_2 - 0.0455).abs() < 0.003, "{beyond_2}");
        // The least and the greatest draws there are.
        let ends = [0.0, 1.0 - 1.0 / 16_777_216.0].map(|u| Normal([u, 0.0]).value());
        assert!(ends[0] == 0.0 && (5.7..Normal::MOST).contains(&ends[1]), "{ends:?}");
    }
}
