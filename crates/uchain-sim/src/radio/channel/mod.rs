//! What is heard over a link: one channel for all links of a run.

mod bursts;
mod delay;
mod noise;
mod one_way;
mod per_link;
mod reading;
mod streams;
#[cfg(test)]
mod tests;

use std::fmt::Debug;

use super::{FaultConfig, PacketParams, RadioParams};
use crate::seed::Seed;

use bursts::Bursts;
use delay::Delayed;
use noise::Noise;
use one_way::OneWay;
use reading::Reading;

/// Which neighbour in a chain a packet comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Toward the base.
    Back,
    /// Toward the head.
    Front,
}

/// The way of a packet. Links are told apart by their ends, and those of neighbours in a chain by receiver and side: a
/// UAV's link to the back stays the same link when another one takes the place behind it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Link {
    /// Who sends.
    pub from: u16,
    /// Who may hear it.
    pub to: u16,
    /// Which neighbour of the receiver sends; `None` of two that are no neighbours in a chain.
    pub side: Option<Side>,
}

/// A packet as it came in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Received<P> {
    /// Who sent it.
    pub from: u16,
    /// The loss that the receiver measured (dB).
    pub loss_db: f32,
    /// What was sent.
    pub payload: P,
}

/// What becomes of packets on their way. Whatever goes wrong with radio is a channel around another one, which keeps a
/// state of its own for each link: what happens on one link moves nothing on any other.
///
/// ```
/// use uchain_sim::{radio::{Channel, FaultConfig, Link, PacketParams, RadioParams, Received, channel}, seed::Seed};
///
/// /// Every wall of a mine hums: from 0 to 9 s of each minute nobody hears anybody.
/// #[derive(Debug)]
/// struct Humming<C>(C);
///
/// impl<P, C: Channel<P>> Channel<P> for Humming<C> {
///     fn transfer(&mut self, link: Link, tick: u64, loss_db: f32, payload: P) -> Option<Received<P>> {
///         self.0.transfer(link, tick, loss_db, payload).filter(|_| tick % 1200 >= 180)
///     }
/// }
///
/// let packets = PacketParams { drop_rate: 0.0, ..PacketParams::default() };
/// let mut radio = Humming(channel(Seed(1), 2, &RadioParams::default(), &packets, &FaultConfig::default()));
/// let link = Link { from: 0, to: 1, side: None };
/// assert_eq!(radio.transfer(link, 100, 50.0, "hello"), None);
/// assert_eq!(radio.transfer(link, 180, 50.0, "hello").unwrap().payload, "hello");
/// ```
pub trait Channel<P>: Debug + Send {
    /// What comes in at `tick`, given a packet that is sent then over a link of this true loss (dB): this one, an earlier
    /// one that was under way, or nothing. A link is asked at rising ticks, at most once in each.
    fn transfer(&mut self, link: Link, tick: u64, loss_db: f32, payload: P) -> Option<Received<P>>;
}

impl<P> Channel<P> for Box<dyn Channel<P>> {
    fn transfer(&mut self, link: Link, tick: u64, loss_db: f32, payload: P) -> Option<Received<P>> {
        (**self).transfer(link, tick, loss_db, payload)
    }
}

/// The radio of one run with everything that is wrong with it: noise or fading, random losses and the limit; then
/// what receivers show of it, bursts, delay and one-way links, as far as there are any. Room is made for `receivers` whose numbers begin at 0;
/// there may be more.
pub fn channel<P: Debug + Send + 'static>(
    seed: Seed,
    receivers: u16,
    radio: &RadioParams,
    packets: &PacketParams,
    faults: &FaultConfig,
) -> Box<dyn Channel<P>> {
    let mut channel: Box<dyn Channel<P>> = Box::new(Noise::new(seed, receivers, radio, packets));
    if Reading::<P>::is_asked_for(radio) {
        channel = Box::new(Reading::new(channel, seed, receivers, radio));
    }
    if faults.burst_rate > 0.0 {
        channel = Box::new(Bursts::new(channel, seed, receivers, faults));
    }
    if packets.delay_ticks > 0 {
        channel = Box::new(Delayed::new(channel, receivers, packets.delay_ticks));
    }
    // Around the delay: who is deaf does not hear what comes in while it is, whenever that was sent.
    if !faults.deaf.is_empty() {
        channel = Box::new(OneWay::new(channel, &faults.deaf));
    }
    channel
}
