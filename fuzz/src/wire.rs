//! Whatever the radio brings.

use uchain_core::wire::{Message, SIZE_MAX, WireError, decode, encode};

/// Bytes as a packet.
///
/// # Panics
/// If they are read as a packet that holds what is no number, or another one once it is said on; or if what is too long is
/// read at all.
pub fn wire(bytes: &[u8]) {
    let read = decode(bytes);
    if bytes.len() > SIZE_MAX {
        assert!(matches!(read, Err(WireError::Long { .. } | WireError::Version { .. })), "{read:?}");
    }
    let Ok(message) = read else { return };
    let Message { packet, .. } = message;
    let numbers =
        [packet.ground_speed_mps, packet.flown_s, packet.imbalance_db, packet.battery.unwrap_or(0.0)];
    assert!(numbers.into_iter().all(f32::is_finite), "{packet:?}");
    assert!(packet.flown_s >= 0.0 && packet.imbalance_db >= 0.0, "{packet:?}");
    let mut said_on = [0; SIZE_MAX];
    let length = encode(&message, &mut said_on);
    assert_eq!(said_on.get(..length).map(decode), Some(Ok(message)));
}
