//! What can go wrong with a radio beyond chance: bursts, one-way links, delay. Each wraps a receiver.

use std::collections::VecDeque;

use serde::{Deserialize, Serialize};
use uchain_core::chain::{Heard, Packet};

use super::{PacketParams, Radio, Receiver, Side};
use crate::{
    clock::time_s,
    seed::{Seed, Source, Stream},
};

uchain_core::params! {
    /// Planned faults of a mission; none by default.
    #[derive(Serialize, Deserialize)]
    #[serde(default, deny_unknown_fields)]
    pub struct FaultConfig {
        /// Chance that a burst of losses begins at a packet, per packet and link end (1).
        /// - Source: Gilbert 1960
        pub burst_rate: f32 = 0.0, in 0.0..=1.0;
        /// Mean length of a burst (packets).
        /// - Source: Gilbert 1960
        pub burst_packets: f32 = 10.0, in 1.0..=100_000.0;
        /// Links that work one way only.
        pub deaf: Vec<Deaf> = Vec::new();
        /// UAVs that fail: from then on they neither fly nor speak.
        pub dead: Vec<Dead> = Vec::new();
    }
}

uchain_core::params! {
    /// A UAV that hears nothing from one side for a while.
    #[derive(Copy, Serialize, Deserialize)]
    #[serde(deny_unknown_fields)]
    pub struct Deaf {
        /// The UAV, 0 = head; one of the chain.
        pub uav: usize, in 0..=999;
        /// The neighbour it does not hear.
        pub side: DeafSide;
        /// From when on (s).
        /// - Source: ours
        #[serde(default)]
        pub start_s: f64, in 0.0..=86_400.0;
        /// Until when (s), later than `start_s`; to the end if left out.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[schemars(range(min = 0.0, max = 86_400.0))]
        pub stop_s: Option<f64>;
    }
}

/// A side, as in a scenario file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum DeafSide {
    /// Toward the base.
    Back,
    /// Toward the head.
    Front,
}

uchain_core::params! {
    /// A UAV that fails for good. Its neighbours listen to the next UAV in line from that moment on, their filters going
    /// on with what they knew of the old link.
    #[derive(Copy, Serialize, Deserialize)]
    #[serde(deny_unknown_fields)]
    pub struct Dead {
        /// The UAV, 0 = head; one of the chain.
        pub uav: usize, in 0..=999;
        /// When (s).
        pub start_s: f64, in 0.0..=86_400.0;
    }
}

/// The receiver of one robot with everything that is wrong with it.
pub fn receiver(
    seed: Seed,
    robot: usize,
    sigma_db: f32,
    packets: &PacketParams,
    faults: &FaultConfig,
) -> Box<dyn Receiver> {
    let index = robot as u32;
    let mut receiver: Box<dyn Receiver> = Box::new(Radio::new(seed, index, sigma_db, packets));
    if faults.burst_rate > 0.0 {
        let streams = [Source::BurstBack, Source::BurstFront].map(|source| seed.stream(index, source));
        receiver = Box::new(Bursty::new(receiver, streams, faults.burst_rate, faults.burst_packets));
    }
    if packets.delay_ticks > 0 {
        receiver = Box::new(Late::new(receiver, u64::from(packets.delay_ticks)));
    }
    // Around the delay: who is deaf does not hear what comes in while it is, whenever that was sent.
    let deaf: Vec<Deaf> = faults.deaf.iter().filter(|deaf| deaf.uav == robot).copied().collect();
    if !deaf.is_empty() {
        receiver = Box::new(OneWay { inner: receiver, deaf });
    }
    receiver
}

/// Losses in bursts: in a burst nothing arrives (Gilbert 1960). Independent for the two sides.
#[derive(Debug)]
struct Bursty {
    inner: Box<dyn Receiver>,
    streams: [Stream; 2],
    in_burst: [bool; 2],
    begin: f32,
    end: f32,
}

impl Bursty {
    fn new(inner: Box<dyn Receiver>, streams: [Stream; 2], rate: f32, packets: f32) -> Self {
        Self { inner, streams, in_burst: [false; 2], begin: rate, end: 1.0 / packets.max(1.0) }
    }
}

impl Receiver for Bursty {
    fn receive(&mut self, tick: u64, side: Side, true_db: f32, from: u16, packet: Packet) -> Option<Heard> {
        let heard = self.inner.receive(tick, side, true_db, from, packet);
        let draw = self.streams[side as usize].uniform();
        let burst = &mut self.in_burst[side as usize];
        *burst = if *burst { draw >= self.end } else { draw < self.begin };
        heard.filter(|_| !*burst)
    }
}

/// Deaf on one side for a while.
#[derive(Debug)]
struct OneWay {
    inner: Box<dyn Receiver>,
    deaf: Vec<Deaf>,
}

impl Receiver for OneWay {
    fn receive(&mut self, tick: u64, side: Side, true_db: f32, from: u16, packet: Packet) -> Option<Heard> {
        let heard = self.inner.receive(tick, side, true_db, from, packet);
        let now_s = time_s(tick);
        let deaf = self.deaf.iter().any(|deaf| {
            let same_side = (deaf.side == DeafSide::Back) == (side == Side::Back);
            same_side && now_s >= deaf.start_s && deaf.stop_s.is_none_or(|stop_s| now_s < stop_s)
        });
        heard.filter(|_| !deaf)
    }
}

/// Packets arrive late; of those that arrive together the newest counts.
#[derive(Debug)]
struct Late {
    inner: Box<dyn Receiver>,
    delay_ticks: u64,
    under_way: [VecDeque<(u64, Heard)>; 2],
}

impl Late {
    fn new(inner: Box<dyn Receiver>, delay_ticks: u64) -> Self {
        Self { inner, delay_ticks, under_way: [VecDeque::new(), VecDeque::new()] }
    }
}

impl Receiver for Late {
    fn receive(&mut self, tick: u64, side: Side, true_db: f32, from: u16, packet: Packet) -> Option<Heard> {
        let under_way = &mut self.under_way[side as usize];
        if let Some(heard) = self.inner.receive(tick, side, true_db, from, packet) {
            under_way.push_back((tick + self.delay_ticks, heard));
        }
        let mut newest = None;
        while under_way.front().is_some_and(|(due, _)| *due <= tick) {
            newest = under_way.pop_front().map(|(_, heard)| heard);
        }
        newest
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Hears everything and keeps the time it heard it as the loss.
    #[derive(Debug)]
    struct Perfect;

    impl Receiver for Perfect {
        fn receive(&mut self, tick: u64, _: Side, _: f32, from: u16, packet: Packet) -> Option<Heard> {
            Some(Heard { from, loss_db: tick as f32, packet })
        }
    }

    fn hear(receiver: &mut dyn Receiver, tick: u64, side: Side) -> Option<f32> {
        receiver.receive(tick, side, 0.0, 0, Packet::default()).map(|heard| heard.loss_db)
    }

    #[test]
    fn bursts_have_the_mean_length_and_the_share_asked_for() {
        let streams = [Source::BurstBack, Source::BurstFront].map(|s| Seed(1).stream(0, s));
        let mut bursty = Bursty::new(Box::new(Perfect), streams, 0.02, 10.0);
        let heard: Vec<bool> =
            (0..200_000).map(|tick| hear(&mut bursty, tick, Side::Back).is_some()).collect();
        let lost = heard.iter().filter(|heard| !**heard).count() as f64;
        let bursts = heard.windows(2).filter(|pair| pair[0] && !pair[1]).count() as f64;
        assert!((lost / bursts - 10.0).abs() < 0.5, "{} packets a burst", lost / bursts);
        assert!((lost / 200_000.0 - 1.0 / 6.0).abs() < 0.01, "{} of all", lost / 200_000.0);
    }

    #[test]
    fn a_one_way_link_is_deaf_on_its_side_and_in_its_time_only() {
        let deaf = Deaf { uav: 0, side: DeafSide::Back, start_s: 1.0, stop_s: Some(2.0) };
        let mut one_way = OneWay { inner: Box::new(Perfect), deaf: vec![deaf] };
        let back = [19, 20, 39, 40].map(|tick| hear(&mut one_way, tick, Side::Back).is_some());
        assert_eq!(back, [true, false, false, true]);
        assert!(hear(&mut one_way, 30, Side::Front).is_some());
    }

    #[test]
    fn a_late_packet_is_heard_at_the_first_decision_after_its_delay() {
        let mut late = Late::new(Box::new(Perfect), 6);
        let heard = [0, 4, 8, 12, 16].map(|tick| hear(&mut late, tick, Side::Back));
        assert_eq!(heard, [None, None, Some(0.0), Some(4.0), Some(8.0)]);
        assert_eq!(hear(&mut late, 16, Side::Front), None);
    }

    #[test]
    fn a_deaf_uav_hears_no_late_packet_while_it_is_deaf_and_afterwards_what_was_sent_meanwhile() {
        let packets = PacketParams { delay_ticks: 8, drop_rate: 0.0, ..PacketParams::default() };
        let deaf = vec![Deaf { uav: 2, side: DeafSide::Back, start_s: 1.0, stop_s: Some(2.0) }];
        let mut whole = receiver(Seed(1), 2, 0.0, &packets, &FaultConfig { deaf, ..FaultConfig::default() });
        // A sample tells when it was sent.
        let mut heard_at = |tick: u64| {
            let heard = whole.receive(tick, Side::Back, tick as f32, 0, Packet::default());
            heard.map(|heard| heard.loss_db)
        };
        let heard: Vec<Option<f32>> = (0..=44).step_by(4).map(&mut heard_at).collect();
        let (before, deaf, after) = (&heard[..5], &heard[5..10], &heard[10..]);
        assert_eq!(before, [None, None, Some(0.0), Some(4.0), Some(8.0)]);
        assert_eq!(deaf, [None; 5], "sent before it was deaf, two of them");
        assert_eq!(after, [Some(32.0), Some(36.0)], "sent while it was deaf");
    }

    #[test]
    fn without_faults_a_receiver_is_the_bare_radio() {
        let packets = PacketParams::default();
        let mut bare = Radio::new(Seed(1), 2, 3.0, &packets);
        let mut whole = receiver(Seed(1), 2, 3.0, &packets, &FaultConfig::default());
        for tick in 0..100 {
            assert_eq!(hear(&mut bare, tick, Side::Back), hear(whole.as_mut(), tick, Side::Back));
        }
    }
}
