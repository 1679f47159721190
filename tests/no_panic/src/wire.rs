//! Packets as bytes, whatever they are.

use std::hint::black_box;

use no_panic::no_panic;
use uchain_core::wire::{Message, SIZE_MAX, WireError};

#[no_panic]
fn encode(message: &Message, into: &mut [u8; SIZE_MAX]) -> usize {
    uchain_core::wire::encode(message, into)
}

#[no_panic]
fn decode(bytes: &[u8]) -> Result<Message, WireError> {
    uchain_core::wire::decode(bytes)
}

/// A message there and back, and bytes of any length, which the compiler cannot know.
pub(super) fn all() -> usize {
    let mut bytes = black_box([0; SIZE_MAX]);
    let length = encode(&black_box(Message::default()), &mut bytes);
    let any = black_box(vec![0; 64]);
    length + usize::from(decode(&any).is_ok()) + usize::from(decode(black_box(&bytes)).is_ok())
}
