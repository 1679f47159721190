//! The channel as it comes: noise or fading, random drops and a limit, hard or soft.

use super::{Channel, Link, PacketParams, Received, streams::LinkStreams};
use crate::{
    radio::{Fading, RadioParams},
    seed::{Normal, Seed, Source, Stream},
};

/// As many widths beyond a soft limit nothing arrives: one packet in 60 000 would.
const SOFT_ENDS: f32 = 11.0;

/// Measured losses with noise; packets lost at random, and all or most from a measured loss on. Own draws for every link.
#[derive(Debug)]
pub(super) struct Noise {
    streams: LinkStreams,
    noise: Law,
    /// By how much a measured loss falls short of the true one at most (dB).
    best_db: f32,
    drop_rate: f32,
    limit_db: f32,
    soft_db: f32,
}

/// By which law a measured loss differs from the true one.
#[derive(Debug, Clone, Copy)]
enum Law {
    White { sigma_db: f32 },
    Rician { steady: f32, scattered: f32 },
}

impl Law {
    fn of(radio: &RadioParams) -> Self {
        match radio.fading {
            Fading::White => Self::White { sigma_db: radio.sigma_db },
            Fading::Rician => {
                let k = libm::powf(10.0, 0.1 * radio.rician_k_db);
                // Mean power 1: of the steady part K/(K + 1), of either scattered one 1/(2 (K + 1)).
                let steady = (k / (k + 1.0)).sqrt();
                Self::Rician { steady, scattered: (0.5 / (k + 1.0)).sqrt() }
            }
        }
    }

    /// What it adds to a loss (dB).
    fn db(self, stream: &mut Stream) -> f32 {
        match self {
            Self::White { sigma_db } => sigma_db * stream.normal(),
            Self::Rician { steady, scattered } => {
                let along = steady + scattered * stream.normal();
                let across = scattered * stream.normal();
                -10.0 * libm::log10f(along * along + across * across)
            }
        }
    }

    fn best_db(self) -> f32 {
        match self {
            Self::White { sigma_db } => Normal::MOST * sigma_db,
            Self::Rician { steady, scattered } => {
                20.0 * libm::log10f(steady + std::f32::consts::SQRT_2 * Normal::MOST * scattered)
            }
        }
    }
}

impl Noise {
    /// Room for so many receivers.
    pub(super) fn new(seed: Seed, receivers: u16, radio: &RadioParams, params: &PacketParams) -> Self {
        let sources = [Source::RadioBack, Source::RadioFront, Source::RadioPair];
        let noise = Law::of(radio);
        Self {
            streams: LinkStreams::new(seed, receivers, sources),
            noise,
            best_db: noise.best_db(),
            drop_rate: params.drop_rate,
            limit_db: params.limit_db,
            soft_db: params.soft_db,
        }
    }

    /// Whether a packet of this measured loss arrives, by a uniform number.
    fn arrives(&self, loss_db: f32, draw: f32) -> bool {
        if self.soft_db > 0.0 {
            let over = (loss_db - self.limit_db) / self.soft_db;
            // In one draw: it arrives if neither the one nor the other loses it.
            return over < SOFT_ENDS && 1.0 - draw <= (1.0 - self.drop_rate) / (1.0 + libm::expf(over));
        }
        draw >= self.drop_rate && loss_db < self.limit_db
    }
}

impl<P> Channel<P> for Noise {
    fn transfer(&mut self, link: Link, tick: u64, loss_db: f32, payload: P) -> Option<Received<P>> {
        // Draws of a pair are a function of its tick: what noise cannot bring below the limit needs none.
        let ends_db = self.limit_db + SOFT_ENDS * self.soft_db;
        if link.side.is_none() && loss_db - self.best_db >= ends_db {
            return None;
        }
        let noise = self.noise;
        let stream = self.streams.of(link, tick);
        // As many draws, whatever happens: what arrives moves nobody's draws.
        let loss_db = loss_db + noise.db(stream);
        let draw = stream.uniform();
        self.arrives(loss_db, draw).then_some(Received { from: link.from, loss_db, payload })
    }
}
