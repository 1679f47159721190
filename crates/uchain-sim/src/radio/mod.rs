//! Radio: how much a link loses, and which packets arrive.

mod packets;
mod path_loss;

pub use packets::{PacketParams, Radio, Side};
pub use path_loss::{PathLoss, PathLossParams};
