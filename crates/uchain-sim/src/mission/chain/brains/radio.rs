//! The radio of a run: packets arrive as they were said, or as the bytes that a drone sends.

use uchain_core::{
    chain::{BASE_ID, Packet},
    wire::{Message, SIZE_MAX, decode, encode},
};

use crate::{
    mission::chain::{Course, Scenario, UAVS_MAX},
    radio::{Channel, Link, Received, channel},
    seed::Seed,
};

// Every id of a chain is a number of the wire of its own, beside the base's.
const _: () = assert!(UAVS_MAX <= BASE_ID as usize);

/// The base as a receiver: one number beyond the UAVs', so that it draws from streams of its own.
pub(super) fn base_of(course: &Course) -> u16 {
    course.spawns.len() as u16
}

/// The radio of a run.
pub(super) fn radio_of(course: &Course, seed: Seed) -> Box<dyn Channel<Packet>> {
    let Scenario { radio, packets, faults, .. } = &course.scenario;
    let receivers = base_of(course) + 1;
    if packets.wire {
        let inner = channel(seed, receivers, radio, packets, faults);
        return Box::new(OverTheWire { inner, senders: vec![Sender::default(); receivers.into()] });
    }
    channel(seed, receivers, radio, packets, faults)
}

/// A packet on its way.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Sent {
    bytes: [u8; SIZE_MAX],
    length: usize,
}

impl Sent {
    fn of(message: &Message) -> Self {
        let mut bytes = [0; SIZE_MAX];
        let length = encode(message, &mut bytes);
        Self { bytes, length }
    }

    /// What it says; `None` if it is no packet.
    fn read(&self) -> Option<Message> {
        decode(self.bytes.get(..self.length)?).ok()
    }
}

/// Tick and number of a sender's last packet.
#[derive(Debug, Clone, Copy, Default)]
struct Sender(Option<(u64, u8)>);

impl Sender {
    /// The number of its packet of a tick, however many hear it.
    fn sequence(&mut self, tick: u64) -> u8 {
        let sequence = match self.0 {
            Some((last, sequence)) if last == tick => sequence,
            Some((_, sequence)) => sequence.wrapping_add(1),
            None => 0,
        };
        self.0 = Some((tick, sequence));
        sequence
    }
}

/// A channel of bytes, as one of packets: each is written where it is sent and read where it is heard. Noise, losses,
/// bursts, delay and one-way links lie between, and do with bytes what they do with packets.
#[derive(Debug)]
struct OverTheWire {
    inner: Box<dyn Channel<Sent>>,
    /// By id, the base last.
    senders: Vec<Sender>,
}

impl Channel<Packet> for OverTheWire {
    fn transfer(&mut self, link: Link, tick: u64, loss_db: f32, packet: Packet) -> Option<Received<Packet>> {
        let base = self.senders.len().saturating_sub(1);
        let sender = self.senders.get_mut(usize::from(link.from).min(base))?;
        let message = Message { from: link.from, sequence: sender.sequence(tick), packet };
        let received = self.inner.transfer(link, tick, loss_db, Sent::of(&message))?;
        let Message { from, packet, .. } = received.payload.read()?;
        Some(Received { from, loss_db: received.loss_db, payload: packet })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::radio::{FaultConfig, PacketParams, RadioParams};

    /// Whatever is sent arrives, and is kept.
    #[derive(Debug, Default)]
    struct Heard(std::sync::Arc<std::sync::Mutex<Vec<Message>>>);

    impl Channel<Sent> for Heard {
        fn transfer(&mut self, link: Link, _: u64, loss_db: f32, sent: Sent) -> Option<Received<Sent>> {
            self.0.lock().unwrap().push(sent.read().unwrap());
            Some(Received { from: link.from, loss_db, payload: sent })
        }
    }

    fn over(inner: impl Channel<Sent> + 'static) -> OverTheWire {
        OverTheWire { inner: Box::new(inner), senders: vec![Sender::default(); 4] }
    }

    fn link(from: u16, to: u16) -> Link {
        Link { from, to, side: None }
    }

    #[test]
    fn packets_are_numbered_by_sender_and_255_is_followed_by_0() {
        let heard = Heard::default();
        let log = heard.0.clone();
        let mut radio = over(heard);
        for tick in 0..600 {
            // Two hear the packet of UAV 2, which is one all the same; UAV 0 speaks half as often; the base speaks, too.
            for to in [1, 0] {
                radio.transfer(link(2, to), tick, 50.0, Packet::default());
            }
            if tick % 2 == 0 {
                radio.transfer(link(0, 1), tick, 50.0, Packet::default());
                radio.transfer(link(BASE_ID, 2), tick, 50.0, Packet::BASE);
            }
        }
        let numbers = |from| {
            let log = log.lock().unwrap();
            log.iter().filter(|message| message.from == from).map(|m| m.sequence).collect::<Vec<u8>>()
        };
        let counted = |count: usize, times: usize| {
            (0..count).flat_map(|i| vec![(i % 256) as u8; times]).collect::<Vec<u8>>()
        };
        assert_eq!(numbers(2), counted(600, 2));
        assert_eq!((numbers(0), numbers(BASE_ID)), (counted(300, 1), counted(300, 1)));
    }

    #[test]
    fn what_arrives_late_is_what_was_said_then_in_steps_and_is_lost_with_the_very_packets() {
        let params = PacketParams { delay_ticks: 4, ..PacketParams::default() };
        let faults = FaultConfig { burst_rate: 0.05, ..FaultConfig::default() };
        let mut bytes = over(channel(Seed(1), 4, &RadioParams::default(), &params, &faults));
        let mut packets: Box<dyn Channel<Packet>> =
            channel(Seed(1), 4, &RadioParams::default(), &params, &faults);
        let mut lost = 0;
        for tick in 0..400 {
            let packet =
                Packet { place: 3, ground_speed_mps: tick as f32 * 1e-4, own: [7; 8], ..Packet::default() };
            let got = bytes.transfer(link(2, 1), tick, 50.0, packet);
            let wanted = packets.transfer(link(2, 1), tick, 50.0, packet);
            lost += usize::from(wanted.is_none());
            assert_eq!(
                got.map(|heard| (heard.from, heard.loss_db)),
                wanted.map(|heard| (heard.from, heard.loss_db))
            );
            let (Some(got), Some(wanted)) = (got, wanted) else { continue };
            let (got_mps, said_mps) = (got.payload.ground_speed_mps, wanted.payload.ground_speed_mps);
            assert!((got_mps - said_mps).abs() <= 0.5 / 1024.0 && (got_mps * 1024.0).fract() == 0.0);
            assert_eq!(Packet { ground_speed_mps: said_mps, ..got.payload }, wanted.payload);
        }
        assert!((50..300).contains(&lost), "{lost}");
    }

    #[test]
    fn bytes_that_are_no_packet_are_heard_by_nobody() {
        /// One of another version.
        #[derive(Debug)]
        struct Other;

        impl Channel<Sent> for Other {
            fn transfer(
                &mut self,
                link: Link,
                _: u64,
                loss_db: f32,
                mut sent: Sent,
            ) -> Option<Received<Sent>> {
                sent.bytes[0] += 1;
                Some(Received { from: link.from, loss_db, payload: sent })
            }
        }
        assert_eq!(over(Other).transfer(link(2, 1), 0, 50.0, Packet::default()), None);
        assert!(over(Heard::default()).transfer(link(2, 1), 0, 50.0, Packet::default()).is_some());
    }
}
