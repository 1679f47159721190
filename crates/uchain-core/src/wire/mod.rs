//! Packets as bytes: what a UAV says, in at most 30 of them, and back.
//!
//! A drone sends bytes, and its neighbour may run another program, in another language. [`encode`] writes a [`Message`],
//! [`decode`] reads one from whatever the radio brought. Neither needs a heap, and neither can panic.
//!
//! # Layout, version 1
//!
//! Numbers of more than one byte are little-endian. A value is the number on the wire times its step.
//!
//! | byte | field | unit | step | range | out of range | not finite |
//! |---|---|---|---|---|---|---|
//! | 0 | version, [`VERSION`] | | | 1 | refused: [`WireError::Version`] | |
//! | 1, bits 0 and 1 | `follow`: 0 centre, 1 left, 2 right | | | 0 to 2 | refused: [`WireError::Follow`] | |
//! | 1, bit 2 | `is_base` | | | 0 or 1 | | |
//! | 1, bits 3 to 7 | written as 0, not looked at | | | | | |
//! | 2, 3 | `from`: who sends; 65,535 is the base | id | 1 | 0 to 65,535 | | |
//! | 4 | `sequence`, one more with every packet of this sender; 255 is followed by 0 | packets | 1 | 0 to 255 | | |
//! | 5, 6 | `place`: 0 leads, 65,535 is the base's | places | 1 | 0 to 65,535 | | |
//! | 7, 8 | `ground_speed_mps`, signed | m/s | 1/1024 | −32 to 31.999 | the nearer end | 0 |
//! | 9, 10 | `flown_s` | s | 1/20 | 0 to 3,276.75 | the nearer end: it does not wrap | 0: it launches nobody |
//! | 11, 12 | `imbalance_db` | dB | 1/64 | 0 to 1,023.98 | the nearer end | the upper end: not level |
//! | 13 | `battery`; 255 is none | share | 1/254 | 0 to 1 | the nearer end | none |
//! | 14 on | sections, none or more | | | | refused: [`WireError::Section`] | |
//!
//! A number is rounded to the nearest step, halves away from 0, so it arrives at most half a step off: 0.5 mm/s, 0.025 s,
//! 0.008 dB, 0.2 % of a charge. The step of `flown_s` is the simulator's tick: a multiple of 0.05 s arrives as it was sent,
//! and `takeoff.after_previous_s`, 600 s at most, is compared with what the sender meant, for ever.
//!
//! # Sections
//!
//! The first byte of a section is 32 times its kind plus the length of its body, then comes the body.
//!
//! | kind | body | bytes, the first included |
//! |---|---|---|
//! | 0 | of any length, passed over; a byte of 0 is an empty one, so a packet may be filled up with zeros | 1 and more |
//! | 1 | `own`, the 8 words of a law of one's own; none if all are 0 | 9 |
//! | 2 | kept for the route round junctions: version, count, first index, 4 entries of 3 bytes | 16 |
//! | 3 to 7 | of no meaning yet | |
//!
//! Nobody says a route yet. [`decode`] passes over every section that it does not know, a route included: what is added in
//! a section of its own leaves the version as it is, and old and new firmware understand each other as far as both can.
//! Whatever changes the first 14 bytes, or a section that has a meaning, raises the version, and nobody reads a version
//! that is not his own.
//!
//! 14 bytes and the route are 30, exactly. The route *and* `own` would be 39, and do not go into one packet: [`encode`] writes
//! `own` and no route, and [`decode`] answers more than 30 bytes with [`WireError::Long`]. Firmware that says routes sends
//! them in packets whose `own` is 0.
//!
//! ```
//! use uchain_core::{chain::{Follow, Packet}, wire::{Message, SIZE_MAX, WireError, decode, encode}};
//!
//! let packet = Packet { place: 2, ground_speed_mps: -0.125, follow: Follow::Left, ..Packet::default() };
//! let message = Message { from: 7, sequence: 255, packet };
//! let mut bytes = [0; SIZE_MAX];
//! let length = encode(&message, &mut bytes);
//! assert_eq!(bytes[..length], [1, 1, 7, 0, 255, 2, 0, 128, 255, 0, 0, 0, 0, 255]);
//! assert_eq!(decode(&bytes[..length]), Ok(message));
//! assert_eq!(decode(&[2, 0, 0]), Err(WireError::Version { got: 2 }));
//! ```

mod error;
mod step;
#[cfg(test)]
mod tests;

use crate::chain::{Follow, Packet};

pub use error::WireError;
use step::{BATTERY, FLOWN_S, IMBALANCE_DB, SPEED_MPS};

/// Version of the layout, the first byte of every packet.
pub const VERSION: u8 = 1;

/// Most bytes of a packet: what the authors' firmware sends to its neighbours at once.
pub const SIZE_MAX: usize = 30;

/// Bytes that every packet has, before its sections.
pub const SIZE_MIN: usize = 14;

/// Bytes of a route's section: its kind and length, version, count, first index, 4 entries of 3 bytes.
const ROUTE_SECTION: usize = 1 + 3 + 4 * 3;
const _: () = assert!(SIZE_MIN + ROUTE_SECTION <= SIZE_MAX, "a packet has room for a route");

/// Bits of a section's first byte that hold its length; its kind is above them.
const LENGTH_BITS: u8 = 5;
/// The kind of section that holds the words of a law of one's own.
const OWN: u8 = 1;
/// The first byte of that section: its kind and its 8 bytes.
const OWN_HEAD: u8 = OWN << LENGTH_BITS | 8;

const FOLLOW_BITS: u8 = 0b11;
const IS_BASE_BIT: u8 = 0b100;
/// No battery is measured.
const NO_BATTERY: u8 = 255;

/// What is said on the air: a packet, and whose it is.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Message {
    /// Who sends: a UAV's id, which it has for life, or [`BASE_ID`](crate::chain::BASE_ID).
    pub from: u16,
    /// One more with every packet of this sender; 255 is followed by 0. Who hears it tells packets apart by it.
    pub sequence: u8,
    /// What it says.
    pub packet: Packet,
}

/// Writes a message as bytes; how many they are. It cannot fail: the [table](self#layout-version-1) says what becomes of
/// values that the wire does not hold. The rest of the room is filled with zeros, which [`decode`] passes over, so that all
/// 30 bytes may be sent as well.
pub fn encode(message: &Message, into: &mut [u8; SIZE_MAX]) -> usize {
    let Message { from, sequence, packet } = message;
    let follow = match packet.follow {
        Follow::Centre => 0,
        Follow::Left => 1,
        Follow::Right => 2,
    };
    let flags = follow | if packet.is_base { IS_BASE_BIT } else { 0 };
    let [from_low, from_high] = from.to_le_bytes();
    let [place_low, place_high] = packet.place.to_le_bytes();
    let speed = SPEED_MPS.count(packet.ground_speed_mps).map_or(0, |steps| steps as i16);
    let [speed_low, speed_high] = speed.to_le_bytes();
    let flown = FLOWN_S.count(packet.flown_s).map_or(0, |steps| steps as u16);
    let [flown_low, flown_high] = flown.to_le_bytes();
    let imbalance = IMBALANCE_DB.count(packet.imbalance_db).map_or(u16::MAX, |steps| steps as u16);
    let [imbalance_low, imbalance_high] = imbalance.to_le_bytes();
    let battery = packet.battery.and_then(|share| BATTERY.count(share));
    let battery = battery.map_or(NO_BATTERY, |steps| steps as u8);
    // Eight words of 0 behind a head of 0 are nine empty sections.
    let has_own = packet.own != [0; 8];
    let head = if has_own { OWN_HEAD } else { 0 };
    let [o0, o1, o2, o3, o4, o5, o6, o7] = packet.own;
    *into = [
        VERSION,
        flags,
        from_low,
        from_high,
        *sequence,
        place_low,
        place_high,
        speed_low,
        speed_high,
        flown_low,
        flown_high,
        imbalance_low,
        imbalance_high,
        battery,
        head,
        o0,
        o1,
        o2,
        o3,
        o4,
        o5,
        o6,
        o7,
        0,
        0,
        0,
        0,
        0,
        0,
        0,
    ];
    if has_own { SIZE_MIN + 1 + packet.own.len() } else { SIZE_MIN }
}

/// Reads a message from bytes, whatever they are. A packet of another version is told by its version, however long it is.
///
/// # Errors
/// [`WireError`] says what is wrong with them; what was read until then is worth nothing.
pub fn decode(bytes: &[u8]) -> Result<Message, WireError> {
    let got = bytes.len();
    let version = *bytes.first().ok_or(WireError::Short { got })?;
    if version != VERSION {
        return Err(WireError::Version { got: version });
    }
    if got > SIZE_MAX {
        return Err(WireError::Long { got });
    }
    let (fields, sections) = bytes.split_first_chunk::<SIZE_MIN>().ok_or(WireError::Short { got })?;
    let [_, flags, f0, f1, sequence, p0, p1, s0, s1, t0, t1, i0, i1, battery] = *fields;
    let follow = match flags & FOLLOW_BITS {
        0 => Follow::Centre,
        1 => Follow::Left,
        2 => Follow::Right,
        got => return Err(WireError::Follow { got }),
    };
    let packet = Packet {
        place: u16::from_le_bytes([p0, p1]),
        ground_speed_mps: SPEED_MPS.value(i16::from_le_bytes([s0, s1])),
        flown_s: FLOWN_S.value(u16::from_le_bytes([t0, t1])),
        follow,
        imbalance_db: IMBALANCE_DB.value(u16::from_le_bytes([i0, i1])),
        is_base: flags & IS_BASE_BIT != 0,
        battery: (battery != NO_BATTERY).then(|| BATTERY.value(battery)),
        own: own_of(sections)?,
    };
    Ok(Message { from: u16::from_le_bytes([f0, f1]), sequence, packet })
}

/// The words of a law of one's own, zeros if there are none.
fn own_of(mut sections: &[u8]) -> Result<[u8; 8], WireError> {
    let mut own = [0; 8];
    while let Some((&head, rest)) = sections.split_first() {
        let (kind, length) = (head >> LENGTH_BITS, head & ((1 << LENGTH_BITS) - 1));
        let cut = WireError::Section { kind, length };
        let (body, next) = rest.split_at_checked(length.into()).ok_or(cut)?;
        if kind == OWN {
            own = body.try_into().map_err(|_| cut)?;
        }
        sections = next;
    }
    Ok(own)
}
