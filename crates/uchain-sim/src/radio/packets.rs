//! Packets: which of them arrive, and the loss their receiver measures.

use uchain_core::chain::{Heard, Packet};

use crate::seed::{Seed, Source, Stream};

uchain_core::params! {
    /// Delivery of packets (Laclau 2021, §6.1).
    #[derive(serde::Serialize, serde::Deserialize)]
    #[serde(default, deny_unknown_fields)]
    pub struct PacketParams {
        /// Share of packets lost at random (1).
        pub drop_rate: f32 = 0.2, in 0.0..=1.0;
        /// Measured loss from which on no packet is delivered (dB); a link at or above it is not connected.
        pub limit_db: f32 = 100.0, in -50.0..=1000.0;
    }
}

/// The receiver of one UAV: own draws for each of its two neighbours.
#[derive(Debug, Clone)]
pub struct Radio {
    back: Stream,
    front: Stream,
    sigma_db: f32,
    params: PacketParams,
}

/// Which neighbour a packet comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Toward the base.
    Back,
    /// Toward the head.
    Front,
}

impl Radio {
    /// The receiver of one robot; `sigma_db` is the standard deviation of a measured loss.
    pub fn new(seed: Seed, robot: u32, sigma_db: f32, params: PacketParams) -> Self {
        let stream = |source| seed.stream(robot, source);
        Self { back: stream(Source::RadioBack), front: stream(Source::RadioFront), sigma_db, params }
    }

    /// What is heard of a packet sent over a link of this true loss. Three draws, whatever happens.
    pub fn receive(&mut self, side: Side, true_db: f32, packet: Packet) -> Option<Heard> {
        let stream = match side {
            Side::Back => &mut self.back,
            Side::Front => &mut self.front,
        };
        let loss_db = true_db + self.sigma_db * stream.normal();
        let arrives = stream.uniform() >= self.params.drop_rate;
        (arrives && loss_db < self.params.limit_db).then_some(Heard { loss_db, packet })
    }
}
