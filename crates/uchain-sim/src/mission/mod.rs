//! Missions: who flies, who waits, what they tell each other.

mod chain;
mod explore;

pub use chain::ChainMission;
pub use explore::Team;
