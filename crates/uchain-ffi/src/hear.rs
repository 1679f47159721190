//! Packets, as bytes.

use core::slice;

use uchain_core::{
    chain::{self, Brain as _, Heard, Packet},
    wire::{self, Message, SIZE_MAX, WireError},
};

use crate::{
    Node, Observation, Status, UCHAIN_BASE_ID, UCHAIN_PACKET_MAX,
    node::{Inner, inner_mut},
    pointer,
};

/// Takes in a packet that the radio brought, for the next decision; of each sender the newest counts. `bytes` and `length`:
/// as received, whatever they are. `loss_db`: the received power (RSSI in dBm) with its sign changed (dB), bigger is worse.
///
/// Of more than 8 senders between two decisions those are kept that are next to the node's place, as it was told last; told none, a
/// relay believes to be the last before the base. `UCHAIN_STATUS_OUT_OF_RANGE`: the
/// loss is not finite.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn uchain_hear(node: *mut Node, bytes: *const u8, length: u32, loss_db: f32) -> Status {
    // SAFETY: as C was asked.
    let node = match unsafe { inner_mut(node) } {
        Ok(node) => node,
        Err(status) => return status,
    };
    if bytes.is_null() {
        return Status::BadPointer;
    }
    if length > UCHAIN_PACKET_MAX as u32 {
        return Status::TooLong;
    }
    // SAFETY: not NULL, and as many as C said, few enough for any memory.
    let bytes = unsafe { slice::from_raw_parts(bytes, length as usize) };
    match node.hear(bytes, loss_db) {
        Ok(()) => Status::Ok,
        Err(status) => status,
    }
}

impl Inner {
    fn hear(&mut self, bytes: &[u8], loss_db: f32) -> Result<(), Status> {
        let Message { from, packet, .. } = wire::decode(bytes).map_err(|error| match error {
            WireError::Short { .. } => Status::TooShort,
            WireError::Long { .. } => Status::TooLong,
            WireError::Version { .. } => Status::OtherVersion,
            _ => Status::Malformed,
        })?;
        if from == self.id {
            return Err(Status::OwnId);
        }
        if !loss_db.is_finite() {
            return Err(Status::OutOfRange);
        }
        if let Some(room) = self.room_for(from, packet.place) {
            *room = Some(Heard { from, loss_db, packet });
        }
        Ok(())
    }

    /// Where a packet of this sender goes: over its last one, to a free place, or over one that is not needed beside it.
    fn room_for(&mut self, from: u16, place: u16) -> Option<&mut Option<Heard>> {
        let of = |wanted: &dyn Fn(&Option<Heard>) -> bool| self.heard.iter().position(wanted);
        let index = of(&|room| room.is_some_and(|heard| heard.from == from))
            .or_else(|| of(&|room| room.is_none()))
            .or_else(|| self.spare(place))?;
        self.heard.get_mut(index)
    }

    /// A packet that is not needed beside one from this place: from farther away than the neighbours, or from a place that
    /// another one is from as well.
    fn spare(&self, newcomer: u16) -> Option<usize> {
        let own = self.place;
        let places = || self.heard.iter().flatten().map(|heard| heard.packet.place);
        let ahead = places().chain([newcomer]).filter(|place| *place < own).max();
        let behind = places().chain([newcomer]).filter(|place| *place > own).min();
        let mut with_index = self.heard.iter().flatten().enumerate();
        let is_spare = |(index, heard): &(usize, &Heard)| {
            let theirs = heard.packet.place;
            let is_next = [ahead, behind].contains(&Some(theirs));
            !is_next || theirs == newcomer || places().take(*index).any(|place| place == theirs)
        };
        // All places are taken, so that those that hold something are all there are.
        with_index.find(is_spare).map(|(index, _)| index)
    }
}

/// What the node tells whoever hears it: call it before `uchain_step`, with the same observation, and broadcast the first
/// bytes of `out`, as many as it returns (14 to `UCHAIN_PACKET_MAX`). `out` has room for `UCHAIN_PACKET_MAX` bytes. 0: a
/// pointer or a choice is wrong, and there is nothing to send.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn uchain_say(node: *mut Node, observation: *const Observation, out: *mut u8) -> u8 {
    // SAFETY: as C was asked.
    let (node, observation, out) = unsafe {
        (inner_mut(node), pointer::read(observation), pointer::write(out.cast::<[u8; SIZE_MAX]>()))
    };
    let (Ok(node), Ok(out)) = (node, out) else { return 0 };
    let mut seen = chain::Observation::default();
    if observation.and_then(|observation| observation.show(&mut seen)).is_err() {
        return 0;
    }
    let message = Message { from: node.id, sequence: node.sequence, packet: node.node.say(&seen) };
    node.sequence = node.sequence.wrapping_add(1);
    wire::encode(&message, out) as u8
}

/// What the base station tells whoever hears it, five times a second or more often: it stands still, behind everybody.
/// `sequence`: one more every time; 255 is followed by 0. `out` has room for `UCHAIN_PACKET_MAX` bytes. How many of them to
/// broadcast; 0: `out` is NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn uchain_say_base(sequence: u8, out: *mut u8) -> u8 {
    // SAFETY: as C was asked.
    let Ok(out) = (unsafe { pointer::write(out.cast::<[u8; SIZE_MAX]>()) }) else { return 0 };
    wire::encode(&Message { from: UCHAIN_BASE_ID, sequence, packet: Packet::BASE }, out) as u8
}
