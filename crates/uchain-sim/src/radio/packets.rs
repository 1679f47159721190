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
        /// Time from sending to hearing, in ticks of 0.05 s.
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
    fn receive(&mut self, tick: u64, side: Side, true_db: f32, packet: Packet) -> Option<Heard>;
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
    fn receive(&mut self, _: u64, side: Side, true_db: f32, packet: Packet) -> Option<Heard> {
        let stream = match side {
            Side::Back => &mut self.back,
            Side::Front => &mut self.front,
        };
        // Three draws, whatever happens: what arrives moves nobody's draws.
        let loss_db = true_db + self.sigma_db * stream.normal();
        let arrives = stream.uniform() >= self.drop_rate;
        (arrives && loss_db < self.limit_db).then_some(Heard { loss_db, packet })
    }
}
