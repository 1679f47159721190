//! What a node believes, and why it asks for what it asks: worked out on request, nothing is kept for it.

use super::{Estimates, Follow, Override, Role, Walls};

/// A brain's account of itself at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Explanation {
    /// Whether it leads the chain or relays.
    pub role: Role,
    /// Its place in the chain, 0 leads it; `None` if it was never told.
    pub place: Option<u16>,
    /// What it is doing.
    pub stage: Stage,
    /// What it makes of its two links, and what came of its wish.
    pub estimates: Estimates,
    /// Variance of the filtered loss of its back link (dB²); `None` before the first packet.
    pub back_variance_db2: Option<f32>,
    /// Variance of the filtered loss of its front link (dB²); `None` before the first packet.
    pub front_variance_db2: Option<f32>,
    /// Loss of the front link minus that of the back link, by the signal it decides on (dB): what it levels. `None` until
    /// both were heard.
    pub imbalance_db: Option<f32>,
    /// Forward speed that its law, or its pilot, wishes (m/s).
    pub wish_mps: f32,
    /// What its wish was overridden by, if it was.
    pub overridden: Option<Override>,
    /// The wall choice it flies by.
    pub follow: Follow,
    /// The walls that its centering steers by, given the distances it sees; `None` without distances, or if it steers by
    /// none.
    pub walls: Option<Walls>,
    /// Share of its forward speed that its distances to the walls leave it (0 to 1).
    pub speed_share: f32,
}

/// What a node is doing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Stage {
    /// On the ground, until the link that will be its own is weak enough for long enough.
    Waiting,
    /// Rising and hovering, until it has settled.
    Rising,
    /// Flying by its laws.
    Flying,
}

impl Stage {
    /// In a word, for people and programs.
    pub fn word(self) -> &'static str {
        match self {
            Self::Waiting => "waiting",
            Self::Rising => "rising",
            Self::Flying => "flying",
        }
    }
}
