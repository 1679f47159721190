//! Missions: who flies, who waits, what they tell each other.

mod chain;

pub use chain::ChainMission;
