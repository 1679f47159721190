//! The seam between the brain of a chain's UAV and its body: what it may know and ask, what it tells the others, what it
//! believes. Plain numbers, no position.

use core::fmt::Debug;

use arrayvec::ArrayVec;

use super::{Doing, Explanation};

/// Id of the base station, which is no UAV.
pub const BASE_ID: u16 = u16::MAX;

/// Packets that a UAV can take in per decision period.
pub const HEARD_MAX: usize = 8;

/// Range of the authors' ToF sensor (m), VL53L1x (Laclau 2021, §6.2).
pub const TOF_RANGE_M: f32 = 2.0;

/// Distances along the four diagonal ToF beams (m); a beam without a return reads its range limit.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Tof {
    /// Front left, +45° (m).
    pub nw_m: f32,
    /// Front right, −45° (m).
    pub ne_m: f32,
    /// Rear left, +135° (m).
    pub sw_m: f32,
    /// Rear right, −135° (m).
    pub se_m: f32,
}

/// Which wall to follow; the pilot's choice, repeated down the chain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Follow {
    /// Keep to the middle (Laclau 2021, Eq. 20).
    #[default]
    Centre,
    /// Keep the left wall (Eq. 21).
    Left,
    /// Keep the right wall (Eq. 21).
    Right,
}

impl Follow {
    /// In a word, the one that scenarios have for it.
    pub fn word(self) -> &'static str {
        match self {
            Self::Centre => "centre",
            Self::Left => "left",
            Self::Right => "right",
        }
    }

    /// The choice of a word; `None` if there is none of it.
    pub fn of_word(word: &str) -> Option<Self> {
        [Self::Centre, Self::Left, Self::Right].into_iter().find(|choice| choice.word() == word)
    }
}

/// What a UAV, or the base, says of itself in a packet.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Packet {
    /// Its place in the chain: 0 leads it, larger ones are nearer to the base; [`Packet::BASE_PLACE`] from the base.
    pub place: u16,
    /// Its forward ground speed by optic flow (m/s); 0 from the base.
    pub ground_speed_mps: f32,
    /// For how long it has been in the air (s); 0 from the base.
    pub flown_s: f32,
    /// The wall choice it flies by.
    pub follow: Follow,
    /// Largest imbalance of two links from here to the head, by the relays' own estimates (dB).
    pub imbalance_db: f32,
    /// The sender is the base station, which stands still.
    pub is_base: bool,
    /// Share of its battery's charge that is left (0 to 1); `None` if it does not measure it.
    pub battery: Option<f32>,
    /// Words of a law of one's own; the laws of this crate say zeros and heed none.
    pub own: [u8; 8],
}

impl Packet {
    /// The base's place in the chain: behind everybody.
    pub const BASE_PLACE: u16 = u16::MAX;

    /// What the base station says.
    pub const BASE: Self = Self {
        place: Self::BASE_PLACE,
        ground_speed_mps: 0.0,
        flown_s: 0.0,
        follow: Follow::Centre,
        imbalance_db: 0.0,
        is_base: true,
        battery: None,
        own: [0; 8],
    };
}

/// One packet as received.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Heard {
    /// Who sent it: a UAV's id, which it has for life, or [`BASE_ID`].
    pub from: u16,
    /// Measured loss of the link (dB), bigger is worse: the negated RSSI reading in dBm.
    pub loss_db: f32,
    /// What the sender said.
    pub packet: Packet,
}

/// What the radio brought in one decision period: at most [`HEARD_MAX`] packets, in no order that means anything.
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RadioSlot(ArrayVec<Heard, HEARD_MAX>);

impl RadioSlot {
    /// Takes a packet in; `false` if there is no room for it, and it is lost.
    pub fn push(&mut self, heard: Heard) -> bool {
        self.0.try_push(heard).is_ok()
    }

    /// Forgets all packets.
    pub fn clear(&mut self) {
        self.0.clear();
    }

    /// All packets.
    pub fn heard(&self) -> &[Heard] {
        &self.0
    }

    /// From the nearest one heard toward the base, seen from a place in the chain; of two that claim one place the first.
    // Once in a program: three copies of a short loop are flash that nobody gains from.
    #[inline(never)]
    pub fn back(&self, place: u16) -> Option<&Heard> {
        let mut nearest: Option<&Heard> = None;
        for heard in &self.0 {
            let theirs = heard.packet.place;
            if theirs > place && nearest.is_none_or(|nearest| theirs < nearest.packet.place) {
                nearest = Some(heard);
            }
        }
        nearest
    }

    /// From the nearest one heard toward the head, seen from a place in the chain; of two that claim one place the last.
    #[inline(never)]
    pub fn front(&self, place: u16) -> Option<&Heard> {
        let mut nearest: Option<&Heard> = None;
        for heard in &self.0 {
            let theirs = heard.packet.place;
            if theirs < place && nearest.is_none_or(|nearest| theirs >= nearest.packet.place) {
                nearest = Some(heard);
            }
        }
        nearest
    }
}

/// The first [`HEARD_MAX`] packets.
impl FromIterator<Heard> for RadioSlot {
    fn from_iter<I: IntoIterator<Item = Heard>>(packets: I) -> Self {
        Self(packets.into_iter().take(HEARD_MAX).collect())
    }
}

/// What the pilot of the head asks for: a speed and a wall, nothing else.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PilotInput {
    /// Forward speed, negative backward (m/s).
    pub speed_mps: f32,
    /// Wall to follow.
    pub follow: Follow,
}

/// All a chain node may know at one instant.
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Observation {
    /// Its place in the chain, 0 leads it; `None`: what it was told last.
    pub place: Option<u16>,
    /// A new set of distances, at the ToF rate; `None` in between.
    pub tof: Option<Tof>,
    /// A decision is due, with what the radio brought since the last one; `None` in between.
    pub radio: Option<RadioSlot>,
    /// Own forward ground speed by optic flow (m/s); `None` without a measurement.
    pub ground_speed_mps: Option<f32>,
    /// Share of the own battery's charge that is left (0 to 1); `None` without a measurement.
    pub battery: Option<f32>,
    /// The pilot's wish; only the head has a pilot.
    pub pilot: Option<PilotInput>,
}

/// All a chain node may ask of its body.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Command {
    /// Forward velocity (m/s).
    pub forward_mps: f32,
    /// Leftward velocity (m/s).
    pub lateral_mps: f32,
    /// Yaw rate, counter-clockwise (rad/s).
    pub yaw_rate_radps: f32,
    /// In the air, or asking to be.
    pub airborne: bool,
}

/// What a UAV makes of the link to one of its neighbours; all `None` before its first packet.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct LinkEstimate {
    /// Filtered loss (dB).
    pub filtered_db: Option<f32>,
    /// Loss of the last packet, as measured (dB).
    pub raw_db: Option<f32>,
    /// For how long nothing has been heard (s).
    pub silent_s: Option<f32>,
}

/// What a UAV believes, for records: nothing in a flight depends on it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Estimates {
    /// The link toward the base.
    pub back: LinkEstimate,
    /// The link toward the head.
    pub front: LinkEstimate,
    /// Forward speed by its laws and overrides, before it slows down near walls (m/s); `None` while it cannot fly freely:
    /// on the ground, and until it has risen and hovered.
    pub allowed_mps: Option<f32>,
}

/// The brain of a chain's UAV: it sees readings and returns wishes. The simulator and the drone drive it alike.
///
/// [`Node`](super::Node) is the built-in one; a law of one's own is another implementation. The same observations in the
/// same order must give the same commands, bit for bit: whatever is random is drawn from a generator with a fixed seed.
///
/// ```
/// use uchain_core::chain::{Brain, Command, Observation};
/// /// Flies toward the worse link at a fixed speed.
/// #[derive(Debug)]
/// struct Bang;
/// impl Brain for Bang {
///     fn decide(&mut self, seen: &Observation) -> Command {
///         let (place, radio) = (seen.place.unwrap_or(1), seen.radio.clone().unwrap_or_default());
///         let loss_db = |heard: Option<&uchain_core::chain::Heard>| heard.map_or(0.0, |heard| heard.loss_db);
///         let imbalance_db = loss_db(radio.front(place)) - loss_db(radio.back(place));
///         Command { forward_mps: 0.1 * imbalance_db.signum(), airborne: true, ..Command::default() }
///     }
/// }
/// assert!(Bang.decide(&Observation::default()).airborne);
/// ```
pub trait Brain: Debug + Send {
    /// One decision.
    fn decide(&mut self, seen: &Observation) -> Command;

    /// What it tells whoever hears it, before it decides on the same observation. Unless told otherwise: its place, its
    /// ground speed and its battery.
    fn say(&self, seen: &Observation) -> Packet {
        Packet {
            place: seen.place.unwrap_or(0),
            ground_speed_mps: seen.ground_speed_mps.unwrap_or(0.0),
            battery: seen.battery,
            ..Packet::default()
        }
    }

    /// How many places up and down the chain the packets come from that it is shown, as far as they arrive: 1, its two
    /// neighbours, to [`HEARD_MAX`] / 2.
    fn reach(&self) -> u16 {
        1
    }

    /// What it believes now, for records. A law that says nothing has empty records of its links.
    fn estimates(&self) -> Estimates {
        Estimates::default()
    }

    /// What it believes now, and why it asks for what it asks, given what it sees: worked out when somebody asks. `None`
    /// from a law that does not explain itself.
    fn explain(&self, _seen: &Observation) -> Option<Explanation> {
        None
    }

    /// What it is about after its decision on what it sees, for records; events are made of it. `None` from a law that does
    /// not say.
    fn doing(&self, _seen: &Observation) -> Option<Doing> {
        None
    }
}

/// Whichever brain.
#[cfg(feature = "alloc")]
impl<B: Brain + ?Sized> Brain for alloc::boxed::Box<B> {
    fn decide(&mut self, seen: &Observation) -> Command {
        (**self).decide(seen)
    }

    fn say(&self, seen: &Observation) -> Packet {
        (**self).say(seen)
    }

    fn reach(&self) -> u16 {
        (**self).reach()
    }

    fn estimates(&self) -> Estimates {
        (**self).estimates()
    }

    fn explain(&self, seen: &Observation) -> Option<Explanation> {
        (**self).explain(seen)
    }

    fn doing(&self, seen: &Observation) -> Option<Doing> {
        (**self).doing(seen)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn heard(from: u16, place: u16) -> Heard {
        Heard { from, loss_db: 50.0, packet: Packet { place, ..Packet::default() } }
    }

    #[test]
    fn front_and_back_are_the_nearest_places_heard_on_either_side_whatever_the_ids() {
        let base = Heard { from: BASE_ID, loss_db: 60.0, packet: Packet::BASE };
        let slot: RadioSlot = [heard(7, 0), base, heard(2, 5), heard(9, 3)].into_iter().collect();
        let around = |place| (slot.front(place).map(|h| h.from), slot.back(place).map(|h| h.from));
        assert_eq!(around(0), (None, Some(9)));
        assert_eq!(around(4), (Some(9), Some(2)));
        assert_eq!(around(5), (Some(9), Some(BASE_ID)));
        // Nobody hears himself: an own place is on neither side.
        assert_eq!(around(3), (Some(7), Some(2)));
    }

    #[test]
    fn of_two_that_claim_one_place_the_first_is_behind_and_the_last_is_ahead() {
        let slot: RadioSlot = [heard(1, 2), heard(2, 2), heard(3, 2)].into_iter().collect();
        assert_eq!(slot.back(1).map(|h| h.from), Some(1));
        assert_eq!(slot.front(3).map(|h| h.from), Some(3));
    }

    #[test]
    fn what_there_is_no_room_for_is_lost_and_said_so() {
        let mut slot: RadioSlot = (0..20).map(|i| heard(i, i)).collect();
        assert_eq!(slot.heard().len(), HEARD_MAX);
        assert!(!slot.push(heard(99, 99)));
        slot.clear();
        assert!(slot.push(heard(99, 99)) && slot.heard().len() == 1);
    }
}
