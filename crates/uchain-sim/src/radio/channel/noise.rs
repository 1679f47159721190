//! The channel as it comes: noise, random drops and a limit.

use super::{Channel, Link, PacketParams, Received, streams::LinkStreams};
use crate::seed::{Normal, Seed, Source};

/// Measured losses with white noise; packets lost at random, and all from a measured loss on. Own draws for every link.
#[derive(Debug)]
pub(super) struct Noise {
    streams: LinkStreams,
    sigma_db: f32,
    drop_rate: f32,
    limit_db: f32,
}

impl Noise {
    /// Room for so many receivers; `sigma_db` is the standard deviation of a measured loss.
    pub(super) fn new(seed: Seed, receivers: u16, sigma_db: f32, params: &PacketParams) -> Self {
        let sources = [Source::RadioBack, Source::RadioFront, Source::RadioPair];
        Self {
            streams: LinkStreams::new(seed, receivers, sources),
            sigma_db,
            drop_rate: params.drop_rate,
            limit_db: params.limit_db,
        }
    }
}

impl<P> Channel<P> for Noise {
    fn transfer(&mut self, link: Link, tick: u64, loss_db: f32, payload: P) -> Option<Received<P>> {
        // Draws of a pair are a function of its tick: what noise cannot bring below the limit needs none.
        if link.side.is_none() && loss_db - Normal::MOST * self.sigma_db >= self.limit_db {
            return None;
        }
        let stream = self.streams.of(link, tick);
        // Three draws, whatever happens: what arrives moves nobody's draws.
        let loss_db = loss_db + self.sigma_db * stream.normal();
        let arrives = stream.uniform() >= self.drop_rate;
        (arrives && loss_db < self.limit_db).then_some(Received { from: link.from, loss_db, payload })
    }
}
