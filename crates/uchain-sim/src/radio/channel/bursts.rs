//! Losses in bursts: in a burst nothing arrives (Gilbert 1960). Independent for every link.

use super::{Channel, FaultConfig, Link, Received, per_link::PerLink, streams::LinkStreams};
use crate::seed::{Seed, Source};

#[derive(Debug)]
pub(super) struct Bursts<P> {
    inner: Box<dyn Channel<P>>,
    streams: LinkStreams,
    in_burst: PerLink<bool>,
    begin: f32,
    end: f32,
}

impl<P> Bursts<P> {
    pub(super) fn new(inner: Box<dyn Channel<P>>, seed: Seed, receivers: u16, faults: &FaultConfig) -> Self {
        let sources = [Source::BurstBack, Source::BurstFront, Source::BurstPair];
        Self {
            inner,
            streams: LinkStreams::new(seed, receivers, sources),
            in_burst: PerLink::new(receivers),
            begin: faults.burst_rate,
            end: 1.0 / faults.burst_packets.max(1.0),
        }
    }
}

impl<P: std::fmt::Debug> Channel<P> for Bursts<P> {
    fn transfer(&mut self, link: Link, tick: u64, loss_db: f32, payload: P) -> Option<Received<P>> {
        let received = self.inner.transfer(link, tick, loss_db, payload);
        let draw = self.streams.of(link, tick).uniform();
        let burst = self.in_burst.of(link);
        *burst = if *burst { draw >= self.end } else { draw < self.begin };
        received.filter(|_| !*burst)
    }
}
