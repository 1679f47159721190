//! Packets: which of them arrive, and the loss their receiver measures.

use uchain_core::chain::{Heard, Packet};

use crate::seed::{Seed, Source, Stream};

uchain_core::params! {
    /// Delivery of packets (Laclau 2021, §6.1).
    #[derive(serde::Serialize, serde::Deserialize)]
    #[serde(default, deny_unknown_fields)]
    pub struct PacketParams {
        /// Share of packets lost at random (1).
        /// - Source: Laclau 2021, §6.1.2; none in the published runs
        pub drop_rate: f32 = 0.2, in 0.0..=1.0;
        /// Measured loss from which on no packet is delivered (dB); a link at or above it is not connected.
        /// - Source: the authors' simulator
        pub limit_db: f32 = 100.0, in -50.0..=1000.0;
        /// Time from sending to hearing (ticks of 0.05 s).
        /// - Source: Laclau 2021, §6.1.1 (none)
        pub delay_ticks: u32 = 0, in 0..=1000;
    }
}

/// Which neighbour a packet comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Toward the base.
    Back,
    /// Toward the head.
    Front,
}

/// The receiver of one UAV. Each kind of imperfection is a receiver around another one.
pub trait Receiver: core::fmt::Debug + Send {
    /// What is heard, at `tick`, of the packet a neighbour sends then over a link of this true loss (dB).
    fn receive(&mut self, tick: u64, side: Side, true_db: f32, from: u16, packet: Packet) -> Option<Heard>;
}

/// The receiver as it comes: noise, random drops and a limit. Own draws for each of the two neighbours.
#[derive(Debug, Clone)]
pub struct Radio {
    back: Stream,
    front: Stream,
    sigma_db: f32,
    drop_rate: f32,
    limit_db: f32,
}

impl Radio {
    /// The receiver of one robot; `sigma_db` is the standard deviation of a measured loss.
    pub fn new(seed: Seed, robot: u32, sigma_db: f32, params: &PacketParams) -> Self {
        let stream = |source| seed.stream(robot, source);
        Self {
            back: stream(Source::RadioBack),
            front: stream(Source::RadioFront),
            sigma_db,
            drop_rate: params.drop_rate,
            limit_db: params.limit_db,
        }
    }
}

impl Receiver for Radio {
    fn receive(&mut self, _: u64, side: Side, true_db: f32, from: u16, packet: Packet) -> Option<Heard> {
        let stream = match side {
            Side::Back => &mut self.back,
            Side::Front => &mut self.front,
        };
        // Three draws, whatever happens: what arrives moves nobody's draws.
        let loss_db = true_db + self.sigma_db * stream.normal();
        let arrives = stream.uniform() >= self.drop_rate;
        (arrives && loss_db < self.limit_db).then_some(Heard { from, loss_db, packet })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn share_heard(true_db: f32, params: &PacketParams) -> f64 {
        let mut radio = Radio::new(Seed(1), 0, 3.0, params);
        let heard = (0..20_000)
            .filter(|tick| radio.receive(*tick, Side::Back, true_db, 0, Packet::default()).is_some())
            .count();
        heard as f64 / 20_000.0
    }

    #[test]
    fn a_fifth_is_lost_at_random_half_at_the_limit_and_all_far_beyond_it() {
        let params = PacketParams::default();
        for (true_db, expected) in [(60.0, 0.8), (100.0, 0.4), (120.0, 0.0)] {
            let share = share_heard(true_db, &params);
            assert!((share - expected).abs() < 0.015, "{share} heard at {true_db} dB");
        }
        assert_eq!(share_heard(60.0, &PacketParams { drop_rate: 1.0, ..params.clone() }), 0.0);
        assert_eq!(share_heard(60.0, &PacketParams { drop_rate: 0.0, ..params }), 1.0);
    }

    #[test]
    fn what_one_side_hears_moves_nobody_elses_draws() {
        let params = PacketParams::default();
        let mut front_only = Radio::new(Seed(1), 0, 3.0, &params);
        let mut both = Radio::new(Seed(1), 0, 3.0, &params);
        for tick in 0..100 {
            both.receive(tick, Side::Back, 50.0, 0, Packet::default());
            let alone = front_only.receive(tick, Side::Front, 55.0, 0, Packet::default());
            assert_eq!(both.receive(tick, Side::Front, 55.0, 0, Packet::default()), alone);
        }
    }
}
