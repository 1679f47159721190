//! Radio: how much a link loses, and which packets arrive.

mod faults;
mod packets;
mod path_loss;

pub use faults::{Dead, Deaf, DeafSide, FaultConfig, receiver};
pub use packets::{PacketParams, Radio, Receiver, Side};
pub use path_loss::{Antenna, PathLoss, PathLossParams, Shadowing};
